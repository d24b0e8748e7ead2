//! What the README shows of the library: a pair of files in, a simplified polycube out.

use polycube::mesh::{read_pair, write};
use polycube::simplify::simplify;
use polycube::{Context, Input, SimplifyOptions};

fn main() -> polycube::Result<()> {
    let [polycube, shape] = ["polycube", "shape"].map(|kind| format!("demo/examples/ring.{kind}.obj"));
    let (cube, shape) = read_pair(polycube.as_ref(), shape.as_ref())?;
    let input = Input { polycube: &cube, shape: Some(&shape), labels: None };
    let simple = simplify(&input, &SimplifyOptions::default(), &Context::default())?;
    println!("{:?} before, {:?} after", simple.report.before, simple.report.after);
    simple.polycube.map_or(Ok(()), |mesh| write("simple.obj".as_ref(), &mesh, &[]))
}
