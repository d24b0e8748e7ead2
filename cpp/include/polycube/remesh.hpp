/// @file
/// From a shape, with its polycube or alone, to a coarse layout, quadrilaterals and hexahedra.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <polycube/make.hpp>
#include <polycube/simplify.hpp>
#include <string>
#include <vector>

namespace polycube {

/// How fine a mesh shall be.
struct Size {
    enum class Kind : std::uint8_t {
        scale,        ///< Lattice steps per unit of the polycube, above 0.
        edge_length,  ///< Mean length of the mesh's edges, in units of the shape, above 0.
        hexes,        ///< About how many hexahedra there shall be, padding included; at least 1.
    };
    Kind kind = Kind::scale;
    double value = 1.0;
};

/// How a shape is meshed.
struct RemeshOptions {
    /// How the polycube is simplified. Unless `simplicity`, `max_displacement` or `max_distortion` is set, the fewest
    /// blocks are taken whose hexahedra are good. Of `scale` only `size` is used where that is given.
    Options simplify;
    /// Without one: as `Options::scale` says.
    std::optional<Size> size;
    /// Layers of hexahedra between the polycube and the surface, 0 to 16.
    std::uint32_t padding = 1;
    /// Leave the hexahedra out.
    bool surface_only = false;
    /// The largest Hausdorff distance to accept, as a **fraction** of the bounding box's diagonal, above 0: 0.005 is
    /// half a percent. (The command and Python take percent.)
    double max_hausdorff = 0.005;
    /// How a polycube is made where none is given.
    MakeOptions make = {};
};

/// The quadrilateral mesh of the surface. One number per quadrilateral.
struct QuadMesh {
    Mesh mesh;                            ///< In units of the shape; vertices lie on the shape.
    std::vector<std::int8_t> label;       ///< 0 to 5 for +X -X +Y -Y +Z -Z.
    std::vector<std::uint32_t> patch_id;  ///< The patch, from 0: a cell of `Layout::patches`.
    std::vector<std::uint32_t> block_id;  ///< The padding block below it in the padded base complex.
    /// u and v, 0 to 1, of each of its four corners: every patch is a rectangle of equal squares; none touch.
    std::vector<double> uv;

    /// label, patch_id, block_id for `write_mesh`, as the command writes them.
    std::vector<CellField> fields() const;
};

/// A face on the outside of a hexahedral mesh.
struct BoundaryFace {
    std::uint32_t hexahedron = 0;  ///< The hexahedron that has it.
    std::uint8_t face = 0;         ///< Which of its faces, 0 to 5, as VTK orders them.
    std::int8_t label = 0;         ///< The direction it has on the polycube, 0 to 5 for +X -X +Y -Y +Z -Z.
    std::uint32_t facet = 0;       ///< The facet of the polycube that it lies on.
};

/// The hexahedral mesh. One number per hexahedron.
struct HexMesh {
    Mesh mesh;                            ///< In units of the shape.
    std::vector<std::uint32_t> block_id;  ///< The block, from 0: a cell of `Layout::blocks`.
    std::vector<std::int8_t> label;       ///< The label of its facet at the surface, 0 to 5; -1 inside.
    std::vector<BoundaryFace> boundary;   ///< Its outside, in the order of the cells of `QuadMesh::mesh`.
    std::vector<double> scaled_jacobian;  ///< The smallest of its corners', -1 to 1; 0 or less is inverted.
    std::vector<double> edge_ratio;       ///< Longest over shortest edge, at least 1.
    std::vector<double> determinant;      ///< The least of its corners' over the mean of the mesh.
    /// The largest angle between a face inside and the line to the middle of the next cell, in degrees (OpenFOAM's).
    std::vector<double> non_orthogonality;
    std::vector<double> skewness;  ///< The largest of its faces' (OpenFOAM's), at least 0; more than 4 is bad.

    /// All of these but the mesh for `write_mesh`, as the command writes them.
    std::vector<CellField> fields() const;
};

/// A line of edges at which an irregular number of blocks meet.
struct SingularEdge {
    std::vector<double> points;  ///< x, y, z of its vertices in order.
    std::uint32_t valence = 0;   ///< How many blocks meet at it.
};

/// Blocks and patches as single cells on the shape. Neighbours share whole faces and sides.
struct Layout {
    Mesh blocks;                           ///< One hexahedron per block; none for a surface alone.
    Mesh patches;                          ///< One quadrilateral per patch.
    std::vector<std::int8_t> patch_label;  ///< The label of every patch.
    std::vector<SingularEdge> singular;    ///< The singular edges.

    /// block_id of `blocks` for `write_mesh`, as the command writes it.
    std::vector<CellField> block_fields() const;
};

/// How good the meshes are. `Remeshed::report_json` has all of it and more.
struct RemeshReport {
    std::uint64_t quads = 0;       ///< Number of quadrilaterals.
    std::uint64_t hexes = 0;       ///< Number of hexahedra; 0 for a surface alone.
    std::uint64_t hex_blocks = 0;  ///< Blocks of the base complex of the hexahedra, counted on the finished mesh.
    std::uint64_t inverted = 0;    ///< Hexahedra whose scaled Jacobian is not positive.
    std::uint64_t released = 0;    ///< Vertices that left polycube corners and edges for the sake of bad hexahedra.
    std::optional<double> min_scaled_jacobian;    ///< Nothing without hexahedra.
    std::optional<double> mean_scaled_jacobian;   ///< Nothing without hexahedra.
    std::optional<double> max_edge_ratio;         ///< Nothing without hexahedra.
    std::optional<double> min_determinant;        ///< Over the mean of the mesh; nothing without hexahedra.
    std::optional<double> max_non_orthogonality;  ///< In degrees; nothing without hexahedra.
    std::optional<double> max_skewness;           ///< Nothing without hexahedra.
    double hausdorff = 0.0;           ///< Hausdorff distance between quadrilaterals and shape, in units of the shape.
    double hausdorff_percent = 0.0;   ///< The same in percent of the diagonal of the shape's bounding box.
    bool within_hausdorff = false;    ///< Whether that is within `RemeshOptions::max_hausdorff`.
    bool good = false;                ///< Whether nothing is inverted and the surface is near enough.
    double seconds = 0.0;             ///< Time spent.
    std::vector<std::string> faults;  ///< What is not as good as asked for, in plain words.
};

/// Meshes of a shape and the block structure that they have.
struct Remeshed {
    Simplified simplified;  ///< The polycube on the lattice of the meshes. Its report says what the simplification did.
    Layout layout;          ///< Blocks and patches as single cells.
    QuadMesh quads;         ///< The surface; with hexahedra it is theirs.
    std::optional<HexMesh> hexes;  ///< The volume, unless only the surface was asked for.
    RemeshReport report;           ///< How good they are.
    std::string
        report_json;  ///< All of it as JSON: what the command writes to report.json, without its files and options.
    std::optional<Made> made;  ///< The polycube that was made of the shape; nothing where one was given.
};

/// Simplifies a polycube and meshes its shape with the block structure found. Without a shape the polycube itself is
/// meshed.
///
/// Where inverted hexahedra remain or the surface is farther from the shape than asked for, the result is given all the
/// same and the report says so.
///
/// @code
/// polycube::RemeshOptions options;
/// options.size = polycube::Size{polycube::Size::Kind::hexes, 500};
/// const polycube::Remeshed result = polycube::remesh({cube, shape}, options);
/// for (const std::string& fault : result.report.faults) std::clog << fault << '\n';
/// polycube::write_mesh("hexes.vtu", result.hexes->mesh, result.hexes->fields());
/// polycube::write_solver("hexes.msh", *result.hexes);
/// polycube::write_mesh("layout.vtk", result.layout.blocks, result.layout.block_fields());
/// @endcode
///
/// @throws Error as `simplify()`; option for a size, padding or distance out of range.
Remeshed remesh(const Input& input, const RemeshOptions& options = {}, const Context& context = {});

/// Meshes a shape alone, a closed surface: `polycube::remesh(shape)` makes a polycube of it as `make()` does, and
/// meshes that as above. `Remeshed::made` is what was made.
///
/// @throws Error as `make()` and as above; option for `guides.fixed_faces`, as there are no faces yet to lock.
Remeshed remesh(const Mesh& shape, const RemeshOptions& options = {}, const Context& context = {});

/// Writes hexahedra for the solver that the extension names, whole or not at all, with blocks and boundary by name
/// (block_0 ...; facet_0 ..., and minus_x to plus_z for all facets that look one way on the polycube): msh of Gmsh 4.1,
/// inp of Abaqus and CalculiX, su2 of SU2 (boundary only), foam for the folder of an OpenFOAM case; or the block
/// structure itself: json, xyz of Plot3D (no names), blockmesh for the folder of a case with a blockMeshDict.
///
/// Where `groups` names a mesh file that lies on the shape, most often the shape's own, the boundary in msh, inp, su2
/// and foam is named by the groups of its faces: materials, groups or objects of OBJ, references of MEDIT, physical
/// groups of Gmsh, element sets of Abaqus, arrays of the cells of VTK.
///
/// @throws Error io, unsupported (another extension, or blocks that blockMesh cannot tell apart), mismatch (the
/// boundary is not that of the mesh, blocks are no boxes, or a face of one is in two groups), parse (no groups in the
/// file).
void write_solver(const std::string& path, const HexMesh& hexes, const std::string& groups = {});

/// Writes quadrilaterals as OBJ with their texture coordinates `uv`, whole or not at all.
///
/// @throws Error io, mismatch (not eight numbers in `uv` for each quadrilateral), unsupported (other cells).
void write_textured(const std::string& path, const QuadMesh& quads);

}  // namespace polycube
