#include <algorithm>
#include <cmath>
#include <functional>

#include "bridge.hpp"
#include "helpers.hpp"

using polycube::CellKind;
using polycube::ErrorKind;
using polycube::Made;
using polycube::Mesh;
using polycube::Remeshed;

namespace {

// The surface of a torus, which has no face along an axis to begin with.
Mesh torus(std::uint32_t around = 18, std::uint32_t across = 8) {
    Mesh mesh;
    mesh.kind = CellKind::quads;
    const double turn = 2.0 * std::acos(-1.0);
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const double a = turn * i / around, b = turn * j / across, r = 3.0 + std::cos(b);
            mesh.points.insert(mesh.points.end(), {r * std::cos(a), r * std::sin(a), std::sin(b)});
            const std::uint32_t i2 = (i + 1) % around, j2 = (j + 1) % across;
            mesh.cells.insert(mesh.cells.end(),
                              {i * across + j, i2 * across + j, i2 * across + j2, i * across + j2});
        }
    }
    return mesh;
}

// A torus without one of its faces.
Mesh open_torus() {
    Mesh mesh = torus();
    mesh.cells.resize(mesh.cells.size() - 4);
    return mesh;
}

const Made& made() {
    static const Made made = polycube::make(torus());
    return made;
}

polycube::RemeshOptions fine(double edge) {
    polycube::RemeshOptions options;
    options.simplify = quick();
    options.size = polycube::Size{polycube::Size::Kind::edge_length, edge};
    return options;
}

}  // namespace

TEST_CASE("the defaults of making are those of the core") {
    const polycube::bridge::MakeOptionsData core = polycube::bridge::default_make_options();
    const polycube::MakeOptions own;
    CHECK(core.detail == own.detail);
    CHECK(core.has_corners == own.corners.has_value());
    CHECK(core.best_axes == (own.axes == polycube::Axes::best));
    CHECK(core.has_labels == own.labels.has_value());
    CHECK(core.no_repair == own.no_repair);
}

TEST_CASE("a shape that looks inward is turned, and that is told, unless it is to be taken as it is") {
    Mesh inward = torus();
    for (auto quad = inward.cells.begin(); quad != inward.cells.end(); quad += 4) std::reverse(quad, quad + 4);
    const Made turned = polycube::make(inward);
    REQUIRE(turned.report.repairs.size() == 1);
    CHECK(turned.report.repairs[0].find("turned to look outward") != std::string::npos);
    CHECK(turned.report.corners == made().report.corners);
    CHECK(made().report.repairs.empty());
    polycube::MakeOptions strict;
    strict.no_repair = true;
    CHECK_THROWS_WITH_AS(polycube::make(inward, strict), doctest::Contains("looks inward"), polycube::Error);
}

TEST_CASE("a polycube is made of a torus") {
    CHECK(polycube::check(made().input()).valid());
    CHECK(made().polycube.cells == made().shape.cells);
    CHECK(made().labels.size() == made().polycube.cell_count());
    CHECK(made().report.genus == 1);
    CHECK(made().report.corners == 16);
    CHECK(made().report.folded.empty());
    CHECK(made().report.distortion->angle >= 1.0);
    // The vertices of the input come first.
    const Mesh input = torus();
    CHECK(std::equal(input.points.begin(), input.points.end(), made().shape.points.begin()));
    CHECK(made().shape.point_count() == input.point_count() + made().report.added);
    const std::vector<double>& levels = made().polycube.points;
    const double highest = *std::max_element(levels.begin(), levels.end());
    CHECK(highest == std::round(highest));
    CHECK(made().report_json.find("\"misfit\"") != std::string::npos);
}

TEST_CASE("how closely a polycube follows its shape") {
    polycube::MakeOptions options;
    options.detail = 0.25;
    options.corners = 12;
    const polycube::bridge::MakeOptionsData data = polycube::internal::options(options);
    CHECK(data.detail == 0.25);
    CHECK(data.has_corners);
    CHECK(data.corners == 12);
    options.detail = 2.0;
    CHECK(error_of([&] { polycube::make(torus(), options); }).kind() == ErrorKind::option);
}

TEST_CASE("a labelled shape gets the polycube of its labels") {
    polycube::MakeOptions options;
    options.labels = made().labels;
    const Made again = polycube::make(made().shape, options);
    CHECK(polycube::check(again.input()).valid());
    CHECK(again.report.corners == made().report.corners);
    CHECK(again.report.facets == made().report.facets);
    options.labels->pop_back();
    CHECK(error_of([&] { polycube::make(made().shape, options); }).kind() == ErrorKind::mismatch);
}

TEST_CASE("a shape alone is meshed like the polycube that is made of it") {
    const Remeshed alone = polycube::remesh(torus(), fine(0.5));
    REQUIRE(alone.made);
    CHECK(alone.made->polycube.points == made().polycube.points);
    const Remeshed pair = polycube::remesh(made().input(), fine(0.5));
    CHECK(!pair.made);
    REQUIRE(alone.hexes);
    CHECK(alone.hexes->mesh.points == pair.hexes->mesh.points);
    CHECK(alone.hexes->mesh.cells == pair.hexes->mesh.cells);
    CHECK(alone.report.inverted == 0);
    // What was simplified is what was made.
    CHECK(alone.simplified.at(alone.made->input(), 0.0).polycube().cells == made().polycube.cells);
}

TEST_CASE("what is no closed surface has no polycube") {
    for (const auto& work : {std::function<void()>([] { polycube::make(open_torus()); }),
                             std::function<void()>([] { polycube::remesh(open_torus()); })}) {
        const polycube::Error error = error_of(work);
        CHECK(error.kind() == ErrorKind::mesh);
        CHECK(error.place().element == polycube::Element::edge);
        CHECK(!error.remedy().empty());
    }
    CHECK(error_of([] { polycube::make(polycube::example("ring", 1, CellKind::tetrahedra).second); }).kind() ==
          ErrorKind::unsupported);
    polycube::RemeshOptions locked;
    locked.simplify.guides.fixed_faces = {0};
    CHECK(error_of([&] { polycube::remesh(torus(), locked); }).kind() == ErrorKind::option);
}

TEST_CASE("making is told of and cancelled") {
    std::string last_stage;
    double last = 0.0;
    const polycube::Context context([&](const char* stage, double progress) {
        CHECK(progress >= last);
        last_stage = stage;
        last = progress;
        return progress < 0.02;
    });
    CHECK(error_of([&] { polycube::remesh(torus(), {}, context); }).kind() == ErrorKind::cancelled);
    // It was still making the polycube.
    CHECK(last_stage == "loops");
    CHECK(last < 0.1);
}

TEST_CASE("the filter makes a polycube where there is none") {
    polycube::filter::Settings settings;
    settings.options = fine(0.5);
    settings.options.surface_only = true;
    const auto meshed = polycube::filter::remesh({{}, torus(), {}, {}}, settings);
    CHECK(meshed.result.made);
    CHECK(meshed.log[0].rfind("polycube made of the shape: ", 0) == 0);
    CHECK(error_of([&] { polycube::filter::remesh({{}, torus(), {}, {1}}, settings); }).kind() == ErrorKind::option);
    CHECK(error_of([&] { polycube::filter::remesh({}, settings); }).kind() == ErrorKind::mesh);
}
