#include <polycube/example.hpp>
#include <stdexcept>

#include "filter.h"
#include "layers.h"

namespace {

/// Polycube: Example.
class ExampleFilter final : public Filter {
 public:
    QString name() const override { return "Polycube: Example"; }
    QString python_name() const override { return "create_polycube_example"; }
    QString help() const override {
        return "Makes a polycube and the shape it was deformed from, as two layers, to try the other filters on: apply "
               "<b>Polycube: Simplify</b> or <b>Polycube: Quad Remesh</b> to it. The polycube is shown, the shape is "
               "hidden.";
    }
    /// While there is no layer, MeshLab opens this submenu only, and nothing in it that is in another one, too.
    host::FilterPlugin::FilterClass submenu() const override { return host::FilterPlugin::MeshCreation; }
    host::Arity arity() const override { return host::FilterPlugin::NONE; }
    int changes() const override { return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE; }
    void add_parameters(const MeshDocument& document, RichParameterList& parameters) const override;
    host::Values apply(const Call& call) const override;
};

void ExampleFilter::add_parameters(const MeshDocument&, RichParameterList& parameters) const {
    QStringList names;
    for (const std::string& name : polycube::example_names()) names << QString::fromStdString(name);
    parameters.addParam(RichEnum("example", 0, names, "Example", "Which one to make."));
    parameters.addParam(
        RichInt("seed", 1, "Seed", "How its parts are shifted against each other; 0 leaves them aligned."));
}

host::Values ExampleFilter::apply(const Call& call) const {
    const int seed = call.parameters.getInt("seed");
    if (seed < 0) throw std::invalid_argument("The seed must be 0 or more.");
    const std::string name = polycube::example_names().at(std::size_t(call.parameters.getEnum("example")));
    const auto [polycube, shape] = polycube::example(name, std::uint64_t(seed));
    const QString label = QString::fromStdString(name);
    NewLayers added(call.document);
    MeshModel& hidden = added.add(shape, label + " shape", nullptr);
    added.add(polycube, label + " polycube", nullptr);
    call.document.setVisible(hidden.id(), false);
    added.keep();
    call.log("A polycube and its shape (hidden), " + std::to_string(polycube.cell_count()) +
             " faces each. Now apply Polycube: Simplify or Polycube: Quad Remesh.");
    return {{"faces", int(polycube.cell_count())}};
}

}  // namespace

std::unique_ptr<Filter> make_example_filter() { return std::make_unique<ExampleFilter>(); }
