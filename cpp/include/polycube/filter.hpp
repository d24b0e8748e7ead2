/// @file
/// What a plugin of a mesh editor calls: pairs of surface meshes in, layers and lines for the log out. Free of any
/// host's types.
///
/// Every function throws `polycube::Error` and nothing else but what the progress callback throws, and leaves its input
/// as it was.
#pragma once

#include <cstdint>
#include <optional>
#include <polycube/check.hpp>
#include <polycube/context.hpp>
#include <polycube/remesh.hpp>
#include <polycube/simplify.hpp>
#include <string>
#include <vector>

namespace polycube::filter {

/// Layers of a document.
struct Pair {
    /// The polycube: triangles or quadrilaterals; for `remesh` an empty mesh to have one made of the shape.
    Mesh polycube;
    /// The shape, with the same vertices and faces; an empty mesh if there is none.
    Mesh shape;
    /// One label per face, or empty for "by the normals".
    std::vector<std::int8_t> labels;
    /// The faces that the user selected: their facets must not move.
    std::vector<std::uint32_t> locked_faces;
};

/// What the dialog asks for. Everything that is not in here is in `Options` and `RemeshOptions`.
struct Settings {
    /// Options for both filters; `guides.fixed_faces` gets `Pair::locked_faces` on top.
    RemeshOptions options;
    /// Give the simplified polycube in units and place of the input, so that the layers lie on each other; otherwise in
    /// lattice units.
    bool in_input_units = true;
};

/// The polycube as it came, ready to be shown.
struct Inspection {
    Checked checked;
    /// What was found, line by line, for the log.
    std::vector<std::string> log;
    /// Faces to select: those with violations.
    std::vector<std::uint32_t> bad_faces;
};

/// A simplified polycube, ready to be shown.
struct SimplifiedPair {
    /// Its faces are those of the input. Per face: label, patch and block below it, for colours and attributes.
    Mesh polycube;
    std::vector<std::int8_t> label_of_face;
    std::vector<std::uint32_t> patch_of_face;
    std::vector<std::uint32_t> block_of_face;
    /// For `Simplified::at`, and everything else.
    Simplified simplified;
    /// What was done, line by line, for the log.
    std::vector<std::string> log;
};

/// A meshed shape, ready to be shown.
struct RemeshedPair {
    Remeshed result;
    /// What was done, line by line, for the log; warnings begin with "warning: ".
    std::vector<std::string> log;
};

/// Lists violations or describes the structure.
/// @throws Error mesh, mismatch, cancelled.
Inspection inspect(const Pair& pair, const Settings& settings = {}, const Context& context = {});

/// Simplifies the polycube.
/// @throws Error as `polycube::simplify`; polycube when the strategy is naive and broke it.
SimplifiedPair simplify(const Pair& pair, const Settings& settings = {}, const Context& context = {});

/// Another point of the front that `simplify` found, without a search: from 1, the fewest blocks, to 0, the least
/// displacement.
/// @throws Error as `Simplified::at`.
SimplifiedPair slide(const Pair& pair, const SimplifiedPair& from, double simplicity, const Settings& settings = {},
                     const Context& context = {});

/// Simplifies and meshes the shape: coarse layout, quadrilaterals and, unless left out, hexahedra. Where there is no
/// polycube, one is made.
/// @throws Error as `polycube::remesh`.
RemeshedPair remesh(const Pair& pair, const Settings& settings = {}, const Context& context = {});

}  // namespace polycube::filter
