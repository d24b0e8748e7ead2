#include <algorithm>
#include <cmath>

#include "helpers.hpp"

using polycube::CellKind;
using polycube::ErrorKind;
using polycube::Input;
using polycube::Remeshed;

namespace {

std::size_t number_of(const std::vector<std::uint32_t>& ids) {
    return ids.empty() ? 0 : *std::max_element(ids.begin(), ids.end()) + 1;
}

}  // namespace

TEST_CASE("a pair becomes layout, quadrilaterals and hexahedra") {
    const Remeshed result = polycube::remesh({pair().first, pair().second}, coarse());
    REQUIRE(result.hexes);
    const polycube::HexMesh& hexes = *result.hexes;
    CHECK(hexes.mesh.kind == CellKind::hexahedra);
    CHECK(hexes.mesh.cell_count() == result.report.hexes);
    CHECK(hexes.block_id.size() == result.report.hexes);
    CHECK(hexes.label.size() == result.report.hexes);
    REQUIRE(hexes.scaled_jacobian.size() == result.report.hexes);
    CHECK(*std::min_element(hexes.scaled_jacobian.begin(), hexes.scaled_jacobian.end()) ==
          *result.report.min_scaled_jacobian);
    REQUIRE(hexes.edge_ratio.size() == result.report.hexes);
    CHECK(*std::max_element(hexes.edge_ratio.begin(), hexes.edge_ratio.end()) == *result.report.max_edge_ratio);
    CHECK(*std::min_element(hexes.determinant.begin(), hexes.determinant.end()) == *result.report.min_determinant);
    CHECK(*std::max_element(hexes.non_orthogonality.begin(), hexes.non_orthogonality.end()) ==
          *result.report.max_non_orthogonality);
    CHECK(*std::max_element(hexes.skewness.begin(), hexes.skewness.end()) == *result.report.max_skewness);
    CHECK(hexes.fields().size() == 7);
    CHECK(number_of(hexes.block_id) == result.layout.blocks.cell_count());
    CHECK(result.layout.blocks.cell_count() == result.simplified.report().after->blocks_padded);
    CHECK(result.layout.patches.cell_count() == result.simplified.report().after->surface_patches);
    CHECK(result.layout.patch_label.size() == result.layout.patches.cell_count());
    CHECK(!result.layout.singular.empty());
    CHECK(result.quads.mesh.cell_count() == result.report.quads);
    CHECK(number_of(result.quads.patch_id) == result.layout.patches.cell_count());
    // The surface of the volume is the quadrilateral mesh.
    CHECK(polycube::boundary(hexes.mesh).cell_count() == result.report.quads);
    CHECK(result.report.hausdorff > 0.0);
    CHECK(result.report_json.find("\"min_sj\"") != std::string::npos);
}

TEST_CASE("the surface alone") {
    polycube::RemeshOptions options = coarse();
    options.surface_only = true;
    const Remeshed result = polycube::remesh({pair().first, pair().second}, options);
    CHECK(!result.hexes);
    CHECK(result.report.hexes == 0);
    CHECK(!result.report.min_scaled_jacobian);
    CHECK(polycube::check(Input(polycube::boundary(result.quads.mesh))).violations.size() != 1);
}

TEST_CASE("sizes") {
    polycube::RemeshOptions options;
    options.padding = 2;
    options.size = polycube::Size{polycube::Size::Kind::scale, 2.0};
    // A cube of 2 x 2 x 2 lattice steps and two layers on its 24 squares.
    CHECK(polycube::remesh(Input(box()), options).report.hexes == 8 + 2 * 24);
    options.size = polycube::Size{polycube::Size::Kind::edge_length, 0.25};
    CHECK(polycube::remesh(Input(box()), options).report.hexes == 64 + 2 * 96);
    for (const double bad : {0.0, -1.0, 1e20, std::nan("")}) {
        options.size = polycube::Size{polycube::Size::Kind::hexes, bad};
        CHECK(error_of([&] { polycube::remesh(Input(box()), options); }).kind() == ErrorKind::option);
    }
    options.size.reset();
    options.padding = 17;
    CHECK(error_of([&] { polycube::remesh(Input(box()), options); }).kind() == ErrorKind::option);
    options.padding = 1;
    options.max_hausdorff = 0.0;
    CHECK(error_of([&] { polycube::remesh(Input(box()), options); }).kind() == ErrorKind::option);
}
