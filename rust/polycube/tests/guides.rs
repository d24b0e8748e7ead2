//! Guides: what must stay stays, for every strategy, and what cannot be is an error that says so.

mod common;

use common::{cases, coarse, dense, read, simplify};
use polycube::align::{Effort, Guides, Strategy, Symmetry};
use polycube::generate::{Cuboid, Example, Voxels, example, random_polycube};
use polycube::mesh::{CellKind, Mesh};
use polycube::simplify::{Cause, Note};
use polycube::structure::Polycube;
use polycube::{Context, Error, ErrorKind, Input, Place, Simplified, SimplifyOptions};
use proptest::prelude::*;

const VALID: [Strategy; 2] = [Strategy::Paper, Strategy::Best];

fn options(strategy: Strategy, guides: Guides) -> SimplifyOptions {
    let effort = Effort { steps_per_level: 40, proof_nodes: 20, ..Effort::default() };
    SimplifyOptions { strategy, guides, effort, scale: Some(2.0), ..SimplifyOptions::default() }
}

fn spikes() -> Mesh {
    example(Example::CubeSpikes, 5, CellKind::Triangles).expect("the example exists").0
}

/// Where each facet lies in a result, on the lattice.
fn facet_levels(result: &Simplified) -> Vec<i64> {
    result.input.structure.facets.iter().map(|f| result.levels[f.level as usize]).collect()
}

fn axis_of(polycube: &Polycube, facet: usize) -> usize {
    polycube.structure.facets[facet].label.axis()
}

fn coordinate(polycube: &Polycube, facet: usize) -> f64 {
    polycube.placement[polycube.structure.facets[facet].level as usize]
}

fn refused(mesh: &Mesh, guides: Guides) -> Error {
    simplify(mesh, &options(Strategy::Best, guides)).map(|r| r.levels).expect_err("these guides make no sense")
}

/// Valid, no more blocks than before, and every guide kept, judged by the facets alone.
fn check(result: &Simplified, guides: &Guides, what: &str) -> Result<(), TestCaseError> {
    let (input, report) = (&result.input, &result.report);
    prop_assert_eq!(dense::check(&input.structure, &result.levels), Ok(()), "{}", what);
    prop_assert!(report.after.is_some_and(|a| a.blocks_padded <= report.before.blocks_padded), "{what}");
    let at = facet_levels(result);
    for &facet in &guides.fixed {
        let wanted = (coordinate(input, facet) * report.scale).round() as i64;
        prop_assert_eq!(at[facet], wanted, "{}: fixed facet {}", what, facet);
    }
    for group in &guides.together {
        prop_assert!(group.iter().all(|&f| at[f] == at[group[0]]), "{what}: {group:?} at {at:?}");
    }
    for [a, b] in &guides.apart {
        prop_assert!(at[*a] != at[*b], "{what}: {a} and {b}");
    }
    for plane in &guides.symmetry {
        check_mirror(result, plane, what)?;
    }
    Ok(())
}

/// Every corner of the result has a mirror image among the corners, and all about one plane.
fn check_mirror(result: &Simplified, plane: &Symmetry, what: &str) -> Result<(), TestCaseError> {
    let structure = &result.input.structure;
    let at = |c: &polycube::structure::Corner| c.levels.map(|l| result.levels[l as usize]);
    let mut corners: Vec<[i64; 3]> = structure.corners.iter().map(at).collect();
    corners.sort_unstable();
    let along = corners.iter().map(|c| c[plane.axis]);
    let doubled = along.clone().min().unwrap_or(0) + along.max().unwrap_or(0);
    let mut mirrored = corners.clone();
    mirrored.iter_mut().for_each(|c| c[plane.axis] = doubled - c[plane.axis]);
    mirrored.sort_unstable();
    prop_assert_eq!(corners, mirrored, "{}: not symmetric", what);
    let off = doubled as f64 / 2.0 - plane.at * result.report.scale;
    prop_assert!(off.abs() <= 1.0, "{what}: the plane moved by {off} steps");
    Ok(())
}

#[test]
fn facets_that_must_not_move_stay() {
    let mesh = spikes();
    for strategy in [Strategy::Naive, Strategy::Paper, Strategy::Best] {
        for scale in [1.0, 2.5, 40.0] {
            let guides = Guides { fixed: vec![0, 7, 12, 20], ..Guides::default() };
            let asked = SimplifyOptions { scale: Some(scale), ..options(strategy, guides.clone()) };
            let result = simplify(&mesh, &asked).expect("there is room");
            for &facet in &guides.fixed {
                let wanted = (coordinate(&result.input, facet) * scale).round() as i64;
                assert_eq!(facet_levels(&result)[facet], wanted, "{strategy:?} at {scale}: facet {facet}");
            }
        }
    }
}

#[test]
fn no_facet_moves_when_all_are_fixed() {
    let mesh = spikes();
    let polycube = read(&mesh);
    let fixed: Vec<usize> = (0..polycube.structure.facets.len()).collect();
    for strategy in VALID {
        let guides = Guides { fixed: fixed.clone(), ..Guides::default() };
        let result = simplify(&mesh, &SimplifyOptions { scale: Some(1.0), ..options(strategy, guides) })
            .expect("the input fits");
        let still: Vec<i64> = polycube.placement.iter().map(|x| x.round() as i64).collect();
        assert_eq!(result.levels, still);
        assert_eq!(result.report.after, Some(result.report.before));
    }
}

#[test]
fn faces_and_labels_lock_their_facets() {
    let mesh = spikes();
    let polycube = read(&mesh);
    let asked = Guides { fixed: vec![2], fixed_faces: vec![0, 1, 5], fixed_labels: vec![5], ..Guides::default() };
    for strategy in VALID {
        let result = simplify(&mesh, &options(strategy, asked.clone())).expect("the input fits");
        let named = [0, 1, 5].map(|f: usize| polycube.facet_of_face[f] as usize);
        let facets = polycube.structure.facets.iter().enumerate();
        let locked: Vec<usize> =
            facets.filter(|(i, f)| *i == 2 || named.contains(i) || f.label.index() == 5).map(|(i, _)| i).collect();
        let mut fixed = result.options.guides.fixed.clone();
        fixed.sort_unstable();
        fixed.dedup();
        assert_eq!(fixed, locked);
        check(&result, &result.options.guides, "locked").expect("the guides hold");
    }
    let face = refused(&mesh, Guides { fixed_faces: vec![0, 1_000_000], ..Guides::default() });
    assert_eq!((face.kind, face.place, face.option), (ErrorKind::Option, Some(Place::Face(1_000_000)), Some("guides")));
    let label = refused(&mesh, Guides { fixed_labels: vec![6], ..Guides::default() });
    assert_eq!((label.kind, label.option), (ErrorKind::Option, Some("guides")));
}

#[test]
fn facets_are_kept_apart_that_the_search_would_join() {
    let mesh = spikes();
    for strategy in VALID {
        let free = simplify(&mesh, &options(strategy, Guides::default())).expect("a valid polycube");
        let (at, input) = (facet_levels(&free), &free.input);
        let joined = |&[a, b]: &[usize; 2]| {
            axis_of(input, a) == axis_of(input, b) && at[a] == at[b] && coordinate(input, a) != coordinate(input, b)
        };
        let pairs = (0..at.len()).flat_map(|b| (0..b).map(move |a| [a, b]));
        let apart: Vec<[usize; 2]> = pairs.filter(joined).take(3).collect();
        assert_eq!(apart.len(), 3, "{strategy:?} joins facets");
        let guides = Guides { apart, ..Guides::default() };
        let result = simplify(&mesh, &options(strategy, guides.clone())).expect("the input has them apart");
        check(&result, &guides, "apart").expect("the guides hold");
        let [free, kept] = [&free, &result].map(|r| r.report.after.expect("valid").blocks_padded);
        assert!(kept > free, "{strategy:?}: {kept} blocks, {free} without guides");
    }
}

/// Two towers of heights 4 and 5 on a plate.
fn towers() -> Mesh {
    let boxes =
        [Cuboid::new([0, 0, 0], [9, 3, 1]), Cuboid::new([1, 1, 1], [2, 2, 4]), Cuboid::new([6, 1, 1], [7, 2, 5])];
    coarse(&Voxels::from_boxes(&boxes).expect("boxes fit"), CellKind::Quads)
}

/// The facets that look along +Z, from the highest down.
fn tops(polycube: &Polycube) -> Vec<usize> {
    let facets = &polycube.structure.facets;
    let mut tops: Vec<usize> =
        (0..facets.len()).filter(|&f| facets[f].label.axis() == 2 && facets[f].label.sign() > 0).collect();
    tops.sort_by(|&a, &b| coordinate(polycube, b).total_cmp(&coordinate(polycube, a)));
    tops
}

#[test]
fn facets_come_together_and_what_cannot_is_refused() {
    let mesh = towers();
    let tops = tops(&read(&mesh));
    for strategy in VALID {
        let guides = Guides { together: vec![vec![tops[0], tops[1]]], ..Guides::default() };
        let result = simplify(&mesh, &options(strategy, guides.clone())).expect("towers can be as high");
        check(&result, &guides, "together").expect("the guides hold");
    }
    let error = refused(&mesh, Guides { together: vec![vec![tops[0], tops[2]]], ..Guides::default() });
    assert_eq!(error.kind, ErrorKind::Option);
    assert!(matches!(error.place, Some(Place::Facet(_))) && error.message.contains("edges"), "{error}");
}

#[test]
fn together_and_fixed_hold_at_once() {
    let mesh = towers();
    let tops = tops(&read(&mesh));
    let guides = Guides { fixed: vec![tops[1]], together: vec![vec![tops[0], tops[1]]], ..Guides::default() };
    for strategy in VALID {
        let result = simplify(&mesh, &options(strategy, guides.clone())).expect("the high tower sinks");
        check(&result, &guides, "together and fixed").expect("the guides hold");
        assert_eq!(facet_levels(&result)[tops[0]], 8);
    }
}

#[test]
fn guides_that_make_no_sense_name_the_facet() {
    let mesh = towers();
    let polycube = read(&mesh);
    let tops = tops(&polycube);
    let side = (0..polycube.structure.facets.len()).find(|&f| axis_of(&polycube, f) == 0).expect("it has sides");
    let mine = |guides: Guides, facet: usize| {
        let error = refused(&mesh, guides);
        assert_eq!((error.kind, error.place), (ErrorKind::Option, Some(Place::Facet(facet as u32))), "{error}");
        assert!(!error.remedy.is_empty());
    };
    mine(Guides { fixed: vec![99], ..Guides::default() }, 99);
    mine(Guides { together: vec![vec![tops[0], side]], ..Guides::default() }, side);
    let pair = [tops[0], tops[1]];
    mine(Guides { together: vec![pair.to_vec()], apart: vec![pair], ..Guides::default() }, pair[0]);
    let both = refused(&mesh, Guides { together: vec![pair.to_vec()], fixed: pair.to_vec(), ..Guides::default() });
    assert!(matches!(both.place, Some(Place::Facet(_))), "{both}");
    let skew = refused(&mesh, Guides { symmetry: vec![Symmetry { axis: 0, at: 4.5 }], ..Guides::default() });
    assert_eq!(skew.kind, ErrorKind::Option);
    let nowhere = refused(&mesh, Guides { symmetry: vec![Symmetry { axis: 3, at: 4.5 }], ..Guides::default() });
    assert_eq!(nowhere.kind, ErrorKind::Option);
}

#[test]
fn too_coarse_a_lattice_for_fixed_facets_is_an_error() {
    let mesh = towers();
    let tops = tops(&read(&mesh));
    let guides = Guides { fixed: tops, ..Guides::default() };
    let asked = SimplifyOptions { scale: Some(0.1), ..options(Strategy::Best, guides) };
    let error = simplify(&mesh, &asked).map(|r| r.levels).expect_err("three planes do not fit into one step");
    assert_eq!(error.kind, ErrorKind::Infeasible, "{error}");
}

/// Boxes and their mirror images about x = 10.
fn mirrored(seed: u64, boxes: usize) -> Option<Mesh> {
    let half = random_polycube(seed, boxes, 9).ok()?;
    let place = |c: [usize; 3]| -> [i64; 3] { std::array::from_fn(|a| half.planes(a)[c[a]] as i64) };
    let cells = half.cells().map(|c| (place(c), place(c.map(|x| x + 1))));
    let both = |(low, high): ([i64; 3], [i64; 3])| {
        let image = Cuboid::new([20 - high[0], low[1], low[2]], [20 - low[0], high[1], high[2]]);
        [Cuboid::new(low, high), image]
    };
    let boxes: Vec<Cuboid> = cells.flat_map(both).collect();
    let plate = Cuboid::new([8, 0, 0], [12, 9, 1]);
    let voxels = Voxels::from_boxes(&[boxes, vec![plate]].concat()).ok()?;
    let mesh = coarse(&voxels, CellKind::Quads);
    let input = Input { polycube: &mesh, shape: None, labels: None };
    polycube::simplify::read_structure(&input, &Default::default()).is_ok().then_some(mesh)
}

#[test]
fn mirrored_polycubes_stay_mirrored() {
    let guides = Guides { symmetry: vec![Symmetry { axis: 0, at: 10.0 }], ..Guides::default() };
    let (mut tried, mut better) = (0, 0);
    for seed in 0..cases(60) {
        let Some(mesh) = mirrored(seed, 2 + seed as usize % 4) else { continue };
        for strategy in VALID {
            for scale in [1.0, 0.7] {
                let asked = SimplifyOptions { scale: Some(scale), ..options(strategy, guides.clone()) };
                let what = format!("seed {seed}, {strategy:?} at {scale}");
                let result = simplify(&mesh, &asked).unwrap_or_else(|e| panic!("{what}: {e}"));
                check(&result, &guides, &what).expect("the guides hold");
                tried += 1;
                better += u32::from(result.report.after.is_some_and(|a| a != result.report.before));
            }
        }
    }
    println!("{tried} tried, {better} better than the input");
    assert!(tried > 0 && 10 * better > tried);
}

/// At 0.75 steps per unit the plane x = 10 lies half way between lattice planes, and at 0.7 on one.
#[test]
fn fixed_facets_that_mirror_each_other_stay_or_are_refused() {
    let (mut kept, mut refused) = (0, 0);
    for seed in 0..cases(40) {
        let Some(mesh) = mirrored(seed, 2 + seed as usize % 4) else { continue };
        let polycube = read(&mesh);
        let at = |f: usize| coordinate(&polycube, f);
        let across: Vec<usize> = (0..polycube.structure.facets.len()).filter(|&f| axis_of(&polycube, f) == 0).collect();
        let one = across[seed as usize % across.len()];
        let image = across.iter().copied().find(|&f| (at(f) + at(one) - 20.0).abs() < 1e-9).expect("it is symmetric");
        for fixed in [vec![one], vec![one, image], across.clone()] {
            let guides = Guides { fixed, symmetry: vec![Symmetry { axis: 0, at: 10.0 }], ..Guides::default() };
            for (strategy, scale) in [(0, 1.0), (0, 0.75), (1, 0.75), (1, 0.7), (2, 0.7), (2, 0.75)] {
                let strategy = [Strategy::Paper, Strategy::Best, Strategy::Naive][strategy];
                let asked = SimplifyOptions { scale: Some(scale), ..options(strategy, guides.clone()) };
                let what = format!("seed {seed}, {strategy:?} at {scale}, {guides:?}");
                match simplify(&mesh, &asked) {
                    Ok(result) if strategy == Strategy::Naive => {
                        let all =
                            guides.fixed.iter().all(|&f| facet_levels(&result)[f] == (at(f) * scale).round() as i64);
                        assert!(all, "{what}");
                        check_mirror(&result, &guides.symmetry[0], &what).expect("it is mirrored");
                    }
                    Ok(result) => check(&result, &guides, &what).expect("the guides hold"),
                    Err(error) => {
                        assert_eq!(error.kind, ErrorKind::Infeasible, "{what}: {error}");
                        assert!(!error.remedy.is_empty() && scale != 1.0, "{what}: {error}");
                        let named =
                            matches!(error.place, Some(Place::Facet(f)) if guides.fixed.contains(&(f as usize)));
                        refused += usize::from(named);
                        continue;
                    }
                }
                kept += 1;
            }
        }
    }
    println!("{kept} kept, {refused} refused by the facet");
    assert!(kept > 30 && refused > 3);
}

#[test]
fn a_slider_gives_what_a_run_with_that_simplicity_gives() {
    let mesh = spikes();
    let input = Input { polycube: &mesh, shape: None, labels: None };
    let context = Context::default();
    for guides in [Guides::default(), Guides { fixed: vec![3, 8], ..Guides::default() }] {
        let one = simplify(&mesh, &options(Strategy::Best, guides.clone())).expect("a valid polycube");
        for simplicity in [1.0, 0.6, 0.3, 0.0] {
            let slid = one.at(&input, simplicity, &context).expect("a point of the front");
            let asked = SimplifyOptions { simplicity: Some(simplicity), ..options(Strategy::Best, guides.clone()) };
            let run = simplify(&mesh, &asked).expect("a valid polycube");
            assert_eq!(slid.levels, run.levels);
            assert_eq!(slid.report.after, run.report.after);
            assert_eq!(slid.report.chosen, run.report.chosen);
            assert_eq!(slid.polycube, run.polycube);
            let located = one.locate(simplicity, &context).expect("a point of the front");
            assert_eq!((Some(located.counts), located.levels), (run.report.after, run.levels));
        }
        assert_eq!(one.at(&input, 1.5, &context).map(|_| ()).unwrap_err().kind, ErrorKind::Option);
    }
}

#[test]
fn the_distortion_stays_within_its_limit() {
    let mesh = example(Example::Ring, 3, CellKind::Triangles).expect("the example exists").0;
    let angle = |r: &Simplified| r.report.distortion.expect("the result is valid")[1].angle;
    let run = |max_distortion, scale| {
        let asked =
            SimplifyOptions { max_distortion, scale: Some(scale), ..options(Strategy::Best, Guides::default()) };
        simplify(&mesh, &asked).expect("valid")
    };
    let coarsest = run(None, 20.0);
    let input = Input { polycube: &mesh, shape: None, labels: None };
    let points = coarsest.pareto(&input, &Context::default()).expect("a front");
    assert_eq!(points.len(), coarsest.report.front.len());
    let least = points.iter().map(angle).fold(f64::INFINITY, f64::min);
    let limit = f64::midpoint(least, angle(&coarsest));
    assert!(least < limit && limit < angle(&coarsest), "there is something to choose");
    let bounded = run(Some(limit), 20.0);
    let first = points.iter().find(|p| angle(p) <= limit).expect("the least is within");
    assert_eq!((&bounded.levels, bounded.report.chosen), (&first.levels, first.report.chosen));
    // The lattice holds the input, which is no distortion at all; a coarser one does not.
    assert!((angle(&run(Some(1.0), 20.0)) - least).abs() < 1e-12 && (least - 1.0).abs() < 1e-12);
    let hopeless = run(Some(1.0), 0.37);
    let points = hopeless.pareto(&input, &Context::default()).expect("a front");
    let least = points.iter().map(angle).fold(f64::INFINITY, f64::min);
    assert!(least > 1.0 && (angle(&hopeless) - least).abs() < 1e-12);
    assert!(
        hopeless.report.notes.iter().any(|n| matches!(n, Note::Distortion { cause: Cause::Search, .. })),
        "{:?}",
        hopeless.report.notes
    );
}

#[test]
fn guides_read_from_json_and_refuse_what_they_do_not_know() {
    let text = r#"{"fixed": [3], "together": [[0, 4]], "apart": [[1, 2]], "symmetry": [{"axis": 0, "at": 2.5}]}"#;
    let guides: Guides = serde_json::from_str(text).expect("guides");
    let symmetry = vec![Symmetry { axis: 0, at: 2.5 }];
    let (together, apart) = (vec![vec![0, 4]], vec![[1, 2]]);
    assert_eq!(guides, Guides { fixed: vec![3], together, apart, symmetry, ..Guides::default() });
    assert!(serde_json::from_str::<Guides>(r#"{"fixd": [3]}"#).is_err());
    assert!(serde_json::from_str::<Guides>("{}").is_ok_and(|g| g.is_empty()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(60) as u32))]

    /// Any guides on any polycube: kept, or refused with a reason; and the same again for the same input.
    #[test]
    fn any_guides_are_kept_or_refused(
        seed in 0..4000_u64, boxes in 2..9_usize, best: bool,
        fixed in prop::collection::vec(0..64_usize, 0..4),
        together in prop::collection::vec(0..64_usize, 0..3),
        apart in prop::collection::vec([0..64_usize, 0..64_usize], 0..3),
    ) {
        let mesh = coarse(&random_polycube(seed, boxes, 12).unwrap(), CellKind::Quads);
        let polycube = read(&mesh);
        let count = polycube.structure.facets.len();
        let level = |f: usize| polycube.structure.facets[f].level;
        let fixed: Vec<usize> = fixed.iter().map(|f| f % count).collect();
        let mut together: Vec<usize> = together.iter().map(|f| f % count).collect();
        together.retain(|&f| axis_of(&polycube, f) == 2);
        let apart: Vec<[usize; 2]> = apart.iter().map(|p| p.map(|f| f % count))
            .filter(|&[a, b]| axis_of(&polycube, a) == axis_of(&polycube, b) && level(a) != level(b)).collect();
        let guides = Guides { fixed, together: vec![together], apart, ..Guides::default() };
        let strategy = if best { Strategy::Best } else { Strategy::Paper };
        let run = || simplify(&mesh, &options(strategy, guides.clone()));
        match (run(), run()) {
            (Ok(one), Ok(two)) => {
                check(&one, &guides, "random")?;
                prop_assert_eq!(&one.levels, &two.levels);
                prop_assert_eq!(&one.report.front, &two.report.front);
                if strategy == Strategy::Paper {
                    let result = one.polycube.as_ref().expect("a valid polycube");
                    let again = SimplifyOptions { scale: Some(1.0), ..options(strategy, guides.clone()) };
                    // Some of its faces may be turned over, so their normals do not tell their labels.
                    let labels = common::labels(&one.input);
                    let input = Input { polycube: result, shape: None, labels: Some(&labels) };
                    let twice = polycube::simplify::simplify(&input, &again, &Context::default());
                    let twice = twice.expect("its own result");
                    prop_assert_eq!(&twice.levels, &one.levels, "a second run changes nothing");
                }
            }
            (Err(one), Err(two)) => {
                prop_assert!(matches!(one.kind, ErrorKind::Option | ErrorKind::Infeasible), "{one}");
                prop_assert!(!one.remedy.is_empty(), "{one}");
                prop_assert_eq!(one, two);
            }
            _ => prop_assert!(false, "two runs differ"),
        }
    }
}
