/// @file
/// Polycubes made by the library itself, for demonstrations and tests.
#pragma once

#include <cstdint>
#include <polycube/mesh.hpp>
#include <string>
#include <utility>
#include <vector>

namespace polycube {

/// The names of the examples: "cube-spikes", "stepped-l", "ring", "double-torus".
std::vector<std::string> example_names();

/// An example's polycube and the shape it was deformed from, **polycube first**: two meshes of `kind` with the same
/// cells, 44 to 66 units long. The seed shifts its parts; 0 leaves all of them aligned.
///
/// @code
/// const auto [ring, bent] = polycube::example("ring", 1, polycube::CellKind::tetrahedra);
/// @endcode
///
/// @throws Error option for an unknown name.
std::pair<Mesh, Mesh> example(const std::string& name, std::uint64_t seed = 1, CellKind kind = CellKind::triangles);

}  // namespace polycube
