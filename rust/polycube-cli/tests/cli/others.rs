//! Files as other tools write them: stored another way, in other units, far away.

use super::Sandbox;
use polycube::generate::{Cuboid, Voxels};
use polycube::mesh::{self, CellKind, Cells, Mesh, Point};

/// An L of unit cells.
fn ell(kind: CellKind) -> Mesh {
    let boxes = [Cuboid::new([0; 3], [4, 2, 1]), Cuboid::new([0; 3], [2, 4, 1])];
    Voxels::from_boxes(&boxes).unwrap().mesh(kind, 1.0).unwrap()
}

fn left_handed(mesh: Mesh) -> Mesh {
    let turn = |cells: &mut Cells| match cells {
        Cells::Tetrahedra(c) => c.iter_mut().step_by(2).for_each(|t| t.swap(0, 1)),
        Cells::Hexahedra(c) => c.iter_mut().for_each(|h| h.rotate_left(4)),
        Cells::Triangles(c) => c.iter_mut().for_each(|t| t.reverse()),
        Cells::Quads(c) => c.iter_mut().step_by(3).for_each(|q| q.reverse()),
    };
    mesh.edited(|_, cells| turn(cells)).unwrap()
}

#[test]
fn what_is_numbered_the_other_way_round_is_turned_and_noted() {
    for kind in CellKind::ALL {
        let sandbox = Sandbox::new();
        sandbox.write_mesh("left.vtk", &left_handed(ell(kind)));
        assert!(sandbox.ok("inspect left.vtk").contains("note: repaired: "), "{kind}");
        sandbox.ok("simplify left.vtk -o out --quiet");
        let report = sandbox.json("out/report.json");
        let notes = report["notes"].as_array().unwrap();
        assert!(notes[0].as_str().unwrap().starts_with("repaired: "), "{kind}: {notes:?}");
        assert_eq!((&report["before"]["blocks"], &report["flipped_elements"]), (&3.into(), &0.into()), "{kind}");
        sandbox.confirm("out");
        sandbox.fails("simplify left.vtk -o strict --no-repair", 3, &["remedy: "]);
        if ell(kind).cells().is_volume() {
            let run = sandbox.run("validate left.vtk");
            assert!(run.code == 3 && run.out.contains("numbered left-handed") && run.out.contains(": 1 violation"));
        }
    }
}

#[test]
fn inverted_cells_of_the_input_are_noted_and_counted() {
    let boxes = [Cuboid::new([0; 3], [4; 3])];
    let good = Voxels::from_boxes(&boxes).unwrap().mesh(CellKind::Tetrahedra, 1.0).unwrap();
    let tangled = good.moved(|p| if *p == Point::new(2.0, 2.0, 2.0) { Point::new(3.3, 2.0, 2.0) } else { *p }).unwrap();
    let count = polycube::measure::flipped(&tangled, &[]).unwrap().cells.len();
    let sandbox = Sandbox::new();
    sandbox.write_mesh("p.vtk", &tangled);
    assert!(sandbox.ok("inspect p.vtk").contains(&format!("note: {count} cells are inverted or flat")));
    sandbox.ok("simplify p.vtk -o out --quiet");
    let report = sandbox.json("out/report.json");
    let note = format!("{count} inverted cells of the input were untangled");
    assert!(report["notes"].as_array().unwrap().contains(&note.into()), "{report}");
    let inverted = [0, 1].map(|i| report["distortion"][i]["inverted"].as_u64().unwrap());
    assert_eq!(inverted, [count as u64, 0]);
}

/// The same block of 50 units, whatever they are.
#[test]
fn the_size_follows_the_mesh_and_not_the_units() {
    for unit in [0.05, 1.0, 50.0, 1000.0] {
        let sandbox = Sandbox::new();
        sandbox.write_mesh("l.obj", &ell(CellKind::Quads).moved(|p| p * unit).unwrap());
        sandbox.ok("remesh l.obj --polycube l.obj -o out --quiet");
        let report = sandbox.json("out/report.json");
        assert_eq!((&report["hexes"], &report["inverted"]), (&52.into(), &0.into()), "{unit}");
    }
}

/// The lowest and the highest corner of the box around a mesh.
fn bounds(mesh: &Mesh) -> [Point; 2] {
    let first = mesh.points()[0];
    mesh.points().iter().fold([first; 2], |[low, high], p| [low.inf(p), high.sup(p)])
}

#[test]
fn a_polycube_far_from_the_origin_is_meshed_where_it_is() {
    let far = Point::new(500_000.0, 5_400_000.0, 120.0);
    let sandbox = Sandbox::new();
    let near = ell(CellKind::Quads).moved(|p| p * 10.0).unwrap();
    let moved = near.moved(|p| p + far.coords).unwrap();
    sandbox.write_mesh("near.obj", &near);
    sandbox.write_mesh("far.obj", &moved);
    sandbox.ok("remesh near.obj --polycube near.obj -o near --quiet");
    for size in ["--hexes 1000", "--scale 0.1", "--edge-length 10", ""] {
        sandbox.ok(&format!("remesh far.obj --polycube far.obj -o far {size} --quiet"));
        let [found, expected] = ["far", "near"].map(|f| sandbox.json(&format!("{f}/report.json")));
        assert_eq!((&found["after"], &found["inverted"]), (&expected["after"], &0.into()), "{size}");
        let hexes = mesh::read(&sandbox.path("far/hexes.mesh")).unwrap();
        let [found, own] = [bounds(&hexes), bounds(&moved)];
        let off = (found[0] - own[0]).norm().max((found[1] - own[1]).norm());
        assert!(off < 1e-6, "{size}: the mesh is where the shape is, but for {off}");
    }
    sandbox.ok("simplify far.obj --scale 1000 -o placed --quiet");
    let placed = mesh::read(&sandbox.path("placed/polycube.obj")).unwrap();
    assert!((bounds(&placed)[0] - far * 1000.0).norm() < 1e-3, "in lattice units, where it was");
}
