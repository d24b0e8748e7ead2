/// @file
/// Is this surface fit for the core, and if not, where and what can be done? See the note on licences in `cgal.hpp`.
#pragma once

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <polycube/cgal/soup.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace polycube::cgal {

/// What is wrong with a surface before the core sees it. Faces are boundary faces of the mesh; quadrilaterals are
/// judged as two triangles each.
struct SurfaceCheck {
    bool closed = false;         ///< No border edge.
    bool outward = false;        ///< Closed, and oriented outward.
    bool bounds_volume = false;  ///< Closed, free of self-intersections, components nested properly and oriented so.
    std::vector<std::uint32_t> open_faces;                    ///< Faces at border edges.
    std::vector<std::uint32_t> turned;                        ///< Faces oriented against their neighbours.
    std::vector<std::uint32_t> degenerate;                    ///< Faces without area.
    std::vector<std::uint32_t> non_manifold_vertices;         ///< Vertices where faces do not form one fan.
    std::vector<std::array<std::uint32_t, 2>> intersections;  ///< Pairs of faces that intersect each other.

    bool good() const noexcept { return bounds_volume && turned.empty() && degenerate.empty(); }
    /// What is wrong, line by line; empty when `good()`.
    std::vector<std::string> log() const;
};

/// Checks a surface, or the boundary of a volume, in exact arithmetic.
///
/// @throws Error mesh when an index is out of range or a coordinate not finite.
SurfaceCheck check_surface(const Mesh& mesh);

/// What `repair` may do.
struct Repairs {
    bool orient = true;  ///< Turn faces so that they agree and look outward. Vertices and faces keep their numbers.
    bool weld = false;   ///< Make one of vertices at exactly the same place. Vertices are numbered anew.
};

/// What `repair` did.
struct Repaired {
    Mesh mesh;
    std::vector<std::uint32_t> turned;     ///< Faces turned.
    std::vector<std::uint32_t> vertex_of;  ///< For every vertex before the one that stands for it now.

    /// The same done to the other mesh of a pair with the same vertices and faces.
    /// @throws Error mismatch when it has others.
    Mesh apply(const Mesh& partner) const;
};

/// Repairs a surface of triangles or quadrilaterals as far as the user allows.
///
/// @throws Error unsupported for a volume; mesh when faces cannot be oriented: open, one-sided or not manifold.
Repaired repair(const Mesh& mesh, const Repairs& allowed = {});

namespace detail {

/// What `orient_polygon_soup` did.
struct Orientation {
    std::set<std::uint32_t> turned;  ///< Polygons.
    std::set<std::uint32_t> split;   ///< Points of the soup.
};

/// Hears of it; CGAL copies it.
struct OrientationVisitor : CGAL::Polygon_mesh_processing::Default_orientation_visitor {
    Orientation* done = nullptr;

    void polygon_orientation_reversed(std::size_t polygon) {
        const auto number = static_cast<std::uint32_t>(polygon);
        if (done->turned.erase(number) == 0) done->turned.insert(number);
    }
    void vertex_id_in_polygon_replaced(std::size_t, std::size_t old, std::size_t) {
        done->split.insert(static_cast<std::uint32_t>(old));
    }
};

/// Makes the polygons agree. What cannot be is split.
inline Orientation orient(Soup& soup) {
    Orientation done;
    OrientationVisitor visitor;
    visitor.done = &done;
    const auto original = static_cast<std::uint32_t>(soup.points.size());
    CGAL::Polygon_mesh_processing::orient_polygon_soup(soup.points, soup.polygons, CGAL::parameters::visitor(visitor));
    done.split.erase(done.split.lower_bound(original), done.split.end());
    return done;
}

inline void check_finite(const Soup& soup) {
    for (std::size_t v = 0; v < soup.points.size(); ++v) {
        const Point& p = soup.points[v];
        if (CGAL::is_finite(p.x()) && CGAL::is_finite(p.y()) && CGAL::is_finite(p.z())) continue;
        throw Error(ErrorKind::mesh, Place{Element::vertex, soup.vertex_of[v], 0},
                    "a coordinate is not a finite number", "export the mesh again");
    }
}

inline bool is_flat(const Soup& soup, const Polygon& triangle) {
    return CGAL::collinear(soup.points[triangle[0]], soup.points[triangle[1]], soup.points[triangle[2]]);
}

inline void find_intersections(const SurfaceMesh& mesh, const std::vector<SurfaceMesh::Face_index>& faces,
                               std::size_t per_face, SurfaceCheck& check) {
    using Pair = std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>;
    std::vector<Pair> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(faces, mesh, std::back_inserter(pairs));
    std::set<std::array<std::uint32_t, 2>> found;
    for (const auto& [a, b] : pairs) {
        const auto first = static_cast<std::uint32_t>(a / per_face), second = static_cast<std::uint32_t>(b / per_face);
        if (first != second) found.insert({std::min(first, second), std::max(first, second)});
    }
    check.intersections.assign(found.begin(), found.end());
}

inline void find_borders(const SurfaceMesh& mesh, std::size_t per_face, SurfaceCheck& check) {
    std::set<std::uint32_t> open;
    for (const auto h : mesh.halfedges()) {
        if (mesh.is_border(h)) open.insert(static_cast<std::uint32_t>(mesh.face(mesh.opposite(h)) / per_face));
    }
    check.open_faces.assign(open.begin(), open.end());
    check.closed = check.open_faces.empty() && check.non_manifold_vertices.empty();
}

/// The faces that have area; the others are noted.
inline std::vector<SurfaceMesh::Face_index> find_degenerate(const Soup& soup, const std::vector<Polygon>& triangles,
                                                            std::size_t per_face, SurfaceCheck& check) {
    std::vector<SurfaceMesh::Face_index> sound;
    std::set<std::uint32_t> flat;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (is_flat(soup, triangles[i])) {
            flat.insert(static_cast<std::uint32_t>(i / per_face));
        } else {
            sound.emplace_back(static_cast<SurfaceMesh::size_type>(i));
        }
    }
    check.degenerate.assign(flat.begin(), flat.end());
    return sound;
}

/// Merges vertices at one place; the first of them stays.
inline void weld(Repaired& repaired) {
    Mesh& mesh = repaired.mesh;
    std::map<std::array<double, 3>, std::uint32_t> seen;
    std::vector<double> points;
    for (std::size_t v = 0; v < mesh.point_count(); ++v) {
        const std::array<double, 3> at{mesh.points[3 * v], mesh.points[3 * v + 1], mesh.points[3 * v + 2]};
        const auto [found, fresh] = seen.emplace(at, static_cast<std::uint32_t>(points.size() / 3));
        if (fresh) points.insert(points.end(), at.begin(), at.end());
        repaired.vertex_of[v] = found->second;
    }
    mesh.points = std::move(points);
    for (std::uint32_t& v : mesh.cells) v = repaired.vertex_of[v];
}

/// Turns a face; its first vertex stays the first.
inline void turn(Mesh& mesh, std::uint32_t face) {
    const auto sides = static_cast<std::ptrdiff_t>(vertices_per_cell(mesh.kind));
    const auto first = mesh.cells.begin() + sides * static_cast<std::ptrdiff_t>(face);
    std::reverse(first + 1, first + sides);
}

inline std::vector<std::uint32_t> faces_to_turn(const Mesh& mesh) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    Soup soup = soup_of(mesh);
    check_finite(soup);
    const std::vector<Polygon> before = soup.polygons;
    if (!orient(soup).split.empty()) {
        throw Error(ErrorKind::mesh, "the surface is one-sided or not manifold, so it cannot be oriented",
                    "use check_surface to list where");
    }
    const std::size_t per_face = vertices_per_cell(mesh.kind) - 2;
    const std::vector<Polygon> triangles = triangles_of(soup.polygons);
    SurfaceMesh surface = mesh_of(soup);
    if (!CGAL::is_closed(surface)) {
        throw Error(ErrorKind::mesh, "the surface is open, so it has no outside", "close the holes");
    }
    pmp::orient_to_bound_a_volume(surface);
    std::vector<std::uint32_t> turned;
    for (std::size_t face = 0; face < before.size(); ++face) {
        // Whether a side of a triangle is one of the face as it was.
        const SurfaceMesh::Face_index f(static_cast<SurfaceMesh::size_type>(face * per_face));
        const Polygon& old = before[face];
        bool agrees = false;
        for (const auto h : CGAL::halfedges_around_face(surface.halfedge(f), surface)) {
            for (std::size_t i = 0; i < old.size(); ++i) {
                agrees = agrees ||
                         (surface.source(h).idx() == old[i] && surface.target(h).idx() == old[(i + 1) % old.size()]);
            }
        }
        if (!agrees) turned.push_back(static_cast<std::uint32_t>(face));
    }
    return turned;
}

}  // namespace detail

inline SurfaceCheck check_surface(const Mesh& mesh) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    detail::Soup soup = detail::soup_of(mesh);
    detail::check_finite(soup);
    SurfaceCheck check;
    if (soup.polygons.empty()) return check;
    const std::size_t per_face = soup.polygons[0].size() - 2;
    const detail::Orientation done = detail::orient(soup);
    check.turned.assign(done.turned.begin(), done.turned.end());
    for (const std::uint32_t v : done.split) check.non_manifold_vertices.push_back(soup.vertex_of[v]);
    const std::vector<detail::Polygon> triangles = detail::triangles_of(soup.polygons);
    const auto sound = detail::find_degenerate(soup, triangles, per_face, check);
    const detail::SurfaceMesh surface = detail::mesh_of(soup);
    detail::find_borders(surface, per_face, check);
    detail::find_intersections(surface, sound, per_face, check);
    if (check.closed && check.degenerate.empty()) {
        check.outward = pmp::is_outward_oriented(surface);
        check.bounds_volume = check.intersections.empty() && pmp::does_bound_a_volume(surface);
    }
    return check;
}

inline std::vector<std::string> SurfaceCheck::log() const {
    std::vector<std::string> lines;
    const auto add = [&lines](std::size_t count, const std::string& text) {
        if (count > 0) lines.push_back(std::to_string(count) + " " + text);
    };
    add(non_manifold_vertices.size(), "vertices where the surface is not manifold");
    add(open_faces.size(), "faces at holes");
    add(turned.size(), "faces oriented against their neighbours");
    add(degenerate.size(), "faces without area");
    add(intersections.size(), "pairs of faces that intersect");
    if (lines.empty() && !outward) lines.emplace_back("the surface looks inward");
    if (lines.empty() && !bounds_volume) lines.emplace_back("components are not nested as the boundary of a solid");
    return lines;
}

inline Mesh Repaired::apply(const Mesh& partner) const {
    if (partner.point_count() != vertex_of.size() || partner.cells.size() != mesh.cells.size() ||
        partner.kind != mesh.kind) {
        throw Error(ErrorKind::mismatch, "the partner has other vertices or faces", "give the other mesh of the pair");
    }
    Mesh result = partner;
    result.points.resize(mesh.points.size());
    // From the last on, so that the first of several vertices stays, as in the mesh itself.
    for (std::size_t v = vertex_of.size(); v-- > 0;) {
        std::copy_n(&partner.points[3 * v], 3, &result.points[3 * std::size_t{vertex_of[v]}]);
    }
    for (std::uint32_t& v : result.cells) v = vertex_of[v];
    for (const std::uint32_t face : turned) detail::turn(result, face);
    return result;
}

inline Repaired repair(const Mesh& mesh, const Repairs& allowed) {
    if (mesh.is_volume()) {
        throw Error(ErrorKind::unsupported, "only surfaces are repaired", "give the boundary() of the volume");
    }
    Repaired repaired{mesh, {}, {}};
    for (std::size_t v = 0; v < mesh.point_count(); ++v) repaired.vertex_of.push_back(static_cast<std::uint32_t>(v));
    if (allowed.weld) {
        detail::soup_of(mesh);  // Refuses indices that are out of range.
        detail::weld(repaired);
    }
    if (allowed.orient) repaired.turned = detail::faces_to_turn(repaired.mesh);
    for (const std::uint32_t face : repaired.turned) detail::turn(repaired.mesh, face);
    return repaired;
}

}  // namespace polycube::cgal
