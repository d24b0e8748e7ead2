//! Groups of faces as other tools store them.

use super::*;

/// The names of the groups of the triangles in a file.
fn groups(name: &str, text: &str) -> Result<Vec<String>> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    let surface = read_grouped_surface(&path)?;
    assert_eq!(surface.mesh().cells().len(), surface.groups().of().len());
    Ok(surface.groups().of().iter().map(|&i| surface.groups().names()[i as usize].clone()).collect())
}

const POINTS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n";

#[test]
fn names_in_obj_are_kept() {
    let text = format!("{POINTS}f 1 2 3\ng Inlet\nf 1 3 4\nusemtl steel wall\nf 2 5 6 3\nusemtl Inlet\nf 1 3 4\n");
    assert_eq!(groups("a.obj", &text).unwrap(), ["other", "Inlet", "steel_wall", "steel_wall", "Inlet"]);
    let text = format!("{POINTS}o Body\nf 1 2 3\ng 7\nf 1 3 4\ng a b\nf 2 5 6\ng a_b\nf 2 6 3\ng A-B\nf 1 2 3\n");
    assert_eq!(groups("a.obj", &text).unwrap(), ["Body", "group_7", "a_b", "a_b_2", "A_B_3"]);
    let error = groups("a.obj", &format!("{POINTS}f 1 2 3\n")).unwrap_err();
    assert!(error.kind == ErrorKind::Parse && error.message.contains("in a group"), "{error}");
}

#[test]
fn references_and_arrays_are_groups_with_numbers() {
    let text = "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 1 0\n\
                Triangles 3\n1 2 3 5\n1 3 4 -2\n1 2 4 5\nTetrahedra 1\n1 2 3 4 9\nEnd\n";
    assert_eq!(groups("a.mesh", text).unwrap(), ["group_5", "group_minus_2", "group_5"]);
    let text = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n\
                POLYGONS 2 8\n3 0 1 2\n3 0 2 3\nCELL_DATA 2\nSCALARS part int 1\nLOOKUP_TABLE default\n3 0\n";
    assert_eq!(groups("a.vtk", text).unwrap(), ["group_3", "group_0"]);
}

#[test]
fn physical_groups_and_sets_of_elements_have_names() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"inside\"\n2 1 \"no slip\"\n2 4 \"top\"\n\
                $EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 1\n$EndNodes\n$Elements\n4\n\
                1 2 2 1 7 1 2 3\n2 2 2 4 8 1 3 4\n3 2 2 6 8 1 2 4\n4 4 2 1 1 1 2 3 4\n$EndElements\n";
    assert_eq!(groups("a.msh", text).unwrap(), ["no_slip", "top", "group_6"]);
    let text = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n*ELEMENT, TYPE=S3, ELSET=Lid\n1, 1, 2, 3\n\
                *ELEMENT, TYPE=S3\n2, 1, 3, 4\n";
    assert_eq!(groups("a.inp", text).unwrap(), ["LID", "other"]);
}

/// The names that hexahedra are written with for solvers are those that are read.
#[test]
fn groups_of_a_file_for_solvers_are_read_back() {
    use crate::map::testing::hex_box;
    use crate::mesh::{GroupedHexes, Groups, HexFace};
    let (folder, mesh) = (tempfile::tempdir().unwrap(), hex_box([1, 1, 1]));
    let boundary: Vec<HexFace> = (0..6).map(|face| HexFace { cell: 0, face }).collect();
    let names = ["a", "b_1", "lid"].map(str::to_owned).to_vec();
    let patches = Groups::new(names, vec![0, 0, 1, 1, 1, 2]).unwrap();
    let blocks = Groups::numbered("block", vec![0]).unwrap();
    let grouped = GroupedHexes::new(&mesh, blocks, boundary, patches.clone(), patches).unwrap();
    let path = folder.path().join("a.msh");
    write_solver(&path, &grouped).unwrap();
    let found = read_grouped_surface(&path).unwrap();
    let mut counts = std::collections::BTreeMap::new();
    for &group in found.groups().of() {
        *counts.entry(found.groups().names()[group as usize].as_str()).or_insert(0) += 1;
    }
    assert_eq!(counts.into_iter().collect::<Vec<_>>(), [("a", 4), ("b_1", 6), ("lid", 2)]);
    let all = |format| {
        let bytes = write_solver_bytes(format, "a", &grouped).unwrap();
        bytes.into_iter().map(|(_, bytes)| String::from_utf8(bytes).unwrap()).collect::<String>()
    };
    // Each name is there once, without the group that a patch is in.
    assert_eq!(all(SolverFormat::Inp).matches("NAME=lid\n").count(), 1);
    assert_eq!(all(SolverFormat::Msh).matches("\"lid\"").count(), 1);
    assert_eq!(all(SolverFormat::Su2).matches("MARKER_TAG= lid\n").count(), 1);
    let foam = all(SolverFormat::Foam);
    assert!(foam.contains("    lid\n    {") && !foam.contains("inGroups"));
}
