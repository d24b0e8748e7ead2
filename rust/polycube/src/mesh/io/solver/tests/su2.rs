//! SU2's text.

use super::*;

#[test]
fn cells_points_and_markers_are_those_of_the_box() {
    let mesh = box_mesh();
    let text = texts(SolverFormat::Su2, &grouped(&mesh)).remove(0);
    let mut lines = text.lines();
    let mut value = |key: &str| -> (String, Vec<String>) {
        let (found, value) = lines.next().unwrap().split_once("= ").unwrap();
        assert_eq!(found, key);
        let count = if key.starts_with("NELEM") || key.starts_with("NPOIN") || key == "MARKER_ELEMS" {
            value.parse().unwrap()
        } else {
            0
        };
        (value.to_owned(), lines.by_ref().take(count).map(str::to_owned).collect())
    };
    assert_eq!(value("NDIME").0, "3");
    for (i, line) in value("NELEM").1.iter().enumerate() {
        let all: Vec<u32> = numbers(line);
        assert_eq!((all[0], array(&all[1..], 0), all[9]), (12, cells(&mesh)[i], i as u32));
    }
    for (i, line) in value("NPOIN").1.iter().enumerate() {
        let all: Vec<f64> = numbers(line);
        assert_eq!((Point::new(all[0], all[1], all[2]), all[3]), (mesh.points()[i], i as f64));
    }
    assert_eq!(value("NMARK").0, "6");
    let mut quads = Vec::new();
    for (s, name) in SIDES.into_iter().enumerate() {
        assert_eq!(value("MARKER_TAG").0, name);
        for line in value("MARKER_ELEMS").1 {
            let all: Vec<u32> = numbers(&line);
            quads.push(array::<4>(&all[1..], 0));
            assert_eq!((all[0], side(mesh.points(), quads[quads.len() - 1])), (9, Some(s)));
        }
    }
    assert_eq!(lines.next(), None);
    encloses_the_box(mesh.points(), &quads);
}
