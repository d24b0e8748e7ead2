//! `remesh` and what it gives.

use crate::failure::{Result, guard};
use crate::ffi::*;
use crate::input::{Owned, mesh as owned};
use crate::making::{made, make_options};
use crate::options::{defaults, options};
use crate::results::{Simplified, json};
use crate::run::run;
use polycube::make;
use polycube::measure::CellMeasures;
use polycube::mesh::{self, HexFace};
use polycube::remesh::{self as core, BoundaryFace, Hexes, Layout, Quads, RemeshOptions, RemeshReport, Remeshed, Size};
use polycube::structure::Label;
use polycube::{Error, ErrorKind};
use std::path::Path;

/// See `polycube::remesh::remesh`.
pub fn remesh(input: &InputView, data: &RemeshOptionsData, observer: &Observer) -> Result<RemeshedData> {
    let (owned, options) = guard(|| {
        let owned = Owned::new(input)?;
        let options = remesh_options(data)?;
        Ok((owned, options))
    })?;
    let result = run(observer, |context| core::remesh(&owned.input(), &options, context))?;
    guard(|| remeshed(result))
}

/// Makes a polycube of a shape and meshes that.
pub fn remesh_shape(
    shape: &MeshView,
    making: &MakeOptionsData,
    data: &RemeshOptionsData,
    observer: &Observer,
) -> Result<RemeshedShapeData> {
    let (shape, options) = guard(|| Ok((owned(shape)?, remesh_options(data)?)))?;
    let (pair, result) = run(observer, |context| make::remesh(&shape, &make_options(making), &options, context))?;
    guard(|| Ok(RemeshedShapeData { made: made(&pair)?, remeshed: remeshed(result)? }))
}

fn remesh_options(data: &RemeshOptionsData) -> polycube::Result<RemeshOptions> {
    Ok(RemeshOptions {
        simplify: options(&data.simplify)?,
        size: data.has_size.then(|| size(data)).transpose()?,
        padding: data.padding as usize,
        surface_only: data.surface_only,
        max_hausdorff: data.max_hausdorff,
    })
}

fn size(data: &RemeshOptionsData) -> polycube::Result<Size> {
    let bad = |message: String| Err(Error::new(ErrorKind::Option, message));
    match data.size_kind {
        0 => Ok(Size::Scale(data.size)),
        1 => Ok(Size::EdgeLength(data.size)),
        2 if data.size >= 1.0 && data.size <= f64::from(u32::MAX) => Ok(Size::Hexes(data.size as usize)),
        2 => bad(format!("{} is no number of hexahedra", data.size)),
        kind => bad(format!("there is no kind of size number {kind}")),
    }
}

fn remeshed(result: Remeshed) -> polycube::Result<RemeshedData> {
    let Remeshed { simplified, layout, quads, hexes, report } = result;
    Ok(RemeshedData {
        simplified: Box::new(Simplified(simplified)),
        layout: (&layout).into(),
        quads: quads.into(),
        has_hexes: hexes.is_some(),
        hexes: hexes_data(hexes),
        report_json: json(&report)?,
        report: (&report).into(),
    })
}

impl From<&Layout> for LayoutData {
    fn from(layout: &Layout) -> Self {
        Self {
            blocks: layout.blocks.as_ref().map_or_else(MeshData::empty, MeshData::from),
            patches: (&layout.patches).into(),
            patch_label: layout.patch_label.clone(),
            singular: layout.singular.iter().map(SingularData::from).collect(),
        }
    }
}

impl From<Quads> for QuadsData {
    fn from(quads: Quads) -> Self {
        let uv = quads.uv().into_flattened().into_flattened();
        let Quads { mesh, label, patch_id, block_id, .. } = quads;
        Self { mesh: (&mesh).into(), label, patch_id, block_id, uv }
    }
}

fn hexes_data(hexes: Option<Hexes>) -> HexesData {
    let scaled_jacobian = hexes.as_ref().map_or_else(Vec::new, |h| h.quality().of_cell);
    let measures = hexes.as_ref().map(Hexes::measures).unwrap_or_default();
    let CellMeasures { edge_ratio, determinant, non_orthogonality, skewness } = measures;
    let boundary = hexes.iter().flat_map(|h| &h.boundary).map(BoundaryFaceData::from).collect();
    let (mesh, block_id, label) = match hexes {
        Some(Hexes { mesh, block_id, label, .. }) => ((&mesh).into(), block_id, label),
        None => (MeshData::empty(), Vec::new(), Vec::new()),
    };
    HexesData { mesh, block_id, label, boundary, scaled_jacobian, edge_ratio, determinant, non_orthogonality, skewness }
}

impl From<&BoundaryFace> for BoundaryFaceData {
    fn from(side: &BoundaryFace) -> Self {
        let HexFace { cell, face } = side.face;
        Self { cell, face, label: side.label.index() as i8, facet: side.facet }
    }
}

impl BoundaryFaceData {
    fn read(&self) -> polycube::Result<BoundaryFace> {
        let label = Label::new(self.label).ok_or_else(|| {
            Error::new(ErrorKind::Mismatch, format!("{} is no label", self.label)).remedy("use 0 to 5")
        })?;
        Ok(BoundaryFace { face: HexFace { cell: self.cell, face: self.face }, label, facet: self.facet })
    }
}

/// See `polycube::mesh::write_solver`; `groups` is the file of groups of the boundary, or empty.
pub fn write_solver(
    path: &str,
    view: &MeshView,
    block_id: &[u32],
    boundary: &[BoundaryFaceData],
    groups: &str,
) -> Result<()> {
    guard(|| {
        let boundary = boundary.iter().map(BoundaryFaceData::read).collect::<polycube::Result<Vec<_>>>()?;
        let hexes = owned(view)?;
        if groups.is_empty() {
            return mesh::write_solver(Path::new(path), &core::grouped(&hexes, block_id, &boundary)?);
        }
        let surface = mesh::read_grouped_surface(Path::new(groups))?;
        let patches = core::carry_groups(&surface, &hexes, &boundary)?;
        mesh::write_solver(Path::new(path), &core::grouped_by(&hexes, block_id, &boundary, patches)?)
    })
}

/// See `polycube::mesh::write_textured_bytes`: u and v of each corner.
pub fn write_textured(path: &str, view: &MeshView, uv: &[f64]) -> Result<()> {
    guard(|| {
        let (corners, rest) = uv.as_chunks::<2>();
        let (quads, few) = corners.as_chunks::<4>();
        if !rest.is_empty() || !few.is_empty() {
            let message = format!("{} texture coordinates are not two for each corner", uv.len());
            return Err(Error::new(ErrorKind::Mismatch, message).remedy("give eight for each quadrilateral"));
        }
        mesh::write_atomically(Path::new(path), &mesh::write_textured_bytes(&owned(view)?, quads)?)
    })
}

impl From<&RemeshReport> for RemeshReportData {
    fn from(report: &RemeshReport) -> Self {
        let measures = report.measures.as_ref();
        Self {
            quads: report.quads as u64,
            hexes: report.hexes as u64,
            hex_blocks: report.hex_blocks as u64,
            inverted: report.inverted as u64,
            released: report.released as u64,
            min_sj: report.min_sj.into(),
            avg_sj: report.avg_sj.into(),
            max_edge_ratio: measures.map(|m| m.edge_ratio.max).into(),
            min_determinant: measures.map(|m| m.determinant.min).into(),
            max_non_orthogonality: measures.map(|m| m.non_orthogonality.max).into(),
            max_skewness: measures.map(|m| m.skewness.max).into(),
            hausdorff: report.hausdorff,
            hausdorff_percent: report.hausdorff_percent,
            within_hausdorff: report.within_hausdorff,
            good: report.is_good(),
            seconds: report.seconds.total,
            faults: report.faults().iter().map(ToString::to_string).collect(),
        }
    }
}

/// The defaults of the core, for C++ to compare its own with.
pub fn default_remesh_options() -> RemeshOptionsData {
    let RemeshOptions { simplify, size, padding, surface_only, max_hausdorff, .. } = RemeshOptions::default();
    RemeshOptionsData {
        simplify: defaults(&simplify),
        has_size: size.is_some(),
        size_kind: 0,
        size: 0.0,
        padding: padding as u32,
        surface_only,
        max_hausdorff,
    }
}
