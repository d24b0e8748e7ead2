#include <QDir>
#include <QFileInfo>
#include <QStringList>
#include <algorithm>
#include <stdexcept>

#include "layers.h"
#include "options.h"
#include "pair.h"

namespace {

/// Polycube: Hex Remesh to File.
class HexFilter final : public Filter {
 public:
    QString name() const override { return "Polycube: Hex Remesh to File"; }
    QString python_name() const override { return "generate_polycube_hex_remesh"; }
    QString help() const override {
        return "Simplifies the polycube of a shape, which is made where there is none, and meshes the solid with "
               "hexahedra along the coarse block structure. "
               "MeshLab holds no volumes, so they go to a file, where one is named: .vtu or .vtk for ParaView, with "
               "scaled Jacobian, block and label of each cell, .mesh (MEDIT), or with blocks and boundary by name .msh "
               "(Gmsh), .inp (Abaqus, CalculiX) or .su2, or as grids of blocks .json or .xyz (Plot3D). Their boundary "
               "is shown as a new layer, coloured by block. "
               "The log tells the counts, the least scaled Jacobian, and what was not possible. Ten thousand hexahedra "
               "take some seconds to a minute, and MeshLab cannot stop a filter on its way.";
    }
    int changes() const override { return MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE; }
    void add_parameters(const MeshDocument& document, RichParameterList& parameters) const override;
    host::Values apply(const Call& call) const override;
};

/// The extensions of files with blocks and boundary by name, and of those of the block structure.
const QStringList SOLVERS = {"msh", "inp", "su2", "json", "xyz"};
/// All that hexahedra are written to.
const QStringList EXTENSIONS = QStringList{"vtu", "vtk", "mesh"} + SOLVERS;

/// About half as many hexahedra as the shape has faces, within what takes seconds.
int proposed_count(const MeshDocument& document) {
    const MeshModel* shape = proposed_shape(document);
    return shape == nullptr ? 5000 : std::min(std::max(shape->cm.fn / 2, 1000), 10000);
}

void HexFilter::add_parameters(const MeshDocument& document, RichParameterList& parameters) const {
    const QString kinds = "Hexahedral mesh (*." + EXTENSIONS.join(" *.") + ")";
    parameters.addParam(host::FileSave("file", "", kinds, "Write the hexahedra to",
                                       "A file whose name ends in ." + EXTENSIONS.join(", .") +
                                           ". Without a name they are shown, and none is written."));
    add_pair(document, parameters, MADE_OF_ALONE);
    parameters.addParam(RichInt("hexes", proposed_count(document), "Number of hexahedra",
                                "About how many there shall be, padding included."));
    parameters.addParam(RichInt("padding", 1, "Padding",
                                "How many layers of hexahedra lie between the blocks and the surface, 0 to 16. Without "
                                "any, hexahedra on polycube edges are flat where the shape is smooth."));
    add_choice_by_quality(parameters, "blocks whose hexahedra are good, as quick coarse meshes show");
    add_lock(parameters);
    add_tolerance(parameters);
}

/// The file to write, empty if none is named. @throws std::invalid_argument if it cannot be one, before any work.
std::string checked_file(const QString& name) {
    if (name.isEmpty()) return {};
    const QFileInfo file(name);
    const QString suffix = file.suffix().toLower();
    if (!EXTENSIONS.contains(suffix))
        throw std::invalid_argument("\"" + name.toStdString() + "\" is no file for hexahedra. Choose a name that "
                                    "ends in ." + EXTENSIONS.join(", .").toStdString() + ".");
    if (!file.absoluteDir().exists())
        throw std::invalid_argument("The folder of \"" + name.toStdString() + "\" does not exist. Choose another one.");
    return file.absoluteFilePath().toStdString();
}

polycube::filter::Settings settings_of(const RichParameterList& parameters) {
    const int hexes = parameters.getInt("hexes");
    const int padding = parameters.getInt("padding");
    if (hexes < 1) throw std::invalid_argument("The number of hexahedra must be 1 or more.");
    if (padding < 0) throw std::invalid_argument("The padding must be 0 to 16.");
    polycube::filter::Settings settings;
    settings.options.size = polycube::Size{polycube::Size::Kind::hexes, double(hexes)};
    settings.options.padding = std::uint32_t(padding);
    set_choice_by_quality(parameters, settings.options.simplify);
    settings.options.simplify.tolerance = chosen_tolerance(parameters);
    return settings;
}

/// Writes the bytes that the command writes: MEDIT files without fields.
void write(const std::string& file, const polycube::HexMesh& hexes) {
    const QString suffix = QFileInfo(QString::fromStdString(file)).suffix().toLower();
    if (SOLVERS.contains(suffix)) return polycube::write_solver(file, hexes);
    const bool medit = suffix == "mesh";
    polycube::write_mesh(file, hexes.mesh, medit ? std::vector<polycube::CellField>() : hexes.fields());
}

host::Values HexFilter::apply(const Call& call) const {
    const std::string file = checked_file(call.parameters.getSaveFileName("file"));
    const polycube::filter::Settings settings = settings_of(call.parameters);
    const PairLayers layers = chosen_pair(call);
    const Meshed meshed = remesh(call, layers, settings);
    const polycube::Remeshed& result = meshed.pair.result;

    MeshModel& target = layers.target();
    NewLayers added(call.document);
    MeshModel& layer = added.add(result.quads.mesh, target.label() + " hexes", &target);
    paint(cells_of_written(result.quads.mesh), colours_of(result.quads.block_id),
          {{"block_id", as_scalars(result.quads.block_id)}}, layer);
    if (!file.empty()) write(file, *result.hexes);
    remember_origin(layers, layer);
    added.keep();
    call.document.setVisible(layers.polycube.id(), false);
    call.document.setVisible(target.id(), false);
    call.log_all(meshed.pair.log);
    call.log(file.empty() ? "no file is named, so the hexahedra are shown only" : "written to " + file);

    host::Values values;
    add_counts(result.simplified.report(), values);
    values["locked_faces"] = meshed.locked;
    values["hexes"] = int(result.report.hexes);
    values["inverted"] = int(result.report.inverted);
    values["min_scaled_jacobian"] = result.report.min_scaled_jacobian.value_or(0.0);
    values["mean_scaled_jacobian"] = result.report.mean_scaled_jacobian.value_or(0.0);
    values["max_edge_ratio"] = result.report.max_edge_ratio.value_or(0.0);
    values["min_determinant"] = result.report.min_determinant.value_or(0.0);
    values["max_non_orthogonality"] = result.report.max_non_orthogonality.value_or(0.0);
    values["max_skewness"] = result.report.max_skewness.value_or(0.0);
    values["hausdorff"] = result.report.hausdorff;
    values["good"] = result.report.good;
    return values;
}

}  // namespace

std::unique_ptr<Filter> make_hex_filter() { return std::make_unique<HexFilter>(); }
