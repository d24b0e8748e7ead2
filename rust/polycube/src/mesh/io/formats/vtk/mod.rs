//! VTK's files: the legacy ones, and of those in XML the unstructured grids and the surfaces.

mod cells;
pub(super) mod legacy;
mod legacy_data;
mod legacy_numbers;
pub(super) mod vtp;
pub(super) mod vtu;
mod xml;
mod xml_data;
