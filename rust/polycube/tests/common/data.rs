//! The folder of the sixteen real polycubes, where the machine has them. All tests and benchmarks find it here.

use std::path::PathBuf;

/// The folder. Without one it says so and gives nothing, unless `POLYCUBE_REQUIRE_DATA` is 1.
pub fn folder() -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let folder = std::env::var_os("POLYCUBE_DATA").map_or_else(|| PathBuf::from(beside), PathBuf::from);
    if folder.join("reference.json").is_file() {
        return Some(folder);
    }
    let required = std::env::var("POLYCUBE_REQUIRE_DATA").is_ok_and(|x| x == "1");
    assert!(!required, "there is no data in {}", folder.display());
    println!("skipped: no data");
    None
}
