//! The polycube that a subcommand works on.

use super::number::{degrees, fraction};
use crate::input::meshes::LabelFile;
use clap::{Args, ValueHint};
use polycube::mesh::LabelOrder;
use polycube::structure::Tolerance;
use std::path::PathBuf;

/// The mesh and its labels.
#[derive(Args, Clone, Debug)]
pub struct PolycubeArgs {
    /// The polycube: a mesh file whose boundary faces look along the axes
    #[arg(value_name = "POLYCUBE", value_hint = ValueHint::FilePath)]
    pub polycube: PathBuf,

    /// What its boundary faces look along.
    #[command(flatten)]
    pub labels: LabelsArg,

    /// How far the mesh may be from an exact polycube.
    #[command(flatten)]
    pub tolerance: ToleranceArgs,
}

/// The labels of a polycube.
#[derive(Args, Clone, Debug, Default)]
pub struct LabelsArg {
    /// Label file: one integer a line, 0 to 5 for +X -X +Y -Y +Z -Z, -1 for "by the normal"; one for each boundary
    /// face (of a surface in the order of the file; of a volume cell by cell, in VTK's order of a cell's faces), for
    /// each face of the file before polygons were cut, for each face that a file of a volume lists beside its cells, or
    /// four for each tetrahedron, for the faces opposite to its corners. Or a mesh file that numbers its faces so, by
    /// references, data of cells, physical groups or names of materials
    #[arg(long = "labels", id = "labels", value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub file: Option<PathBuf>,

    /// Which number stands for which direction in the label file, where not +X-X+Y-Y+Z-Z; as in "-X+X-Y+Y-Z+Z", or
    /// "1:+X-X+Y-Y+Z-Z" where numbers count from 1
    #[arg(
        long = "label-order", id = "label_order", value_name = "ORDER", requires = "labels", allow_hyphen_values = true,
        value_parser = order
    )]
    pub order: Option<LabelOrder>,
}

impl LabelsArg {
    /// The file, if one was given.
    pub fn given(&self) -> Option<LabelFile<'_>> {
        Some(LabelFile { file: self.file.as_deref()?, order: self.order.as_ref() })
    }
}

fn order(text: &str) -> Result<LabelOrder, String> {
    text.parse().map_err(|error: polycube::Error| error.to_string())
}

/// How far a mesh may be from a polycube.
#[derive(Args, Clone, Debug, Default)]
pub struct ToleranceArgs {
    /// Largest angle between a face and the nearest axis, in degrees from 0 to 45 [default: 30]
    #[arg(long, value_name = "DEG", value_parser = degrees)]
    pub angle_tolerance: Option<f64>,

    /// Largest distance of a vertex from the plane of its facet, as a fraction of the bounding box's diagonal, from 0
    /// to 1 [default: 0.05]
    #[arg(long, value_name = "F", value_parser = fraction)]
    pub level_tolerance: Option<f64>,

    /// Whether it is repaired.
    #[command(flatten)]
    pub repair: RepairArg,
}

/// Whether the input is repaired.
#[derive(Args, Clone, Copy, Debug, Default)]
pub struct RepairArg {
    /// Take the input as it is. Else what has one right answer is repaired, and a note says so: cells numbered
    /// left-handed, surfaces and labels that look inward, vertices at one place, faces that are double or inside
    #[arg(long = "no-repair", id = "no_repair")]
    pub off: bool,
}

impl ToleranceArgs {
    /// The tolerance asked for; the library's defaults where nothing was said.
    pub fn get(&self) -> Tolerance {
        let default = Tolerance::default();
        Tolerance {
            degrees: self.angle_tolerance.unwrap_or(default.degrees),
            distance: self.level_tolerance.unwrap_or(default.distance),
            ..default
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_in_the_help_are_those_of_the_library() {
        let found = ToleranceArgs::default().get();
        assert_eq!((found.degrees, found.distance), (30.0, 0.05));
    }
}
