//! Labels as other tools store them.

use super::*;
use crate::generate::{Cuboid, Voxels};
use crate::mesh::Face;

/// A mesh that was written with others beside, and a file of labels.
struct Files(tempfile::TempDir);

impl Files {
    fn new(name: &str, text: &str) -> Self {
        let files = Self(tempfile::tempdir().unwrap());
        fs::write(files.path(name), text).unwrap();
        files
    }

    fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    /// Reads the labels of `mesh`, which came from the file `source`, in the order given.
    fn labels(&self, mesh: &Mesh, source: &str, labels: &[i8], order: Option<&str>) -> Result<Vec<i8>> {
        let text: String = labels.iter().map(|l| format!("{l}\n")).collect();
        fs::write(self.path("labels"), text).unwrap();
        let order = order.map(|order| order.parse::<LabelOrder>().unwrap());
        read_labels_of(mesh, Some(&self.path(source)), &self.path("labels"), order.as_ref())
    }
}

#[test]
fn a_label_for_each_polygon_goes_to_its_triangles() {
    // A prism over an L: two caps of six corners, the first with a reflex corner at its start, and six sides.
    let at = |z: i32| format!("v 1 1 {z}\nv 1 2 {z}\nv 0 2 {z}\nv 0 0 {z}\nv 2 0 {z}\nv 2 1 {z}\n");
    let caps = "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
    let sides = "f 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";
    let text = &format!("{}{}{caps}{sides}", at(0), at(1));
    let files = Files::new("prism.obj", text);
    let mesh = read(&files.path("prism.obj")).unwrap();
    assert_eq!(mesh.cells().len(), 2 * 4 + 6 * 2);
    let own = [5, 4, 0, 2, 1, 3, 0, 2];
    let mut expected = [[5; 4], [4; 4]].concat();
    expected.extend(own[2..].iter().flat_map(|&l| [l; 2]));
    assert_eq!(files.labels(&mesh, "prism.obj", &own, None).unwrap(), expected);
    assert_eq!(files.labels(&mesh, "prism.obj", &expected, None).unwrap(), expected);
    let error = files.labels(&mesh, "prism.obj", &own[1..], None).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Mismatch);
    assert!(error.message.contains("20 boundary faces or 8 faces in the file"), "{error}");
    // Counted from 1, as they come and by an order.
    let from_one: Vec<i8> = own.iter().map(|l| l + 1).collect();
    assert_eq!(files.labels(&mesh, "prism.obj", &from_one, None).unwrap()[0], 6);
    assert_eq!(files.labels(&mesh, "prism.obj", &from_one, Some("1:+X-X+Y-Y+Z-Z")).unwrap(), expected);
    assert_eq!(files.labels(&mesh, "prism.obj", &own, Some("1:+X-X+Y-Y+Z-Z")).unwrap_err().kind, ErrorKind::Option);
}

fn key(corners: &[u32]) -> Vec<u32> {
    let mut key = corners.to_vec();
    key.sort_unstable();
    key
}

/// A box of tetrahedra, its boundary, and the labels of that.
fn tetrahedra() -> (Mesh, Vec<Face>, Vec<i8>) {
    let mesh = Voxels::from_boxes(&[Cuboid::new([0; 3], [2, 1, 1])]).unwrap().mesh(CellKind::Tetrahedra, 1.0).unwrap();
    let boundary = mesh.cells().boundary().unwrap();
    let polycube = crate::structure::Polycube::new(&mesh, None, &crate::structure::Tolerance::default()).unwrap();
    let labels = polycube.labels().map(|l| l.index() as i8).collect();
    (mesh, boundary, labels)
}

#[test]
fn four_labels_for_each_tetrahedron_are_those_opposite_to_its_corners() {
    let (mesh, boundary, labels) = tetrahedra();
    let Cells::Tetrahedra(cells) = mesh.cells() else { unreachable!() };
    let of = |corners: [u32; 3]| {
        let found = boundary.iter().position(|f| key(f.vertices()) == key(&corners));
        found.map_or(-1, |i| labels[i])
    };
    let four: Vec<i8> =
        cells.iter().flat_map(|&[a, b, c, d]| [[b, c, d], [a, c, d], [a, b, d], [a, b, c]].map(of)).collect();
    let files = Files::new("box.mesh", "");
    write(&files.path("box.mesh"), &mesh, &[]).unwrap();
    assert_eq!(files.labels(&mesh, "box.mesh", &four, None).unwrap(), labels);
    let error = files.labels(&mesh, "box.mesh", &four[1..], None).unwrap_err();
    assert!(error.message.contains(&format!("faces of {} tetrahedra", cells.len())), "{error}");
}

#[test]
fn a_label_for_each_triangle_beside_a_volume_goes_to_that_face() {
    let (mesh, boundary, labels) = tetrahedra();
    let text = String::from_utf8(write_bytes(Format::Medit, &mesh, &[]).unwrap()).unwrap();
    let Cells::Tetrahedra(cells) = mesh.cells() else { unreachable!() };
    // Some faces, in another order, turned and reversed, and one from inside.
    let mut inner = cells.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [b, c, d]]);
    let inner = inner.find(|f| boundary.iter().all(|b| key(b.vertices()) != key(f))).unwrap();
    let listed: Vec<usize> = (1..boundary.len()).rev().collect();
    let faces = listed.iter().map(|&i| boundary[i].vertices().to_vec()).chain([inner.to_vec()]);
    let lines: String = faces.map(|f| format!("{} {} {} 0\n", f[2] + 1, f[1] + 1, f[0] + 1)).collect();
    let text = text.replace("End\n", &format!("Triangles\n{}\n{lines}End\n", listed.len() + 1));
    let files = Files::new("box.mesh", &text);
    let given: Vec<i8> = listed.iter().map(|&i| labels[i]).chain([3]).collect();
    let found = files.labels(&mesh, "box.mesh", &given, None).unwrap();
    assert_eq!((found[0], &found[1..]), (-1, &labels[1..]));
    // The file lists as many faces as there are outside: labels that are those of the boundary are left as they are.
    assert_eq!(given.len(), labels.len());
    assert_eq!(files.labels(&mesh, "box.mesh", &labels, None).unwrap(), labels);
}

/// The faces of a box of two by one by one cells with the label of each.
fn labelled_box() -> (Mesh, Vec<i8>) {
    let voxels = Voxels::from_boxes(&[Cuboid::new([0, 0, 0], [2, 1, 1])]).unwrap();
    let mesh = voxels.mesh(CellKind::Quads, 1.0).unwrap();
    let polycube = crate::structure::Polycube::new(&mesh, None, &Default::default()).unwrap();
    let labels = polycube.labels().map(|label| label.index() as i8).collect();
    (mesh, labels)
}

/// The labels of `mesh` in a mesh file of this name.
fn within(mesh: &Mesh, name: &str, bytes: &[u8]) -> Result<Vec<i8>> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    read_labels_of(mesh, None, &path, None)
}

#[test]
fn the_numbers_of_faces_in_mesh_files_are_labels() {
    let (mesh, labels) = labelled_box();
    let own = CellField::integer("label", labels.iter().map(|&l| l.into()).collect());
    let other = CellField::integer("part", vec![9; labels.len()]);
    for format in [Format::Medit, Format::Vtk, Format::Vtu, Format::Vtp] {
        let bytes = write_bytes(format, &mesh, &[other.clone(), own.clone()]).unwrap();
        assert_eq!(within(&mesh, &format!("a.{format}"), &bytes), Ok(labels.clone()), "{format}");
        let alone = CellField { name: "anything".into(), ..own.clone() };
        if format != Format::Medit {
            let bytes = write_bytes(format, &mesh, &[alone]).unwrap();
            assert_eq!(within(&mesh, &format!("a.{format}"), &bytes), Ok(labels.clone()), "{format}");
        }
    }
    let corners = |i: usize| mesh.cells().cell(i).iter().map(|v| format!(" {}", v + 1)).collect::<String>();
    let points = |between: &str| {
        let point = |p: &Point| format!("{}{between}{}{between}{}\n", p.x, p.y, p.z);
        mesh.points().iter().map(point).collect::<Vec<_>>()
    };
    let names = ["plus_x", "-x", "label_2", "Material.003", "+Z", "minus_z"];
    for keyword in ["usemtl", "g"] {
        let face = |(i, &l): (usize, &i8)| format!("{keyword} {}\nf{}\n", names[l as usize], corners(i));
        let faces: String = labels.iter().enumerate().map(face).collect();
        let vertices: String = points(" ").iter().map(|p| format!("v {p}")).collect();
        assert_eq!(within(&mesh, "a.obj", format!("{vertices}{faces}").as_bytes()), Ok(labels.clone()), "{keyword}");
    }
    let numbered =
        |between: &str| (1..).zip(points(between)).map(|(i, p)| format!("{i}{between}{p}")).collect::<String>();
    let set = |(i, &l): (usize, &i8)| {
        format!("*ELEMENT, TYPE=S4, ELSET=side_{l}\n{}{}\n", i + 1, corners(i).replace(' ', ", "))
    };
    let sets: String = labels.iter().enumerate().map(set).collect();
    let text = format!("*NODE\n{}{sets}", numbered(", "));
    assert_eq!(within(&mesh, "a.inp", text.as_bytes()), Ok(labels.clone()));
    let element = |(i, l): (usize, &i8)| format!("{} 3 2 {l} 7{}\n", i + 1, corners(i));
    let elements: String = labels.iter().enumerate().map(element).collect();
    let (n, m) = (mesh.points().len(), labels.len());
    let nodes = format!("$Nodes\n{n}\n{}$EndNodes\n", numbered(" "));
    let text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{nodes}$Elements\n{m}\n{elements}$EndElements\n");
    assert_eq!(within(&mesh, "a.msh", text.as_bytes()), Ok(labels.clone()));
}

#[test]
fn physical_groups_of_entities_are_labels() {
    let (mesh, labels) = labelled_box();
    let (n, m) = (mesh.points().len(), labels.len());
    // One surface a face, the group of each its label; a point and a curve before them.
    let entity = |(i, l): (usize, &i8)| format!("{} 0 0 0 1 1 1 1 {l} 1 1\n", i + 1);
    let entities: String = labels.iter().enumerate().map(entity).collect();
    let tags: String = (1..=n).map(|i| format!("{i}\n")).collect();
    let points: String = mesh.points().iter().map(|p| format!("{} {} {}\n", p.x, p.y, p.z)).collect();
    let block = |i: usize| {
        let corners: String = mesh.cells().cell(i).iter().map(|v| format!(" {}", v + 1)).collect();
        format!("2 {} 3 1\n{}{corners}\n", i + 1, i + 2)
    };
    let blocks: String = (0..m).map(block).collect();
    let text = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 1 {m} 0\n7 0 0 0 0\n1 0 0 0 1 1 1 2 5 6 1 7\n{entities}\
         $EndEntities\n$Nodes\n1 {n} 1 {n}\n2 1 0 {n}\n{tags}{points}$EndNodes\n\
         $Elements\n{} {} 1 {}\n0 7 15 1\n1 1\n{blocks}$EndElements\n",
        m + 1,
        m + 1,
        m + 1
    );
    assert_eq!(within(&mesh, "a.msh", text.as_bytes()), Ok(labels));
}

#[test]
fn faces_beside_a_volume_have_their_labels() {
    let text = "MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n\
                Tetrahedra\n1\n1 2 3 4 9\nTriangles\n4\n1 3 2 5\n1 2 4 3\n1 4 3 1\n2 3 4 0\nEnd\n";
    let mesh = read_bytes(Format::Medit, text.as_bytes()).unwrap();
    let found = within(&mesh, "a.mesh", text.as_bytes()).unwrap();
    let by_corners = [([0, 1, 2], 5), ([0, 1, 3], 3), ([0, 2, 3], 1), ([1, 2, 3], 0)];
    for (face, label) in mesh.cells().boundary().unwrap().iter().zip(found) {
        let vertices = key(face.vertices());
        assert!(by_corners.iter().any(|(corners, l)| vertices == corners && *l == label), "{vertices:?}: {label}");
    }
}

#[test]
fn mesh_files_without_labels_are_refused() {
    let (mesh, labels) = labelled_box();
    let plain = write_bytes(Format::Obj, &mesh, &[]).unwrap();
    let error = within(&mesh, "a.obj", &plain).unwrap_err();
    assert!(error.message.contains("have no numbers") && error.remedy.contains("plus_x"), "{error}");
    let large = CellField::integer("label", labels.iter().map(|&l| i32::from(l) + 100).collect());
    let error = within(&mesh, "a.vtu", &write_bytes(Format::Vtu, &mesh, &[large]).unwrap()).unwrap_err();
    assert_eq!((error.kind, error.place), (ErrorKind::Parse, Some(Place::Face(0))));
}
