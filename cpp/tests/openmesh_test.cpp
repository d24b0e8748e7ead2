#include <polycube/openmesh.hpp>

#include "helpers.hpp"

using polycube::CellKind;
using polycube::ErrorKind;
using polycube::Mesh;
namespace om = polycube::openmesh;

namespace {

struct Traits : OpenMesh::DefaultTraitsDouble {
    FaceAttributes(OpenMesh::Attributes::Status);
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
};
using Triangles = OpenMesh::TriMesh_ArrayKernelT<Traits>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<Traits>;
using Floats = OpenMesh::TriMesh_ArrayKernelT<>;

}  // namespace

TEST_CASE("triangles and quadrilaterals go there and back") {
    for (const CellKind kind : {CellKind::triangles, CellKind::quads}) {
        const Mesh mesh = polycube::example("ring", 1, kind).second;
        const auto there = om::to<Polygons>(mesh);
        CHECK(there.n_faces() == mesh.cell_count());
        const Mesh back = om::from(there);
        CHECK(back.kind == kind);
        CHECK(back.points == mesh.points);
        CHECK(back.cells == mesh.cells);
    }
    const Mesh back = om::from(om::to<Floats>(box()));
    CHECK(back.points == box().points);
    CHECK(back.cells == box().cells);
}

TEST_CASE("a triangle mesh gets quadrilaterals in halves, a mixed one is cut") {
    const Mesh quads = polycube::example("ring", 1, CellKind::quads).first;
    CHECK(om::from(om::to<Triangles>(quads)).cell_count() == 2 * quads.cell_count());
    Polygons house;
    std::vector<OpenMesh::VertexHandle> v;
    for (const auto& p : {std::array{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 1.5}, {0.0, 1.0}}) {
        v.push_back(house.add_vertex({p[0], p[1], 0.0}));
    }
    house.add_face(v);
    const Mesh mesh = om::from(house);
    CHECK(mesh.kind == CellKind::triangles);
    CHECK(mesh.cells == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 3, 4});
}

TEST_CASE("deleted elements are left out") {
    auto mesh = om::to<Triangles>(box());
    mesh.delete_vertex(mesh.vertex_handle(0));
    const Mesh found = om::from(mesh);
    CHECK(found.point_count() == 7);
    CHECK(found.cell_count() == mesh.n_faces() - 6);
    mesh.garbage_collection();
    CHECK(found.cell_count() == mesh.n_faces());
    for (const std::uint32_t i : found.cells) CHECK(i < 7);
}

TEST_CASE("properties") {
    const auto result = polycube::simplify({pair().first, pair().second}, quick());
    auto mesh = om::to<Triangles>(result.polycube());
    om::set_face_property(mesh, om::label_property, result.labels());
    om::set_face_property(mesh, om::patch_property, result.patch_of_face());
    const std::vector<std::int32_t> labels = om::face_property(mesh, om::label_property);
    CHECK(std::equal(labels.begin(), labels.end(), result.labels().begin(), result.labels().end()));
    CHECK(om::face_property(mesh, om::block_property).empty());
    CHECK(error_of([&] { om::set_face_property(mesh, "x", std::vector<int>(3)); }).kind() == ErrorKind::mismatch);
}

TEST_CASE("what OpenMesh cannot hold") {
    CHECK(error_of([] { om::to<Polygons>(polycube::example("ring", 0, CellKind::hexahedra).first); }).kind() ==
          ErrorKind::unsupported);
    Mesh mesh = box();
    mesh.cells.insert(mesh.cells.end(), {0, 2, 3});
    omerr().disable();
    const polycube::Error error = error_of([&] { om::to<Polygons>(mesh); });
    CHECK(error.kind() == ErrorKind::mesh);
    CHECK(error.place().index == 12);
    mesh.cells = {0, 1, 99};
    CHECK(error_of([&] { om::to<Polygons>(mesh); }).kind() == ErrorKind::mesh);
    CHECK(error_of([] { om::from(Polygons()); }).kind() == ErrorKind::mesh);
}
