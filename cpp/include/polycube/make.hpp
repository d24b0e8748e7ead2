/// @file
/// From a plain shape to its polycube.
#pragma once

#include <cstdint>
#include <optional>
#include <polycube/simplify.hpp>
#include <string>
#include <vector>

namespace polycube {

/// Which directions of a shape become the axes of its polycube.
enum class Axes : std::uint8_t {
    keep,  ///< Those of the coordinates.
    best,  ///< Those that the surface looks along best, for a shape that lies askew.
};

/// How a polycube is made.
struct MakeOptions {
    /// How closely the polycube follows the shape, from 0, as few corners as can be, to 1.
    double detail = 0.5;
    /// Take corners away until no more than these are left, as far as the shape allows, whatever `detail` says.
    std::optional<std::uint64_t> corners;
    /// Which directions of the shape become the axes of the polycube.
    Axes axes = Axes::keep;
    /// One label for each face of the shape, 0 to 5 for +X -X +Y -Y +Z -Z, as programs that label shapes leave them.
    /// Their charts become the facets as they are; `detail`, `corners` and `axes` then have no effect.
    std::optional<std::vector<std::int8_t>> labels;
    /// Take the shape as it is. Else what has one right answer is repaired and told in `MakeReport::repairs`: faces and
    /// labels that look inward, vertices at one place, faces that are double or inside.
    bool no_repair = false;
};

/// What was made and how good it is. `Made::report_json` has all of it and more.
struct MakeReport {
    std::vector<std::string> repairs;  ///< What of the shape was repaired first, as sentences; mostly nothing.
    std::uint64_t corners = 0;  ///< Corners of the polycube.
    std::uint64_t edges = 0;    ///< Its edges.
    std::uint64_t facets = 0;   ///< Its facets.
    std::uint64_t genus = 0;    ///< Handles, over all parts.
    std::uint64_t added = 0;    ///< Vertices that were added to the shape to make room for the map.
    /// Mean over the surface of one minus the cosine between its normal and the direction of its facet; 0 to 2.
    double misfit = 0.0;
    /// The share of the surface, 0 to 1, that is squeezed to under a quarter of its size.
    double squashed = 0.0;
    std::optional<Distortion> distortion;  ///< Of the map from the shape to the polycube; nothing where it is folded.
    std::vector<std::uint32_t> folded;     ///< Triangles whose map is turned over; mostly none.
    double seconds = 0.0;                  ///< Time spent.
};

/// A polycube and its shape, with the same triangles.
struct Made {
    /// The polycube on the integer lattice.
    Mesh polycube;
    /// The shape as triangles, cut finer where the map needs room; the vertices of the input come first and keep their
    /// numbers.
    Mesh shape;
    /// The label of every triangle, 0 to 5 for +X -X +Y -Y +Z -Z.
    std::vector<std::int8_t> labels;
    MakeReport report;        ///< How good it is.
    std::string report_json;  ///< All of it as JSON: what the command writes to report.json, without its options.

    /// What `simplify()` and `remesh()` take; this must outlive it.
    Input input() const& noexcept {
        Input input(polycube, shape);
        input.labels = &labels;
        return input;
    }
    Input input() && = delete;
};

/// Makes a polycube of a closed surface of triangles or quadrilaterals, of any genus and any number of parts.
///
/// It is valid and does not touch itself. Where its map is folded in places it is given all the same, and
/// `MakeReport::folded` lists them. Some seconds for 20,000 triangles. Self-intersections of the shape do not matter.
///
/// @code
/// const polycube::Made made = polycube::make(shape);
/// std::clog << made.report.corners << " corners\n";
/// polycube::simplify(made.input());
/// polycube::write_mesh("polycube.obj", made.polycube);
/// @endcode
///
/// @throws Error mesh (open, not manifold, not oriented, or inward, with the element), unsupported (a volume),
/// polycube (no structure was found, the labels are not those of a polycube, or its parts cannot be kept apart),
/// mismatch (labels that do not fit the faces), option (detail out of range), cancelled.
Made make(const Mesh& shape, const MakeOptions& options = {}, const Context& context = {});

}  // namespace polycube
