/// @file
/// Checks of the input and measures of the result with CGAL 5.5 or later; link `polycube::cgal`.
///
/// These headers use CGAL packages under the GPL (Polygon Mesh Processing, AABB Tree, 3D Triangulations): a program
/// that includes them must be distributed under the GPL, version 3 or later. The rest of the library is under MIT OR
/// Apache-2.0 and does without.
#pragma once

#include <polycube/cgal/delaunay.hpp>
#include <polycube/cgal/distance.hpp>
#include <polycube/cgal/surface.hpp>
