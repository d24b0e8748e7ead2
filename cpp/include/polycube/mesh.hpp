/// @file
/// Meshes as plain buffers, and their files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace polycube {

/// The kinds of cells there are.
enum class CellKind : std::uint8_t {
    triangles,   ///< Surface, counter-clockwise seen from outside.
    quads,       ///< Surface, counter-clockwise seen from outside.
    tetrahedra,  ///< Volume in VTK's order: det(b - a, c - a, d - a) > 0.
    hexahedra,   ///< Volume in VTK's order: bottom counter-clockwise seen from the top, then the top above it.
};

/// How many vertices a cell of this kind has: 3, 4, 4 or 8.
constexpr std::size_t vertices_per_cell(CellKind kind) noexcept {
    return kind == CellKind::triangles ? 3 : kind == CellKind::hexahedra ? 8 : 4;
}

/// Vertices and cells, all of one kind. A polycube and the shape it was deformed from are two meshes with the same
/// cells.
struct Mesh {
    /// x, y, z of every vertex.
    std::vector<double> points;
    CellKind kind = CellKind::triangles;
    /// The vertices of every cell, counted from 0: `vertices_per_cell(kind)` numbers a cell.
    std::vector<std::uint32_t> cells;

    std::size_t point_count() const noexcept { return points.size() / 3; }
    std::size_t cell_count() const noexcept { return cells.size() / vertices_per_cell(kind); }
    bool is_volume() const noexcept { return kind == CellKind::tetrahedra || kind == CellKind::hexahedra; }
};

/// A named number per cell. Names have letters, digits and `_ - . :` only.
struct CellField {
    std::string name;
    /// One value per cell.
    std::variant<std::vector<double>, std::vector<std::int32_t>> values;
};

/// Reads .obj .off .ply .stl .vtp (surfaces) .mesh .meshb .vtk .vtu .msh .inp (all cells); the extension tells the
/// format.
///
/// Vertices keep their order, used or not. Where a file holds volume and surface, the volume is taken. Polygons that
/// are not all quadrilaterals are split into triangles. Paths are UTF-8.
///
/// @throws Error io, parse (with the line), mesh (nothing in it, not finite), unsupported.
Mesh read_mesh(const std::string& path);

/// Reads a polycube and its shape and checks that they have the same cells. The order is **polycube first, then
/// shape**, in the arguments and in the pair that is returned (Python's `read_pair` has the shape first).
///
/// @code
/// const auto [cube, shape] = polycube::read_pair("ring.polycube.obj", "ring.shape.obj");
/// @endcode
///
/// @throws Error as `read_mesh`, and mismatch naming the first difference.
std::pair<Mesh, Mesh> read_pair(const std::string& polycube, const std::string& shape);

/// Writes a mesh, whole or not at all: to a temporary name first. .ply, .vtk and .vtu hold every field, .mesh one of
/// integers, the others none. The bytes depend on the mesh alone, and are those that the command `polycube` writes.
///
/// @code
/// std::vector<double> quality(cube.cell_count(), 1.0);
/// polycube::write_mesh("cube.vtu", cube, {{"quality", quality}});
/// @endcode
///
/// @throws Error io, unsupported (the format cannot hold the cells), mesh, option (a field's name or length).
void write_mesh(const std::string& path, const Mesh& mesh, const std::vector<CellField>& fields = {});

/// Reads as `read_mesh` does from the bytes of a file with this extension, such as "obj". @throws Error as `read_mesh`.
Mesh read_mesh_bytes(const std::string& extension, const void* bytes, std::size_t size);

/// The bytes that `write_mesh` writes to a file with this extension. @throws Error as `write_mesh`.
std::vector<std::uint8_t> write_mesh_bytes(const std::string& extension, const Mesh& mesh,
                                           const std::vector<CellField>& fields = {});

/// Reads one label a line for each of `face_count` boundary faces: 0 to 5 for +X -X +Y -Y +Z -Z, -1 for "by the
/// normal"; or those numbers of the faces in a mesh file (references, cell data, physical groups, materials).
///
/// @throws Error io, parse (with the line), mismatch (another number of labels).
std::vector<std::int8_t> read_labels(const std::string& path, std::size_t face_count);

/// Writes one label a line, whole or not at all. @throws Error io, option (a label outside -1 to 5).
void write_labels(const std::string& path, const std::vector<std::int8_t>& labels);

/// The faces that belong to one cell only, outward, as triangles or quadrilaterals over the same points: the boundary
/// faces that labels, selections and errors count. A surface is its own boundary.
///
/// @throws Error mesh when more than two cells share a face or an index is out of range.
Mesh boundary(const Mesh& mesh);

}  // namespace polycube
