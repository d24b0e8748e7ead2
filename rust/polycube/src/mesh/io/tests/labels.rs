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
