/// @file
/// Nearest points and distances. See the note on licences in `cgal.hpp`.
#pragma once

#include <CGAL/AABB_tree.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif
#include <CGAL/Polygon_mesh_processing/distance.h>

#include <cmath>
#include <polycube/cgal/soup.hpp>
#include <vector>

namespace polycube::cgal {

namespace detail {

using Triangles = std::vector<Kernel::Triangle_3>;
#if CGAL_VERSION_MAJOR >= 6
using Primitive = CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits_3<Kernel, Primitive>>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
#endif

inline Triangles solid_triangles(const Mesh& mesh) {
    const Soup soup = soup_of(mesh);
    Triangles triangles;
    for (const Polygon& t : triangles_of(soup.polygons)) {
        const Kernel::Triangle_3 triangle(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
        if (!triangle.is_degenerate()) triangles.push_back(triangle);
    }
    if (triangles.empty()) throw Error(ErrorKind::mesh, "the surface has no face with an area", "give a surface");
    return triangles;
}

}  // namespace detail

/// A surface that can be asked for nearest points, such as those of the vertices of a quadrilateral mesh. It may be
/// asked from several threads.
class Surface {
 public:
    /// Indexes a surface, or the boundary of a volume; quadrilaterals are cut in two. O(n log n).
    /// @throws Error mesh when it has no face with an area.
    explicit Surface(const Mesh& mesh)
        : triangles_(detail::solid_triangles(mesh)), tree_(triangles_.begin(), triangles_.end()) {
        tree_.accelerate_distance_queries();
    }
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;

    /// The point of the surface nearest to each of `points` (x, y, z each), up to rounding.
    std::vector<double> project(const std::vector<double>& points) const {
        std::vector<double> nearest;
        for (const detail::Point& point : detail::points_of(points)) {
            const detail::Point found = tree_.closest_point(point);
            nearest.insert(nearest.end(), {found.x(), found.y(), found.z()});
        }
        return nearest;
    }

    /// The distance of each of `points` (x, y, z each) to the surface, in units of the mesh.
    std::vector<double> distances(const std::vector<double>& points) const {
        std::vector<double> distances;
        for (const detail::Point& point : detail::points_of(points)) {
            distances.push_back(std::sqrt(CGAL::to_double(tree_.squared_distance(point))));
        }
        return distances;
    }

 private:
    detail::Triangles triangles_;
    detail::Tree tree_;
};

/// The Hausdorff distance between two surfaces, the larger of both ways, in units of the meshes, up to an error of
/// `error`.
///
/// @throws Error mesh for surfaces that are not manifold; option unless `error` is positive.
inline double hausdorff(const Mesh& a, const Mesh& b, double error) {
    if (!(error > 0.0) || !std::isfinite(error)) {
        throw Error(ErrorKind::option, "the error of the Hausdorff distance is not positive", "give a positive number");
    }
    const detail::SurfaceMesh first = detail::mesh_of(detail::soup_of(a)), second = detail::mesh_of(detail::soup_of(b));
    return CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
        first, second, error);
}

}  // namespace polycube::cgal
