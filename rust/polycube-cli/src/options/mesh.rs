//! What `remesh` and `compare` mesh.

use super::number::{positive, whole};
use clap::Args;
use polycube::remesh::{RemeshOptions, Size};

/// What is meshed, and how fine.
#[derive(Args, Clone, Debug)]
pub struct MeshArgs {
    /// How fine the mesh is.
    #[command(flatten)]
    size: SizeArgs,

    /// Layers of hexahedra between the polycube and the surface, 0 to 16
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = whole::<u8>(0..=16))]
    padding: u8,

    /// Leave the hexahedra out
    #[arg(long)]
    pub surface_only: bool,
}

impl MeshArgs {
    /// These options for `remesh`, after those for `simplify`.
    pub fn set(&self, options: RemeshOptions) -> RemeshOptions {
        let (padding, surface_only) = (usize::from(self.padding), self.surface_only);
        RemeshOptions { size: self.size.get(), padding, surface_only, ..options }
    }
}

/// How fine a mesh is: one of three.
#[derive(Args, Clone, Debug)]
#[group(multiple = false)]
struct SizeArgs {
    /// Mean length of the mesh's edges, in units of the shape [default: see --scale]
    #[arg(long, value_name = "H", value_parser = positive)]
    edge_length: Option<f64>,

    /// Lattice steps per unit of the polycube [default: 1 if all its levels are integers, else one step per mean mesh
    /// edge]
    #[arg(long, value_name = "S", value_parser = positive)]
    scale: Option<f64>,

    /// About how many hexahedra there shall be, padding included; with --surface-only, would be
    #[arg(long, value_name = "N", value_parser = whole::<u32>(1..=u64::from(u32::MAX)))]
    hexes: Option<u32>,
}

impl SizeArgs {
    /// The size asked for.
    fn get(&self) -> Option<Size> {
        let length = self.edge_length.map(Size::EdgeLength);
        length.or(self.scale.map(Size::Scale)).or(self.hexes.map(|n| Size::Hexes(n as usize)))
    }
}
