mod data;
mod labels;
mod malformed;
mod painted;
mod property;
mod variants;

use super::*;
use crate::error::Place;
use crate::mesh::{CellKind, Cells, Point};
use std::fs;

/// Two cells of `kind` over awkward but finite coordinates, numbered as they first appear.
pub(super) fn sample(kind: CellKind) -> Mesh {
    let cells = match kind {
        CellKind::Triangles => Cells::Triangles(vec![[0, 1, 2], [2, 1, 3]]),
        CellKind::Quads => Cells::Quads(vec![[0, 1, 2, 3], [3, 2, 4, 5]]),
        CellKind::Tetrahedra => Cells::Tetrahedra(vec![[0, 1, 2, 3], [1, 2, 3, 4]]),
        CellKind::Hexahedra => Cells::Hexahedra(vec![[0, 1, 2, 3, 4, 5, 6, 7], [4, 5, 6, 7, 8, 9, 10, 11]]),
    };
    let odd = [0.1 + 0.2, -1e-300, 1e300, 5e-324, -0.0, 1.0 / 3.0, -12345678.9, 1e16, 9e-6, 7.0];
    let count = (0..2).flat_map(|i| cells.cell(i)).max().unwrap() + 1;
    let coordinate = |i: u32, axis: usize| odd[(i as usize * 3 + axis * 7) % odd.len()] + 0.0;
    let points = (0..count).map(|i| Point::new(f64::from(i), coordinate(i, 1), coordinate(i, 2))).collect();
    Mesh::new(points, cells).unwrap()
}

/// The mesh with its coordinates rounded to what STL can hold.
pub(super) fn single(mut mesh: Mesh) -> Mesh {
    for x in mesh.points_mut().iter_mut().flat_map(|p| p.iter_mut()) {
        *x = f64::from(x.clamp(-1e30, 1e30) as f32);
    }
    mesh
}

pub(super) fn bits(mesh: &Mesh) -> Vec<u64> {
    let coordinates = mesh.points().iter().flat_map(|p| p.iter());
    coordinates.map(|x| x.to_bits()).collect()
}

fn fields() -> Vec<CellField> {
    vec![CellField::integer("block_id", vec![7, -3]), CellField::real("scaled_jacobian", vec![0.1, -1e-9])]
}

#[test]
fn every_format_returns_every_cell_it_holds() {
    for format in Format::ALL {
        for kind in CellKind::ALL {
            let mesh = match format {
                Format::Stl => single(sample(kind)),
                _ => sample(kind),
            };
            let written = write_bytes(format, &mesh, &fields());
            if !format.holds(kind) {
                assert_eq!(written.unwrap_err().kind, ErrorKind::Unsupported);
                continue;
            }
            let bytes = written.unwrap();
            let again = read_bytes(format, &bytes).unwrap();
            assert_eq!(again, mesh, "{format} {kind}");
            assert_eq!(bits(&again), bits(&mesh), "{format} {kind}");
            assert_eq!(write_bytes(format, &again, &fields()).unwrap(), bytes);
        }
    }
}

#[test]
fn formats_are_told_by_extension() {
    for format in Format::ALL {
        let path = format!("a.b/c.{}", format.extension().to_uppercase());
        assert_eq!(Format::from_path(Path::new(&path)).unwrap(), format);
        assert_eq!(format.to_string().parse::<Format>().unwrap(), format);
    }
    for path in ["mesh", "a.pvtu", "a.stp", "dir.obj/x", ""] {
        let error = Format::from_path(Path::new(path)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Unsupported);
        assert!(!error.remedy.is_empty());
    }
}

#[test]
fn fields_go_where_they_can() {
    let mesh = sample(CellKind::Quads);
    let text = |format| String::from_utf8_lossy(&write_bytes(format, &mesh, &fields()).unwrap()).into_owned();
    let vtk = text(Format::Vtk);
    assert!(vtk.contains("CELL_DATA 2\nSCALARS block_id int 1\nLOOKUP_TABLE default\n7\n-3\n"));
    assert!(vtk.ends_with("SCALARS scaled_jacobian double 1\nLOOKUP_TABLE default\n0.1\n-1e-9\n"));
    assert!(text(Format::Medit).contains("Quadrilaterals\n2\n1 2 3 4 7\n4 3 5 6 -3\nEnd\n"));
    assert!(text(Format::Ply).contains("property int block_id\nproperty double scaled_jacobian\n"));
    assert!(text(Format::Vtu).contains("<DataArray type=\"Int32\" Name=\"block_id\""));
    assert!(!text(Format::Obj).contains("block"));
}

#[test]
fn unusable_fields_and_meshes_are_not_written() {
    let mesh = sample(CellKind::Triangles);
    for (name, count) in [("a", 1), ("a b", 2), ("", 2), ("<a>", 2)] {
        let field = CellField::integer(name, vec![0; count]);
        let error = write_bytes(Format::Vtu, &mesh, &[field]).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Option);
    }
    let twice = [fields(), fields()].concat();
    assert_eq!(write_bytes(Format::Vtk, &mesh, &twice).unwrap_err().kind, ErrorKind::Option);
    let none = Mesh::new(Vec::new(), Cells::Quads(Vec::new())).unwrap();
    assert_eq!(write_bytes(Format::Off, &none, &[]).unwrap_err().kind, ErrorKind::Mesh);
}

#[test]
fn a_file_is_replaced_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    let mesh = sample(CellKind::Triangles);
    write(&path, &mesh, &[]).unwrap();
    assert_eq!(read(&path).unwrap(), mesh);
    let before = fs::read(&path).unwrap();
    // Nothing that fails touches the file.
    let broken = [CellField::integer("number", Vec::new())];
    assert!(write(&path, &mesh, &broken).is_err());
    assert_eq!(fs::read(&path).unwrap(), before);
    // A folder in the way, and a folder that is not there.
    fs::create_dir(folder.path().join("b.obj")).unwrap();
    for name in ["b.obj", "none/c.obj"] {
        let error = write(&folder.path().join(name), &mesh, &[]).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Io);
        assert!(error.message.contains(name), "{error}");
        assert!(!error.remedy.is_empty(), "{error}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    let error = read(&folder.path().join("b.obj")).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Io);
    let error = read(&folder.path().join("nowhere.obj")).unwrap_err();
    assert!(error.message.contains("nowhere.obj") && error.remedy.contains("path"));
    fs::write(&path, "v 0 0 0\nv 0 x 0\n").unwrap();
    let error = read(&path).unwrap_err();
    assert_eq!((error.file.as_deref(), error.place), (path.to_str(), Some(Place::Line(2))));
    let start = format!("{}: line 2: expected a coordinate", path.display());
    assert!(error.to_string().starts_with(&start), "{error}");
}

#[cfg(unix)]
#[test]
fn links_and_permissions_survive_a_write() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("file"), folder.path().join("link"));
    write_atomically(&file, b"1").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    assert_ne!(mode(&file) & 0o044, 0, "a new file follows the umask");
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&file, &link).unwrap();
    write_atomically(&link, b"2").unwrap();
    assert_eq!(fs::read(&file).unwrap(), b"2");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(mode(&file), 0o640);
    fs::set_permissions(&file, fs::Permissions::from_mode(0o444)).unwrap();
    assert_eq!(write_atomically(&file, b"3").unwrap_err().kind, ErrorKind::Io);
    assert_eq!(fs::read(&file).unwrap(), b"2");
}

#[cfg(unix)]
#[test]
fn a_link_to_no_file_yet_is_written_through() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("far")).unwrap();
    // Two links, relative to their own folders.
    symlink("far/second", path("first")).unwrap();
    symlink("../target", path("far/second")).unwrap();
    write_atomically(&path("first"), b"1").unwrap();
    assert_eq!(fs::read(path("target")).unwrap(), b"1");
    assert!(["first", "far/second"].iter().all(|link| fs::symlink_metadata(path(link)).unwrap().is_symlink()));
    // Into a folder that is not there, and around for ever.
    symlink("none/target", path("lost")).unwrap();
    symlink("loop", path("loop")).unwrap();
    for name in ["lost", "loop"] {
        let error = write_atomically(&path(name), b"2").unwrap_err();
        assert!(error.kind == ErrorKind::Io && error.message.contains(name), "{error}");
        assert!(fs::symlink_metadata(path(name)).unwrap().is_symlink());
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 5, "no temporary file is left");
}

#[test]
fn labels_round_trip_and_name_the_wrong_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("labels.txt");
    let labels = [-1, 0, 1, 2, 3, 4, 5];
    write_labels(&path, &labels).unwrap();
    assert_eq!(read_labels(&path, 7).unwrap(), labels);
    assert_eq!(read_labels(&path, 8).unwrap_err().kind, ErrorKind::Mismatch);
    assert_eq!(write_labels(&path, &[6]).unwrap_err().kind, ErrorKind::Option);
    assert_eq!(parse_labels(b" 3\r\n-1 \r\n\r\n \n", 2).unwrap(), [3, -1]);
    assert!(parse_labels(b"", 0).unwrap().is_empty());
    for text in ["0\n6\n", "0\n\n1\n", "0\n1 2\n", "0\nx", "0\n1.0", "0\n-2"] {
        let error = parse_labels(text.as_bytes(), 3).unwrap_err();
        assert_eq!((error.kind, error.place), (ErrorKind::Parse, Some(Place::Line(2))));
    }
}

#[test]
fn a_pair_must_have_one_connectivity() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name| folder.path().join(name);
    let mesh = sample(CellKind::Quads);
    let mut other = mesh.clone();
    other.points_mut()[0].x = 9.0;
    write(&path("a.obj"), &mesh, &[]).unwrap();
    write(&path("b.vtk"), &other, &[]).unwrap();
    assert_eq!(read_pair(&path("a.obj"), &path("b.vtk")).unwrap(), (mesh.clone(), other.clone()));
    other = other.edited(|_, cells| *cells = Cells::Quads(vec![[0, 1, 2, 3], [2, 4, 5, 3]])).unwrap();
    write(&path("b.vtk"), &other, &[]).unwrap();
    let error = read_pair(&path("a.obj"), &path("b.vtk")).unwrap_err();
    assert_eq!((error.kind, error.place), (ErrorKind::Mismatch, Some(Place::Cell(1))));
    other = other.edited(|points, _| points.push(Point::origin())).unwrap();
    write(&path("b.vtk"), &other, &[]).unwrap();
    write(&path("c.stl"), &single(sample(CellKind::Triangles)), &[]).unwrap();
    for name in ["b.vtk", "c.stl"] {
        let error = read_pair(&path("a.obj"), &path(name)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Mismatch);
        assert!(!error.remedy.is_empty());
    }
}

#[test]
fn a_pair_of_stl_is_welded_jointly() {
    let folder = tempfile::tempdir().unwrap();
    let (a, b) = (folder.path().join("a.stl"), folder.path().join("b.stl"));
    let polycube = single(sample(CellKind::Triangles));
    // Vertices 0 and 3 of the shape coincide, but not those of the polycube.
    let mut shape = polycube.clone();
    shape.points_mut()[3] = shape.points()[0];
    write(&a, &polycube, &[]).unwrap();
    write(&b, &shape, &[]).unwrap();
    assert_eq!(read(&b).unwrap().points().len(), 3);
    assert_eq!(read_pair(&a, &b).unwrap(), (polycube.clone(), shape));
    let one = Cells::Triangles(vec![[0, 1, 2]]);
    write(&b, &polycube.edited(|_, cells| *cells = one).unwrap(), &[]).unwrap();
    assert_eq!(read_pair(&a, &b).unwrap_err().kind, ErrorKind::Mismatch);
}
