/// @file
/// Meshes of this library as CGAL's. For the other headers in this folder.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <polycube/error.hpp>
#include <polycube/mesh.hpp>
#include <vector>

namespace polycube::cgal::detail {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using Polygon = std::vector<std::size_t>;

/// Points and polygons without connectivity; every point is used.
struct Soup {
    std::vector<Point> points;
    std::vector<Polygon> polygons;
    /// The vertex of the mesh that each point is.
    std::vector<std::uint32_t> vertex_of;
};

inline std::vector<Point> points_of(const std::vector<double>& coordinates) {
    std::vector<Point> points;
    for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3) {
        points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
    }
    return points;
}

/// The faces of a surface, or of the boundary of a volume. Throws `Error` mesh for an index that is out of range.
inline Soup soup_of(const Mesh& mesh) {
    const Mesh faces = boundary(mesh);
    const std::vector<Point> all = points_of(faces.points);
    constexpr std::size_t unused = static_cast<std::size_t>(-1);
    std::vector<std::size_t> number(all.size(), unused);
    Soup soup;
    const std::size_t sides = vertices_per_cell(faces.kind);
    for (std::size_t i = 0; i < faces.cells.size(); ++i) {
        const std::uint32_t v = faces.cells[i];
        if (number[v] == unused) {
            number[v] = soup.points.size();
            soup.points.push_back(all[v]);
            soup.vertex_of.push_back(v);
        }
        if (i % sides == 0) soup.polygons.emplace_back();
        soup.polygons.back().push_back(number[v]);
    }
    return soup;
}

/// Every polygon as a fan around its first point.
inline std::vector<Polygon> triangles_of(const std::vector<Polygon>& polygons) {
    std::vector<Polygon> triangles;
    for (const Polygon& polygon : polygons) {
        for (std::size_t i = 2; i < polygon.size(); ++i) triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
    return triangles;
}

/// A triangle mesh of polygons that fit together; face i is triangle i of `triangles_of`.
inline SurfaceMesh mesh_of(const Soup& soup) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    const std::vector<Polygon> triangles = triangles_of(soup.polygons);
    if (!pmp::is_polygon_soup_a_polygon_mesh(triangles)) {
        throw Error(ErrorKind::mesh, "the faces do not fit together to a manifold surface",
                    "use check_surface to list where");
    }
    SurfaceMesh mesh;
    pmp::polygon_soup_to_polygon_mesh(soup.points, triangles, mesh);
    return mesh;
}

}  // namespace polycube::cgal::detail
