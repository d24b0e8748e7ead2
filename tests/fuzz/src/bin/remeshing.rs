//! Fuzz target, see the function of the same name.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| polycube_fuzz::remeshing(data));
