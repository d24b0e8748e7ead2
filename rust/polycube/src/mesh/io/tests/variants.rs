//! The many ways in which one mesh may be written.

use super::*;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;

fn parse(format: Format, text: &str) -> Mesh {
    read_bytes(format, text.as_bytes()).unwrap()
}

fn triangles(mesh: &Mesh) -> &[[u32; 3]] {
    match mesh.cells() {
        Cells::Triangles(cells) => cells,
        other => panic!("{other:?}"),
    }
}

#[test]
fn obj_in_all_its_forms() {
    let text = "\u{feff}# a comment that ends in \\\r\nmtllib c:\\\r\nv 0 0 0 1.0\r\nv 1 0 \\\r\n 0\r\n\
        vt 0 0\nvn 0 0 1\ng a b\n\tv  1 1 0\nv 0 1 0 # top\nusemtl x\ns off\nv 9 9 9\n\
        f 1/1/1 2//1 3/1\nf -5 -3 \\\n -2\n";
    let mesh = parse(Format::Obj, text);
    assert_eq!(mesh.points().len(), 5);
    assert_eq!(mesh.points()[1], Point::new(1.0, 0.0, 0.0));
    assert_eq!(triangles(&mesh), [[0, 1, 2], [0, 2, 3]]);
}

#[test]
fn lines_may_end_with_a_carriage_return_alone() {
    let obj = "# a comment\rv 0 0 0\rv 1 0 0\rv 0 1 0\rusemtl 7\rf 1 2 3\r";
    assert_eq!(triangles(&parse(Format::Obj, obj)), [[0, 1, 2]]);
    let inp = "** a comment\r*NODE\r1, 0, 0, 0\r2, 1, 0, 0\r3, 0, 1, 0\r*ELEMENT, TYPE=S3\r1, 1, 2, 3\r";
    assert_eq!(triangles(&parse(Format::Inp, inp)), [[0, 1, 2]]);
    let error = read_bytes(Format::Obj, b"v 0 0 0\r\rv 1 x 0\r").unwrap_err();
    assert_eq!(error.place, Some(Place::Line(3)));
}

#[test]
fn obj_faces_may_come_first() {
    let mesh = parse(Format::Obj, "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0");
    assert_eq!(triangles(&mesh), [[0, 1, 2]]);
}

#[test]
fn mixed_surfaces_become_fans() {
    let points = "v 0 0 0\n".repeat(5);
    let mesh = parse(Format::Obj, &format!("{points}f 2 3 4 5 1\nf 1 2 3\nf 1 2 3 4"));
    let expected = [[1, 2, 3], [1, 3, 4], [1, 4, 0], [0, 1, 2], [0, 1, 2], [0, 2, 3]];
    assert_eq!(triangles(&mesh), expected);
}

#[test]
fn off_in_all_its_forms() {
    let body = "0 0 0\n1 0 0\n0 1 0\n";
    for head in ["OFF\n3 1 0\n", "OFF 3 1 0\n", "# x\nOFF # y\n\n3 1\n# z\n", "\u{feff}OFF\r\n3 1 9\r\n"] {
        for face in ["3 0 1 2", "3 0 1 2 255 0 0\n", "3\n0 1 2 # red\n\n"] {
            let mesh = parse(Format::Off, &format!("{head}{body}{face}"));
            assert_eq!(triangles(&mesh), [[0, 1, 2]]);
        }
    }
    // Some programs leave the keyword out, and some end lines as they once were ended.
    for text in [format!("3 1 0\n{body}3 0 1 2\n"), format!("OFF\r3 1 0\r{}3 0 1 2 9\r", body.replace('\n', "\r"))] {
        assert_eq!(triangles(&parse(Format::Off, &text)), [[0, 1, 2]]);
    }
    let text = "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 0 0 0 0\n3 0 1 2";
    assert_eq!(parse(Format::Off, text).points()[2], Point::new(0.0, 1.0, 0.0));
}

#[test]
fn ply_text_and_both_binaries() {
    let header = |encoding: &str| {
        format!(
            "ply\r\nformat {encoding} 1.0\ncomment x\nelement extra 1\nproperty list uchar short s\n\
            element vertex 3\nproperty uchar red\nproperty float z\nproperty double x\nproperty short y\n\
            element none 99999999999\nelement face 1\nproperty char c\n\
            property list ushort int vertex_index\nend_header\n"
        )
    };
    let text = header("ascii") + "2 7 8\n1 0 0 0\n1 0 1 0\n1 0.5 0 -2\n9 3 0 1 2\n";
    let mesh = parse(Format::Ply, &text);
    assert_eq!(triangles(&mesh), [[0, 1, 2]]);
    assert_eq!(mesh.points()[2], Point::new(0.0, -2.0, 0.5));
    for (name, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut bytes = header(name).into_bytes();
        let mut put = |mut number: Vec<u8>| {
            if !big {
                number.reverse();
            }
            bytes.extend(number);
        };
        put(vec![2]);
        put(7_i16.to_be_bytes().into());
        put(8_i16.to_be_bytes().into());
        for (z, x, y) in [(0.0_f32, 0.0_f64, 0_i16), (0.0, 1.0, 0), (0.5, 0.0, -2)] {
            put(vec![1]);
            put(z.to_be_bytes().into());
            put(x.to_be_bytes().into());
            put(y.to_be_bytes().into());
        }
        put(vec![9]);
        put(3_u16.to_be_bytes().into());
        (0..3_i32).for_each(|i| put(i.to_be_bytes().into()));
        assert_eq!(read_bytes(Format::Ply, &bytes).unwrap(), mesh, "{name}");
    }
}

#[test]
fn stl_text_is_welded() {
    let facet = |corners: &str| {
        let [a, b, c] = corners.split(',').collect::<Vec<_>>().try_into().unwrap();
        format!("facet normal nan 0 1\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
    };
    let text = ["solid a vertex\n", &facet("0 0 0,1 0 0,0 1e0 0"), &facet("1 0 0,1 1 0,0 1 -0"), "endsolid"];
    for text in [text.concat(), text.concat().to_uppercase()] {
        assert_eq!(triangles(&parse(Format::Stl, &text)), [[0, 1, 2], [1, 3, 2]]);
    }
}

#[test]
fn medit_in_all_its_forms() {
    let text = "# x\nMeshVersionFormatted 1\nDimension\n3 Tetrahedra 1\n1 2 3 4 7\nCorners 2\n1 2\n\
        Normals\n1\n0 -1 .5\nPrisms 0\nTriangles\n1\n1 2 3 0\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1";
    let mesh = parse(Format::Medit, text);
    assert_eq!(*mesh.cells(), Cells::Tetrahedra(vec![[0, 1, 2, 3]]));
    assert_eq!(parse(Format::Medit, &format!("{text}\nEnd garbage")), mesh);
}

#[test]
fn vtk_versions_and_data_sets() {
    let text = "# vtk DataFile Version 2.0\nCELLS 1 2\nASCII\nDATASET POLYDATA\nFIELD FieldData 1\n\
        TIME 1 1 double\n0.5\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nMETADATA\nINFORMATION 0\n\n\
        VERTICES 1 2\n1 0\nPOLYGONS 1 5\n4 0 1 2 3\nCELL_DATA 1\nanything";
    assert_eq!(*parse(Format::Vtk, text).cells(), Cells::Quads(vec![[0, 1, 2, 3]]));
    let text = "# vtk DataFile Version 5.1\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n\
        0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\nCELLS 3 9\nOFFSETS vtktypeint64\n0 1 9\n\
        CONNECTIVITY vtktypeint64\n0 0 1 2 3 4 5 6 7\nCELL_TYPES 2\n1 11\n";
    let expected = Cells::Hexahedra(vec![[0, 1, 3, 2, 4, 5, 7, 6]]);
    assert_eq!(*parse(Format::Vtk, text).cells(), expected);
}

#[test]
fn vtk_binary_old_and_new() {
    let points: Vec<u8> = [0_f32, 10., 2573., 1., 0., 0., 0., 1., 0.].iter().flat_map(|x| x.to_be_bytes()).collect();
    let ints = |v: &[i32]| v.iter().flat_map(|x| x.to_be_bytes()).collect::<Vec<u8>>();
    let longs = |v: &[i64]| v.iter().flat_map(|x| x.to_be_bytes()).collect::<Vec<u8>>();
    let head = |version: &str| {
        let text = format!("# vtk DataFile Version {version}\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n");
        [text.as_bytes(), &points].concat()
    };
    let types = [&b"\nCELL_TYPES 1\n"[..], &ints(&[5])].concat();
    let old = [head("4.2"), b"\nCELLS 1 4\n".to_vec(), ints(&[3, 0, 1, 2]), types.clone()].concat();
    let new = [
        head("5.1"),
        b"\nMETADATA\nINFORMATION 0\n\nCELLS 2 3\nOFFSETS vtktypeint64\n".to_vec(),
        longs(&[0, 3]),
        b"\nCONNECTIVITY vtktypeint64\n".to_vec(),
        longs(&[0, 1, 2]),
        types,
    ]
    .concat();
    let mesh = read_bytes(Format::Vtk, &old).unwrap();
    assert_eq!(mesh.points()[0], Point::new(0.0, 10.0, 2573.0));
    assert_eq!(triangles(&mesh), [[0, 1, 2]]);
    assert_eq!(read_bytes(Format::Vtk, &new).unwrap(), mesh);
}

fn vtu(attributes: &str, arrays: [&str; 4], tail: &[u8]) -> Vec<u8> {
    let [points, corners, ends, types] = arrays;
    let text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" {attributes}>\n<UnstructuredGrid>\
        <Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points>\
        <DataArray type=\"Float32\" NumberOfComponents=\"3\" {points}</DataArray></Points><Cells>\
        <DataArray type=\"Int32\" Name=\"connectivity\" {corners}</DataArray>\
        <DataArray type=\"Int32\" Name=\"offsets\" {ends}</DataArray>\
        <DataArray type=\"UInt8\" Name=\"types\" {types}</DataArray></Cells></Piece></UnstructuredGrid>\n"
    );
    [text.as_bytes(), tail].concat()
}

#[test]
fn vtu_in_every_encoding() {
    let ascii =
        ["format=\"ascii\">0 0 0 1 0 0 0 1 0", "format=\"ascii\">0 1 2", "format=\"ascii\">3", "format=\"ascii\">5"];
    let mesh = read_bytes(Format::Vtu, &vtu("", ascii, b"</VTKFile>")).unwrap();
    assert_eq!(triangles(&mesh), [[0, 1, 2]]);
    let data: [Vec<u8>; 4] = [
        [0_f32, 0., 0., 1., 0., 0., 0., 1., 0.].iter().flat_map(|x| x.to_le_bytes()).collect(),
        [0_i32, 1, 2].iter().flat_map(|x| x.to_le_bytes()).collect(),
        3_i32.to_le_bytes().into(),
        vec![5],
    ];
    let plain = data.clone().map(|d| [&(d.len() as u32).to_le_bytes()[..], &d].concat());
    let packed = data.map(|d| {
        let zip = miniz_oxide::deflate::compress_to_vec_zlib(&d, 6);
        let header = [1, 32768, d.len() as u32, zip.len() as u32];
        (header.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<_>>(), zip)
    });
    let raw_packed = packed.clone().map(|(head, zip)| [head, zip].concat());
    let zlib = "compressor=\"vtkZLibDataCompressor\"";
    let inline_plain = plain.clone().map(|d| BASE64_STANDARD.encode(&d));
    let inline_packed = packed.map(|(head, zip)| BASE64_STANDARD.encode(&head) + &BASE64_STANDARD.encode(&zip));
    for (attributes, data) in [("", &inline_plain), (zlib, &inline_packed)] {
        let inline = data.each_ref().map(|d| format!("format=\"binary\">\n  {d}\n"));
        let file = vtu(attributes, inline.each_ref().map(String::as_str), b"</VTKFile>");
        assert_eq!(read_bytes(Format::Vtu, &file).unwrap(), mesh);
        let base64 = data.each_ref().map(|d| d.clone().into_bytes());
        assert_eq!(read_bytes(Format::Vtu, &appended(attributes, "base64", &base64)).unwrap(), mesh);
    }
    for (attributes, data) in [("", &plain), (zlib, &raw_packed)] {
        assert_eq!(read_bytes(Format::Vtu, &appended(attributes, "raw", data)).unwrap(), mesh);
    }
}

/// Data compressed in blocks of `size` bytes.
fn packed(data: &[u8], size: usize) -> Vec<u8> {
    let blocks: Vec<_> = data.chunks(size).map(|b| miniz_oxide::deflate::compress_to_vec_zlib(b, 6)).collect();
    let head = [blocks.len(), size, data.len() % size].into_iter().chain(blocks.iter().map(Vec::len));
    head.flat_map(|x| (x as u32).to_le_bytes()).chain(blocks.concat()).collect()
}

#[test]
fn compressed_vtu_may_be_a_regular_grid_but_no_bomb() {
    let zlib = "compressor=\"vtkZLibDataCompressor\"";
    let mesh = crate::map::testing::hex_box([20, 20, 20]);
    let Cells::Hexahedra(cells) = mesh.cells() else { panic!() };
    let points: Vec<u8> = mesh.points().iter().flat_map(|p| p.iter()).flat_map(|&x| (x as f32).to_le_bytes()).collect();
    let corners: Vec<u8> = cells.as_flattened().iter().flat_map(|v| v.to_le_bytes()).collect();
    let ends: Vec<u8> = (1..=cells.len() as u32).flat_map(|i| (8 * i).to_le_bytes()).collect();
    let grid = [points, corners, ends, vec![12; cells.len()]];
    for size in [32768, 1 << 24] {
        let packed = |data: &[u8]| packed(data, size);
        let file = appended(zlib, "raw", &grid.each_ref().map(|data| packed(data)));
        assert_eq!(read_bytes(Format::Vtu, &file).unwrap().cells(), mesh.cells());
        let mut bomb = grid.each_ref().map(|data| packed(data));
        bomb[0] = packed(&vec![0; 1 << 26]);
        let error = read_bytes(Format::Vtu, &appended(zlib, "raw", &bomb)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Parse);
        assert!(error.message.contains("larger") && error.remedy.contains("uncompressed"), "{error}");
    }
}

fn appended(attributes: &str, encoding: &str, data: &[Vec<u8>; 4]) -> Vec<u8> {
    let mut offset = 0;
    let arrays = data.each_ref().map(|d| {
        let array = format!("format=\"appended\" offset=\"{offset}\">");
        offset += d.len();
        array
    });
    let tag = format!("<AppendedData encoding=\"{encoding}\">\n _");
    let tail = [tag.as_bytes(), &data.concat(), b"\n</AppendedData></VTKFile>"].concat();
    vtu(attributes, arrays.each_ref().map(String::as_str), &tail)
}

/// What the padding of base64 may not be: in the middle of four characters, or three of them.
#[test]
fn base64_that_is_malformed_is_refused() {
    let ascii =
        ["format=\"ascii\">0 0 0 1 0 0 0 1 0", "format=\"ascii\">0 1 2", "format=\"ascii\">3", "format=\"ascii\">5"];
    let kind = |bytes: &str| {
        let types = format!("format=\"binary\">{bytes}");
        read_bytes(Format::Vtu, &vtu("", [ascii[0], ascii[1], ascii[2], &types], b"</VTKFile>")).map(drop)
    };
    assert_eq!(kind("AQAAAAU="), Ok(()));
    for wrong in ["AQAAA=U=", "AQAA=AAA BQ==", "AQAAAAU", "AQAA====", "AQAAAA=5", "AQAAAA-_"] {
        let error = kind(wrong).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Parse, "{wrong}");
    }
}

#[test]
fn quadratic_cells_are_named_as_such() {
    let points = "0 0 0\n".repeat(10);
    let grid = "DATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n";
    let vtk = format!(
        "# vtk DataFile Version 3.0\nx\nASCII\n{grid}{points}CELLS 1 11\n10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n24\n"
    );
    let vertices = "0 0 0 0\n".repeat(10);
    let medit = format!(
        "MeshVersionFormatted 2\nDimension 3\nVertices\n10\n{vertices}TetrahedraP2\n1\n1 2 3 4 5 6 7 8 9 10 0\nEnd\n"
    );
    for (format, text) in [(Format::Vtk, vtk), (Format::Medit, medit)] {
        let error = read_bytes(format, text.as_bytes()).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Unsupported);
        assert!(error.message.contains("quadratic") && error.remedy.contains("linear"), "{error}");
    }
}
