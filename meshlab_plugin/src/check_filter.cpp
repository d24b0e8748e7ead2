#include <algorithm>
#include <stdexcept>

#include "layers.h"
#include "options.h"
#include "pair.h"

namespace {

/// Polycube: Check.
class CheckFilter final : public Filter {
 public:
    QString name() const override { return "Polycube: Check"; }
    QString python_name() const override { return "compute_polycube_check"; }
    QString help() const override {
        return "Tells whether the current layer is a polycube: closed, with faces that look along the axes, with "
               "corners "
               "and edges like those of boxes, touching itself nowhere. If it is not, the faces that stop it are "
               "selected, and the log says why and what to do. If it is, the log tells its sides, corners and counts.";
    }
    host::Arity arity() const override { return host::FilterPlugin::SINGLE_MESH; }
    int changes() const override { return MeshModel::MM_FACEFLAGSELECT; }
    void add_parameters(const MeshDocument&, RichParameterList& parameters) const override {
        add_tolerance(parameters);
    }
    host::Values apply(const Call& call) const override;
};

/// Selects the faces of these cells, which are in order, and no others; gives back how many.
int select_cells(const std::vector<std::uint32_t>& cells, const Plain& plain, CMeshO& mesh) {
    const std::vector<CFaceO*> faces = live_faces(mesh);
    int count = 0;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const bool chosen = std::binary_search(cells.begin(), cells.end(), plain.cell_of_face[f]);
        chosen ? faces[f]->SetS() : faces[f]->ClearS();
        count += chosen;
    }
    return count;
}

/// The lines, with the end left out where there are too many to read.
std::vector<std::string> shortened(std::vector<std::string> lines) {
    constexpr std::size_t kMost = 25;
    if (lines.size() <= kMost) return lines;
    const std::size_t more = lines.size() - kMost;
    lines.resize(kMost);
    lines.push_back("and " + std::to_string(more) + " more like these");
    return lines;
}

host::Values CheckFilter::apply(const Call& call) const {
    MeshModel* layer = call.document.mm();
    if (layer == nullptr || layer->cm.fn == 0)
        throw std::invalid_argument("The current layer has no faces. Choose a layer with a closed mesh.");
    const Plain plain = read(layer->cm);
    polycube::filter::Pair pair;
    pair.polycube = plain.mesh;
    polycube::filter::Settings settings;
    settings.options.simplify.tolerance = chosen_tolerance(call.parameters);
    const polycube::filter::Inspection found = polycube::filter::inspect(pair, settings, call.context);
    const std::vector<std::string> lines = shortened(found.log);

    host::Values values;
    values["selected_faces"] = select_cells(found.bad_faces, plain, layer->cm);
    call.log_all(lines);
    values["valid"] = found.checked.valid();
    values["violations"] = int(found.checked.violations.size());
    if (const auto& structure = found.checked.structure) {
        values["facets"] = int(structure->facets.size());
        values["corners"] = int(structure->corners.size());
        values["genus"] = int(structure->genus);
        values["surface_patches"] = int(structure->counts.surface_patches);
        values["blocks"] = int(structure->counts.blocks);
        values["blocks_padded"] = int(structure->counts.blocks_padded);
    }
    return values;
}

}  // namespace

std::unique_ptr<Filter> make_check_filter() { return std::make_unique<CheckFilter>(); }
