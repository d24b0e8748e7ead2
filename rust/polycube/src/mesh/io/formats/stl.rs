//! STL: loose triangles in single precision, whose corners are welded where they coincide exactly.

use crate::error::{Error, ErrorKind, Place, Result};
use crate::mesh::checked::check_points;
use crate::mesh::io::scalar::{Endian, Scalar};
use crate::mesh::io::scan::Scanner;
use crate::mesh::io::soup::Soup;
use crate::mesh::{Cells, Mesh, Point};
use std::collections::HashMap;

/// Bytes before the triangles of a binary file: a comment and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a binary triangle: its normal, its corners and two spare bytes.
const FACET: usize = 50;

/// Reads a mesh; vertices are numbered as they first appear.
pub(super) fn read(bytes: &[u8]) -> Result<Soup> {
    let corners = corners(bytes)?;
    let (triangles, firsts) = weld(corners.len(), |i| key(&corners[i]))?;
    let mut soup = Soup::default();
    soup.points = firsts.iter().map(|&i| corners[i]).collect();
    triangles.iter().try_for_each(|t| soup.polygon(t, 0))?;
    Ok(soup)
}

/// Joins the corners of two files with the same triangles; two corners are one vertex where both files
/// agree that they coincide.
pub(in crate::mesh::io) fn pair(polycube: &[Point], shape: &[Point]) -> Result<(Mesh, Mesh)> {
    let (n, m) = (polycube.len() / 3, shape.len() / 3);
    if n != m {
        let message = format!("the polycube has {n} triangles, the shape {m}");
        return Err(Error::new(ErrorKind::Mismatch, message)
            .remedy("export both from one mesh, with the triangles in the same order"));
    }
    let (triangles, firsts) = weld(polycube.len(), |i| (key(&polycube[i]), key(&shape[i])))?;
    let select = |corners: &[Point]| select(corners, &triangles, &firsts);
    Ok((select(polycube)?, select(shape)?))
}

fn select(corners: &[Point], triangles: &[[u32; 3]], firsts: &[usize]) -> Result<Mesh> {
    Mesh::new(firsts.iter().map(|&i| corners[i]).collect(), Cells::Triangles(triangles.to_vec()))
}

/// The bits of a point; zero and minus zero are the same place.
fn key(point: &Point) -> [u64; 3] {
    [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits())
}

/// Gives equal corners one number, and lists the corner where each number first appears.
fn weld<K: std::hash::Hash + Eq>(count: usize, key: impl Fn(usize) -> K) -> Result<(Vec<[u32; 3]>, Vec<usize>)> {
    let mut firsts = Vec::new();
    let mut known = HashMap::with_capacity(count / 6 + 1);
    let mut indices = Vec::with_capacity(count);
    for i in 0..count {
        let next = firsts.len();
        let vertex = *known.entry(key(i)).or_insert(next);
        if vertex == next {
            firsts.push(i);
        }
        indices.push(
            u32::try_from(vertex)
                .map_err(|_| Error::new(ErrorKind::Unsupported, "more vertices than 32-bit indices can name"))?,
        );
    }
    let triangles = indices.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
    Ok((triangles, firsts))
}

/// The corners of all triangles of a file, three after three; at least one triangle.
pub(in crate::mesh::io) fn corners(bytes: &[u8]) -> Result<Vec<Point>> {
    // Some binary files begin with "solid" too, but then their length fits their number of triangles.
    let text = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    let corners = match binary_facets(bytes) {
        Some((facets, rest)) if rest.is_empty() || !text => binary(facets),
        _ if text => ascii(bytes)?,
        _ if bytes.is_empty() => Vec::new(),
        _ => return Err(truncated()),
    };
    check_points(&corners)?;
    if corners.is_empty() {
        return Err(Error::new(ErrorKind::Mesh, "the file holds no triangles"));
    }
    Ok(corners)
}

/// The triangles of a binary file that holds as many as it claims, and what comes after them.
fn binary_facets(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let count = Scalar::U32.read(bytes.get(HEADER - 4..HEADER)?, Endian::Little) as usize;
    bytes[HEADER..].split_at_checked(count.checked_mul(FACET)?)
}

fn truncated() -> Error {
    let message = "neither a text STL file nor a binary one with as many triangles as it claims";
    Error::new(ErrorKind::Parse, message).remedy("the file is cut short: export it again")
}

fn binary(facets: &[u8]) -> Vec<Point> {
    let corner = |c: &[u8]| {
        let x = Scalar::F32.read_all(c, Endian::Little);
        Point::new(x[0], x[1], x[2])
    };
    facets.chunks_exact(FACET).flat_map(|facet| facet[12..48].chunks_exact(12).map(corner)).collect()
}

fn ascii(bytes: &[u8]) -> Result<Vec<Point>> {
    let mut scanner = Scanner::new(bytes);
    let mut corners = Vec::new();
    let mut open = false;
    while let Some(word) = scanner.word() {
        match word.to_ascii_lowercase().as_slice() {
            // A name may follow, of any words.
            solid @ (b"solid" | b"endsolid") => {
                open = solid == b"solid";
                scanner.rest_of_line();
            }
            b"vertex" => corners.push(scanner.point()?),
            // The orientation of the corners tells more than the normal.
            b"facet" => {
                scanner.rest_of_line();
            }
            b"outer" | b"loop" | b"endloop" => {}
            b"endfacet" if corners.len() % 3 == 0 => {}
            b"endfacet" => return Err(scanner.error("a facet without three corners")),
            _ => return Err(scanner.unexpected("a facet", word)),
        }
    }
    if open || corners.len() % 3 != 0 {
        return Err(scanner.truncated("\"endsolid\""));
    }
    Ok(corners)
}

/// Writes a binary file.
pub(super) fn write(mesh: &Mesh) -> Result<Vec<u8>> {
    let count = u32::try_from(mesh.cells().len());
    let count = count.map_err(|_| Error::new(ErrorKind::Unsupported, "too many triangles for STL"))?;
    for (i, point) in mesh.points().iter().enumerate() {
        if point.iter().any(|&x| !(x as f32).is_finite()) {
            let message = "a coordinate beyond the single precision of STL";
            let place = Place::Vertex(u32::try_from(i).unwrap_or(u32::MAX));
            return Err(Error::new(ErrorKind::Mesh, message)
                .at(place)
                .remedy("scale the mesh down, or write .ply or .obj"));
        }
    }
    let mut bytes = vec![b' '; HEADER - 4];
    bytes[..8].copy_from_slice(b"polycube");
    bytes.extend(count.to_le_bytes());
    for i in 0..mesh.cells().len() {
        let corners: Vec<_> = mesh.cells().cell(i).iter().map(|&v| mesh.points()[v as usize]).collect();
        let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let normal = normal.try_normalize(0.0).unwrap_or_default();
        let numbers = normal.iter().chain(corners.iter().flat_map(|c| c.iter()));
        bytes.extend(numbers.flat_map(|&x| (x as f32).to_le_bytes()));
        bytes.extend([0; 2]);
    }
    Ok(bytes)
}
