//! Files that are wrong, and what is said about them.

use super::*;

#[track_caller]
fn fails(format: Format, bytes: impl AsRef<[u8]>, kind: ErrorKind, place: Option<Place>) {
    let error = read_bytes(format, bytes.as_ref()).unwrap_err();
    assert_eq!((error.kind, error.place), (kind, place), "{error}");
    assert!(!error.message.is_empty());
}

fn line(line: usize) -> Option<Place> {
    Some(Place::Line(line))
}

#[test]
fn empty_files_hold_no_mesh() {
    for format in Format::ALL {
        assert!(read_bytes(format, b"").is_err());
    }
    fails(Format::Obj, "", ErrorKind::Mesh, None);
    fails(Format::Obj, "v 0 0 0\n", ErrorKind::Mesh, None);
    fails(Format::Stl, "", ErrorKind::Mesh, None);
    fails(Format::Stl, "solid\nendsolid", ErrorKind::Mesh, None);
    fails(Format::Off, "OFF 0 0 0", ErrorKind::Mesh, None);
    fails(Format::Medit, "MeshVersionFormatted 2\nEnd", ErrorKind::Mesh, None);
    let text = "ply\nformat ascii 1.0\nelement face 0\nend_header\n";
    fails(Format::Ply, text, ErrorKind::Mesh, None);
}

#[test]
fn obj_names_the_line() {
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for wrong in ["f 1 2 4", "f 0 1 2", "f 1 2 -4", "f 1 2", "f 1 2 x", "f", "f 1 2 99999999999999999999"] {
        fails(Format::Obj, format!("{v}{wrong}\n"), ErrorKind::Parse, line(4));
    }
    for wrong in ["v 0 0", "v", "v 0 0 O", "v 0 \\\n0"] {
        fails(Format::Obj, format!("{v}{wrong}\nf 1 2 3"), ErrorKind::Parse, line(4));
    }
    for wrong in ["nan", "-inf", "1e999"] {
        let text = format!("{v}v 0 {wrong} 0\nf 1 2 3");
        fails(Format::Obj, text, ErrorKind::Mesh, Some(Place::Vertex(3)));
    }
    fails(Format::Obj, format!("{v}f 1 2 -9223372036854775808"), ErrorKind::Parse, line(4));
}

#[test]
fn off_names_the_line() {
    let head = "OFF\n3 1 0\n0 0 0\n1 0 0\n";
    fails(Format::Off, format!("{head}0 1\n"), ErrorKind::Parse, line(6));
    fails(Format::Off, format!("{head}0 1 0\n3 0 1 3"), ErrorKind::Parse, line(6));
    fails(Format::Off, format!("{head}0 1 0\n3 0 1 -1"), ErrorKind::Parse, line(6));
    fails(Format::Off, format!("{head}0 1 0\n2 0 1"), ErrorKind::Parse, line(6));
    fails(Format::Off, format!("{head}0 nan 0\n3 0 1 2"), ErrorKind::Mesh, Some(Place::Vertex(2)));
    fails(Format::Off, "OFF\n-3 1 0\n", ErrorKind::Parse, line(2));
    fails(Format::Off, "solid", ErrorKind::Parse, line(1));
    fails(Format::Off, "4OFF 1 1 1", ErrorKind::Unsupported, None);
    fails(Format::Off, "OFF BINARY\n\0", ErrorKind::Unsupported, None);
    fails(Format::Off, "OFF 18446744073709551615 18446744073709551615 0\n", ErrorKind::Parse, line(2));
}

#[test]
fn ply_names_the_line() {
    let head = "ply\nformat ascii 1.0\nelement vertex 1\n";
    fails(Format::Ply, "plx\n", ErrorKind::Parse, line(2));
    fails(Format::Ply, "ply\nformat ebcdic 1.0\n", ErrorKind::Parse, line(2));
    fails(Format::Ply, format!("{head}property quad x\n"), ErrorKind::Parse, line(4));
    fails(Format::Ply, format!("{head}element face -1\n"), ErrorKind::Parse, line(4));
    fails(Format::Ply, format!("{head}what\n"), ErrorKind::Parse, line(4));
    fails(Format::Ply, head, ErrorKind::Parse, line(4));
    fails(Format::Ply, format!("{head}property float x\nend_header\n1"), ErrorKind::Parse, line(6));
    let head = "ply\nformat ascii 1.0\nelement face 9999999999999\nproperty list char int vertex_indices\n";
    for (face, place) in [("3 0 1 2", line(6)), ("-3 0 1 2", line(6)), ("3 0 0.5 2", line(6))] {
        fails(Format::Ply, format!("{head}end_header\n{face}"), ErrorKind::Parse, place);
    }
}

#[test]
fn stl_names_the_line() {
    let good = write_bytes(Format::Stl, &single(sample(CellKind::Triangles)), &[]).unwrap();
    fails(Format::Stl, &good[..good.len() - 1], ErrorKind::Parse, None);
    fails(Format::Stl, &good[..40], ErrorKind::Parse, None);
    let mut bad = good;
    bad[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    fails(Format::Stl, bad, ErrorKind::Mesh, Some(Place::Vertex(0)));
    let head = "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n";
    fails(Format::Stl, head, ErrorKind::Parse, line(5));
    fails(Format::Stl, format!("{head}endloop\nendfacet"), ErrorKind::Parse, line(6));
    fails(Format::Stl, format!("{head}vertex 0 0 a"), ErrorKind::Parse, line(5));
    fails(Format::Stl, format!("{head}apex 0 0 0"), ErrorKind::Parse, line(5));
    let mut large = sample(CellKind::Triangles);
    large.points_mut()[1].x = 1e39;
    large.points_mut().iter_mut().for_each(|p| p.y = 0.0);
    large.points_mut().iter_mut().for_each(|p| p.z = 0.0);
    let error = write_bytes(Format::Stl, &large, &[]).unwrap_err();
    assert_eq!((error.kind, error.place), (ErrorKind::Mesh, Some(Place::Vertex(1))));
}

#[test]
fn medit_names_the_line() {
    let head = "MeshVersionFormatted 2\nDimension 3\nVertices\n2\n0 0 0 0\n1 0 0 0\n";
    fails(Format::Medit, format!("{head}2 0 0 0\n"), ErrorKind::Parse, line(7));
    fails(Format::Medit, format!("{head}Triangles\n1\n1 2 3 0"), ErrorKind::Parse, line(9));
    fails(Format::Medit, format!("{head}Triangles\n1\n1 2 0 0"), ErrorKind::Parse, line(9));
    fails(Format::Medit, format!("{head}Triangles\n2\n1 2 1 0\nEnd"), ErrorKind::Parse, line(10));
    fails(Format::Medit, format!("{head}Triangles\n99999999999\n1 2 1 0\n"), ErrorKind::Parse, line(10));
    fails(Format::Medit, format!("{head}Vertices\n1\n"), ErrorKind::Parse, line(8));
    fails(Format::Medit, format!("{head}Pyramids\n1\n1 1 1 1 1 0\n"), ErrorKind::Unsupported, None);
    fails(Format::Medit, "MeshVersionFormatted 2\nDimension 2\n", ErrorKind::Unsupported, None);
    fails(Format::Medit, "\u{1}\0\0\0", ErrorKind::Parse, line(1));
    let mixed = "Tetrahedra\n1\n1 2 1 2 0\nHexahedra\n1\n1 2 1 2 1 2 1 2 0\n";
    fails(Format::Medit, format!("{head}{mixed}"), ErrorKind::Unsupported, None);
}

#[test]
fn vtk_names_the_line_or_cell() {
    let head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 double\n0 0 0 1 0 0\n";
    let cell = Some(Place::Cell(0));
    fails(Format::Vtk, format!("{head}CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5"), ErrorKind::Parse, cell);
    fails(Format::Vtk, format!("{head}CELLS 1 4\n3 0 1 -1\nCELL_TYPES 1\n5"), ErrorKind::Parse, cell);
    fails(Format::Vtk, format!("{head}CELLS 1 4\n3 0 1 0\nCELL_TYPES 1\n10"), ErrorKind::Parse, cell);
    fails(Format::Vtk, format!("{head}CELLS 1 4\n3 0 1 0\nCELL_TYPES 1\n22"), ErrorKind::Unsupported, cell);
    fails(Format::Vtk, format!("{head}CELLS 1 4\n3 0 1 0\nCELL_TYPES 0\n"), ErrorKind::Parse, None);
    fails(Format::Vtk, format!("{head}CELLS 1 4\n4 0 1 0\n"), ErrorKind::Parse, line(8));
    fails(Format::Vtk, format!("{head}CELLS 2 4\n3 0 1 0\n"), ErrorKind::Parse, line(8));
    fails(Format::Vtk, format!("{head}CELLS 1 4\n3 0 x 0\n"), ErrorKind::Parse, line(8));
    fails(Format::Vtk, format!("{head}CELLS 1 99999999999999\n3 0 1 0\n"), ErrorKind::Parse, line(9));
    fails(
        Format::Vtk,
        "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET STRUCTURED_GRID\n",
        ErrorKind::Unsupported,
        None,
    );
    let huge = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 18446744073709551615 double\n";
    fails(Format::Vtk, huge, ErrorKind::Parse, line(6));
}

#[test]
fn vtu_names_the_line() {
    fails(Format::Vtu, "<VTKFile type=\"UnstructuredGrid\">\n<a></b>", ErrorKind::Parse, line(2));
    fails(Format::Vtu, b"\xff\xfe", ErrorKind::Parse, None);
    fails(Format::Vtu, "<VTKFile type=\"PolyData\"/>", ErrorKind::Unsupported, None);
    fails(Format::Vtu, "<VTKFile type=\"UnstructuredGrid\"/>", ErrorKind::Mesh, None);
    let lz4 = "<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"/>";
    fails(Format::Vtu, lz4, ErrorKind::Unsupported, None);
    let piece = |array: &str| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\">\n<Piece><Points>\n\
            <DataArray type=\"Float64\" NumberOfComponents=\"3\" {array}</DataArray></Points></Piece></VTKFile>"
        )
    };
    for array in [
        "format=\"binary\">!!!!",
        "format=\"binary\">/////w==",
        "format=\"binary\">AA",
        "format=\"ascii\">0 0 x",
        "format=\"appended\" offset=\"0\">",
        "format=\"appended\" offset=\"-1\">",
        "format=\"hex\">",
    ] {
        fails(Format::Vtu, piece(array), ErrorKind::Parse, line(3));
    }
    fails(Format::Vtu, piece("format=\"ascii\">0 0 0"), ErrorKind::Parse, line(2));
}

#[test]
fn deep_and_wide_xml_is_survived() {
    let deep = "<a>".repeat(200_000);
    assert!(read_bytes(Format::Vtu, deep.as_bytes()).is_err());
    let closed = format!("{deep}{}", "</a>".repeat(200_000));
    assert!(read_bytes(Format::Vtu, closed.as_bytes()).is_err());
    let many: String = (0..200_000).map(|i| format!(" a{i}=''")).collect();
    assert!(read_bytes(Format::Vtu, format!("<VTKFile{many}/>").as_bytes()).is_err());
    let nested: String = (0..50_000).map(|i| format!("<a xmlns:a{i}='u{i}'>")).collect();
    assert!(read_bytes(Format::Vtu, nested.as_bytes()).is_err());
    let bomb = "<!DOCTYPE x [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><x>&b;</x>";
    assert!(read_bytes(Format::Vtu, bomb.as_bytes()).is_err());
}

#[test]
fn every_truncation_fails_or_gives_a_mesh() {
    for format in Format::ALL {
        let kind = format.cells()[format.cells().len() - 1];
        let bytes = write_bytes(format, &single(sample(kind)), &[]).unwrap();
        for end in 0..bytes.len() {
            let _ = read_bytes(format, &bytes[..end]);
        }
    }
}
