/// @file
/// How good the cells of a mesh are.
#pragma once

#include <polycube/mesh.hpp>
#include <vector>

namespace polycube {

/// The scaled Jacobian of every cell, -1 to 1: 1 for rectangles and boxes, 0 or less for cells that are turned over,
/// with Verdict's definition for quadrilaterals and tetrahedra and the least of the corners' for hexahedra.
///
/// @code
/// const std::vector<double> quality = polycube::scaled_jacobians(cube);
/// @endcode
///
/// @throws Error unsupported for triangles; mesh for an index out of range.
std::vector<double> scaled_jacobians(const Mesh& mesh);

}  // namespace polycube
