//! Times the optimiser on real polycubes: `untangle [--padding] [--step h] PAIR...`, where a pair is a path without `.shape.mesh`.
//! Makes the lattice of the polycube, takes it to the shape tetrahedron by tetrahedron, lets its surface slide, and says what became of it.

use polycube::mesh::{Cells, Face, Mesh, Point, read};
use polycube::optimise::{
    CurveGuide, Elements, Freedom, Guide, Settings, SurfaceGuide, cell_qualities, optimise, statistics,
};
use polycube::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

fn main() -> Result<()> {
    let mut args: Vec<String> = std::env::args().skip(1).collect();
    let padding = args.iter().position(|a| a == "--padding").map(|i| args.remove(i)).is_some();
    let step = args.iter().position(|a| a == "--step").map_or(1.0, |i| {
        args.remove(i);
        args.remove(i).parse().unwrap_or(1.0)
    });
    for stem in &args {
        let polycube = read(Path::new(&format!("{stem}.polycube.mesh")))?;
        let shape = read(Path::new(&format!("{stem}.shape.mesh")))?;
        polycube_map(&polycube, &shape)?;
        hexes(stem, &polycube, &shape, step, padding)?;
    }
    Ok(())
}

/// Moves the inner vertices of the polycube towards the shape's proportions.
fn polycube_map(polycube: &Mesh, shape: &Mesh) -> Result<()> {
    let Cells::Tetrahedra(tets) = &polycube.cells else { return Ok(()) };
    let mut freedom = vec![[false; 3]; polycube.points.len()];
    for (face, label) in labels(polycube)? {
        face.iter().for_each(|v| freedom[*v as usize][label as usize / 2] = true);
    }
    let freedom: Vec<Freedom> = freedom.into_iter().map(Freedom::Axes).collect();
    let elements = Elements::tetrahedra_like(tets, &shape.points)?;
    let (start, mut points) = (Instant::now(), polycube.points.clone());
    let report = optimise(&mut points, &elements, &freedom, &[], &Settings::default(), &Context::default())?;
    println!("map, {} tets, {:.2} s: {report:.4?}", tets.len(), start.elapsed().as_secs_f64());
    Ok(())
}

/// The boundary triangles with the axis (times 2) they are across.
fn labels(polycube: &Mesh) -> Result<Vec<(Vec<u32>, u8)>> {
    let of = |f: &Face| {
        let p: Vec<Point> = f.vertices().iter().map(|v| polycube.points[*v as usize]).collect();
        let n = (p[1] - p[0]).cross(&(p[2] - p[0]));
        let axis = n.iamax();
        (f.vertices().to_vec(), 2 * axis as u8 + u8::from(n[axis] < 0.0))
    };
    Ok(polycube.cells.boundary()?.iter().map(of).collect())
}

/// Lattice points and the hexahedra whose middle is inside.
struct Lattice {
    points: Vec<Point>,
    cells: Vec<[u32; 8]>,
}

fn barycentric(p: &[Point; 4], x: &Point) -> Option<[f64; 4]> {
    let m = nalgebra::Matrix3::from_columns(&[p[1] - p[0], p[2] - p[0], p[3] - p[0]]);
    let w = m.try_inverse()? * (x - p[0]);
    let w = [1.0 - w.sum(), w.x, w.y, w.z];
    w.iter().all(|w| *w > -1e-9).then_some(w)
}

/// Takes every lattice point (and middle, at odd places) inside the polycube to the shape.
fn sample(polycube: &Mesh, shape: &Mesh, step: f64) -> BTreeMap<[i64; 3], Point> {
    let Cells::Tetrahedra(tets) = &polycube.cells else { return BTreeMap::new() };
    let mut images = BTreeMap::new();
    for tet in tets {
        let p = tet.map(|v| polycube.points[v as usize]);
        let low: Vec<i64> =
            (0..3).map(|a| (p.iter().map(|p| p[a]).fold(1e30, f64::min) / step * 2.0 - 1e-6).ceil() as i64).collect();
        let high: Vec<i64> =
            (0..3).map(|a| (p.iter().map(|p| p[a]).fold(-1e30, f64::max) / step * 2.0 + 1e-6).floor() as i64).collect();
        for (i, j, k) in (low[0]..=high[0])
            .flat_map(|i| (low[1]..=high[1]).flat_map(move |j| (i..=i).map(move |i| (i, j))))
            .flat_map(|(i, j)| (low[2]..=high[2]).map(move |k| (i, j, k)))
        {
            let x = Point::new(i as f64, j as f64, k as f64) * (step / 2.0);
            if let Some(w) = barycentric(&p, &x) {
                let image: nalgebra::Vector3<f64> =
                    tet.iter().zip(w).map(|(v, w)| shape.points[*v as usize].coords * w).sum();
                images.insert([i, j, k], Point::from(image));
            }
        }
    }
    images
}

fn lattice(polycube: &Mesh, shape: &Mesh, step: f64) -> Lattice {
    let images = sample(polycube, shape, step);
    let mut number = BTreeMap::new();
    let mut lattice = Lattice { points: vec![], cells: vec![] };
    for at in images.keys().filter(|at| at.iter().all(|x| x.rem_euclid(2) == 1)) {
        let offsets =
            [[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]];
        let keys = offsets.map(|o| [at[0] + o[0], at[1] + o[1], at[2] + o[2]]);
        if keys.iter().all(|k| images.contains_key(k)) {
            lattice.cells.push(keys.map(|k| {
                *number.entry(k).or_insert_with(|| {
                    lattice.points.push(images[&k]);
                    lattice.points.len() as u32 - 1
                })
            }));
        }
    }
    lattice
}

/// Sets of boundary faces connected without crossing an edge between labels; and the edges between two sets.
type Charts = (Vec<usize>, BTreeMap<(usize, usize), Vec<[u32; 2]>>);

fn charts(faces: &[(Vec<u32>, u8)]) -> Charts {
    let mut beside: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (i, (f, _)) in faces.iter().enumerate() {
        for k in 0..f.len() {
            let (a, b) = (f[k], f[(k + 1) % f.len()]);
            beside.entry((a.min(b), a.max(b))).or_default().push(i);
        }
    }
    let mut root: Vec<usize> = (0..faces.len()).collect();
    fn find(root: &mut [usize], mut i: usize) -> usize {
        while root[i] != i {
            root[i] = root[root[i]];
            i = root[i];
        }
        i
    }
    for pair in beside.values() {
        if faces[pair[0]].1 == faces[pair[1]].1 {
            let (a, b) = (find(&mut root, pair[0]), find(&mut root, pair[1]));
            root[a.max(b)] = a.min(b);
        }
    }
    let chart: Vec<usize> = (0..faces.len()).map(|i| find(&mut root, i)).collect();
    let mut curves: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for ((a, b), pair) in beside {
        let (c, d) = (chart[pair[0]], chart[pair[1]]);
        if c != d {
            curves.entry((c.min(d), c.max(d))).or_default().push([a, b]);
        }
    }
    (chart, curves)
}

fn hexes(name: &str, polycube: &Mesh, shape: &Mesh, step: f64, padding: bool) -> Result<()> {
    let mut lattice = lattice(polycube, shape, step);
    let faces: Vec<Vec<u32>> =
        Cells::Hexahedra(lattice.cells.clone()).boundary()?.iter().map(|f| f.vertices().to_vec()).collect();
    // One guide for each label's triangles near enough, by the polycube's charts.
    let tri = labels(polycube)?;
    let (chart, curves) = charts(&tri);
    let mut surfaces: BTreeMap<usize, Vec<[u32; 3]>> = BTreeMap::new();
    for ((t, _), c) in tri.iter().zip(&chart) {
        surfaces.entry(*c).or_default().push([t[0], t[1], t[2]]);
    }
    let mut guides: Vec<Box<dyn Guide>> = Vec::new();
    let mut surface_ids = BTreeMap::new();
    for (c, t) in &surfaces {
        surface_ids.insert(*c, guides.len() as u32);
        guides.push(Box::new(SurfaceGuide::new(&shape.points, t)?));
    }
    let mut curve_ids = BTreeMap::new();
    for (c, s) in &curves {
        curve_ids.insert(*c, guides.len() as u32);
        guides.push(Box::new(CurveGuide::new(&shape.points, s)?));
    }
    // The chart of each boundary quad: that nearest to its middle.
    let mut touched: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for f in &faces {
        let middle = f.iter().map(|v| lattice.points[*v as usize].coords).sum::<nalgebra::Vector3<f64>>() / 4.0;
        let best = surface_ids
            .iter()
            .map(|(c, g)| {
                let far = |p: &Point| (guides[*g as usize].contact(p).point - p).norm_squared();
                (
                    f.iter().map(|v| far(&lattice.points[*v as usize])).sum::<f64>() * 10.0 + far(&Point::from(middle)),
                    *c,
                )
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(0, |b| b.1);
        f.iter().for_each(|v| touched.entry(*v).or_default().push(best));
    }
    let mut freedom = vec![Freedom::Free; lattice.points.len()];
    for (v, mut c) in touched.clone() {
        c.sort_unstable();
        c.dedup();
        freedom[v as usize] = match c[..] {
            [c] => Freedom::Guided(surface_ids[&c]),
            [c, d] => curve_ids.get(&(c, d)).map_or(Freedom::Fixed, |g| Freedom::Guided(*g)),
            _ => Freedom::Fixed,
        };
    }
    if padding {
        pad(&mut lattice, &faces, &mut freedom);
    }
    let mesh = |points: &[Point]| Mesh { points: points.to_vec(), cells: Cells::Hexahedra(lattice.cells.clone()) };
    let before = statistics(&cell_qualities(&mesh(&lattice.points))?);
    println!(
        "{name}: {} hexes, {} guides, before min {:.3} avg {:.3} inverted {}",
        before.cells,
        guides.len(),
        before.min,
        before.average,
        before.inverted
    );
    let guides: Vec<&dyn Guide> = guides.iter().map(|g| &**g).collect();
    let mut points = lattice.points.clone();
    let start = Instant::now();
    let elements = Elements::boxes_like(&lattice.cells, &points, 3)?;
    let mut settings = Settings::default();
    let number = |name: &str, or: f64| std::env::var(name).ok().and_then(|s| s.parse().ok()).unwrap_or(or);
    settings.theta = number("THETA", settings.theta);
    settings.strength = number("STRENGTH", settings.strength);
    settings.improve_rounds = number("ROUNDS", settings.improve_rounds as f64) as usize;
    settings.improve_iterations = number("ITERATIONS", settings.improve_iterations as f64) as usize;
    settings.polish_rounds = number("POLISH", settings.polish_rounds as f64) as usize;
    let last = std::sync::Mutex::new((String::new(), Instant::now()));
    let context = Context::new(move |stage, _| {
        if let Ok(mut last) = last.lock()
            && last.0 != stage
        {
            println!("  {} took {:.2} s", last.0, last.1.elapsed().as_secs_f64());
            *last = (stage.to_owned(), Instant::now());
        }
    });
    let report = optimise(&mut points, &elements, &freedom, &guides, &settings, &context)?;
    let after = statistics(&cell_qualities(&mesh(&points))?);
    println!(
        "  {:.2} s, {} iterations: min {:.3} avg {:.3} inverted {} {:?}",
        start.elapsed().as_secs_f64(),
        report.iterations,
        after.min,
        after.average,
        after.inverted,
        after.histogram
    );
    Ok(())
}

/// A layer of hexahedra around the mesh; the old surface moves inside a bit.
fn pad(lattice: &mut Lattice, faces: &[Vec<u32>], freedom: &mut Vec<Freedom>) {
    let mut outer = BTreeMap::new();
    let inside: Vec<Point> = {
        let mut sums = vec![(nalgebra::Vector3::zeros(), 0.0); lattice.points.len()];
        for c in &lattice.cells {
            let middle = c.iter().map(|v| lattice.points[*v as usize].coords).sum::<nalgebra::Vector3<f64>>() / 8.0;
            c.iter().for_each(|v| {
                sums[*v as usize].0 += middle;
                sums[*v as usize].1 += 1.0;
            });
        }
        sums.into_iter().map(|(s, n)| Point::from(s / n)).collect()
    };
    for f in faces {
        for v in f {
            outer.entry(*v).or_insert_with(|| {
                let p = lattice.points[*v as usize];
                lattice.points.push(p);
                lattice.points[*v as usize] = nalgebra::center(&p, &inside[*v as usize]);
                freedom.push(freedom[*v as usize]);
                freedom[*v as usize] = Freedom::Free;
                lattice.points.len() as u32 - 1
            });
        }
        lattice.cells.push([f[0], f[1], f[2], f[3], outer[&f[0]], outer[&f[1]], outer[&f[2]], outer[&f[3]]]);
    }
}
