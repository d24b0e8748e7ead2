#include <algorithm>
#include <stdexcept>

#include "layers.h"
#include "options.h"
#include "pair.h"

namespace {

/// What both filters do: read the structure of the polycube and paint polycube and shape with it.
class ColourFilter : public Filter {
 public:
    int changes() const override { return MeshModel::MM_FACECOLOR | MeshModel::MM_FACEQUALITY; }
    void add_parameters(const MeshDocument& document, RichParameterList& parameters) const override {
        add_pair(document, parameters);
        add_tolerance(parameters);
    }
    host::Values apply(const Call& call) const override;

 private:
    /// The name of the scalar, a colour and a scalar for each face.
    virtual std::pair<std::vector<vcg::Color4b>, Scalars> paint_of(const polycube::Structure& structure) const = 0;
};

host::Values ColourFilter::apply(const Call& call) const {
    const PairLayers layers = chosen_pair(call);
    const PlainPair plain = read_pair(call, layers);
    polycube::filter::Settings settings;
    settings.options.simplify.tolerance = chosen_tolerance(call.parameters);
    const polycube::filter::Inspection found = polycube::filter::inspect(plain.pair, settings, call.context);
    if (!found.checked.structure)
        throw std::invalid_argument(found.checked.violations.front().message +
                                    ". Run Polycube: Check to see where and what to do.");
    const auto [colours, scalars] = paint_of(*found.checked.structure);
    paint(plain.polycube_cell_of_face, colours, {scalars}, layers.polycube);
    if (layers.shape != nullptr) paint(plain.shape_cell_of_face, colours, {scalars}, *layers.shape);
    const int most = int(*std::max_element(scalars.values.begin(), scalars.values.end()));
    call.log_all(found.log);
    return {{scalars.name + "_max", most}};
}

/// Polycube: Colour by Label.
class LabelFilter final : public ColourFilter {
 public:
    QString name() const override { return "Polycube: Colour by Label"; }
    QString python_name() const override { return "set_polycube_color_by_label_per_face"; }
    QString help() const override {
        return "Colours the faces of a polycube, and those of its shape, by the direction they look along on the "
               "polycube: X red, Y white, Z blue, the negative directions darker. Their scalar is the label, 0 to 5 "
               "for "
               "+X -X +Y -Y +Z -Z.";
    }

 private:
    std::pair<std::vector<vcg::Color4b>, Scalars> paint_of(const polycube::Structure& structure) const override {
        std::vector<vcg::Color4b> colours;
        for (std::int8_t label : structure.label_of_face) colours.push_back(colour_of_label(label));
        return {colours, {"label", as_scalars(structure.label_of_face)}};
    }
};

/// Polycube: Colour by Block.
class BlockFilter final : public ColourFilter {
 public:
    QString name() const override { return "Polycube: Colour by Block"; }
    QString python_name() const override { return "set_polycube_color_by_block_per_face"; }
    QString help() const override {
        return "Colours the faces of a polycube, and those of its shape, by the block of the solid that lies below the "
               "middle of the face. Their scalar is the number of the block.";
    }

 private:
    std::pair<std::vector<vcg::Color4b>, Scalars> paint_of(const polycube::Structure& structure) const override {
        return {colours_of(structure.block_of_face), {"block_id", as_scalars(structure.block_of_face)}};
    }
};

}  // namespace

std::unique_ptr<Filter> make_label_filter() { return std::make_unique<LabelFilter>(); }
std::unique_ptr<Filter> make_block_filter() { return std::make_unique<BlockFilter>(); }
