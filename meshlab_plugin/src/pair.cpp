#include "pair.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <stdexcept>

#include "layers.h"

namespace {

/// How far the faces look along the axes: 1 if all do.
double axis_alignment(const CMeshO& mesh) {
    double sum = 0.0;
    for (const CFaceO* face : live_faces(mesh)) {
        const Point3m normal = vcg::NormalizedTriangleNormal(*face);
        sum += std::max({std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2])});
    }
    return mesh.fn > 0 ? sum / mesh.fn : 0.0;
}

/// Another layer that may be of one pair with `layer`; `layer` itself if there is none.
const MeshModel* twin_of(const MeshModel* layer, const MeshDocument& document) {
    for (const MeshModel* other : host::layers(document))
        if (other != layer && other->cm.fn == layer->cm.fn && other->cm.vn == layer->cm.vn) return other;
    return layer;
}

/// The custom attribute of a result with the ids of the layers that it was made of.
const char* const ORIGIN = "polycube_origin";
using Ids = std::pair<int, int>;

const MeshModel* layer_of(int id, const MeshDocument& document) {
    for (const MeshModel* layer : host::layers(document))
        if (layer->id() == id) return layer;
    return nullptr;
}

/// The polycube and the shape that a result was made of; null where one is gone, and for other layers.
std::pair<const MeshModel*, const MeshModel*> origin_of(const MeshModel& layer, const MeshDocument& document) {
    // Looking changes nothing, but MeshLab's function is not made for constant meshes.
    auto& mesh = const_cast<CMeshO&>(layer.cm);
    auto ids = vcg::tri::Allocator<CMeshO>::FindPerMeshAttribute<Ids>(mesh, ORIGIN);
    if (!vcg::tri::Allocator<CMeshO>::IsValidHandle(mesh, ids)) return {nullptr, nullptr};
    return {layer_of(ids().first, document), layer_of(ids().second, document)};
}

/// The polycube and the shape that the dialog proposes; null in an empty document.
std::pair<const MeshModel*, const MeshModel*> proposed_pair(const MeshDocument& document) {
    const MeshModel* current = document.mm();
    if (current == nullptr) return {nullptr, nullptr};
    const auto origin = origin_of(*current, document);
    if (origin.first != nullptr && origin.second != nullptr) return origin;
    const MeshModel* twin = twin_of(current, document);
    if (axis_alignment(twin->cm) > axis_alignment(current->cm)) return {twin, current};
    return {current, twin};
}

bool shall_lock(const RichParameterList& parameters) {
    return parameters.hasParameter("lock_selected_faces") && parameters.getBool("lock_selected_faces");
}

/// What to do in MeshLab about a rule that every closed surface follows; null for rules of polycubes.
const char* remedy_of(const std::string& rule) {
    static const std::map<std::string, const char*> remedies = {
        {"bad_face", "Apply Cleaning and Repairing: Remove Zero Area Faces, then Remeshing: Close Holes."},
        {"open_edge", "Apply Cleaning and Repairing: Merge Close Vertices, then Remeshing: Close Holes."},
        {"non_manifold_edge", "Apply Cleaning and Repairing: Remove Duplicate Faces, then Repair non Manifold Edges."},
        {"inconsistent_orientation", "Apply Normals: Re-Orient all faces coherently."},
        {"non_manifold_vertex", "Apply Cleaning and Repairing: Repair non Manifold Vertices by splitting."},
    };
    const auto found = remedies.find(rule);
    return found == remedies.end() ? nullptr : found->second;
}

/// Refuses what is no closed surface.
void check_surface(const std::vector<polycube::Violation>& violations) {
    if (violations.empty()) return;
    const polycube::Violation& first = violations.front();
    const char* remedy = remedy_of(first.rule);
    if (remedy == nullptr) return;
    const std::size_t others = violations.size() - 1;
    throw std::invalid_argument(to_string(first.place) + ": " + first.message +
                                (others > 0 ? "; " + std::to_string(others) + " more like it. " : ". ") + remedy);
}

}  // namespace

const char* const MADE_OF_ALONE =
    "If there is none, choose the same layer in both places: unless that is a polycube, one is made of it.";

void add_pair(const MeshDocument& document, RichParameterList& parameters, const QString& alone) {
    const auto [polycube, shape] = proposed_pair(document);
    parameters.addParam(host::layer_parameter(
        "polycube", polycube, document, "Polycube",
        "The layer with the polycube: a closed mesh whose faces look along the axes. It need not be exact: faces may "
        "be off by 30 degrees."));
    parameters.addParam(host::layer_parameter(
        "shape", shape, document, "Shape",
        "The layer with the shape that the polycube was deformed from; it has the same vertices and faces. " + alone));
}

const MeshModel* proposed_shape(const MeshDocument& document) { return proposed_pair(document).second; }

void remember_origin(const PairLayers& layers, MeshModel& result) {
    vcg::tri::Allocator<CMeshO>::GetPerMeshAttribute<Ids>(result.cm, ORIGIN)() = {layers.polycube.id(),
                                                                                 layers.target().id()};
}

void add_lock(RichParameterList& parameters) {
    parameters.addParam(RichBool("lock_selected_faces", false, "Lock selected faces",
                                 "The plane sides of the polycube that hold a selected face stay where they are, up to "
                                 "rounding to the lattice. Faces may be selected on either layer."));
}

PairLayers chosen_pair(const Call& call) {
    MeshModel* polycube = host::chosen_layer(call.parameters, "polycube", call.document);
    MeshModel* shape = host::chosen_layer(call.parameters, "shape", call.document);
    for (const MeshModel* layer : {polycube, shape}) {
        if (layer == nullptr) throw std::invalid_argument("A chosen layer does not exist. Choose another one.");
        if (layer->cm.fn == 0)
            throw std::invalid_argument("The layer \"" + layer->label().toStdString() +
                                        "\" has no faces. Choose a layer with a closed mesh.");
    }
    return {*polycube, shape == polycube ? nullptr : shape};
}

PlainPair read_pair(const Call& call, const PairLayers& layers) {
    const CMeshO& first = layers.polycube.cm;
    if (layers.shape == nullptr) {
        Plain polycube = read(first);
        std::vector<std::uint32_t> locked;
        if (shall_lock(call.parameters)) locked = selected_cells(first, polycube);
        return {{std::move(polycube.mesh), {}, {}, std::move(locked)}, std::move(polycube.cell_of_face), {}};
    }
    const CMeshO& second = layers.shape->cm;
    Plain polycube = read(first), shape = read(second);
    if (polycube.mesh.kind != shape.mesh.kind) {
        polycube = read_triangles(first);
        shape = read_triangles(second);
    }
    std::vector<std::uint32_t> locked;
    if (shall_lock(call.parameters)) {
        const std::vector<std::uint32_t> here = selected_cells(first, polycube), there = selected_cells(second, shape);
        std::set_union(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(locked));
    }
    return {{std::move(polycube.mesh), std::move(shape.mesh), {}, std::move(locked)},
            std::move(polycube.cell_of_face),
            std::move(shape.cell_of_face)};
}

Meshed remesh(const Call& call, const PairLayers& layers, const polycube::filter::Settings& settings) {
    polycube::filter::Pair pair = read_pair(call, layers).pair;
    try {
        return {polycube::filter::remesh(pair, settings, call.context), int(pair.locked_faces.size())};
    } catch (const polycube::Error& error) {
        const bool none = error.kind() == polycube::ErrorKind::mesh || error.kind() == polycube::ErrorKind::polycube;
        if (layers.shape != nullptr || !none) throw;
    }
    if (!pair.locked_faces.empty())
        call.log("warning: no face is locked, as the polycube is yet to be made of the layer");
    polycube::filter::Pair alone;
    alone.shape = pair.polycube;
    try {
        return {polycube::filter::remesh(alone, settings, call.context), 0};
    } catch (const polycube::Error& error) {
        if (error.kind() == polycube::ErrorKind::mesh)
            check_surface(polycube::filter::inspect(pair, settings, call.context).checked.violations);
        throw;
    }
}

void add_counts(const polycube::Report& report, host::Values& values) {
    const auto add = [&values](const std::string& when, const polycube::Counts& counts) {
        values["surface_patches_" + when] = int(counts.surface_patches);
        values["blocks_" + when] = int(counts.blocks);
        values["blocks_padded_" + when] = int(counts.blocks_padded);
    };
    add("before", report.before);
    if (report.after) add("after", *report.after);
    values["max_displacement"] = report.max_displacement;
    values["scale"] = report.scale;
}

std::vector<vcg::Color4b> colours_of(const std::vector<std::uint32_t>& numbers) {
    std::vector<vcg::Color4b> colours;
    for (std::uint32_t number : numbers) colours.push_back(colour_of_number(number));
    return colours;
}
