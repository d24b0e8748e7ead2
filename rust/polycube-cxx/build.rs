//! Compiles the C++ half of the bridge into the library.

fn main() {
    cxx_build::bridge("src/lib.rs").std("c++17").compile("polycube-cxx-bridge");
    println!("cargo:rerun-if-changed=src/lib.rs");
    println!("cargo:rerun-if-changed=include/observer.h");
}
