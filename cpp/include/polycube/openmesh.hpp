/// @file
/// OpenMesh meshes in and out. Needs OpenMesh 9 or later; link `polycube::openmesh`.
#pragma once

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <cstdint>
#include <polycube/error.hpp>
#include <polycube/mesh.hpp>
#include <string>
#include <vector>

namespace polycube::openmesh {

/// A face property with the label of each face, 0 to 5.
inline constexpr const char* label_property = "polycube:label";
/// A face property with the patch of each face.
inline constexpr const char* patch_property = "polycube:patch_id";
/// A face property with the block below each face.
inline constexpr const char* block_property = "polycube:block_id";

namespace detail {

/// The vertices of every face, numbered as `from` does.
template <class OMesh>
std::vector<std::vector<std::uint32_t>> polygons(const OMesh& mesh) {
    std::vector<std::uint32_t> number(mesh.n_vertices());
    std::uint32_t next = 0;
    for (const auto v : mesh.vertices()) number[static_cast<std::size_t>(v.idx())] = next++;
    std::vector<std::vector<std::uint32_t>> polygons;
    for (const auto f : mesh.faces()) {
        polygons.emplace_back();
        for (auto v = mesh.cfv_ccwbegin(f); v != mesh.cfv_ccwend(f); ++v) {
            polygons.back().push_back(number[static_cast<std::size_t>(v->idx())]);
        }
    }
    return polygons;
}

/// Adds a face; OpenMesh refuses what is not manifold.
template <class OMesh>
void add_face(OMesh& mesh, const std::vector<OpenMesh::VertexHandle>& vertices, std::size_t cell) {
    if (mesh.add_face(vertices).is_valid()) return;
    throw Error(ErrorKind::mesh, Place{Element::face, cell, 0}, "OpenMesh cannot hold this face: it is not manifold",
                "use `check` to list what is wrong");
}

}  // namespace detail

/// A surface mesh with the vertices and faces of `mesh` in their order. Deleted elements are left out, so numbers are
/// those that `garbage_collection` would give. Triangles if all faces are, quadrilaterals if all are; faces of other
/// polygon meshes are cut into fans, and numbers of faces then differ.
///
/// @throws Error mesh when there is no face.
template <class OMesh>
Mesh from(const OMesh& mesh) {
    Mesh result;
    for (const auto v : mesh.vertices()) {
        const auto& point = mesh.point(v);
        for (std::size_t axis = 0; axis < 3; ++axis) result.points.push_back(static_cast<double>(point[axis]));
    }
    const std::vector<std::vector<std::uint32_t>> polygons = detail::polygons(mesh);
    if (polygons.empty()) throw Error(ErrorKind::mesh, "the mesh has no faces", "give a surface");
    const auto is_quad = [](const auto& polygon) { return polygon.size() == 4; };
    if (std::all_of(polygons.begin(), polygons.end(), is_quad)) {
        result.kind = CellKind::quads;
        for (const auto& p : polygons) result.cells.insert(result.cells.end(), p.begin(), p.end());
        return result;
    }
    for (const auto& p : polygons) {
        for (std::size_t i = 2; i < p.size(); ++i) result.cells.insert(result.cells.end(), {p[0], p[i - 1], p[i]});
    }
    return result;
}

/// An OpenMesh with the vertices and faces of a surface `mesh` in their order; OpenMesh cuts the quadrilaterals that a
/// triangle mesh type gets.
///
/// @throws Error unsupported for a volume (take its `boundary()`), mesh for faces that OpenMesh cannot hold (not
/// manifold, or vertices that are not there).
template <class OMesh>
OMesh to(const Mesh& mesh) {
    if (mesh.is_volume()) {
        throw Error(ErrorKind::unsupported, "OpenMesh holds surfaces only", "give the boundary() of the volume");
    }
    OMesh result;
    std::vector<OpenMesh::VertexHandle> handles;
    for (std::size_t v = 0; v < mesh.point_count(); ++v) {
        typename OMesh::Point point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] = static_cast<typename OMesh::Scalar>(mesh.points[3 * v + axis]);
        }
        handles.push_back(result.add_vertex(point));
    }
    const std::size_t sides = vertices_per_cell(mesh.kind);
    for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
        std::vector<OpenMesh::VertexHandle> face;
        for (std::size_t i = 0; i < sides; ++i) {
            const std::uint32_t v = mesh.cells[sides * cell + i];
            if (v >= handles.size()) {
                throw Error(ErrorKind::mesh, Place{Element::face, cell, 0},
                            "the face names a vertex that is not there");
            }
            face.push_back(handles[v]);
        }
        detail::add_face(result, face, cell);
    }
    return result;
}

/// Stores one number per face, in their order, as a property of this name, such as `patch_property`.
///
/// @throws Error mismatch when there is not one number per face.
template <class OMesh, class Number>
void set_face_property(OMesh& mesh, const std::string& name, const std::vector<Number>& values) {
    const auto faces = mesh.faces();
    const auto count = static_cast<std::size_t>(std::distance(faces.begin(), faces.end()));
    if (values.size() != count) {
        const std::string message = std::to_string(values.size()) + " values for " + std::to_string(count) + " faces";
        throw Error(ErrorKind::mismatch, message, "give one value per face");
    }
    OpenMesh::FPropHandleT<std::int32_t> property;
    if (!mesh.get_property_handle(property, name)) mesh.add_property(property, name);
    auto value = values.begin();
    for (const auto f : mesh.faces()) mesh.property(property, f) = static_cast<std::int32_t>(*value++);
}

/// The numbers of a face property, one per face in their order; empty if there is none of that name.
template <class OMesh>
std::vector<std::int32_t> face_property(const OMesh& mesh, const std::string& name) {
    OpenMesh::FPropHandleT<std::int32_t> property;
    if (!mesh.get_property_handle(property, name)) return {};
    std::vector<std::int32_t> values;
    for (const auto f : mesh.faces()) values.push_back(mesh.property(property, f));
    return values;
}

}  // namespace polycube::openmesh
