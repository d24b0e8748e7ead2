/// @file
/// OpenMesh meshes in and out. Needs OpenMesh 9 or later; link `polycube::openmesh`.
#pragma once

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>
#include <cstdint>
#include <polycube/error.hpp>
#include <polycube/mesh.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace polycube::openmesh {

/// A face property with the label of each face, 0 to 5.
inline constexpr const char* label_property = "polycube:label";
/// A face property with the patch of each face.
inline constexpr const char* patch_property = "polycube:patch_id";
/// A face property with the block below each face.
inline constexpr const char* block_property = "polycube:block_id";

/// A surface mesh with the vertices and faces of `mesh` in their order. Deleted elements are left out, so numbers are
/// those that `garbage_collection` would give. Triangles if all faces are, quadrilaterals if all are; faces of other
/// polygon meshes are cut into fans, and numbers of faces then differ.
///
/// @throws Error mesh when there is no face.
template <class OMesh>
Mesh from(const OMesh& mesh);

/// An OpenMesh with the vertices and faces of a surface `mesh`; a triangle mesh type gets quadrilaterals cut in two.
///
/// @throws Error unsupported for a volume (take its `boundary()`), mesh for faces that OpenMesh cannot hold
/// (non-manifold).
template <class OMesh>
OMesh to(const Mesh& mesh);

/// Stores one number per face as a property of this name, such as `patch_property`. T is int for every property of this
/// library.
///
/// @throws Error mismatch when there is not one number per face.
template <class OMesh, class Number>
void set_face_property(OMesh& mesh, const std::string& name, const std::vector<Number>& values);

/// The numbers of a face property; empty if there is none of that name.
template <class OMesh>
std::vector<std::int32_t> face_property(const OMesh& mesh, const std::string& name);

}  // namespace polycube::openmesh
