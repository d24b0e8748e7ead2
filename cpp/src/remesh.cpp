#include <polycube/remesh.hpp>

#include "bridge.hpp"

namespace polycube {
namespace {

template <class T>
CellField integers(const char* name, const std::vector<T>& values) {
    return {name, std::vector<std::int32_t>(values.begin(), values.end())};
}

bridge::RemeshOptionsData options(const RemeshOptions& options) {
    bridge::RemeshOptionsData data;
    data.simplify = internal::options(options.simplify);
    const Size size = options.size.value_or(Size{});
    data.has_size = options.size.has_value();
    data.size_kind = static_cast<std::uint8_t>(size.kind);
    data.size = size.value;
    data.padding = options.padding;
    data.surface_only = options.surface_only;
    data.max_hausdorff = options.max_hausdorff;
    return data;
}

Layout layout(const bridge::LayoutData& data) {
    Layout layout{internal::mesh(data.blocks), internal::mesh(data.patches), internal::vector(data.patch_label), {}};
    for (const auto& edge : data.singular) layout.singular.push_back({internal::vector(edge.points), edge.valence});
    return layout;
}

QuadMesh quads(const bridge::QuadsData& data) {
    return {internal::mesh(data.mesh), internal::vector(data.label), internal::vector(data.patch_id),
            internal::vector(data.block_id), internal::vector(data.uv)};
}

HexMesh hexes(const bridge::HexesData& data) {
    std::vector<BoundaryFace> boundary;
    for (const auto& side : data.boundary) boundary.push_back({side.cell, side.face, side.label, side.facet});
    return {internal::mesh(data.mesh), internal::vector(data.block_id), internal::vector(data.label),
            std::move(boundary), internal::vector(data.scaled_jacobian), internal::vector(data.edge_ratio),
            internal::vector(data.determinant), internal::vector(data.non_orthogonality),
            internal::vector(data.skewness)};
}

RemeshReport report(const bridge::RemeshReportData& data) {
    RemeshReport report;
    report.quads = data.quads;
    report.hexes = data.hexes;
    report.hex_blocks = data.hex_blocks;
    report.inverted = data.inverted;
    report.released = data.released;
    report.min_scaled_jacobian = internal::real(data.min_sj);
    report.mean_scaled_jacobian = internal::real(data.avg_sj);
    report.max_edge_ratio = internal::real(data.max_edge_ratio);
    report.min_determinant = internal::real(data.min_determinant);
    report.max_non_orthogonality = internal::real(data.max_non_orthogonality);
    report.max_skewness = internal::real(data.max_skewness);
    report.hausdorff = data.hausdorff;
    report.hausdorff_percent = data.hausdorff_percent;
    report.within_hausdorff = data.within_hausdorff;
    report.good = data.good;
    report.seconds = data.seconds;
    report.faults = internal::strings(data.faults);
    return report;
}

Remeshed remeshed(bridge::RemeshedData result) {
    Remeshed remeshed{internal::simplified(std::move(result.simplified)),
                      layout(result.layout),
                      quads(result.quads),
                      {},
                      report(result.report),
                      std::string(result.report_json),
                      {}};
    if (result.has_hexes) remeshed.hexes = hexes(result.hexes);
    return remeshed;
}

}  // namespace

std::vector<CellField> QuadMesh::fields() const {
    return {integers("label", label), integers("patch_id", patch_id), integers("block_id", block_id)};
}

std::vector<CellField> HexMesh::fields() const {
    return {integers("block_id", block_id),
            integers("label", label),
            {"scaled_jacobian", scaled_jacobian},
            {"edge_ratio", edge_ratio},
            {"determinant", determinant},
            {"non_orthogonality", non_orthogonality},
            {"skewness", skewness}};
}

void write_solver(const std::string& path, const HexMesh& hexes, const std::string& groups) {
    std::vector<bridge::BoundaryFaceData> boundary;
    for (const BoundaryFace& side : hexes.boundary) {
        boundary.push_back({side.hexahedron, side.face, side.label, side.facet});
    }
    internal::call([&] {
        bridge::write_solver(internal::text(path), internal::view(hexes.mesh), internal::slice(hexes.block_id),
                             internal::slice(boundary), internal::text(groups));
    });
}

void write_textured(const std::string& path, const QuadMesh& quads) {
    internal::call([&] {
        bridge::write_textured(internal::text(path), internal::view(quads.mesh), internal::slice(quads.uv));
    });
}

std::vector<CellField> Layout::block_fields() const {
    std::vector<std::int32_t> ids(blocks.cell_count());
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int32_t>(i);
    return {{"block_id", std::move(ids)}};
}

Remeshed remesh(const Input& input, const RemeshOptions& settings, const Context& context) {
    const bridge::RemeshOptionsData data = options(settings);
    const auto work = [&](const auto& listener) { return bridge::remesh(internal::view(input), data, listener); };
    return remeshed(internal::call(context, work));
}

Remeshed remesh(const Mesh& shape, const RemeshOptions& settings, const Context& context) {
    const bridge::MakeOptionsData making = internal::options(settings.make);
    const bridge::RemeshOptionsData data = options(settings);
    const auto work = [&](const auto& listener) {
        return bridge::remesh_shape(internal::view(shape), making, data, listener);
    };
    bridge::RemeshedShapeData result = internal::call(context, work);
    Remeshed meshes = remeshed(std::move(result.remeshed));
    meshes.made = internal::made(result.made);
    return meshes;
}

}  // namespace polycube
