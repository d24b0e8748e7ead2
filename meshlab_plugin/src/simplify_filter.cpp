#include <array>

#include "layers.h"
#include "options.h"
#include "pair.h"

namespace {

/// Polycube: Simplify.
class SimplifyFilter final : public Filter {
 public:
    QString name() const override { return "Polycube: Simplify"; }
    QString python_name() const override { return "generate_polycube_simplified"; }
    QString help() const override {
        return "Moves the plane sides of a polycube until its corners align, so that it falls into as few blocks as "
               "can be found. The result is a new layer with the vertices and faces of the polycube, coloured by "
               "patch, its corners on an integer lattice. It is a polycube again: closed, with the same topology, "
               "touching itself nowhere, and never with more blocks than before. With the shape, the log tells how "
               "the map between the two is distorted. Faces selected on either layer can be locked.";
    }
    int changes() const override { return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE; }
    void add_parameters(const MeshDocument& document, RichParameterList& parameters) const override;
    host::Values apply(const Call& call) const override;
};

void SimplifyFilter::add_parameters(const MeshDocument& document, RichParameterList& parameters) const {
    add_pair(document, parameters);
    parameters.addParam(
        RichEnum("strategy", 0, {"Best", "Paper", "Rounding"}, "Strategy",
                 "Best searches for the fewest; Paper aligns corners round by round as published; "
                 "Rounding moves every side to the nearest lattice plane, which may break the polycube."));
    parameters.addParam(RichEnum("objective", 0, {"Surface patches", "Blocks", "Blocks with padding"}, "Make few",
                                 "What Best makes few: quadrilateral patches of the surface, blocks of the solid, or "
                                 "blocks once a layer of hexahedra lies around the solid."));
    add_choice(parameters);
    const double diagonal = document.mm() != nullptr ? document.mm()->cm.bbox.Diag() : 1.0;
    parameters.addParam(host::Percentage("lattice_step", 0, 0, diagonal, "Lattice step (0 is automatic)",
                                         "The length of a lattice step. Automatic: 1 if all sides of the polycube lie "
                                         "on whole numbers, else the mean length of its edges."));
    add_lock(parameters);
    parameters.addParam(RichBool("lattice_units", false, "Result in lattice units",
                                 "Give the result in steps of the lattice, with whole numbers for its sides, instead "
                                 "of in the units and at the place of the polycube."));
    add_tolerance(parameters);
}

polycube::filter::Settings settings_of(const RichParameterList& parameters) {
    using polycube::Objective;
    using polycube::Strategy;
    constexpr std::array<Strategy, 3> strategies = {Strategy::best, Strategy::paper, Strategy::naive};
    constexpr std::array<Objective, 3> objectives = {Objective::surface_patches, Objective::blocks,
                                                     Objective::blocks_padded};
    polycube::filter::Settings settings;
    polycube::Options& options = settings.options.simplify;
    options.strategy = strategies.at(std::size_t(parameters.getEnum("strategy")));
    options.objective = objectives.at(std::size_t(parameters.getEnum("objective")));
    set_choice(parameters, options);
    options.tolerance = chosen_tolerance(parameters);
    if (const double step = parameters.getAbsPerc("lattice_step"); step != 0.0) options.scale = 1.0 / step;
    settings.in_input_units = !parameters.getBool("lattice_units");
    return settings;
}

host::Values SimplifyFilter::apply(const Call& call) const {
    const PairLayers layers = chosen_pair(call);
    const polycube::filter::Pair pair = read_pair(call, layers).pair;
    const polycube::filter::SimplifiedPair result =
        polycube::filter::simplify(pair, settings_of(call.parameters), call.context);

    NewLayers added(call.document);
    MeshModel& layer = added.add(result.polycube, layers.polycube.label() + " simplified", &layers.polycube);
    if (result.polycube.kind == polycube::CellKind::triangles) copy_faux_edges(layers.polycube.cm, layer.cm);
    paint(cells_of_written(result.polycube), colours_of(result.patch_of_face),
          {{"patch_id", as_scalars(result.patch_of_face)},
           {"block_id", as_scalars(result.block_of_face)},
           {"label", as_scalars(result.label_of_face)}},
          layer);
    remember_origin(layers, layer);
    added.keep();
    call.document.setVisible(layers.polycube.id(), false);
    if (layers.shape != nullptr) call.document.setVisible(layers.shape->id(), false);
    call.log_all(result.log);

    host::Values values;
    add_counts(result.simplified.report(), values);
    values["locked_faces"] = int(pair.locked_faces.size());
    values["flipped_faces"] = int(result.simplified.report().flipped_faces.size());
    return values;
}

}  // namespace

std::unique_ptr<Filter> make_simplify_filter() { return std::make_unique<SimplifyFilter>(); }
