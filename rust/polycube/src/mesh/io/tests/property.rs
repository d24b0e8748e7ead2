//! Arbitrary input and arbitrary meshes.

use super::*;
use proptest::prelude::*;

fn any_format() -> impl Strategy<Value = Format> {
    proptest::sample::select(&Format::ALL[..])
}

fn any_mesh() -> impl Strategy<Value = Mesh> {
    any_mesh_of(&CellKind::ALL)
}

fn any_mesh_of(kinds: &'static [CellKind]) -> impl Strategy<Value = Mesh> {
    let coordinate = prop_oneof![
        proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO,
        (-20..20).prop_map(f64::from),
    ];
    let points = proptest::collection::vec([coordinate.clone(), coordinate.clone(), coordinate], 1..20);
    let kind = proptest::sample::select(kinds);
    let corners = proptest::collection::vec(any::<[proptest::sample::Index; 8]>(), 1..10);
    (points, kind, corners).prop_map(|(points, kind, corners)| {
        let corners: Vec<[u32; 8]> =
            corners.iter().map(|c| c.map(|i| u32::try_from(i.index(points.len())).unwrap())).collect();
        let four = || corners.iter().map(|c| [c[0], c[1], c[2], c[3]]).collect();
        let cells = match kind {
            CellKind::Triangles => Cells::Triangles(corners.iter().map(|c| [c[0], c[1], c[2]]).collect()),
            CellKind::Quads => Cells::Quads(four()),
            CellKind::Tetrahedra => Cells::Tetrahedra(four()),
            CellKind::Hexahedra => Cells::Hexahedra(corners),
        };
        let points = points.into_iter().map(Point::from).collect();
        Mesh::new(points, cells).unwrap()
    })
}

/// Words that readers know, so that arbitrary files get past their headers.
fn any_words() -> impl Strategy<Value = Vec<u8>> {
    const WORDS: &[&str] = &[
        "v",
        "f",
        "\\",
        "#",
        "OFF",
        "COFF",
        "ply",
        "format",
        "ascii",
        "1.0",
        "binary_little_endian",
        "element",
        "vertex",
        "face",
        "property",
        "list",
        "uchar",
        "int",
        "float",
        "x",
        "y",
        "z",
        "vertex_indices",
        "end_header",
        "solid",
        "facet",
        "endfacet",
        "endsolid",
        "MeshVersionFormatted",
        "Dimension",
        "Vertices",
        "Triangles",
        "Tetrahedra",
        "End",
        "# vtk DataFile Version 5.1\n\nASCII",
        "# vtk DataFile Version 3.0\n\nBINARY",
        "DATASET",
        "POLYDATA",
        "UNSTRUCTURED_GRID",
        "POINTS",
        "CELLS",
        "CELL_TYPES",
        "POLYGONS",
        "OFFSETS",
        "CONNECTIVITY",
        "FIELD",
        "METADATA",
        "0",
        "1",
        "2",
        "3",
        "4",
        "-1",
        "0.5",
        "nan",
        "99999999999999999999",
        "18446744073709551615",
        "\n",
        "\n",
        "\r\n",
        "\0\0\0",
    ];
    let words = proptest::collection::vec(proptest::sample::select(WORDS), 0..60);
    words.prop_map(|words| words.join(" ").replace(" \n ", "\n").into_bytes())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_bytes_never_panic(format in any_format(), bytes in any::<Vec<u8>>()) {
        let _ = read_bytes(format, &bytes);
        let _ = parse_labels(&bytes, 3);
    }

    #[test]
    fn arbitrary_words_never_panic(format in any_format(), bytes in any_words()) {
        let _ = read_bytes(format, &bytes);
    }

    #[test]
    fn damaged_files_never_panic(
        format in any_format(),
        mesh in any_mesh(),
        damage in proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 1..6),
    ) {
        if let Ok(mut bytes) = write_bytes(format, &mesh, &[]) {
            for (place, byte) in damage {
                let place = place.index(bytes.len());
                bytes[place] = byte;
            }
            let _ = read_bytes(format, &bytes);
        }
    }

    #[test]
    fn what_was_written_is_read(mesh in any_mesh()) {
        let able = |f: &Format| *f != Format::Stl && f.holds(mesh.cells().kind());
        for format in Format::ALL.into_iter().filter(able) {
        let again = read_bytes(format, &write_bytes(format, &mesh, &[]).unwrap()).unwrap();
        prop_assert_eq!(bits(&again), bits(&mesh));
        prop_assert_eq!(&again, &mesh);
        }
    }

    #[test]
    fn stl_keeps_every_corner(mesh in any_mesh_of(&[CellKind::Triangles])) {
        let mesh = single(mesh);
        let again = read_bytes(Format::Stl, &write_bytes(Format::Stl, &mesh, &[]).unwrap()).unwrap();
        for i in 0..mesh.cells().len() {
            for (a, b) in mesh.cells().cell(i).iter().zip(again.cells().cell(i)) {
                prop_assert_eq!(mesh.points()[*a as usize], again.points()[*b as usize]);
            }
        }
    }
}
