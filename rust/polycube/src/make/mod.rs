//! A polycube of a plain shape: any closed, oriented, manifold surface, of any genus and any number of parts.
//!
//! [`make()`] is the way in, [`remesh()`] goes on to meshes. It goes from structure to place: `loops` finds few closed
//! curves of three kinds on the surface whose dual is a polycube, valid from the first to the last, `charts` draws that
//! polycube's facets on the surface, and `embedding` puts them in space, apart from each other, and lays each chart
//! flat in its facet.

mod axes;
mod charts;
mod embedding;
mod labelled;
mod loops;
mod meshed;
mod report;

pub use axes::Axes;
pub use meshed::remesh;
pub use report::{MakeReport, MakeSeconds};

use crate::context::Context;
use crate::error::{Error, ErrorKind, Place, Result};
use crate::input::Input;
use crate::mesh::{Face, Mesh};
use crate::repair::{Repaired, repair};
use crate::structure::Surface;
use axes::{turn_back, turned};
use charts::ChartedSurface;
use embedding::{Embedded, Levels};
use labelled::Labelled;
use loops::{Candidate, LoopOptions};
use std::time::Instant;

/// Embedded candidates with folds after which no more are tried.
const MOST_EMBEDDED: usize = 3;
/// No polycube has fewer corners.
const FEWEST_CORNERS: usize = 8;
/// What fewer corners may be worth, as a share of the surface, where creases show a polycube already.
const LITTLE: f64 = 0.1;

/// How a polycube is made.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct MakeOptions {
    /// How much of the shape the polycube follows, from 0, as few corners as can be, to 1; 0.5 by default. It is the
    /// worth of a corner against how much of the surface its facets shrink.
    pub detail: f64,
    /// Take corners away until no more than these are left, as far as the shape allows, whatever `detail` says.
    pub corners: Option<usize>,
    /// Which directions of the shape become the axes of the polycube; those of the coordinates by default.
    pub axes: Axes,
    /// One label for each face of the shape, 0 to 5 for +X −X +Y −Y +Z −Z, as programs that label shapes leave them.
    /// With them nothing is searched for, and `detail`, `corners` and `axes` have no effect: the charts stay as they
    /// are, their facets are put apart from each other on integer levels, and the charts laid flat in them. Labels do
    /// not say whether edges run up or down: the shape tells.
    #[serde(skip)]
    pub labels: Option<Vec<i8>>,
    /// Whether the shape is taken as it is, without [repairs](crate::repair::repair).
    pub no_repair: bool,
}

impl Default for MakeOptions {
    fn default() -> Self {
        Self { detail: 0.5, corners: None, axes: Axes::Keep, labels: None, no_repair: false }
    }
}

impl MakeOptions {
    /// Refuses what is out of its range, before anything is done.
    ///
    /// # Errors
    /// [`ErrorKind::Option`] that names the field.
    pub fn check(&self) -> Result<()> {
        if (0.0..=1.0).contains(&self.detail) {
            return Ok(());
        }
        Err(Error::new(ErrorKind::Option, format!("{} is no detail", self.detail))
            .in_option("detail")
            .remedy("give a number from 0, as few corners as can be, to 1"))
    }

    /// The shape and its labels after repairs, where there is something to repair and that is wanted.
    fn repaired(&self, shape: &Mesh) -> Option<Repaired> {
        if self.no_repair || shape.cells().is_volume() {
            return None;
        }
        repair(&Input { polycube: shape, shape: None, labels: self.labels.as_deref() })
    }

    fn for_loops(&self) -> LoopOptions {
        LoopOptions { detail: self.detail, corners: self.corners }
    }
}

/// A polycube and its shape, with the same triangles.
#[derive(Clone, Debug)]
pub struct Made {
    /// The shape as triangles, cut finer where the map needs room: the vertices of the input come first and keep their
    /// numbers.
    pub shape: Mesh,
    /// The polycube, on integer levels, vertex by vertex and triangle by triangle that of [`shape`](Self::shape).
    pub polycube: Mesh,
    /// The label of each triangle, 0 to 5 for +X −X +Y −Y +Z −Z.
    pub labels: Vec<i8>,
    /// What was done and how good it is.
    pub report: MakeReport,
}

impl Made {
    /// What is then simplified, meshed, compared or validated.
    pub fn input(&self) -> Input<'_> {
        Input { polycube: &self.polycube, shape: Some(&self.shape), labels: Some(&self.labels) }
    }
}

/// Makes a polycube of a surface.
///
/// The structure comes first: level sets of three functions on the surface, near to the coordinates, are made a valid
/// set of loops (see ARCHITECTURE.md), and loops are taken away as long as a corner less is worth what the surface then
/// looks another way. What is valid and of the right topology stays so with every step. The polycube is checked exactly
/// on integers at the end: embedded, of the topology of the shape. Same input, same bytes, for any number of threads.
///
/// Self-intersections of the shape do not matter. What has one right answer is [repaired](crate::repair::repair) first,
/// as faces that look inward, and the report says so. Some seconds for 20,000 triangles.
///
/// Where [`MakeOptions::labels`] are given, the structure is theirs. Where sharp creases cut the surface into the faces
/// of a polycube, as those of a box or a bracket do, it is that of the creases, at once.
///
/// ```
/// use polycube::Context;
/// use polycube::generate::{Example, example};
/// use polycube::make::{MakeOptions, make};
/// use polycube::mesh::CellKind;
///
/// let (_, shape) = example(Example::SteppedL, 1, CellKind::Triangles)?;
/// let made = make(&shape, &MakeOptions::default(), &Context::default())?;
/// assert_eq!(made.shape.cells(), made.polycube.cells());
/// assert!(made.report.folded.is_empty());
///
/// // The same structure again, of its labels.
/// let labelled = MakeOptions { labels: Some(made.labels), ..MakeOptions::default() };
/// let again = make(&made.shape, &labelled, &Context::default())?;
/// assert_eq!(again.report.facets, made.report.facets);
/// # Ok::<(), polycube::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Option`] for options out of range; [`ErrorKind::Unsupported`] for a volume; [`ErrorKind::Mesh`] with
/// the edge, face or vertex where the surface is not closed, oriented and manifold; [`ErrorKind::Polycube`] with a face
/// where no structure was found or where parts of the polycube could not be kept apart, or with the vertex, edge or
/// face where labels are not those of a polycube; [`ErrorKind::Mismatch`] for labels that do not fit the faces;
/// [`ErrorKind::Cancelled`].
pub fn make(shape: &Mesh, options: &MakeOptions, context: &Context) -> Result<Made> {
    options.check()?;
    let clock = Instant::now();
    context.tick(0.0)?;
    let repaired = options.repaired(shape);
    let (shape, labels) = match &repaired {
        Some(repaired) => (&repaired.polycube, &repaired.labels),
        None => (shape, &options.labels),
    };
    let surface = surface(shape)?;
    let turn = options.axes.turn(shape).filter(|_| labels.is_none());
    let turned_shape = turn.map(|turn| turned(shape, &turn));
    let upright = turned_shape.as_ref().unwrap_or(shape);
    let Found { embedded, structure } = match labels {
        Some(labels) => of_labels(shape, &surface, labels, context)?,
        None => match of_creases(upright, &surface, options, &context.stage("embed", 0.0, 0.1))? {
            Some(found) => found,
            None => of_loops(upright, &surface, options, &context.stage("loops", 0.1, 1.0))?,
        },
    };
    let total = clock.elapsed().as_secs_f64();
    let seconds = MakeSeconds { structure, embedding: total - structure, total };
    let mut made = finish(upright, embedded, seconds)?;
    if let Some(turn) = turn {
        turn_back(&mut made.shape, shape, &turn);
        made.report.rotation = Some(turn.transpose().into());
    }
    made.report.repairs = repaired.map_or_else(Vec::new, |repaired| repaired.repairs);
    Ok(made)
}

/// An error about a triangle as one about the face that it is part of.
fn of_face(mut error: Error, surface: &Surface) -> Error {
    if let Some(Place::Face(triangle)) = error.place {
        let mut owners = (0..).zip(surface.faces()).flat_map(|(i, face)| face.triangles().map(move |_| i));
        error.place = owners.nth(triangle as usize).map(Place::Face);
    }
    error
}

/// A polycube with its map.
struct Found {
    embedded: Embedded,
    /// Seconds until its structure was known.
    structure: f64,
}

fn of_labels(shape: &Mesh, surface: &Surface, labels: &[i8], context: &Context) -> Result<Found> {
    let clock = Instant::now();
    let Labelled { charts, levels, .. } = labelled::read(shape, surface, labels)?;
    let structure = clock.elapsed().as_secs_f64();
    let embedded = embedding::embed(&charts, levels, context).map_err(|error| of_face(error, surface))?;
    Ok(Found { embedded, structure })
}

/// The polycube that sharp creases show, if they show one that the map fits without folds and if no other could be
/// worth much more: no labels suit the normals better, so that all there is to be had is fewer corners.
fn of_creases(shape: &Mesh, surface: &Surface, options: &MakeOptions, context: &Context) -> Result<Option<Found>> {
    let clock = Instant::now();
    let Some(Labelled { charts, levels, corners }) = labelled::creased(shape, surface) else { return Ok(None) };
    let spared = corners.saturating_sub(FEWEST_CORNERS) as f64;
    let too_many = options.corners.is_some_and(|most| corners > most);
    if too_many || spared * options.for_loops().price_of_corner() > LITTLE {
        return Ok(None);
    }
    let structure = clock.elapsed().as_secs_f64();
    match embedding::embed(&charts, levels, context) {
        Ok(embedded) if embedded.folded.is_empty() => Ok(Some(Found { embedded, structure })),
        Err(error) if error.kind == ErrorKind::Cancelled => Err(error),
        _ => Ok(None),
    }
}

fn of_loops(shape: &Mesh, surface: &Surface, options: &MakeOptions, context: &Context) -> Result<Found> {
    let clock = Instant::now();
    let triangles: Vec<[u32; 3]> = surface.faces().iter().flat_map(Face::triangles).collect();
    let named = |error| of_face(error, surface);
    let candidates = draw(shape, &triangles, options, &context.stage("loops", 0.0, 0.5)).map_err(named)?;
    let structure = clock.elapsed().as_secs_f64();
    let embedded = embed_best(&candidates, &context.stage("embed", 0.5, 1.0)).map_err(named)?;
    Ok(Found { embedded, structure })
}

/// Sets of loops and the charts that they stand for, cheapest first: by what their labels cost and how many corners
/// they have.
fn draw(
    shape: &Mesh,
    triangles: &[[u32; 3]],
    options: &MakeOptions,
    context: &Context,
) -> Result<Vec<Candidate<ChartedSurface>>> {
    let wanted = options.for_loops();
    loops::loops(shape.points(), triangles, &wanted, context, |set| {
        let drawn = charts::charts(shape.points(), triangles, set, context)?;
        Ok((drawn.cost() + wanted.price_of_corner() * set.corners as f64, drawn))
    })
}

/// The first candidate that can be embedded without folds; if there is none, the least folded of the first few.
fn embed_best(candidates: &[Candidate<ChartedSurface>], context: &Context) -> Result<Embedded> {
    let (mut folded, mut refused): (Vec<Embedded>, Option<Error>) = (Vec::new(), None);
    for (i, candidate) in candidates.iter().enumerate() {
        let [from, to] = [i, i + 1].map(|k| k as f64 / candidates.len() as f64);
        let levels = Levels::new(&candidate.drawn, &candidate.loops);
        match embedding::embed(&candidate.drawn, levels, &context.stage("embed", from, to)) {
            Ok(found) if found.polycube.structure.corners.len() != candidate.loops.corners => {
                return Err(Error::new(ErrorKind::Internal, "the polycube has other corners than its loops"));
            }
            Ok(found) if found.folded.is_empty() => return Ok(found),
            Ok(found) => folded.push(found),
            Err(error) if error.kind == ErrorKind::Cancelled => return Err(error),
            Err(error) => refused = refused.or(Some(error)),
        }
        if folded.len() == MOST_EMBEDDED {
            break;
        }
    }
    let best = folded.into_iter().min_by_key(|found| found.folded.len());
    best.ok_or_else(|| refused.unwrap_or_else(|| Error::new(ErrorKind::Internal, "there is nothing to embed")))
}

fn finish(shape: &Mesh, embedded: Embedded, seconds: MakeSeconds) -> Result<Made> {
    let [polycube, refined] = embedded.refined.meshes()?;
    let labels = embedded.refined.labels();
    let report = MakeReport::new(shape, &embedded, [&polycube, &refined], seconds);
    Ok(Made { shape: refined, polycube, labels, report })
}

/// The faces of a closed surface that looks outward.
fn surface(shape: &Mesh) -> Result<Surface> {
    if shape.cells().is_volume() {
        let message = format!("a polycube is made of a surface, and this mesh has {}", shape.cells().kind());
        return Err(Error::new(ErrorKind::Unsupported, message).remedy("give the boundary of the mesh, as triangles"));
    }
    let surface = Surface::new(shape.cells().boundary()?, shape.points().len());
    let surface = surface.map_err(|mut all| Error::from(all.swap_remove(0)))?;
    if surface.volume(shape.points()) < 0.0 { Err(embedding::looks_inward(0)) } else { Ok(surface) }
}
