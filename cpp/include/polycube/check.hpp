/// @file
/// What is wrong with a polycube, and the structure of one that is right.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <polycube/simplify.hpp>
#include <string>
#include <vector>

namespace polycube {

/// One reason why a mesh is not a polycube.
struct Violation {
    std::string rule;       ///< A short name of the rule broken, such as "open_edge"; those of `polycube validate`.
    bool in_shape = false;  ///< Whether the shape is concerned, not the polycube.
    std::string message;    ///< What is wrong.
    std::string remedy;     ///< How to mend it.
    Place place;            ///< The element.
    std::optional<std::array<double, 3>> at;  ///< The middle of the element, in units of the mesh.
    std::vector<std::uint32_t> faces;  ///< The boundary faces concerned, to select and show; empty for inner elements.
};

/// The coordinate that a connected set of facets shares: one unknown of the alignment.
struct Level {
    std::uint32_t axis = 0;   ///< 0, 1 or 2.
    double coordinate = 0.0;  ///< Where it lies, in units of the mesh.
};

/// A plane region of the polycube's surface: the boundary faces of one label that hang together, straightened.
struct Facet {
    std::int8_t label = 0;    ///< 0 to 5 for +X -X +Y -Y +Z -Z.
    std::uint32_t level = 0;  ///< Its level.
    std::uint32_t loops = 0;  ///< Its boundary loops: 1, and one for each hole.
};

/// A vertex where three or more facets meet.
struct Corner {
    std::uint32_t vertex = 0;               ///< The mesh vertex.
    std::uint32_t valence = 0;              ///< How many edges meet here: 3 to 6.
    std::array<std::uint32_t, 3> levels{};  ///< Its level along X, Y and Z.
};

/// The common border of two facets between two corners.
struct Edge {
    std::uint32_t axis = 0;                  ///< The direction it runs in.
    std::array<std::uint32_t, 2> corners{};  ///< The corner with the lower and the one with the higher coordinate.
    std::array<std::uint32_t, 2>
        facets{};  ///< The facet on its left and on its right, seen from outside when walking up the axis.
    std::vector<std::uint32_t> vertices;  ///< The mesh vertices along it, from the lower corner on.
};

/// The structure of a valid polycube, and what of it each boundary face belongs to.
struct Structure {
    std::vector<Level> levels;
    std::vector<Facet> facets;
    std::vector<Corner> corners;
    std::vector<Edge> edges;
    Counts counts;                    ///< How coarse it is as it comes.
    std::uint32_t components = 0;     ///< Connected components of the surface.
    std::uint32_t genus = 0;          ///< Handles, over all components.
    double deviation_degrees = 0.0;   ///< How far faces are off their axes.
    double deviation_distance = 0.0;  ///< How far vertices are off their facets, in units of the mesh.
    /// Per boundary face: its label, facet, the surface patch that its middle lies in, and the block below that; for
    /// colouring.
    std::vector<std::int8_t> label_of_face;
    std::vector<std::uint32_t> facet_of_face;
    std::vector<std::uint32_t> patch_of_face;
    std::vector<std::uint32_t> block_of_face;
};

/// What a check found.
struct Checked {
    /// Every violation of the first rule that does not hold, then all elements that are turned over, as `polycube
    /// validate` lists them; empty for a valid polycube and a shape that goes with it.
    std::vector<Violation> violations;
    /// Nothing when there are violations.
    std::optional<Structure> structure;

    bool valid() const noexcept { return violations.empty(); }
};

/// Checks whether a mesh is a valid polycube and reads its structure. A broken mesh is a result, not an exception.
///
/// @code
/// const polycube::Checked checked = polycube::check({cube, shape});
/// for (const polycube::Violation& violation : checked.violations) {
///     std::clog << to_string(violation.place) << ": " << violation.message << " (" << violation.remedy << ")\n";
/// }
/// if (checked.valid()) std::clog << checked.structure->counts.blocks << " blocks\n";
/// @endcode
///
/// @throws Error mesh for buffers that are no mesh (an index out of range); cancelled.
Checked check(const Input& input, const Tolerance& tolerance = {}, const Context& context = {});

}  // namespace polycube
