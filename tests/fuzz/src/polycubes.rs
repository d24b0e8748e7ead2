//! Meshes and options made of bytes.

use crate::judge;
use arbitrary::{Result, Unstructured};
use polycube::align::{Effort, Guides, SolverKind, Strategy, Symmetry};
use polycube::context::Context;
use polycube::generate::{Cuboid, Voxels, random_polycube};
use polycube::mesh::{CellKind, Cells, Mesh, Point};
use polycube::parts::perturb;
use polycube::remesh::{RemeshOptions, Size, remesh};
use polycube::simplify::{Input, SimplifyOptions, SimplifyReport, read_structure, simplify};
use polycube::structure::Tolerance;
use polycube::{ErrorKind, Simplified};

/// Simplifies a mesh of anything.
pub fn any_mesh(data: &[u8]) {
    let mut bytes = Unstructured::new(data);
    let Ok((mesh, options)) = any(&mut bytes) else { return };
    show(&mesh, &options);
    match simplify(&Input { polycube: &mesh, shape: None, labels: None }, &options, &Context::default()) {
        Ok(result) => judge(&mesh, &result),
        Err(error) => assert!(error.kind != ErrorKind::Internal && !error.message.is_empty(), "{error}"),
    }
}

/// Simplifies a valid polycube, which must succeed.
pub fn valid_polycube(data: &[u8]) {
    let mut bytes = Unstructured::new(data);
    let Ok(mesh) = polycube(&mut bytes) else { return };
    let Ok(options) = options(&mut bytes) else { return };
    show(&mesh, &options);
    let guided = !options.guides.is_empty();
    match simplify(&Input { polycube: &mesh, shape: None, labels: None }, &options, &Context::default()) {
        Ok(result) => judge(&mesh, &result),
        Err(error) => {
            let told = matches!(error.kind, ErrorKind::Option | ErrorKind::Infeasible);
            assert!(guided && told, "{error}");
        }
    }
}

/// Meshes a valid polycube, which must succeed.
pub fn remeshing(data: &[u8]) {
    let mut bytes = Unstructured::new(data);
    let Ok(mesh) = polycube(&mut bytes) else { return };
    let Ok(options) = remesh_options(&mut bytes) else { return };
    show(&mesh, &options);
    let input = Input { polycube: &mesh, shape: None, labels: None };
    let result = match remesh(&input, &options, &Context::default()) {
        Ok(result) => result,
        Err(error) => panic!("{error}"),
    };
    let Simplified { report: SimplifyReport { after, .. }, .. } = &result.simplified;
    let Some(after) = after else { panic!("no counts") };
    assert_eq!(result.layout.patches.cells().len(), after.surface_patches);
    let blocks = if options.padding == 0 { after.blocks } else { after.blocks_padded };
    let Some(hexes) = &result.hexes else { return assert!(options.surface_only) };
    let cells = result.layout.blocks.as_ref().map_or(0, |mesh| mesh.cells().len());
    assert_eq!((result.report.hex_blocks, cells), (blocks, blocks));
    assert!(hexes.mesh.points().iter().all(|p| p.iter().all(|x| x.is_finite())));
    let bad = hexes.quality().of_cell.iter().filter(|q| q.is_nan() || **q <= 0.0).count();
    assert_eq!(result.report.inverted, bad);
}

/// For a look at a finding: writes the mesh to the VTK file that `POLYCUBE_FUZZ_MESH` names, and prints the options.
fn show(mesh: &Mesh, options: &impl std::fmt::Debug) {
    if let Some(path) = std::env::var_os("POLYCUBE_FUZZ_MESH") {
        let written = polycube::mesh::write(path.as_ref(), mesh, &[]);
        eprintln!("{written:?} {options:?}");
    }
}

/// Any numbers as points and any vertices as cells; often on a lattice, where things touch.
fn any(bytes: &mut Unstructured) -> Result<(Mesh, SimplifyOptions)> {
    let count = bytes.int_in_range(1..=40)?;
    let wild = bytes.ratio(1, 8)?;
    let points = (0..count).map(|_| {
        let mut coordinate =
            || -> Result<f64> { if wild { bytes.arbitrary() } else { Ok(f64::from(bytes.int_in_range(0_u8..=5)?)) } };
        Ok(Point::new(coordinate()?, coordinate()?, coordinate()?))
    });
    let points = points.collect::<Result<Vec<_>>>()?;
    let kind = *bytes.choose(&CellKind::ALL)?;
    let mut cells: Vec<[u32; 8]> = Vec::new();
    while !bytes.is_empty() && cells.len() < 100 {
        let mut cell = [0; 8];
        for v in &mut cell {
            *v = bytes.int_in_range(0..=count - 1)?;
        }
        cells.push(cell);
    }
    let four = || cells.iter().map(|&[a, b, c, d, ..]| [a, b, c, d]).collect();
    let cells = match kind {
        CellKind::Triangles => Cells::Triangles(cells.iter().map(|&[a, b, c, ..]| [a, b, c]).collect()),
        CellKind::Quads => Cells::Quads(four()),
        CellKind::Tetrahedra => Cells::Tetrahedra(four()),
        CellKind::Hexahedra => Cells::Hexahedra(cells),
    };
    let mesh = Mesh::new(points, cells).map_err(|_| arbitrary::Error::IncorrectFormat)?;
    Ok((mesh, SimplifyOptions { effort: effort(), ..SimplifyOptions::default() }))
}

/// A polycube that is valid by construction: boxes made manifold, moved off the lattice in some cases.
fn polycube(bytes: &mut Unstructured) -> Result<Mesh> {
    let kind = *bytes.choose(&CellKind::ALL)?;
    let moved = bytes.ratio(1, 3)?.then(|| bytes.arbitrary()).transpose()?;
    let voxels = if bytes.ratio(1, 4)? {
        random_polycube(bytes.arbitrary()?, bytes.int_in_range(1..=10)?, bytes.int_in_range(3..=12)?)
    } else {
        let boxes = boxes(bytes, 6)?;
        let holes = boxes_or_none(bytes)?;
        Voxels::from_difference(&boxes, &holes)
    };
    let voxels = voxels.map_err(|_| arbitrary::Error::IncorrectFormat)?;
    let mesh = voxels.mesh(kind, 1e9).map_err(|_| arbitrary::Error::IncorrectFormat)?;
    // Boxes that touch along edges are no polycube.
    let labels = labels(&mesh)?;
    let surface = matches!(kind, CellKind::Triangles | CellKind::Quads);
    let Some(seed) = moved.filter(|_| surface) else { return Ok(mesh) };
    let moved = perturb(&mesh, &labels, 0.4, seed).map_err(|_| arbitrary::Error::IncorrectFormat)?;
    // Triangles between vertices that move apart may turn over.
    self::labels(&moved).map(|_| moved)
}

/// The labels of a valid polycube.
fn labels(mesh: &Mesh) -> Result<Vec<i8>> {
    let read = read_structure(&Input { polycube: mesh, shape: None, labels: None }, &Tolerance::default());
    let read = read.map_err(|_| arbitrary::Error::IncorrectFormat)?;
    Ok(read.labels().map(|l| l.index() as i8).collect())
}

fn boxes(bytes: &mut Unstructured, most: usize) -> Result<Vec<Cuboid>> {
    let count = bytes.int_in_range(1..=most)?;
    let cuboid = |_| {
        let (mut min, mut max) = ([0; 3], [0; 3]);
        for a in 0..3 {
            min[a] = bytes.int_in_range(0..=9)?;
            max[a] = min[a] + bytes.int_in_range(1..=6)?;
        }
        Ok(Cuboid { min, max })
    };
    (0..count).map(cuboid).collect()
}

fn boxes_or_none(bytes: &mut Unstructured) -> Result<Vec<Cuboid>> {
    if bytes.arbitrary()? { boxes(bytes, 3) } else { Ok(Vec::new()) }
}

/// Little effort: the guarantee must not depend on it.
fn effort() -> Effort {
    Effort { steps_per_level: 4, proof_nodes: 4, ..Effort::default() }
}

fn options(bytes: &mut Unstructured) -> Result<SimplifyOptions> {
    let scale = bytes.choose(&[None, None, Some(0.1), Some(0.7), Some(1.0), Some(3.3), Some(1e3)])?;
    Ok(SimplifyOptions {
        strategy: *bytes.choose(&[Strategy::Best, Strategy::Paper, Strategy::Naive])?,
        scale: *scale,
        lambda_min: f64::from(bytes.int_in_range(0_u8..=4)?) / 4.0,
        solver: if bytes.ratio(1, 8)? { SolverKind::Linear } else { SolverKind::Exact },
        effort: effort(),
        simplicity: bytes.ratio(1, 3)?.then_some(f64::from(bytes.arbitrary::<u8>()?) / 255.0),
        max_displacement: bytes.ratio(1, 4)?.then_some(0.01 + f64::from(bytes.arbitrary::<u8>()?) / 64.0),
        max_distortion: bytes.ratio(1, 6)?.then_some(1.0 + f64::from(bytes.arbitrary::<u8>()?) / 255.0),
        guides: if bytes.ratio(1, 3)? { guides(bytes)? } else { Guides::default() },
        ..SimplifyOptions::default()
    })
}

fn guides(bytes: &mut Unstructured) -> Result<Guides> {
    let facet = |bytes: &mut Unstructured| bytes.int_in_range(0_usize..=30);
    let mut guides = Guides::default();
    for _ in 0..bytes.int_in_range(0..=3)? {
        guides.fixed.push(facet(bytes)?);
    }
    for _ in 0..bytes.int_in_range(0..=2)? {
        guides.together.push(vec![facet(bytes)?, facet(bytes)?]);
        guides.apart.push([facet(bytes)?, facet(bytes)?]);
    }
    if bytes.ratio(1, 4)? {
        let at = f64::from(bytes.int_in_range(0_u8..=30)?) / 2.0;
        guides.symmetry.push(Symmetry { axis: bytes.int_in_range(0..=3)?, at });
    }
    Ok(guides)
}

fn remesh_options(bytes: &mut Unstructured) -> Result<RemeshOptions> {
    let size = match bytes.int_in_range(0_u8..=2)? {
        0 => None,
        1 => Some(Size::Hexes(bytes.int_in_range(1..=600)?)),
        _ => Some(Size::Scale(*bytes.choose(&[0.1, 0.5, 1.0])?)),
    };
    let strategy = *bytes.choose(&[Strategy::Best, Strategy::Paper, Strategy::Naive])?;
    Ok(RemeshOptions {
        simplify: SimplifyOptions { strategy, effort: effort(), ..SimplifyOptions::default() },
        size,
        padding: bytes.int_in_range(0..=2)?,
        surface_only: bytes.ratio(1, 4)?,
        ..RemeshOptions::default()
    })
}
