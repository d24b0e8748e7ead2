#include <cmath>
#include <polycube/cgal.hpp>
#include <random>

#include "bridge.hpp"
#include "helpers.hpp"

using polycube::CellKind;
using polycube::ErrorKind;
using polycube::Mesh;
namespace cgal = polycube::cgal;

namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

// The corner pairs of the core.
Pairs core_pairs(const std::vector<double>& points) {
    const std::vector<std::int64_t> integers(points.begin(), points.end());
    const auto call = [&] { return polycube::bridge::corner_pairs({integers.data(), integers.size()}); };
    const std::vector<std::uint32_t> flat = polycube::internal::vector(polycube::internal::call(call));
    Pairs pairs;
    for (std::size_t i = 0; i < flat.size(); i += 2) pairs.push_back({flat[i], flat[i + 1]});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

// Two boxes over each other, so far apart.
Mesh two_boxes(double shift) {
    Mesh mesh = box();
    for (std::size_t i = 0; i < 24; ++i) mesh.points.push_back(mesh.points[i] + (i % 3 == 2 ? shift : 0.25));
    for (std::size_t i = 0; i < 36; ++i) mesh.cells.push_back(mesh.cells[i] + 8);
    return mesh;
}

// Every quadrilateral as four triangles around its middle, as the core measures it.
Mesh in_quarters(const Mesh& quads) {
    Mesh mesh{quads.points, CellKind::triangles, {}};
    for (auto v = quads.cells.begin(); v != quads.cells.end(); v += 4) {
        const auto middle = static_cast<std::uint32_t>(mesh.point_count());
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double sum = 0.0;
            for (std::ptrdiff_t i = 0; i < 4; ++i) sum += quads.points[3 * v[i] + axis];
            mesh.points.push_back(sum / 4.0);
        }
        for (std::ptrdiff_t i = 0; i < 4; ++i) mesh.cells.insert(mesh.cells.end(), {v[i], v[(i + 1) % 4], middle});
    }
    return mesh;
}

double longest_side(const Mesh& quads) {
    double longest = 0.0;
    for (std::size_t i = 0; i < quads.cells.size(); ++i) {
        const std::size_t a = quads.cells[i], b = quads.cells[i % 4 == 3 ? i - 3 : i + 1];
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            sum += std::pow(quads.points[3 * a + axis] - quads.points[3 * b + axis], 2);
        longest = std::max(longest, std::sqrt(sum));
    }
    return longest;
}

void turn(Mesh& mesh, std::size_t face) { std::swap(mesh.cells[3 * face], mesh.cells[3 * face + 1]); }

}  // namespace

TEST_CASE("good surfaces and volumes are good") {
    for (const CellKind kind : {CellKind::triangles, CellKind::quads, CellKind::tetrahedra, CellKind::hexahedra}) {
        for (const Mesh& mesh : {polycube::example("ring", 1, kind).first, polycube::example("ring", 1, kind).second}) {
            const cgal::SurfaceCheck check = cgal::check_surface(mesh);
            CHECK(check.good());
            CHECK(check.closed);
            CHECK(check.outward);
            CHECK(check.log().empty());
        }
    }
}

TEST_CASE("what is wrong is located") {
    Mesh mesh = box();
    mesh.cells.resize(33);
    cgal::SurfaceCheck check = cgal::check_surface(mesh);
    CHECK(!check.closed);
    CHECK(!check.good());
    CHECK(check.open_faces.size() == 3);
    mesh = box();
    turn(mesh, 4);
    check = cgal::check_surface(mesh);
    CHECK(check.turned.size() == 1);
    CHECK(!check.good());
    mesh = box();
    for (std::size_t face = 0; face < 12; ++face) turn(mesh, face);
    check = cgal::check_surface(mesh);
    CHECK(check.closed);
    CHECK(!check.outward);
    CHECK(check.log() == std::vector<std::string>{"the surface looks inward"});
    check = cgal::check_surface(two_boxes(0.5));
    CHECK(check.closed);
    CHECK(!check.bounds_volume);
    CHECK(!check.intersections.empty());
    for (const auto& [a, b] : check.intersections) CHECK((a < 12) != (b < 12));
    CHECK(cgal::check_surface(two_boxes(2.0)).good());
    mesh = box();
    mesh.points[0] = mesh.points[3];
    check = cgal::check_surface(mesh);
    CHECK(!check.degenerate.empty());
    // Two boxes that share an edge.
    mesh = two_boxes(2.0);
    for (std::uint32_t& v : mesh.cells) v = v == 8 ? 4 : v == 9 ? 5 : v;
    check = cgal::check_surface(mesh);
    CHECK(check.non_manifold_vertices == std::vector<std::uint32_t>{4, 5});
    mesh = box();
    mesh.cells[0] = 8;
    CHECK(error_of([&] { cgal::check_surface(mesh); }).kind() == ErrorKind::mesh);
    mesh = box();
    mesh.points[5] = std::nan("");
    CHECK(error_of([&] { cgal::check_surface(mesh); }).place().index == 1);
}

TEST_CASE("faces are turned where the user allows, in both meshes of a pair") {
    Mesh mesh = box();
    for (const std::size_t face : {0, 1, 2, 3, 4, 9}) turn(mesh, face);
    const Mesh partner = [&] {
        Mesh other = mesh;
        for (double& x : other.points) x *= 2.0;
        return other;
    }();
    CHECK(!polycube::check(polycube::Input(mesh)).valid());
    const cgal::Repaired repaired = cgal::repair(mesh);
    CHECK(repaired.turned == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 9});
    CHECK(polycube::check(polycube::Input(repaired.mesh)).valid());
    CHECK(polycube::simplify({repaired.mesh, repaired.apply(partner)}).valid());
    CHECK(cgal::repair(box()).mesh.cells == box().cells);
    CHECK(cgal::repair(mesh, {false, false}).mesh.cells == mesh.cells);
    CHECK(error_of([&] { repaired.apply(two_boxes(2.0)); }).kind() == ErrorKind::mismatch);
    mesh.cells.resize(33);
    CHECK(error_of([&] { cgal::repair(mesh); }).kind() == ErrorKind::mesh);
    const Mesh volume = polycube::example("ring", 0, CellKind::hexahedra).first;
    CHECK(error_of([&] { cgal::repair(volume); }).kind() == ErrorKind::unsupported);
}

TEST_CASE("quadrilaterals are turned, too") {
    const Mesh mesh = polycube::example("ring", 1, CellKind::quads).first;
    Mesh turned = mesh;
    for (std::size_t face = 0; face < mesh.cell_count(); face += 3) {
        std::swap(turned.cells[4 * face + 1], turned.cells[4 * face + 3]);
    }
    CHECK(cgal::repair(turned).mesh.cells == mesh.cells);
}

TEST_CASE("vertices at one place become one") {
    Mesh soup;
    const Mesh whole = box();
    for (const std::uint32_t v : whole.cells) {
        soup.cells.push_back(static_cast<std::uint32_t>(soup.cells.size()));
        soup.points.insert(soup.points.end(), &whole.points[3 * v], &whole.points[3 * v] + 3);
    }
    const cgal::Repaired repaired = cgal::repair(soup, {true, true});
    CHECK(repaired.mesh.point_count() == 8);
    CHECK(polycube::check(polycube::Input(repaired.mesh)).valid());
    CHECK(repaired.apply(soup).points == repaired.mesh.points);
    CHECK(repaired.apply(soup).cells == repaired.mesh.cells);
}

TEST_CASE("vertices of a quadrilateral mesh lie on the shape") {
    const polycube::Remeshed result = polycube::remesh({pair().first, pair().second}, coarse());
    const cgal::Surface shape(pair().second);
    const std::vector<double> nearest = shape.project(result.quads.mesh.points);
    REQUIRE(nearest.size() == result.quads.mesh.points.size());
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        CHECK(nearest[i] == doctest::Approx(result.quads.mesh.points[i]).scale(50.0).epsilon(1e-9));
    }
    for (const double distance : shape.distances(result.quads.mesh.points)) CHECK(distance < 1e-7);
    CHECK(cgal::Surface(box()).distances({0.5, 0.5, 3.0, 0.5, 0.5, 0.25}) == std::vector<double>{2.0, 0.25});
}

TEST_CASE("the Hausdorff distance of the report is that of CGAL") {
    CHECK(cgal::hausdorff(box(), box(1.0, 1.0, 3.0), 1e-4) == doctest::Approx(2.0).epsilon(1e-4));
    CHECK(error_of([] { cgal::hausdorff(box(), box(), 0.0); }).kind() == ErrorKind::option);
    const polycube::Remeshed result = polycube::remesh({pair().first, pair().second}, coarse());
    // The report's is sampled on the same surface, so it is at most the exact one, and less by a face at most.
    const double error = 0.01 * result.report.hausdorff;
    const double exact = cgal::hausdorff(in_quarters(result.quads.mesh), pair().second, error);
    CHECK(result.report.hausdorff <= exact + error);
    CHECK(exact <= result.report.hausdorff + longest_side(result.quads.mesh));
    MESSAGE("sampled ", result.report.hausdorff, ", exact ", exact);
}

TEST_CASE("in general position the core pairs corners as CGAL's Delaunay triangulation does") {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> coordinate(-1000000, 1000000);
    for (int round = 0; round < 10; ++round) {
        std::vector<double> points(3 * 60);
        for (double& x : points) x = coordinate(random);
        const Pairs edges = cgal::delaunay_edges(points);
        CHECK(edges == cgal::touching_cells(points));
        CHECK(core_pairs(points) == edges);
    }
}

TEST_CASE("the core pairs the corners of polycubes only where Voronoi cells touch, and wherever they must") {
    for (const std::string& name : polycube::example_names()) {
        const Mesh mesh = polycube::example(name).first;
        std::vector<double> points;
        const polycube::Checked checked = polycube::check(polycube::Input(mesh));
        for (const polycube::Corner& corner : checked.structure->corners) {
            points.insert(points.end(), &mesh.points[3 * corner.vertex], &mesh.points[3 * corner.vertex] + 3);
        }
        const Pairs touching = cgal::touching_cells(points), core = core_pairs(points);
        CHECK(std::includes(touching.begin(), touching.end(), core.begin(), core.end()));
        // Of one triangulation of n points with t tetrahedra and f faces on the hull, each has as many edges as it has
        // simplices; but every corner has neighbours in each, and the shortest pair of each corner is in all of them.
        std::vector<double> nearest(points.size() / 3, INFINITY);
        const auto distance = [&](const auto& pair) {
            double sum = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                sum += std::pow(points[3 * pair[0] + axis] - points[3 * pair[1] + axis], 2);
            }
            return sum;
        };
        for (const auto& pair : touching) {
            for (const std::uint32_t v : pair) nearest[v] = std::min(nearest[v], distance(pair));
        }
        for (const auto& pair : touching) {
            if (distance(pair) != nearest[pair[0]] && distance(pair) != nearest[pair[1]]) continue;
            CHECK(std::binary_search(core.begin(), core.end(), pair));
        }
    }
}
