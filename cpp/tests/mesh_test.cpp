#include <fstream>

#include "helpers.hpp"

using polycube::CellField;
using polycube::CellKind;
using polycube::ErrorKind;
using polycube::Mesh;

TEST_CASE("every format gives back what it holds") {
    const Folder folder("mesh");
    for (const CellKind kind : {CellKind::triangles, CellKind::quads, CellKind::tetrahedra, CellKind::hexahedra}) {
        const Mesh mesh = polycube::example("ring", 1, kind).second;
        for (const char* extension : {"obj", "off", "ply", "mesh", "vtk", "vtu"}) {
            const bool surface_only = std::string("obj off ply").find(extension) != std::string::npos;
            if (mesh.is_volume() && surface_only) continue;
            const std::string file = folder / (std::string("mesh.") + extension);
            polycube::write_mesh(file, mesh);
            const Mesh found = polycube::read_mesh(file);
            CHECK(found.kind == mesh.kind);
            CHECK(found.cells == mesh.cells);
            CHECK(found.points == mesh.points);
        }
    }
}

TEST_CASE("bytes are those of the file") {
    const Folder folder("bytes");
    const std::vector<CellField> fields{{"label", std::vector<std::int32_t>(12, 3)},
                                        {"size", std::vector<double>(12, 0.5)}};
    polycube::write_mesh(folder / "box.vtu", box(), fields);
    const std::vector<std::uint8_t> bytes = polycube::write_mesh_bytes("vtu", box(), fields);
    std::ifstream file(folder / "box.vtu", std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    CHECK(text == std::string(bytes.begin(), bytes.end()));
    CHECK(text.find("Name=\"label\"") != std::string::npos);
    CHECK(text.find("Name=\"size\"") != std::string::npos);
    const Mesh found = polycube::read_mesh_bytes("vtu", bytes.data(), bytes.size());
    CHECK(found.points == box().points);
}

TEST_CASE("labels are read back, and counted") {
    const Folder folder("labels");
    const std::vector<std::int8_t> labels{5, 0, -1};
    polycube::write_labels(folder / "labels", labels);
    CHECK(polycube::read_labels(folder / "labels", 3) == labels);
    CHECK(error_of([&] { polycube::read_labels(folder / "labels", 4); }).kind() == ErrorKind::mismatch);
    CHECK(error_of([&] { polycube::write_labels(folder / "labels", {6}); }).kind() == ErrorKind::option);
}

TEST_CASE("a pair of files is checked") {
    const Folder folder("pair");
    polycube::write_mesh(folder / "a.obj", box());
    polycube::write_mesh(folder / "b.off", box(2.0, 3.0, 4.0));
    const auto [a, b] = polycube::read_pair(folder / "a.obj", folder / "b.off");
    CHECK(a.points == box().points);
    CHECK(b.points == box(2.0, 3.0, 4.0).points);
    Mesh other = box();
    std::swap(other.cells[3], other.cells[4]);
    polycube::write_mesh(folder / "b.off", other);
    const polycube::Error error = error_of([&] { polycube::read_pair(folder / "a.obj", folder / "b.off"); });
    CHECK(error.kind() == ErrorKind::mismatch);
    CHECK(error.place().element == polycube::Element::cell);
    CHECK(error.place().index == 1);
}

TEST_CASE("the boundary of a volume is closed and its own boundary") {
    const Mesh hexes = polycube::example("ring", 0, CellKind::hexahedra).first;
    const Mesh faces = polycube::boundary(hexes);
    CHECK(faces.kind == CellKind::quads);
    CHECK(faces.points == hexes.points);
    CHECK(polycube::boundary(faces).cells == faces.cells);
    CHECK(polycube::check(polycube::Input(faces)).valid());
    CHECK(polycube::boundary(polycube::example("ring", 0, CellKind::tetrahedra).first).kind == CellKind::triangles);
}

TEST_CASE("examples have names and kinds") {
    CHECK(polycube::example_names() == std::vector<std::string>{"cube-spikes", "stepped-l", "ring", "double-torus"});
    for (const std::string& name : polycube::example_names()) {
        const auto [polycube, shape] = polycube::example(name, 3, CellKind::quads);
        CHECK(polycube.cells == shape.cells);
        CHECK(polycube.points != shape.points);
    }
    CHECK(error_of([] { polycube::example("teapot"); }).kind() == ErrorKind::option);
}
