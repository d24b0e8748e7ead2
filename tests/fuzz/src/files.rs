//! Files: the first byte chooses the format, the others are the file.

use polycube::align::Guides;
use polycube::mesh::{Format, Mesh, parse_labels, read_bytes, write_bytes};

/// Reads a mesh in one of the formats, labels, or guides. What can be read can be written and read again.
pub fn files(data: &[u8]) {
    let Some((&choice, bytes)) = data.split_first() else { return };
    let formats = Format::ALL.len();
    let choice = usize::from(choice) % (formats + 2);
    match Format::ALL.get(choice) {
        Some(&format) => {
            if let Ok(mesh) = read_bytes(format, bytes) {
                write(&mesh);
            }
        }
        None if choice == formats => {
            if let Ok(labels) = parse_labels(bytes, bytes.len() / 4) {
                assert!(labels.iter().all(|l| (-1..6).contains(l)));
            }
        }
        None => {
            if let Ok(guides) = serde_json::from_slice::<Guides>(bytes) {
                let again = serde_json::to_vec(&guides).map(|text| serde_json::from_slice::<Guides>(&text));
                assert!(again.is_ok_and(|again| again.is_ok_and(|again| again == guides)));
            }
        }
    }
}

fn write(mesh: &Mesh) {
    let _ = mesh.cells().boundary();
    for format in Format::ALL.into_iter().filter(|f| f.holds(mesh.cells().kind())) {
        let bytes = write_bytes(format, mesh, &[]);
        if format == Format::Stl {
            continue; // Single precision, and vertices are welded.
        }
        let again = bytes.map(|bytes| read_bytes(format, &bytes));
        assert!(matches!(&again, Ok(Ok(again)) if again == mesh), "{format}: {again:?}");
    }
}
