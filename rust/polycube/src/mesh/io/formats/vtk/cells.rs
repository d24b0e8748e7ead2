//! The cells that legacy and XML VTK files share.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::io::scalar::whole;
use crate::mesh::io::soup::Soup;
use crate::mesh::{CellKind, Point};

/// Names of arrays of the cells that are taken for their numbers, the first that is there.
const TAG_NAMES: [&str; 8] =
    ["label", "labels", "flag", "flags", "medit:ref", "gmsh:physical", "CellEntityIds", "MaterialIds"];

/// Which of the arrays is taken for the numbers of the cells: one of a known name, or else the only one of integers.
pub(super) fn choose_tags<T>(arrays: Vec<(String, bool, T)>) -> Option<T> {
    let place = |name: &&str| arrays.iter().position(|array| array.0.eq_ignore_ascii_case(name));
    let known = TAG_NAMES.iter().find_map(place);
    let mut integers = (0..arrays.len()).filter(|&i| arrays[i].1);
    let only = integers.next().filter(|_| integers.next().is_none());
    known.or(only).and_then(|i| arrays.into_iter().nth(i)).map(|array| array.2)
}

/// VTK's number of a polygon.
pub(super) const POLYGON: u8 = 7;

/// VTK's number of a kind of cell.
pub(super) fn number_of(kind: CellKind) -> u8 {
    match kind {
        CellKind::Triangles => 5,
        CellKind::Quads => 9,
        CellKind::Tetrahedra => 10,
        CellKind::Hexahedra => 12,
    }
}

/// The points of a list of coordinates, which must come in threes.
pub(super) fn points(coordinates: &[f64]) -> Vec<Point> {
    let triples = coordinates.chunks_exact(3);
    triples.map(|x| Point::new(x[0], x[1], x[2])).collect()
}

/// Cells of any kind: cell `i` has the kind `types[i]` and its corners are those before `ends[i]`.
pub(super) struct VtkCells {
    pub(super) types: Vec<f64>,
    pub(super) ends: Vec<f64>,
    pub(super) corners: Vec<f64>,
    /// A number of each cell, or none.
    pub(super) tags: Vec<f64>,
}

impl VtkCells {
    /// Adds the cells over points that start at `base`.
    pub(super) fn add_to(&self, soup: &mut Soup, base: u32) -> Result<()> {
        if self.types.len() != self.ends.len() {
            let (cells, types) = (self.ends.len(), self.types.len());
            let message = format!("the file lists {cells} cells but the types of {types}");
            return Err(Error::new(ErrorKind::Parse, message));
        }
        let mut corners = Vec::new();
        let mut start = 0;
        for (i, (kind, end)) in self.types.iter().zip(&self.ends).enumerate() {
            let here = |error: Error| error.at(Place::Cell(u32::try_from(i).unwrap_or(u32::MAX)));
            let end = whole(*end).map_err(here)? as usize;
            let range = self.corners.get(start..end);
            let range = range.ok_or_else(|| here(bad_offset(end, self.corners.len())))?;
            corners.clear();
            for &corner in range {
                let vertex = whole(corner).map_err(here)?;
                // Beyond every vertex the index is refused later, with those of other cells.
                corners.push(base.saturating_add(vertex));
            }
            if add(soup, *kind, &mut corners).map_err(here)? {
                soup.tag(self.tags.get(i).filter(|tag| tag.fract() == 0.0).map(|&tag| tag as i64));
            }
            start = end;
        }
        Ok(())
    }
}

fn bad_offset(end: usize, corners: usize) -> Error {
    let message = format!("its corners end at {end} of {corners}");
    Error::new(ErrorKind::Parse, message)
}

/// Adds a cell and says whether it did: of vertices and lines nothing is made.
fn add(soup: &mut Soup, kind: f64, corners: &mut [u32]) -> Result<bool> {
    match (whole(kind)?, &mut *corners) {
        (0..=4, _) => Ok(false),
        (5, [_, _, _]) | (9, [_, _, _, _]) | (7, _) => soup.polygon(corners, 0).map(|()| true),
        (8, [_, _, c, d]) => {
            std::mem::swap(c, d);
            soup.polygon(corners, 0).map(|()| true)
        }
        (10, &mut [a, b, c, d]) => {
            soup.tetrahedron([a, b, c, d], 0);
            Ok(true)
        }
        (12, &mut [a, b, c, d, e, f, g, h]) | (11, &mut [a, b, d, c, e, f, h, g]) => {
            soup.hexahedron([a, b, c, d, e, f, g, h], 0);
            Ok(true)
        }
        (5 | 8..=12, _) => {
            let message = format!("a cell of VTK's type {kind} with {} corners", corners.len());
            Err(Error::new(ErrorKind::Parse, message))
        }
        (21..=37 | 60..=81, _) => {
            let message = format!("a quadratic or higher cell, VTK's type {kind}");
            Err(Error::new(ErrorKind::Unsupported, message).remedy("export linear cells, without nodes on edges"))
        }
        _ => {
            let message = format!("a cell of VTK's type {kind}");
            Err(Error::new(ErrorKind::Unsupported, message)
                .remedy("export linear triangles, quadrilaterals, polygons, tetrahedra or hexahedra"))
        }
    }
}
