//! The `polycube` command.

fn main() {}
