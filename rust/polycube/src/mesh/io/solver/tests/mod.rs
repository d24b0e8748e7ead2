//! Every file is read here from its text alone, as its format is described, and compared with what went in.

mod block_mesh;
mod foam;
mod inp;
mod json;
mod msh;
mod plot3d;
mod su2;

use super::*;
use crate::map::testing::{hex_box, shuffled};
use crate::mesh::{Cells, Groups, HexFace, Mesh, Point};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

const SIZE: [u32; 3] = [3, 2, 2];
const SIDES: [&str; 6] = ["minus_x", "plus_x", "minus_y", "plus_y", "minus_z", "plus_z"];
const VOLUME: f64 = 12.0;
const QUADS: usize = 32;

/// A box with vertices and cells in any order.
fn box_mesh() -> Mesh {
    shuffled(&hex_box(SIZE), 7).moved(|p| Point::from(p.coords + Vector3::new(1e-7, -0.1, 0.0))).unwrap()
}

fn cells(mesh: &Mesh) -> &[[u32; 8]] {
    let Cells::Hexahedra(cells) = mesh.cells() else { panic!("not hexahedra") };
    cells
}

/// The side of the box that all the vertices lie on.
fn side(points: &[Point], vertices: impl IntoIterator<Item = u32>) -> Option<usize> {
    let all: Vec<Vector3<f64>> =
        vertices.into_iter().map(|v| points[v as usize].coords - Vector3::new(1e-7, -0.1, 0.0)).collect();
    let on = |s: usize, p: &Vector3<f64>| (p[s / 2] - f64::from(SIZE[s / 2]) * (s % 2) as f64).abs() < 1e-9;
    (0..6).find(|&s| all.iter().all(|p| on(s, p)))
}

/// A block on each side of the middle of the box, and a patch for each side and block.
fn grouped(mesh: &Mesh) -> GroupedHexes<'_> {
    let (points, cells) = (mesh.points(), cells(mesh));
    let half = |cell: &[u32; 8]| u32::from(cell.iter().map(|&v| points[v as usize].x).sum::<f64>() > 8.0 * 1.1);
    let block: Vec<u32> = cells.iter().map(half).collect();
    let all = (0..cells.len() as u32).flat_map(|cell| (0..6).map(move |face| HexFace { cell, face }));
    let mut boundary: Vec<HexFace> = all.filter(|f| side(points, f.vertices(cells)).is_some()).collect();
    // In an order of their own.
    boundary.reverse();
    let sides: Vec<u32> = boundary.iter().map(|f| side(points, f.vertices(cells)).unwrap() as u32).collect();
    let patches = boundary.iter().zip(&sides).map(|(f, s)| 2 * s + block[f.cell as usize]).collect();
    GroupedHexes::new(
        mesh,
        Groups::numbered("block", block).unwrap(),
        boundary,
        Groups::numbered("facet", patches).unwrap(),
        Groups::new(SIDES.map(str::to_owned).to_vec(), sides).unwrap(),
    )
    .unwrap()
}

fn texts(format: SolverFormat, hexes: &GroupedHexes) -> Vec<String> {
    let files = write_solver_bytes(format, "box", hexes).unwrap();
    assert_eq!(files, write_solver_bytes(format, "box", hexes).unwrap());
    files.into_iter().map(|(_, bytes)| String::from_utf8(bytes).unwrap()).collect()
}

fn area_vector(points: &[Point], [a, b, c, d]: [u32; 4]) -> Vector3<f64> {
    let at = |v: u32| points[v as usize];
    (at(c) - at(a)).cross(&(at(d) - at(b))) / 2.0
}

/// The quadrilaterals are a closed surface that looks outward and has the volume of the box inside.
fn encloses_the_box(points: &[Point], quads: &[[u32; 4]]) {
    assert_eq!(quads.len(), QUADS);
    let edges: BTreeSet<[u32; 2]> = quads.iter().flat_map(|q| (0..4).map(|k| [q[k], q[(k + 1) % 4]])).collect();
    assert_eq!(edges.len(), 4 * QUADS);
    assert!(edges.iter().all(|&[a, b]| edges.contains(&[b, a])));
    let cone = |q: &[u32; 4]| area_vector(points, *q).dot(&points[q[0] as usize].coords) / 3.0;
    assert!((quads.iter().map(cone).sum::<f64>() - VOLUME).abs() < 1e-9);
}

/// The numbers of a text between whatever is no number.
fn numbers<T: std::str::FromStr>(line: &str) -> Vec<T> {
    line.split([' ', ',', '(', ')']).filter_map(|word| word.parse().ok()).collect()
}

fn array<const N: usize>(numbers: &[u32], first: u32) -> [u32; N] {
    std::array::from_fn(|k| numbers[k] - first)
}

/// What is written to the disk is what there are bytes of; a case keeps what else is in it, and what cannot be written
/// leaves nothing.
#[test]
fn files_are_written_whole_or_not_at_all() {
    let (folder, mesh) = (tempfile::tempdir().unwrap(), box_mesh());
    let hexes = grouped(&mesh);
    for format in SolverFormat::ALL {
        let path = folder.path().join(format!("box.{format}"));
        write_solver(&path, &hexes).unwrap();
        for (name, bytes) in write_solver_bytes(format, "box", &hexes).unwrap() {
            let within = name.split_once('/').map_or_else(|| path.clone(), |(_, rest)| path.join(rest));
            assert!(fs::read(&within).unwrap() == bytes, "{}", within.display());
        }
    }
    let (case, own) = (folder.path().join("box.foam"), folder.path().join("box.foam/constant/g"));
    fs::write(&own, "uniform").unwrap();
    write_solver(&case, &hexes).unwrap();
    assert!(own.exists());
    assert_eq!(fs::read_dir(case.join("constant/polyMesh")).unwrap().count(), 6);
    fs::write(folder.path().join("file"), "").unwrap();
    for name in ["file/case.foam", "file/case.blockmesh", "file/box.msh", "file/box.json"] {
        assert_eq!(write_solver(&folder.path().join(name), &hexes).unwrap_err().kind, ErrorKind::Io, "{name}");
    }
    assert_eq!(write_solver(&folder.path().join("box.obj"), &hexes).unwrap_err().kind, ErrorKind::Unsupported);
}

#[test]
fn files_have_names_and_formats_are_read_back() {
    for format in SolverFormat::ALL {
        assert_eq!(format.to_string().to_uppercase().parse(), Ok(format));
        let written: Vec<String> = write_solver_bytes(format, "box", &grouped(&box_mesh()))
            .unwrap()
            .into_iter()
            .map(|(name, _)| name)
            .collect();
        assert_eq!(written, format.files("box"));
    }
    assert_eq!(SolverFormat::Inp.files("box"), ["box.inp"]);
    assert_eq!(SolverFormat::Xyz.files("box"), ["box.xyz"]);
    assert_eq!(SolverFormat::Json.files("box"), ["blocks.json"]);
    assert_eq!(SolverFormat::Foam.files("box")[0], "foam/constant/polyMesh/points");
    assert_eq!(SolverFormat::BlockMesh.files("box")[0], "blockmesh/system/blockMeshDict");
    let error = "cgns".parse::<SolverFormat>().unwrap_err();
    assert!(error.kind == ErrorKind::Unsupported && error.remedy.contains("msh"), "{error}");
}

/// What has no block structure is not written, and what is there stays.
#[test]
fn blocks_that_are_no_boxes_are_not_written() {
    let (folder, mesh) = (tempfile::tempdir().unwrap(), box_mesh());
    let hexes = grouped(&mesh);
    let one = |name, count| Groups::numbered(name, vec![0; count]).unwrap();
    let corner = Groups::numbered("block", (0..12).map(|cell| u32::from(cell > 0)).collect()).unwrap();
    let (patches, sides) = (one("patch", QUADS), one("side", QUADS));
    let broken = GroupedHexes::new(&mesh, corner, hexes.boundary().to_vec(), patches, sides).unwrap();
    for format in [SolverFormat::Json, SolverFormat::Xyz, SolverFormat::BlockMesh] {
        let path = folder.path().join(format!("box.{format}"));
        assert_eq!(write_solver(&path, &broken).unwrap_err().kind, ErrorKind::Mismatch);
        assert!(!path.exists());
        assert_eq!(write_solver_bytes(format, "box", &broken).unwrap_err().kind, ErrorKind::Mismatch);
    }
}
