#include <algorithm>
#include <cmath>

#include "helpers.hpp"

using polycube::ErrorKind;
using polycube::filter::Pair;
using polycube::filter::Settings;

namespace {

Settings settings() {
    Settings settings;
    settings.options = coarse();
    return settings;
}

Pair document() { return {pair().first, pair().second, {}, {}}; }

}  // namespace

TEST_CASE("a pair is inspected") {
    const auto good = polycube::filter::inspect(document());
    CHECK(good.checked.valid());
    CHECK(good.bad_faces.empty());
    CHECK(good.log[0] == "this is a valid polycube");
    Pair broken = document();
    broken.shape = {};
    broken.polycube.cells.resize(broken.polycube.cells.size() - 3);
    const auto bad = polycube::filter::inspect(broken);
    CHECK(!bad.checked.valid());
    CHECK(bad.bad_faces.size() >= 1);
    CHECK(bad.log.size() == bad.checked.violations.size() + 1);
}

TEST_CASE("a pair is simplified, in place") {
    const auto result = polycube::filter::simplify(document(), settings());
    const std::size_t faces = pair().first.cell_count();
    CHECK(result.polycube.cells == pair().first.cells);
    CHECK(result.label_of_face.size() == faces);
    CHECK(result.patch_of_face.size() == faces);
    CHECK(result.block_of_face.size() == faces);
    CHECK(result.log.size() >= 3);
    // Vertices stay where they were, but for the displacement of corners and what the morph does between them.
    double farthest = 0.0;
    for (std::size_t i = 0; i < result.polycube.points.size(); ++i) {
        farthest = std::max(farthest, std::abs(result.polycube.points[i] - pair().first.points[i]));
    }
    CHECK(farthest <= 2.0 * result.simplified.report().max_displacement);
    Settings lattice = settings();
    lattice.in_input_units = false;
    lattice.options.simplify.scale = 2.0;
    CHECK(polycube::filter::simplify(document(), lattice).polycube.points != result.polycube.points);
}

TEST_CASE("a pair is meshed, without a shape, too") {
    const auto meshed = polycube::filter::remesh(document(), settings());
    CHECK(meshed.result.hexes);
    CHECK(meshed.log.size() >= 5);
    Settings surface = settings();
    surface.options.surface_only = true;
    CHECK(!polycube::filter::remesh({pair().first, {}, {}, {}}, surface).result.hexes);
}

TEST_CASE("the filter tells what is wrong") {
    Pair pair = document();
    pair.labels = {1, 2, 3};
    CHECK(error_of([&] { polycube::filter::simplify(pair); }).kind() == ErrorKind::mismatch);
    const polycube::Context context;
    context.cancel();
    CHECK(error_of([&] { polycube::filter::remesh(document(), {}, context); }).kind() == ErrorKind::cancelled);
    Settings naive;
    naive.options.simplify.strategy = polycube::Strategy::naive;
    naive.options.simplify.scale = 0.05;
    pair = {polycube::example("double-torus").first, {}, {}, {}};
    CHECK(error_of([&] { polycube::filter::simplify(pair, naive); }).kind() == ErrorKind::polycube);
}
