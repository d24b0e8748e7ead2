//! What a file holds, before one kind of cell is chosen for the mesh.

use super::polygon::triangles;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::checked::check_points;
use crate::mesh::{Cells, Mesh, Point};
use std::collections::HashMap;

#[derive(Clone, Copy, PartialEq, Eq)]
enum Shape {
    Polygon,
    Tetrahedron,
    Hexahedron,
}

struct Entry {
    shape: Shape,
    /// Line in the file, or 0 where lines mean nothing.
    line: usize,
    end: usize,
    /// A number that the file gives it: a reference, a group, a material.
    tag: Option<i64>,
    /// The place of its group's name, where that has one.
    name: Option<u32>,
}

/// What a file calls a group of faces.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum GroupKey<'a> {
    Name(&'a str),
    Number(i64),
}

/// Points and polygons, tetrahedra and hexahedra over them, in the order of the file.
#[derive(Default)]
pub(super) struct Soup {
    /// Vertex positions.
    pub(super) points: Vec<Point>,
    corners: Vec<u32>,
    entries: Vec<Entry>,
    /// Names of groups in the order in which the file has them.
    names: Vec<String>,
    places: HashMap<String, u32>,
}

impl Soup {
    fn add(&mut self, shape: Shape, corners: &[u32], line: usize) {
        self.corners.extend_from_slice(corners);
        let end = self.corners.len();
        self.entries.push(Entry { shape, line, end, tag: None, name: None });
    }

    /// Adds a face. `line` is where the file says so, 0 where lines mean nothing.
    pub(super) fn polygon(&mut self, corners: &[u32], line: usize) -> Result<()> {
        if corners.len() < 3 {
            let message = format!("a face of {} corners", corners.len());
            return Err(Error::new(ErrorKind::Parse, message)
                .at(place(line, self.entries.len()))
                .remedy("every face needs three corners or more"));
        }
        self.add(Shape::Polygon, corners, line);
        Ok(())
    }

    /// Gives what was added last a number.
    pub(super) fn tag(&mut self, tag: Option<i64>) {
        if let Some(entry) = self.entries.last_mut() {
            entry.tag = tag;
        }
    }

    /// The number of a group of this name, for [`put_in`](Self::put_in).
    pub(super) fn group(&mut self, name: &[u8]) -> u32 {
        let name = String::from_utf8_lossy(name.trim_ascii());
        if let Some(&known) = self.places.get(name.as_ref()) {
            return known;
        }
        let place = u32::try_from(self.names.len()).unwrap_or(u32::MAX);
        self.places.insert(name.clone().into_owned(), place);
        self.names.push(name.into_owned());
        place
    }

    /// Puts what was added last into a group.
    pub(super) fn put_in(&mut self, group: Option<u32>) {
        if let Some(entry) = self.entries.last_mut() {
            entry.name = group;
        }
    }

    /// The group of each face that the file lists, by its name or else by its number, if it has either.
    pub(super) fn groups_of_polygons(&self) -> impl Iterator<Item = Option<GroupKey<'_>>> {
        let polygons = self.entries.iter().filter(|entry| entry.shape == Shape::Polygon);
        polygons.map(|entry| {
            let name = entry.name.map(|i| GroupKey::Name(&self.names[i as usize]));
            name.or(entry.tag.map(GroupKey::Number))
        })
    }

    /// The number of each face that the file lists, if it has one.
    pub(super) fn tags_of_polygons(&self) -> impl Iterator<Item = Option<i64>> {
        self.entries.iter().filter(|entry| entry.shape == Shape::Polygon).map(|entry| entry.tag)
    }

    /// Adds a tetrahedron.
    pub(super) fn tetrahedron(&mut self, corners: [u32; 4], line: usize) {
        self.add(Shape::Tetrahedron, &corners, line);
    }

    /// Adds a hexahedron.
    pub(super) fn hexahedron(&mut self, corners: [u32; 8], line: usize) {
        self.add(Shape::Hexahedron, &corners, line);
    }

    fn entries(&self) -> impl Iterator<Item = (&Entry, &[u32])> {
        let mut start = 0;
        self.entries.iter().map(move |entry| {
            let corners = &self.corners[start..entry.end];
            start = entry.end;
            (entry, corners)
        })
    }

    /// The corners of each face that the file lists, those beside a volume, too.
    pub(super) fn polygons(&self) -> impl Iterator<Item = &[u32]> {
        self.of(Shape::Polygon)
    }

    fn of(&self, shape: Shape) -> impl Iterator<Item = &[u32]> {
        self.entries().filter(move |(entry, _)| entry.shape == shape).map(|(_, corners)| corners)
    }

    fn check(&self) -> Result<()> {
        check_points(&self.points)?;
        if self.entries.is_empty() {
            return Err(Error::new(ErrorKind::Mesh, "the file holds no cells")
                .remedy("export faces, tetrahedra or hexahedra along with the vertices"));
        }
        let count = self.points.len();
        for (i, (entry, corners)) in self.entries().enumerate() {
            if let Some(vertex) = corners.iter().find(|&&v| v as usize >= count) {
                let message = format!("a cell names vertex {vertex} (counting from 0) of a mesh with {count} vertices");
                return Err(Error::new(ErrorKind::Parse, message).at(place(entry.line, i)));
            }
        }
        Ok(())
    }

    /// The mesh: volume before surface, all quadrilaterals or else triangles.
    pub(super) fn finish(self) -> Result<Mesh> {
        let cells = self.cells()?;
        Mesh::new(self.points, cells)
    }

    /// The mesh as [`finish`](Self::finish) makes it.
    pub(super) fn mesh(&self) -> Result<Mesh> {
        Mesh::new(self.points.clone(), self.cells()?)
    }

    /// The mesh of a shape, cut into triangles as `mesh` is, its polycube that holds `polycube`: where both have the
    /// same faces, those of the polycube, which are flat, tell how they are cut.
    pub(super) fn finish_like(self, polycube: &Self, mesh: &Mesh) -> Result<Mesh> {
        let alike = |(a, b): (&Entry, &Entry)| a.shape == b.shape && a.end == b.end;
        let counts = |soup: &Self| (soup.points.len(), soup.entries.len());
        if counts(&self) != counts(polycube)
            || self.corners != polycube.corners
            || !self.entries.iter().zip(&polycube.entries).all(alike)
        {
            return self.finish();
        }
        Mesh::new(self.points, mesh.cells().clone())
    }

    /// The cells of the mesh that [`finish`](Self::finish) makes.
    fn cells(&self) -> Result<Cells> {
        self.check()?;
        let tetrahedra = arrays(self.of(Shape::Tetrahedron));
        let hexahedra = arrays(self.of(Shape::Hexahedron));
        let cells = match (tetrahedra.is_empty(), hexahedra.is_empty()) {
            (false, false) => return Err(mixed_volume()),
            (false, true) => Cells::Tetrahedra(tetrahedra),
            (true, false) => Cells::Hexahedra(hexahedra),
            (true, true) => self.surface(),
        };
        Ok(cells)
    }

    fn surface(&self) -> Cells {
        if self.of(Shape::Polygon).all(|corners| corners.len() == 4) {
            return Cells::Quads(arrays(self.of(Shape::Polygon)));
        }
        Cells::Triangles(self.of(Shape::Polygon).flat_map(|corners| triangles(&self.points, corners)).collect())
    }
}

fn place(line: usize, cell: usize) -> Place {
    match line {
        0 => Place::Cell(u32::try_from(cell).unwrap_or(u32::MAX)),
        _ => Place::Line(line),
    }
}

/// The cells that have `N` corners.
fn arrays<'a, const N: usize>(cells: impl Iterator<Item = &'a [u32]>) -> Vec<[u32; N]> {
    cells.filter_map(|c| c.try_into().ok()).collect()
}

fn mixed_volume() -> Error {
    let message = "the file mixes tetrahedra and hexahedra";
    Error::new(ErrorKind::Unsupported, message)
        .remedy("export one kind of cell, or split every hexahedron into tetrahedra")
}
