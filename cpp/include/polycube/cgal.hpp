/// @file
/// Checks of the input and measures of the result with CGAL 5.5 or later; link `polycube::cgal`.
///
/// This header uses CGAL packages under the GPL (Polygon Mesh Processing, AABB Tree, 3D Triangulations): a program that
/// includes it must be distributed under the GPL, version 3 or later. The rest of the library is under MIT OR
/// Apache-2.0 and does without.
#pragma once

#include <array>
#include <cstdint>
#include <polycube/error.hpp>
#include <polycube/mesh.hpp>
#include <string>
#include <utility>
#include <vector>

namespace polycube::cgal {

/// What is wrong with a surface before the core sees it. Quadrilaterals are judged as two triangles each, volumes by
/// their boundary.
struct SurfaceCheck {
    bool closed = false;         ///< No border edge.
    bool bounds_volume = false;  ///< Closed, free of self-intersections, components nested properly and oriented so.
    bool outward = false;        ///< Closed and oriented outward.
    std::vector<std::uint32_t> open_faces;                    ///< Faces at border edges.
    std::vector<std::array<std::uint32_t, 2>> intersections;  ///< Pairs of faces that intersect each other.
    std::vector<std::uint32_t> degenerate;                    ///< Faces without area.
    std::vector<std::uint32_t>
        non_manifold_vertices;  ///< Vertices where several sheets touch, or faces do not fit together.

    bool good() const noexcept {
        return bounds_volume && outward && degenerate.empty() && non_manifold_vertices.empty();
    }
    /// What is wrong, line by line; empty when `good()`.
    std::vector<std::string> log;
};

/// Checks a surface, or the boundary of a volume. Exact.
/// @throws Error mesh when an index is out of range.
SurfaceCheck check_surface(const Mesh& mesh);

/// What `repair` may do.
struct Repairs {
    bool orient = true;  ///< Turn faces so that they agree and look outward. Keeps the numbers of vertices and faces.
    bool weld = false;   ///< Make one of vertices at exactly the same place. Renumbers vertices.
};

/// What `repair` did.
struct Repaired {
    Mesh mesh;
    std::uint64_t turned = 0;  ///< Faces turned.
    std::uint64_t welded = 0;  ///< Vertices that became one with another.
};

/// Repairs a surface of triangles or quadrilaterals as far as the user allows. Give shape and polycube the same
/// repairs.
/// @throws Error unsupported for a volume; mesh when faces cannot be oriented (a Moebius strip, non-manifold).
Repaired repair(const Mesh& mesh, const Repairs& allowed = {});

/// A surface that can be asked for nearest points. Quadrilaterals are cut in two.
class Surface {
 public:
    /// @throws Error mesh.
    explicit Surface(const Mesh& mesh);
    /// The point of the surface nearest to each of `points` (x, y, z each).
    std::vector<double> project(const std::vector<double>& points) const;
    /// The distance of each of `points` to the surface.
    std::vector<double> distances(const std::vector<double>& points) const;
};

/// The Hausdorff distance between two surfaces, both ways, in units of the meshes, up to an error of `error`.
/// @throws Error mesh; option unless `error` is positive.
double hausdorff(const Mesh& a, const Mesh& b, double error);

/// The pairs of points joined by an edge of the exact Delaunay triangulation of `points` (x, y, z each; at least 4 not
/// in a plane), each with the lower number first, in order. Of cospherical points, which have several triangulations,
/// one that CGAL's symbolic perturbation chooses.
std::vector<std::array<std::uint32_t, 2>> delaunay_edges(const std::vector<double>& points);

}  // namespace polycube::cgal
