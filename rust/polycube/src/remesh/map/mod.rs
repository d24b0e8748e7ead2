//! From the lattice to the shape: the map of the surface and of the inside, made one to one.

mod interior;
mod lattice_map;
mod level_interpolation;
mod refine;
mod surface_map;
mod untangling;
mod volume_map;

pub(crate) use interior::{fill_inside, interpolate};
pub(crate) use lattice_map::LatticeMap;
pub(crate) use level_interpolation::LevelInterpolation;
pub(crate) use refine::Refined;
pub(crate) use surface_map::SurfaceMap;
pub(crate) use untangling::untangle_surface;
pub(crate) use volume_map::VolumeMap;
