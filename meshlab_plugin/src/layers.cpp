#include "layers.h"

#include <vcg/complex/allocate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;
constexpr std::uint32_t kUnused = UINT32_MAX;

/// The number of every vertex in the plain mesh, and `kUnused` for those that do not get into it.
std::vector<std::uint32_t> number_vertices(const CMeshO& mesh) {
    std::vector<std::uint32_t> number(mesh.vert.size(), kUnused);
    for (const CFaceO* face : live_faces(mesh))
        for (int i = 0; i < 3; ++i) number[vcg::tri::Index(mesh, face->cV(i))] = 0;
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] != kUnused) number[v] = next++;
    return number;
}

template <class Face, class Mesh>
std::vector<Face*> list_live_faces(Mesh& mesh) {
    std::vector<Face*> faces;
    faces.reserve(mesh.fn);
    for (auto& face : mesh.face)
        if (!face.IsD()) faces.push_back(&face);
    return faces;
}

void add_vertices(const std::vector<double>& points, CMeshO& mesh) {
    auto vertex = Allocator::AddVertices(mesh, points.size() / 3);
    for (std::size_t i = 0; i < points.size(); i += 3, ++vertex)
        vertex->P() = Point3m(Scalarm(points[i]), Scalarm(points[i + 1]), Scalarm(points[i + 2]));
}

void set_vertices(CFaceO& face, CMeshO& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    face.V(0) = &mesh.vert[a];
    face.V(1) = &mesh.vert[b];
    face.V(2) = &mesh.vert[c];
}

void add_triangles(const std::vector<std::uint32_t>& cells, CMeshO& mesh) {
    auto face = Allocator::AddFaces(mesh, cells.size() / 3);
    for (std::size_t i = 0; i < cells.size(); i += 3, ++face)
        set_vertices(*face, mesh, cells[i], cells[i + 1], cells[i + 2]);
}

void add_quads(const std::vector<std::uint32_t>& cells, CMeshO& mesh) {
    auto face = Allocator::AddFaces(mesh, cells.size() / 2);
    for (std::size_t i = 0; i < cells.size(); i += 4) {
        set_vertices(*face, mesh, cells[i], cells[i + 1], cells[i + 2]);
        face->SetF(2);
        ++face;
        set_vertices(*face, mesh, cells[i], cells[i + 2], cells[i + 3]);
        face->SetF(0);
        ++face;
    }
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The faux edge of each triangle as the number of its first vertex, 0 to 2; nothing unless all have exactly one.
std::optional<std::vector<int>> faux_edges(const std::vector<const CFaceO*>& faces) {
    std::vector<int> found;
    for (const CFaceO* face : faces) {
        if (face->IsF(0) + face->IsF(1) + face->IsF(2) != 1) return std::nullopt;
        found.push_back(face->IsF(0) ? 0 : face->IsF(1) ? 1 : 2);
    }
    return found;
}

/// The other triangle at the faux edge of each; nothing unless they pair up.
std::optional<std::vector<std::uint32_t>> other_halves(const std::vector<std::uint32_t>& triangles,
                                                       const std::vector<int>& faux) {
    std::map<Edge, std::uint32_t> by_edge;
    const auto corner = [&](std::size_t f, int i) { return triangles[3 * f + std::size_t(i % 3)]; };
    for (std::uint32_t f = 0; f < faux.size(); ++f)
        if (!by_edge.emplace(Edge(corner(f, faux[f]), corner(f, faux[f] + 1)), f).second) return std::nullopt;
    std::vector<std::uint32_t> other;
    for (std::uint32_t f = 0; f < faux.size(); ++f) {
        const auto found = by_edge.find(Edge(corner(f, faux[f] + 1), corner(f, faux[f])));
        if (found == by_edge.end()) return std::nullopt;
        other.push_back(found->second);
    }
    return other;
}

/// Joins the triangles to quadrilaterals if faux edges pair all of them. The lowest vertex comes first, whichever way
/// the quadrilateral was split.
void merge_quads(const std::vector<const CFaceO*>& faces, Plain& plain) {
    const auto faux = faux_edges(faces);
    if (!faux) return;
    const std::vector<std::uint32_t> triangles = plain.mesh.cells;
    const auto other = other_halves(triangles, *faux);
    if (!other) return;
    const auto corner = [&](std::size_t f, int i) { return triangles[3 * f + std::size_t(i % 3)]; };
    plain.mesh.kind = polycube::CellKind::quads;
    plain.mesh.cells.clear();
    std::uint32_t next = 0;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        const std::uint32_t g = (*other)[f];
        if (g < f) continue;
        const int i = (*faux)[f];
        std::array<std::uint32_t, 4> quad = {corner(f, i), corner(g, (*faux)[g] + 2), corner(f, i + 1),
                                             corner(f, i + 2)};
        std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
        plain.mesh.cells.insert(plain.mesh.cells.end(), quad.begin(), quad.end());
        plain.cell_of_face[f] = plain.cell_of_face[g] = next++;
    }
}

}  // namespace

std::vector<const CFaceO*> live_faces(const CMeshO& mesh) { return list_live_faces<const CFaceO>(mesh); }
std::vector<CFaceO*> live_faces(CMeshO& mesh) { return list_live_faces<CFaceO>(mesh); }

Plain read_triangles(const CMeshO& mesh) {
    const std::vector<std::uint32_t> number = number_vertices(mesh);
    Plain plain;
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] != kUnused)
            for (int k = 0; k < 3; ++k) plain.mesh.points.push_back(mesh.vert[v].cP()[k]);
    for (const CFaceO* face : live_faces(mesh)) {
        plain.cell_of_face.push_back(std::uint32_t(plain.cell_of_face.size()));
        for (int i = 0; i < 3; ++i) plain.mesh.cells.push_back(number[vcg::tri::Index(mesh, face->cV(i))]);
    }
    return plain;
}

Plain read(const CMeshO& mesh) {
    Plain plain = read_triangles(mesh);
    merge_quads(live_faces(mesh), plain);
    return plain;
}

std::vector<std::uint32_t> selected_cells(const CMeshO& mesh, const Plain& plain) {
    std::set<std::uint32_t> selected;
    const std::vector<const CFaceO*> faces = live_faces(mesh);
    for (std::size_t f = 0; f < faces.size(); ++f)
        if (faces[f]->IsS()) selected.insert(plain.cell_of_face[f]);
    return {selected.begin(), selected.end()};
}

void write(const polycube::Mesh& mesh, MeshModel& layer) {
    add_vertices(mesh.points, layer.cm);
    if (mesh.kind == polycube::CellKind::quads) {
        add_quads(mesh.cells, layer.cm);
        layer.updateDataMask(MeshModel::MM_POLYGONAL);
        layer.cm.pvn = int(mesh.point_count());
        layer.cm.pfn = int(mesh.cell_count());
    } else {
        add_triangles(mesh.cells, layer.cm);
    }
    host::update_box_and_normals(layer);
}

std::vector<std::uint32_t> cells_of_written(const polycube::Mesh& mesh) {
    const std::size_t triangles_per_cell = mesh.kind == polycube::CellKind::quads ? 2 : 1;
    std::vector<std::uint32_t> cells(mesh.cell_count() * triangles_per_cell);
    for (std::size_t f = 0; f < cells.size(); ++f) cells[f] = std::uint32_t(f / triangles_per_cell);
    return cells;
}

void paint(const std::vector<std::uint32_t>& cell_of_face, const std::vector<vcg::Color4b>& colours,
           const std::vector<Scalars>& scalars, MeshModel& layer) {
    layer.updateDataMask(MeshModel::MM_FACECOLOR | MeshModel::MM_FACEQUALITY);
    const std::vector<CFaceO*> faces = live_faces(layer.cm);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        faces[f]->C() = colours[cell_of_face[f]];
        faces[f]->Q() = Scalarm(scalars.front().values[cell_of_face[f]]);
    }
    for (const Scalars& scalar : scalars) {
        auto attribute = Allocator::GetPerFaceAttribute<Scalarm>(layer.cm, scalar.name);
        for (std::size_t f = 0; f < faces.size(); ++f) attribute[faces[f]] = Scalarm(scalar.values[cell_of_face[f]]);
    }
}

void copy_faux_edges(const CMeshO& from, CMeshO& to) {
    const std::vector<const CFaceO*> sources = live_faces(from);
    const std::vector<CFaceO*> faces = live_faces(to);
    for (std::size_t f = 0; f < sources.size(); ++f)
        for (int i = 0; i < 3; ++i)
            if (sources[f]->IsF(i)) faces.at(f)->SetF(i);
}

vcg::Color4b colour_of_label(int label) {
    static const vcg::Color4b colours[6] = {{214, 48, 39, 255},   {158, 30, 26, 255},  {250, 250, 250, 255},
                                            {196, 196, 196, 255}, {54, 100, 214, 255}, {32, 62, 150, 255}};
    return label >= 0 && label < 6 ? colours[label] : vcg::Color4b(vcg::Color4b::Gray);
}

vcg::Color4b colour_of_number(std::uint32_t number) {
    // Steps of the golden section round the circle of hues never come near each other soon.
    const double turns = number * 0.6180339887498949;
    vcg::Color4b colour;
    colour.SetHSVColor(float(turns - std::floor(turns)), number % 2 == 0 ? 0.45f : 0.65f,
                       number % 3 == 0 ? 0.8f : 0.95f);
    return colour;
}

double mean_edge(const CMeshO& mesh) {
    double sum = 0.0;
    std::size_t count = 0;
    for (const CFaceO* face : live_faces(mesh)) {
        for (int i = 0; i < 3; ++i) {
            if (face->IsF(i)) continue;
            sum += vcg::Distance(face->cP0(i), face->cP1(i));
            ++count;
        }
    }
    return count > 0 ? sum / double(count) : 0.0;
}

NewLayers::~NewLayers() {
    for (MeshModel* layer : added_) host::remove_layer(document_, layer);
    if (!added_.empty() && current_ != nullptr) document_.setCurrentMesh(current_->id());
}

MeshModel& NewLayers::add(const polycube::Mesh& mesh, const QString& label, const MeshModel* origin) {
    added_.reserve(added_.size() + 1);
    MeshModel* layer = document_.addNewMesh(QString(), label, true);
    added_.push_back(layer);
    write(mesh, *layer);
    if (origin != nullptr) layer->cm.Tr = origin->cm.Tr;
    return *layer;
}

void NewLayers::keep() { added_.clear(); }
