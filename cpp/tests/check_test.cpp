#include <cmath>

#include "helpers.hpp"

using polycube::Checked;
using polycube::Element;
using polycube::Input;
using polycube::Mesh;

TEST_CASE("the structure of a box") {
    const Mesh mesh = box(1.0, 2.0, 3.0);
    const Checked checked = polycube::check(Input(mesh));
    REQUIRE(checked.valid());
    const polycube::Structure& s = *checked.structure;
    CHECK(s.facets.size() == 6);
    CHECK(s.corners.size() == 8);
    CHECK(s.edges.size() == 12);
    CHECK(s.levels.size() == 6);
    CHECK(s.genus == 0);
    CHECK(s.components == 1);
    CHECK(s.counts.blocks == 1);
    CHECK(s.counts.surface_patches == 6);
    CHECK(s.counts.blocks_padded == 7);
    CHECK(s.label_of_face == std::vector<std::int8_t>{5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0});
    for (std::size_t i = 0; i < 12; ++i) {
        CHECK(s.facets[s.facet_of_face[i]].label == s.label_of_face[i]);
        CHECK(s.patch_of_face[i] == s.patch_of_face[i ^ 1]);
        CHECK(s.block_of_face[i] == 0);
    }
    for (const polycube::Corner& corner : s.corners) {
        CHECK(corner.valence == 3);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(s.levels[corner.levels[axis]].coordinate == mesh.points[3 * corner.vertex + axis]);
        }
    }
    for (const polycube::Edge& edge : s.edges) {
        CHECK(edge.vertices.front() == s.corners[edge.corners[0]].vertex);
        CHECK(edge.vertices.back() == s.corners[edge.corners[1]].vertex);
    }
}

TEST_CASE("a hole is located") {
    Mesh mesh = box();
    mesh.cells.resize(33);
    const Checked checked = polycube::check(Input(mesh));
    CHECK(!checked.valid());
    CHECK(!checked.structure);
    REQUIRE(checked.violations.size() == 3);
    for (const polycube::Violation& violation : checked.violations) {
        CHECK(violation.rule == "open_edge");
        CHECK(violation.place.element == Element::edge);
        CHECK(violation.faces.size() == 1);
        REQUIRE(violation.at);
        CHECK(!violation.remedy.empty());
    }
}

TEST_CASE("broken meshes are results, each with its rule") {
    const auto first = [](const Mesh& mesh) {
        const Checked checked = polycube::check(Input(mesh));
        REQUIRE(!checked.valid());
        return checked.violations[0];
    };
    Mesh mesh = box();
    mesh.points[0] = std::nan("");
    CHECK(first(mesh).rule == "not_finite");
    mesh = box();
    mesh.cells.clear();
    CHECK(first(mesh).rule == "empty");
    mesh = box();
    std::swap(mesh.cells[0], mesh.cells[1]);
    CHECK(first(mesh).rule == "inconsistent_orientation");
    mesh = box();
    for (std::size_t i = 0; i < mesh.cells.size(); i += 3) std::swap(mesh.cells[i], mesh.cells[i + 1]);
    CHECK(first(mesh).rule == "inside_out");
    mesh = box();
    mesh.points[0] = -2.0;
    mesh.points[1] = -1.0;
    CHECK(first(mesh).rule == "skew_face");
}

TEST_CASE("two boxes that overlap are both named") {
    Mesh mesh = box(2.0, 2.0, 2.0);
    const Mesh other = box(2.0, 2.0, 2.0);
    for (std::size_t i = 0; i < other.points.size(); ++i) mesh.points.push_back(other.points[i] + 1.0);
    for (const std::uint32_t v : other.cells) mesh.cells.push_back(v + 8);
    const Checked checked = polycube::check(Input(mesh));
    REQUIRE(!checked.valid());
    CHECK(checked.violations[0].rule == "self_overlap");
    CHECK(checked.violations[0].faces.size() >= 1);
}

TEST_CASE("tolerances decide") {
    Mesh mesh = box();
    mesh.points[0] = 0.02;
    polycube::Tolerance tolerance;
    CHECK(polycube::check(Input(mesh), tolerance).valid());
    tolerance.distance = 0.001;
    CHECK(polycube::check(Input(mesh), tolerance).violations[0].rule == "off_level");
    tolerance.degrees = 0.5;
    CHECK(polycube::check(Input(mesh), tolerance).violations[0].rule == "skew_face");
}
