#include <cmath>
#include <limits>

#include "bridge.hpp"
#include "helpers.hpp"

using polycube::Element;
using polycube::Error;
using polycube::ErrorKind;
using polycube::Input;
using polycube::Mesh;
using polycube::Options;

namespace {

ErrorKind kind_of(const Input& input, const Options& options = {}) {
    const Error simplifying = error_of([&] { polycube::simplify(input, options); });
    polycube::RemeshOptions meshing;
    meshing.simplify = options;
    CHECK(error_of([&] { polycube::remesh(input, meshing); }).kind() == simplifying.kind());
    CHECK(!simplifying.message().empty());
    return simplifying.kind();
}

}  // namespace

TEST_CASE("an error says what, where and what to do") {
    const Error error(ErrorKind::mesh, {Element::edge, 3, 8}, "open", "close it");
    CHECK(std::string(error.what()) == "edge 3-8: open (close it)");
    CHECK(std::string(polycube::name_of(error.kind())) == "mesh");
    CHECK(std::string(Error(ErrorKind::io, "gone").what()) == "gone");
}

TEST_CASE("files") {
    CHECK(error_of([] { polycube::read_mesh("/nowhere/at.all.obj"); }).kind() == ErrorKind::io);
    CHECK(error_of([] { polycube::write_mesh("/nowhere/at.all.obj", box()); }).kind() == ErrorKind::io);
    CHECK(error_of([] { polycube::read_mesh("/tmp"); }).kind() == ErrorKind::io);
    CHECK(error_of([] {
              polycube::write_mesh("box.stl", polycube::example("ring", 0, polycube::CellKind::quads).first);
          }).kind() == ErrorKind::unsupported);
    const std::string text = "v 0 0 0\nv 1 0 0\nv one\n";
    const Error error = error_of([&] { polycube::read_mesh_bytes("obj", text.data(), text.size()); });
    CHECK(error.kind() == ErrorKind::parse);
    CHECK(error.place().element == Element::line);
    CHECK(error.place().index == 3);
    CHECK(error_of([] { polycube::read_mesh_bytes("obj", nullptr, 0); }).kind() == ErrorKind::mesh);
    CHECK(error_of([] { polycube::read_mesh("\xff\xfe.obj"); }).kind() == ErrorKind::option);
    const auto named = [](const char* name, std::size_t count) {
        return error_of([&] { polycube::write_mesh_bytes("vtu", box(), {{name, std::vector<double>(count)}}); }).kind();
    };
    CHECK(named("a b", 12) == ErrorKind::option);
    CHECK(named("a", 11) == ErrorKind::option);
}

TEST_CASE("buffers that are no mesh") {
    Mesh mesh = box();
    mesh.cells[7] = 8;
    const Error error = error_of([&] { polycube::simplify(Input(mesh)); });
    CHECK(error.kind() == ErrorKind::mesh);
    CHECK(error.place().element == Element::cell);
    CHECK(error.place().index == 2);
    CHECK(error_of([&] { polycube::boundary(mesh); }).kind() == ErrorKind::mesh);
    CHECK(error_of([&] { polycube::check(Input(mesh)); }).kind() == ErrorKind::mesh);
    mesh = box();
    mesh.cells.pop_back();
    CHECK(kind_of(Input(mesh)) == ErrorKind::mesh);
    mesh = box();
    mesh.points.pop_back();
    CHECK(kind_of(Input(mesh)) == ErrorKind::mesh);
    mesh = box();
    mesh.kind = static_cast<polycube::CellKind>(9);
    CHECK(error_of([&] { polycube::simplify(Input(mesh)); }).kind() == ErrorKind::unsupported);
    CHECK(kind_of(Input(Mesh{})) == ErrorKind::mesh);
}

TEST_CASE("meshes that are no polycube") {
    Mesh mesh = box();
    mesh.cells.resize(33);
    CHECK(kind_of(Input(mesh)) == ErrorKind::mesh);
    mesh = box();
    mesh.points[0] = std::numeric_limits<double>::infinity();
    CHECK(kind_of(Input(mesh)) == ErrorKind::mesh);
    mesh = box();
    mesh.points[0] = mesh.points[1] = mesh.points[2] = -3.0;
    CHECK(kind_of(Input(mesh)) == ErrorKind::polycube);
}

TEST_CASE("shapes and labels that do not fit") {
    const Mesh mesh = box();
    Mesh shape = box();
    shape.points.insert(shape.points.end(), {0.0, 0.0, 0.0});
    CHECK(kind_of({mesh, shape}) == ErrorKind::mismatch);
    shape = box();
    shape.points[4] = std::nan("");
    CHECK(kind_of({mesh, shape}) == ErrorKind::mesh);
    Input input(mesh);
    std::vector<std::int8_t> labels(11, -1);
    input.labels = &labels;
    CHECK(kind_of(input) == ErrorKind::mismatch);
    labels.assign(12, 6);
    CHECK(kind_of(input) == ErrorKind::option);
    input.polycube = nullptr;
    CHECK(kind_of(input) == ErrorKind::option);
}

TEST_CASE("options out of their ranges") {
    const Mesh mesh = box();
    const auto refused = [&](auto change) {
        Options options;
        change(options);
        CHECK(kind_of(Input(mesh), options) == ErrorKind::option);
    };
    for (const double bad : {-1.0, 0.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        refused([&](Options& o) { o.scale = bad; });
        refused([&](Options& o) { o.effort.time_limit = bad; });
    }
    for (const double bad : {-0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
        refused([&](Options& o) { o.max_displacement = bad; });
    }
    for (const double bad : {-0.1, 1.1, std::nan("")}) {
        refused([&](Options& o) { o.simplicity = bad; });
        refused([&](Options& o) { o.lambda_min = bad; });
        refused([&](Options& o) { o.tolerance.distance = bad; });
        refused([&](Options& o) { o.tolerance.merge = bad; });
    }
    refused([](Options& o) { o.tolerance.degrees = 46.0; });
    refused([](Options& o) { o.strategy = static_cast<polycube::Strategy>(3); });
    refused([](Options& o) { o.solver = static_cast<polycube::Solver>(2); });
    refused([](Options& o) { o.objective = static_cast<polycube::Objective>(3); });
    refused([](Options& o) { o.effort.time_limit = 1e300; });
}

TEST_CASE("a panic in the core is an exception, wherever it happens") {
    const Mesh mesh = pair().first;
    const polycube::Context context;
    for (const std::string stage : {"structure", "align", "morph"}) {
        const Error error = error_of([&] {
            polycube::internal::call(context, [&](const auto& listener) {
                polycube::bridge::panic_in_core(polycube::internal::view(Input(mesh)), stage, listener);
                return true;
            });
        });
        CHECK(error.kind() == ErrorKind::internal);
        CHECK(error.message().find("injected into " + stage) != std::string::npos);
    }
    // Nothing is broken by it.
    CHECK(polycube::simplify(Input(box())).valid());
}
