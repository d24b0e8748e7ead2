//! What is said of a result that is not as asked, or not as might be expected.

use crate::mesh::CellKind;
use crate::repair::Repair;
use std::fmt;

/// What was not possible or not as asked. Written, for people and in reports, as a sentence.
#[derive(Clone, Debug, PartialEq, bitcode::Encode, bitcode::Decode)]
pub enum Note {
    /// Rounding to the lattice made the surface touch or cross itself in so many places.
    Broken(usize),
    /// Something was repaired before all else.
    Repaired(Repair),
    /// So many vertices along polycube edges of the input were out of order.
    OutOfOrder(usize),
    /// Cells of the polycube came inverted or flat.
    Tangled {
        /// How many.
        came: usize,
        /// How many cells are so in the result.
        left: usize,
    },
    /// The strategy `best` could not search: the result is that of Algorithm 1.
    Unsearched,
    /// Corners move farther than they may.
    Displacement {
        /// How far the farthest moves, in units of the polycube.
        moved: f64,
        /// How far it may.
        limit: f64,
        /// Why.
        cause: Cause,
    },
    /// The map is distorted more than it may be.
    Distortion {
        /// Its mean angle distortion, at least 1.
        angle: f64,
        /// What it may be.
        limit: f64,
        /// Why.
        cause: Cause,
    },
    /// The distortion of the map could not be measured, because of this.
    Unmeasured(String),
    /// Elements of the morphed mesh are turned over or flat.
    Flipped {
        /// How many.
        count: usize,
        /// Whether there is a front to move along to results that move less.
        has_front: bool,
    },
    /// The levels were placed in the order they have, as rounding broke the polycube.
    InOrder,
    /// Another point of the front was meshed than the first.
    MoreBlocks {
        /// Blocks, or patches of a surface alone.
        count: usize,
        /// How many the first has.
        least: usize,
        /// What is meshed: quadrilaterals for a surface alone, else hexahedra.
        cells: CellKind,
    },
    /// The points of the front that were tried just before and after the one that was meshed.
    Alternatives(Vec<Alternative>),
    /// So many vertices left polycube corners and edges.
    Released(usize),
    /// So many hexahedra are inverted.
    Inverted(usize),
    /// The map of the surface is folded, and so many quadrilaterals lie wrong.
    Folded(usize),
    /// The mesh is farther from the shape than asked for.
    Far {
        /// The Hausdorff distance, in percent of the diagonal.
        percent: f64,
        /// About how many cells of a kind would be near enough, where more of them help.
        enough: Option<(f64, CellKind)>,
    },
}

/// What another simplicity would give.
#[derive(Clone, Debug, PartialEq, bitcode::Encode, bitcode::Decode)]
pub struct Alternative {
    /// Blocks with padding, or patches of a surface alone.
    pub count: usize,
    /// The simplicity that asks for it.
    pub simplicity: f64,
    /// What is meshed: quadrilaterals for a surface alone, else hexahedra.
    pub cells: CellKind,
    /// What is wrong with its mesh, in words; nothing if nothing is.
    pub fault: Option<String>,
}

/// Why a limit is not kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bitcode::Encode, bitcode::Decode)]
pub enum Cause {
    /// Nothing that was found keeps it.
    Search,
    /// Another point of the front was asked for.
    Choice,
    /// It was kept at another scale.
    Scale,
}

impl Note {
    /// Whether it is about the order of the levels, and so holds at every scale.
    pub(super) fn is_of_order(&self) -> bool {
        self.is_of_input() || matches!(self, Self::Unsearched | Self::MoreBlocks { .. })
    }

    /// Whether it is about the input, and so holds for every result.
    pub(super) fn is_of_input(&self) -> bool {
        matches!(self, Self::Repaired(_))
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Broken(n) => {
                write!(f, "rounding to the lattice made the surface touch or cross itself in {n} places")
            }
            Self::Repaired(repair) => write!(f, "{repair}"),
            Self::OutOfOrder(n) => {
                write!(f, "{n} vertices along polycube edges were out of order and were put in order")
            }
            Self::Tangled { came, left: 0 } => write!(f, "{came} inverted cells of the input were untangled"),
            Self::Tangled { came, left } => {
                write!(f, "{came} cells of the input are inverted or flat; {left} are so in the result")
            }
            Self::Unsearched => f.write_str(
                "the result is that of Algorithm 1: there are more than 1022 levels on every axis, too many to search, \
                 or fewer patches would have meant more blocks",
            ),
            Self::Displacement { moved, limit, cause } => displacement(f, *moved, *limit, *cause),
            Self::Distortion { angle, limit, cause } => distortion(f, *angle, *limit, *cause),
            Self::Unmeasured(why) => write!(f, "the distortion of the map could not be measured: {why}"),
            Self::Flipped { count, has_front } => {
                let remedy = if *has_front { "; lower the simplicity to move less" } else { "" };
                write!(f, "{count} elements of the morphed mesh are turned over or flat{remedy}")
            }
            Self::InOrder => f.write_str(
                "rounding to the lattice broke the polycube, so the levels were placed in the order they have",
            ),
            Self::MoreBlocks { count, least, cells } => {
                write!(f, "{count} {} instead of {least}: fewer made bad {cells} or a mesh ", counted(*cells))?;
                f.write_str("too far from the shape; a limit on the displacement or a simplicity chooses otherwise")
            }
            Self::Alternatives(others) => {
                let told: Vec<String> = others.iter().map(ToString::to_string).collect();
                write!(f, "tried besides: {}", told.join("; "))
            }
            Self::Released(n) => {
                write!(f, "{n} vertices left polycube corners and edges for the surface around, ")?;
                f.write_str("which made inverted or poor hexahedra better")
            }
            Self::Inverted(n) => write!(f, "{n} hexahedra are inverted: those whose scaled_jacobian is 0 or less"),
            Self::Folded(n) => {
                f.write_str("the map of the surface is folded, and quadrilaterals lie wrong there ")?;
                write!(f, "({n} are inverted): lower the simplicity")
            }
            Self::Far { percent, enough } => {
                write!(f, "the Hausdorff distance is {percent:.3} % of the diagonal, more than asked for")?;
                let Some((count, cells)) = enough else { return Ok(()) };
                write!(f, ": {count} {cells} are likely to be near enough")
            }
        }
    }
}

fn counted(cells: CellKind) -> &'static str {
    if cells == CellKind::Quads { "patches" } else { "blocks" }
}

impl fmt::Display for Alternative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} with a simplicity of {:.4}", self.count, counted(self.cells), self.simplicity)?;
        self.fault.as_ref().map_or(Ok(()), |fault| write!(f, " ({fault})"))
    }
}

fn displacement(f: &mut fmt::Formatter<'_>, moved: f64, limit: f64, cause: Cause) -> fmt::Result {
    match cause {
        Cause::Search => {
            write!(f, "no result found moves the corners by {limit} or less; this one moves them by {moved}")
        }
        Cause::Choice => {
            write!(f, "the corners move by {moved:.6}, more than {limit}: a lower simplicity moves them less")
        }
        Cause::Scale => write!(
            f,
            "at this size the corners move by {moved:.6}, more than {limit}: a finer lattice or a smaller limit moves \
             them less"
        ),
    }
}

fn distortion(f: &mut fmt::Formatter<'_>, angle: f64, limit: f64, cause: Cause) -> fmt::Result {
    match cause {
        Cause::Search => {
            write!(f, "no result found has a mean angle distortion of {limit} or less; this one has {angle}")
        }
        Cause::Choice => {
            write!(f, "the mean angle distortion is {angle:.6}, more than {limit}: a lower simplicity distorts less")
        }
        Cause::Scale => write!(
            f,
            "at this size the mean angle distortion is {angle:.6}, more than {limit}: a finer lattice distorts less"
        ),
    }
}

impl serde::Serialize for Note {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}
