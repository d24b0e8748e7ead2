/// @file
/// Exact neighbours among points, independent of the core's own. See the note on licences in `cgal.hpp`.
#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <array>
#include <cstdint>
#include <polycube/cgal/soup.hpp>
#include <set>
#include <utility>
#include <vector>

namespace polycube::cgal {

namespace detail {

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using CellBase = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Pairs = std::set<std::array<std::uint32_t, 2>>;

inline Delaunay triangulate(const std::vector<double>& points) {
    std::vector<std::pair<Point, std::uint32_t>> numbered;
    for (const Point& point : points_of(points)) {
        numbered.emplace_back(point, static_cast<std::uint32_t>(numbered.size()));
    }
    return Delaunay(numbered.begin(), numbered.end());
}

inline void add(Pairs& pairs, std::uint32_t a, std::uint32_t b) { pairs.insert({std::min(a, b), std::max(a, b)}); }

}  // namespace detail

/// The pairs of points (x, y, z each) joined by an edge of their Delaunay triangulation, in order, each with its lower
/// number first. Cospherical points have several triangulations; this is the one that CGAL's perturbation chooses.
inline std::vector<std::array<std::uint32_t, 2>> delaunay_edges(const std::vector<double>& points) {
    const detail::Delaunay delaunay = detail::triangulate(points);
    detail::Pairs pairs;
    for (auto e = delaunay.finite_edges_begin(); e != delaunay.finite_edges_end(); ++e) {
        detail::add(pairs, e->first->vertex(e->second)->info(), e->first->vertex(e->third)->info());
    }
    return {pairs.begin(), pairs.end()};
}

/// The pairs of points (x, y, z each) whose Voronoi cells share a corner: the edges of all Delaunay triangulations
/// there are. In order, each with its lower number first. O(n c) for n points and c tetrahedra; the points must not all
/// lie in a plane.
inline std::vector<std::array<std::uint32_t, 2>> touching_cells(const std::vector<double>& points) {
    const detail::Delaunay delaunay = detail::triangulate(points);
    detail::Pairs pairs;
    for (auto cell = delaunay.finite_cells_begin(); cell != delaunay.finite_cells_end(); ++cell) {
        std::vector<std::uint32_t> on_sphere;
        for (auto v = delaunay.finite_vertices_begin(); v != delaunay.finite_vertices_end(); ++v) {
            const detail::Delaunay::Cell_handle handle = cell;
            const bool own = cell->has_vertex(v);
            const auto side =
                CGAL::side_of_oriented_sphere(handle->vertex(0)->point(), handle->vertex(1)->point(),
                                              handle->vertex(2)->point(), handle->vertex(3)->point(), v->point());
            if (own || side == CGAL::ON_ORIENTED_BOUNDARY) on_sphere.push_back(v->info());
        }
        for (const std::uint32_t a : on_sphere) {
            for (const std::uint32_t b : on_sphere) {
                if (a < b) detail::add(pairs, a, b);
            }
        }
    }
    return {pairs.begin(), pairs.end()};
}

}  // namespace polycube::cgal
