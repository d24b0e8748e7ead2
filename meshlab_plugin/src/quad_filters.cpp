#include <numeric>
#include <polycube/quality.hpp>

#include "layers.h"
#include "options.h"
#include "pair.h"

namespace {

/// What both filters take by quality.
const char* const UNFOLDED = "patches that do not fold the surface";

/// The parameter that chooses what MeshLab shows as the scalar of the faces.
void add_scalar_choice(RichParameterList& parameters) {
    parameters.addParam(RichEnum("face_scalar", 0, {"Patch id", "Scaled Jacobian"}, "Scalar of the faces",
                                 "What each face keeps as its scalar. Both are kept as the custom attributes patch_id "
                                 "and scaled_jacobian, too."));
}

/// Adds a layer with quadrilaterals that are coloured by patch.
void add_quad_layer(const Call& call, const PairLayers& layers, const polycube::Mesh& quads,
                    const std::vector<std::uint32_t>& patch_id, const QString& suffix) {
    std::vector<Scalars> scalars = {{"patch_id", as_scalars(patch_id)},
                                    {"scaled_jacobian", polycube::scaled_jacobians(quads)}};
    if (call.parameters.getEnum("face_scalar") == 1) std::swap(scalars[0], scalars[1]);
    MeshModel& target = layers.target();
    NewLayers added(call.document);
    MeshModel& layer = added.add(quads, target.label() + suffix, &target);
    paint(cells_of_written(quads), colours_of(patch_id), scalars, layer);
    remember_origin(layers, layer);
    added.keep();
    call.document.setVisible(layers.polycube.id(), false);
    call.document.setVisible(target.id(), false);
}

/// The surface alone, as the parameters that both filters have say.
polycube::filter::Settings settings_of(const RichParameterList& parameters) {
    polycube::filter::Settings settings;
    settings.options.surface_only = true;
    set_choice_by_quality(parameters, settings.options.simplify);
    settings.options.simplify.tolerance = chosen_tolerance(parameters);
    return settings;
}

host::Values values_of(const Meshed& meshed) {
    const polycube::Remeshed& result = meshed.pair.result;
    host::Values values;
    add_counts(result.simplified.report(), values);
    values["locked_faces"] = meshed.locked;
    values["quads"] = int(result.report.quads);
    values["hausdorff"] = result.report.hausdorff;
    return values;
}

/// Polycube: Coarse Quad Layout.
class LayoutFilter final : public Filter {
 public:
    QString name() const override { return "Polycube: Coarse Quad Layout"; }
    QString python_name() const override { return "generate_polycube_coarse_quad_layout"; }
    QString help() const override {
        return "Simplifies the polycube of a shape and gives the coarse layout of the shape's surface: a new layer "
               "with "
               "one quadrilateral for each patch, its corners on the shape, each patch with a colour of its own. Use "
               "<b>Polycube: Quad Remesh</b> for a mesh that follows the shape.";
    }
    int changes() const override { return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE; }
    void add_parameters(const MeshDocument& document, RichParameterList& parameters) const override {
        add_pair(document, parameters, MADE_OF_ALONE);
        add_choice_by_quality(parameters, UNFOLDED);
        add_lock(parameters);
        add_scalar_choice(parameters);
        add_tolerance(parameters);
    }
    host::Values apply(const Call& call) const override;
};

host::Values LayoutFilter::apply(const Call& call) const {
    const PairLayers layers = chosen_pair(call);
    const polycube::filter::Settings settings = settings_of(call.parameters);
    const Meshed meshed = remesh(call, layers, settings);
    const polycube::Remeshed& result = meshed.pair.result;
    const polycube::Mesh& patches = result.layout.patches;
    std::vector<std::uint32_t> patch_id(patches.cell_count());
    std::iota(patch_id.begin(), patch_id.end(), 0);
    add_quad_layer(call, layers, patches, patch_id, " layout");
    call.log_all(meshed.pair.log);
    host::Values values = values_of(meshed);
    values["patches"] = int(patches.cell_count());
    return values;
}

/// Polycube: Quad Remesh.
class QuadFilter final : public Filter {
 public:
    QString name() const override { return "Polycube: Quad Remesh"; }
    QString python_name() const override { return "generate_polycube_quad_remesh"; }
    QString help() const override {
        return "Simplifies the polycube of a shape, which is made where there is none, and meshes the shape's surface "
               "with quadrilaterals along the coarse layout. The result is a new layer, coloured by patch; it keeps "
               "the quadrilaterals the way MeshLab does, as pairs of triangles with a faux edge, and writes them to "
               "formats that can hold them. The log tells the counts, the distance from the shape, and what was not "
               "possible.";
    }
    int changes() const override { return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE; }
    void add_parameters(const MeshDocument& document, RichParameterList& parameters) const override;
    host::Values apply(const Call& call) const override;
};

void QuadFilter::add_parameters(const MeshDocument& document, RichParameterList& parameters) const {
    add_pair(document, parameters, MADE_OF_ALONE);
    const MeshModel* shape = proposed_shape(document);
    const double length = shape != nullptr ? mean_edge(shape->cm) : 1.0;
    const double diagonal = shape != nullptr ? shape->cm.bbox.Diag() : 1.0;
    parameters.addParam(host::Percentage("edge_length", length, 0, diagonal, "Edge length",
                                         "The mean length of the quadrilaterals' edges; by default that of the "
                                         "shape."));
    add_choice_by_quality(parameters, UNFOLDED);
    add_lock(parameters);
    add_scalar_choice(parameters);
    add_tolerance(parameters);
}

host::Values QuadFilter::apply(const Call& call) const {
    const PairLayers layers = chosen_pair(call);
    polycube::filter::Settings settings = settings_of(call.parameters);
    settings.options.size =
        polycube::Size{polycube::Size::Kind::edge_length, call.parameters.getAbsPerc("edge_length")};
    const Meshed meshed = remesh(call, layers, settings);
    const polycube::QuadMesh& quads = meshed.pair.result.quads;
    add_quad_layer(call, layers, quads.mesh, quads.patch_id, " quads");
    call.log_all(meshed.pair.log);
    return values_of(meshed);
}

}  // namespace

std::unique_ptr<Filter> make_layout_filter() { return std::make_unique<LayoutFilter>(); }
std::unique_ptr<Filter> make_quad_filter() { return std::make_unique<QuadFilter>(); }
