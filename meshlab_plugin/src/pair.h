/// @file
/// The parameters that most filters share: which layer is the polycube, which one the shape, and what stays in place.
#pragma once

#include <polycube/filter.hpp>

#include "filter.h"

/// The layers that a filter works on.
struct PairLayers {
    MeshModel& polycube;
    /// Null if the polycube stands alone.
    MeshModel* shape;

    /// What a mesh made from them lies on: the shape, or the polycube where there is none.
    MeshModel& target() const { return shape != nullptr ? *shape : polycube; }
};

/// Adds the parameters `polycube` and `shape`; `alone` says what a layer alone is taken for. By default these are those
/// that the current layer was made of, where it is a result; else the current layer and another one with as many
/// vertices and faces, the polycube being the one that looks along the axes.
void add_pair(const MeshDocument& document, RichParameterList& parameters,
              const QString& alone = "If there is none, choose the polycube here, too.");

/// What filters that mesh take a layer alone for.
extern const char* const MADE_OF_ALONE;

/// The shape that `add_pair` proposes; null in an empty document.
const MeshModel* proposed_shape(const MeshDocument& document);

/// Lets a result know the layers that it was made of, so that the next filter finds them.
void remember_origin(const PairLayers& layers, MeshModel& result);

/// Adds the parameter `lock_selected_faces`.
void add_lock(RichParameterList& parameters);

/// The chosen layers. @throws std::invalid_argument if one has no faces.
PairLayers chosen_pair(const Call& call);

/// The chosen layers as the core takes them.
struct PlainPair {
    /// Holds the selected faces of both layers if they shall be locked.
    polycube::filter::Pair pair;
    /// See `Plain`; that of the shape is empty without one.
    std::vector<std::uint32_t> polycube_cell_of_face;
    std::vector<std::uint32_t> shape_cell_of_face;
};

/// Reads the chosen layers: as quadrilaterals where both are such.
PlainPair read_pair(const Call& call, const PairLayers& layers);

/// What came of meshing.
struct Meshed {
    polycube::filter::RemeshedPair pair;
    /// How many faces were locked.
    int locked;
};

/// Meshes the chosen layers. A layer alone that is no polycube is a shape, of which one is made.
/// @throws std::invalid_argument where none can be made, with what to do in MeshLab.
Meshed remesh(const Call& call, const PairLayers& layers, const polycube::filter::Settings& settings);

/// Counts before and after for PyMeshLab.
void add_counts(const polycube::Report& report, host::Values& values);

/// Numbers as scalars of faces.
template <class Number>
std::vector<double> as_scalars(const std::vector<Number>& numbers) {
    return std::vector<double>(numbers.begin(), numbers.end());
}

/// One colour for each number.
std::vector<vcg::Color4b> colours_of(const std::vector<std::uint32_t>& numbers);
