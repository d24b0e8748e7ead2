//! Published polycubes, where they are at hand.

use super::*;
use std::path::PathBuf;
use std::time::Instant;

fn polycubes() -> Vec<PathBuf> {
    let Some(folder) = crate::data::folder() else {
        return Vec::new();
    };
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files.filter(|p| p.to_string_lossy().contains(".polycube.")).collect();
    files.sort();
    files
}

#[test]
fn published_pairs_agree() {
    for path in polycubes() {
        let shape = PathBuf::from(path.to_string_lossy().replace(".polycube.", ".shape."));
        let (polycube, _) = read_pair(&path, &shape).unwrap();
        let is_volume = Format::from_path(&path).unwrap() == Format::Medit;
        assert_eq!(polycube.cells().is_volume(), is_volume);
        assert!(polycube.points().iter().all(|p| p.iter().all(|x| x.fract() == 0.0)));
    }
}

#[test]
fn published_shapes_round_trip() {
    for path in polycubes() {
        let shape = read(&PathBuf::from(path.to_string_lossy().replace(".polycube.", ".shape."))).unwrap();
        for format in Format::ALL.into_iter().filter(|f| f.holds(shape.cells().kind()) && *f != Format::Stl) {
            let start = Instant::now();
            let bytes = write_bytes(format, &shape, &[]).unwrap();
            let written = start.elapsed();
            let start = Instant::now();
            let again = read_bytes(format, &bytes).unwrap();
            let name = path.file_name().unwrap().to_string_lossy();
            println!("{name} as {format}: written in {written:?}, read in {:?}", start.elapsed());
            assert!(again == shape && bits(&again) == bits(&shape), "{name} as {format}");
        }
    }
}
