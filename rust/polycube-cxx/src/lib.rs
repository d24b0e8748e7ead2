//! The bridge from the core to C++. Hosts use the library in `cpp`, which alone knows what is here.
//!
//! Data crosses as flat buffers, results as structs of them. Every function gives an error instead of unwinding
//! (`failure`), long ones run on a thread of their own while the caller's thread listens for progress and cancellation
//! (`run`). There is no state between calls.

mod buffers;
mod checking;
mod failure;
mod input;
mod making;
mod meshing;
mod options;
mod results;
mod run;
#[cfg(test)]
mod tests;

use buffers::{
    boundary, example, read_mesh, read_mesh_bytes, read_pair, scaled_jacobians, write_mesh, write_mesh_bytes,
};
use buffers::{example_names, read_labels, write_labels};
use checking::check;
use making::{default_make_options, make};
use meshing::{default_remesh_options, remesh, remesh_shape, write_solver, write_textured};
use options::default_options;
use results::{Simplified, corner_pairs, panic_in_core, simplify};

/// The version of the library.
fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// What crosses. Optional values are a flag and a value; enumerations are numbers in the order of their declaration.
// cxx calls C++ and is called by it; both sides of every call are generated from this declaration.
#[allow(unsafe_code)]
#[cxx::bridge(namespace = "polycube::bridge")]
mod ffi {
    struct MeshView<'a> {
        points: &'a [f64],
        kind: u8,
        cells: &'a [u32],
    }

    struct InputView<'a> {
        polycube: MeshView<'a>,
        has_shape: bool,
        shape: MeshView<'a>,
        has_labels: bool,
        labels: &'a [i8],
    }

    struct MeshData {
        points: Vec<f64>,
        kind: u8,
        cells: Vec<u32>,
    }

    struct PairData {
        polycube: MeshData,
        shape: MeshData,
    }

    struct FieldData {
        name: String,
        is_real: bool,
        real: Vec<f64>,
        integer: Vec<i32>,
    }

    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    struct Real {
        some: bool,
        value: f64,
    }

    #[derive(Clone, Copy, Debug, PartialEq)]
    struct ToleranceData {
        degrees: f64,
        distance: f64,
        merge: f64,
    }

    struct SymmetryData {
        axis: u32,
        at: f64,
    }

    struct PairOfFacets {
        first: u32,
        second: u32,
    }

    struct GuidesData {
        fixed: Vec<u32>,
        fixed_faces: Vec<u32>,
        /// The groups one after the other.
        together: Vec<u32>,
        /// Where each group ends.
        together_ends: Vec<usize>,
        apart: Vec<PairOfFacets>,
        symmetry: Vec<SymmetryData>,
    }

    struct OptionsData {
        strategy: u8,
        scale: Real,
        lambda_min: f64,
        solver: u8,
        has_objective: bool,
        objective: u8,
        steps_per_level: u32,
        proof_nodes: u64,
        time_limit: Real,
        simplicity: Real,
        max_displacement: Real,
        max_distortion: Real,
        no_repair: bool,
        tolerance: ToleranceData,
        guides: GuidesData,
    }

    struct MakeOptionsData {
        detail: f64,
        has_corners: bool,
        corners: u64,
        best_axes: bool,
        has_labels: bool,
        labels: Vec<i8>,
        no_repair: bool,
    }

    struct RemeshOptionsData {
        simplify: OptionsData,
        has_size: bool,
        size_kind: u8,
        size: f64,
        padding: u32,
        surface_only: bool,
        max_hausdorff: f64,
    }

    #[derive(Default)]
    struct CountsData {
        surface_patches: u64,
        blocks: u64,
        blocks_padded: u64,
    }

    struct RoundData {
        lambda: f64,
        pairs: u64,
        alignments: u64,
        counts: CountsData,
    }

    struct TradeOffData {
        count: u64,
        displacement: f64,
    }

    struct DistortionData {
        angle: f64,
        size: f64,
        worst_angle: f64,
        worst_size: f64,
        worst_cell: u32,
    }

    struct SecondsData {
        structure: f64,
        align: f64,
        morph: f64,
        total: f64,
    }

    struct ReportData {
        scale: f64,
        valid: bool,
        before: CountsData,
        after: CountsData,
        rounds: Vec<RoundData>,
        front: Vec<TradeOffData>,
        has_chosen: bool,
        chosen: u64,
        has_bound: bool,
        bound: u64,
        proven: bool,
        seconds: SecondsData,
        max_displacement: f64,
        flipped_cells: Vec<u32>,
        flipped_faces: Vec<u32>,
        deviation_degrees: f64,
        deviation_distance: f64,
        /// Before and after, or nothing.
        distortion: Vec<DistortionData>,
        notes: Vec<String>,
    }

    struct SimplifiedData {
        report: ReportData,
        report_json: String,
        /// Empty when the result is not valid.
        polycube: MeshData,
        levels: Vec<i64>,
        labels: Vec<i8>,
        facet_of_face: Vec<u32>,
        patch_of_face: Vec<u32>,
        block_of_face: Vec<u32>,
    }

    struct MadeData {
        polycube: MeshData,
        shape: MeshData,
        labels: Vec<i8>,
        repairs: Vec<String>,
        corners: u64,
        edges: u64,
        facets: u64,
        genus: u64,
        added: u64,
        misfit: f64,
        squashed: f64,
        /// One or nothing.
        distortion: Vec<DistortionData>,
        folded: Vec<u32>,
        seconds: f64,
        report_json: String,
    }

    struct QuadsData {
        mesh: MeshData,
        label: Vec<i8>,
        patch_id: Vec<u32>,
        block_id: Vec<u32>,
        uv: Vec<f64>,
    }

    struct BoundaryFaceData {
        cell: u32,
        face: u8,
        label: i8,
        facet: u32,
    }

    struct HexesData {
        mesh: MeshData,
        block_id: Vec<u32>,
        label: Vec<i8>,
        boundary: Vec<BoundaryFaceData>,
        scaled_jacobian: Vec<f64>,
        edge_ratio: Vec<f64>,
        determinant: Vec<f64>,
        non_orthogonality: Vec<f64>,
        skewness: Vec<f64>,
    }

    struct SingularData {
        points: Vec<f64>,
        valence: u32,
    }

    struct LayoutData {
        blocks: MeshData,
        patches: MeshData,
        patch_label: Vec<i8>,
        singular: Vec<SingularData>,
    }

    struct RemeshReportData {
        quads: u64,
        hexes: u64,
        hex_blocks: u64,
        inverted: u64,
        released: u64,
        min_sj: Real,
        avg_sj: Real,
        max_edge_ratio: Real,
        min_determinant: Real,
        max_non_orthogonality: Real,
        max_skewness: Real,
        hausdorff: f64,
        hausdorff_percent: f64,
        within_hausdorff: bool,
        good: bool,
        seconds: f64,
        faults: Vec<String>,
    }

    struct RemeshedData {
        simplified: Box<Simplified>,
        layout: LayoutData,
        quads: QuadsData,
        has_hexes: bool,
        hexes: HexesData,
        report: RemeshReportData,
        report_json: String,
    }

    struct RemeshedShapeData {
        made: MadeData,
        remeshed: RemeshedData,
    }

    struct PlaceData {
        element: u8,
        index: u64,
        second: u64,
    }

    struct ViolationData {
        rule: String,
        in_shape: bool,
        message: String,
        remedy: String,
        place: PlaceData,
        /// Three coordinates or nothing.
        at: Vec<f64>,
        faces: Vec<u32>,
    }

    struct LevelData {
        axis: u32,
        coordinate: f64,
    }

    struct FacetData {
        label: i8,
        level: u32,
        loops: u32,
    }

    struct CornerData {
        vertex: u32,
        valence: u32,
        levels: [u32; 3],
    }

    struct EdgeData {
        axis: u32,
        corners: [u32; 2],
        facets: [u32; 2],
        vertices: Vec<u32>,
    }

    #[derive(Default)]
    struct StructureData {
        levels: Vec<LevelData>,
        facets: Vec<FacetData>,
        corners: Vec<CornerData>,
        edges: Vec<EdgeData>,
        counts: CountsData,
        components: u32,
        genus: u32,
        deviation_degrees: f64,
        deviation_distance: f64,
        label_of_face: Vec<i8>,
        facet_of_face: Vec<u32>,
        patch_of_face: Vec<u32>,
        block_of_face: Vec<u32>,
    }

    struct CheckedData {
        violations: Vec<ViolationData>,
        /// Empty when there are violations.
        structure: StructureData,
    }

    unsafe extern "C++" {
        include!("polycube-cxx/include/observer.h");
        /// Who listens to a call.
        type Observer;
        fn is_cancelled(self: &Observer) -> bool;
        fn report(self: &Observer, stage: &str, progress: f64) -> bool;
    }

    extern "Rust" {
        type Simplified;
        fn data(self: &Simplified) -> Result<SimplifiedData>;
        fn at(self: &Simplified, input: &InputView, simplicity: f64, observer: &Observer) -> Result<Box<Simplified>>;
        fn rescaled(self: &Simplified, input: &InputView, scale: f64, observer: &Observer) -> Result<Box<Simplified>>;
        fn simplify(input: &InputView, options: &OptionsData, observer: &Observer) -> Result<Box<Simplified>>;
        fn remesh(input: &InputView, options: &RemeshOptionsData, observer: &Observer) -> Result<RemeshedData>;
        fn make(shape: &MeshView, options: &MakeOptionsData, observer: &Observer) -> Result<MadeData>;
        fn remesh_shape(
            shape: &MeshView,
            making: &MakeOptionsData,
            options: &RemeshOptionsData,
            observer: &Observer,
        ) -> Result<RemeshedShapeData>;
        fn check(input: &InputView, tolerance: &ToleranceData, observer: &Observer) -> Result<CheckedData>;

        fn read_mesh(path: &str) -> Result<MeshData>;
        fn read_pair(polycube: &str, shape: &str) -> Result<PairData>;
        fn read_mesh_bytes(extension: &str, bytes: &[u8]) -> Result<MeshData>;
        fn write_mesh(path: &str, mesh: &MeshView, fields: Vec<FieldData>) -> Result<()>;
        fn write_mesh_bytes(extension: &str, mesh: &MeshView, fields: Vec<FieldData>) -> Result<Vec<u8>>;
        fn read_labels(path: &str, face_count: usize) -> Result<Vec<i8>>;
        fn write_labels(path: &str, labels: &[i8]) -> Result<()>;
        fn write_solver(
            path: &str,
            mesh: &MeshView,
            block_id: &[u32],
            boundary: &[BoundaryFaceData],
            groups: &str,
        ) -> Result<()>;
        fn write_textured(path: &str, mesh: &MeshView, uv: &[f64]) -> Result<()>;
        fn boundary(mesh: &MeshView) -> Result<MeshData>;
        fn scaled_jacobians(mesh: &MeshView) -> Result<Vec<f64>>;
        fn example_names() -> Vec<String>;
        fn example(name: &str, seed: u64, kind: u8) -> Result<PairData>;
        fn version() -> &'static str;

        // For tests.
        fn default_options() -> OptionsData;
        fn default_remesh_options() -> RemeshOptionsData;
        fn default_make_options() -> MakeOptionsData;
        fn corner_pairs(points: &[i64]) -> Result<Vec<u32>>;
        fn panic_in_core(input: &InputView, stage: &str, observer: &Observer) -> Result<()>;
    }
}
