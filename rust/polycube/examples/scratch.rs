#![allow(missing_docs, clippy::all)]
use polycube::mesh::*; use polycube::structure::*; use polycube::layout::*;
use std::time::Instant;
fn obj(p: &str) -> Mesh {
    let s = std::fs::read_to_string(p).unwrap();
    let mut points = vec![]; let mut t = vec![];
    for l in s.lines() { let w: Vec<&str> = l.split_whitespace().collect();
        if w.is_empty() { continue }
        if w[0]=="v" { points.push(Point::new(w[1].parse().unwrap(), w[2].parse().unwrap(), w[3].parse().unwrap())) }
        if w[0]=="f" { let v: Vec<u32> = w[1..].iter().map(|x| x.split('/').next().unwrap().parse::<u32>().unwrap()-1).collect(); t.push([v[0],v[1],v[2]]) } }
    Mesh { points, cells: Cells::Triangles(t) }
}
fn main() {
    let mut names: Vec<_> = std::fs::read_dir("/work/shared/data").unwrap().map(|e| e.unwrap().path()).filter(|p| p.to_str().unwrap().ends_with(".polycube.obj")).collect();
    names.sort();
    for p in names {
        let mesh = obj(p.to_str().unwrap());
        let t = Instant::now();
        let pc = match Polycube::new(&mesh, None, &Tolerance::default()) { Ok(p) => p, Err(v) => { println!("{:?} {} violations, first {}", p, v.len(), v[0]); continue } };
        let t1 = t.elapsed();
        let t = Instant::now();
        let a = Arrangement::new(&pc.structure, &pc.placement);
        let c = a.conflicts(); let io = a.inside_out();
        let t2 = t.elapsed();
        let t = Instant::now();
        let l = Lattice::new(&a); let k = Complex::new(&l, &a).counts(&a);
        let t3 = t.elapsed();
        let s = &pc.structure;
        println!("{} c{} f{} e{} l{} g{} comp{} conflicts {} io {} short {} {:?} lattice {:?} | {:?} {:?} {:?}", p.file_stem().unwrap().to_str().unwrap(), s.corners.len(), s.facets.len(), s.edges.len(), s.levels.len(), s.genus(), s.components().iter().max().unwrap()+1, c.len(), io.len(), s.shortest_edge(&pc.placement), k, l.size, t1, t2, t3);
        for c in c.iter().take(3) { println!("   {:?}", c); }
    }
}
