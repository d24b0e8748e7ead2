/// @file
/// Everything but the adapters `polycube/openmesh.hpp` and `polycube/cgal.hpp`.
///
/// All functions may be called from several threads at once; there is no global state. They throw `polycube::Error`.
#pragma once

#include <polycube/check.hpp>
#include <polycube/context.hpp>
#include <polycube/error.hpp>
#include <polycube/example.hpp>
#include <polycube/filter.hpp>
#include <polycube/make.hpp>
#include <polycube/mesh.hpp>
#include <polycube/quality.hpp>
#include <polycube/remesh.hpp>
#include <polycube/simplify.hpp>

namespace polycube {

/// The version of the library, such as "0.1.0".
const char* version() noexcept;

}  // namespace polycube
