// The library writes what the command writes, byte for byte.
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "helpers.hpp"

using polycube::CellKind;

namespace {

std::string bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    REQUIRE_MESSAGE(file, path);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Whether `file`, which `write` writes to the folder `own`, is as the command wrote it to `theirs`.
void same(const std::string& own, const std::string& theirs) {
    const bool equal = bytes(own) == bytes(theirs);
    CHECK_MESSAGE(equal, theirs);
}

void run(const std::string& arguments) {
    const int status = std::system((std::string(POLYCUBE_COMMAND) + " " + arguments).c_str());
    REQUIRE(status == 0);
}

}  // namespace

TEST_CASE("simplify writes what the command writes") {
    const Folder folder("command");
    for (const auto& [kind, extension] :
         {std::pair(CellKind::triangles, "obj"), std::pair(CellKind::tetrahedra, "mesh"),
          std::pair(CellKind::hexahedra, "vtu")}) {
        const auto [polycube, shape] = polycube::example("ring", 2, kind);
        const std::string p = folder / (std::string("p.") + extension), s = folder / (std::string("s.") + extension);
        polycube::write_mesh(p, polycube);
        polycube::write_mesh(s, shape);
        run("simplify " + p + " --shape " + s + " --scale 0.7 --steps 50 --proof-nodes 10 -q -o " + (folder / "out"));
        polycube::Options options = quick();
        options.scale = 0.7;
        const polycube::Simplified result = polycube::simplify({polycube, shape}, options);
        polycube::write_mesh(folder / (std::string("own.") + extension), result.polycube());
        polycube::write_labels(folder / "own.labels", result.labels());
        same(folder / (std::string("own.") + extension), folder / (std::string("out/polycube.") + extension));
        same(folder / "own.labels", folder / "out/polycube.labels");
    }
}

TEST_CASE("remesh writes what the command writes") {
    const Folder folder("remesh");
    const auto& [polycube, shape] = pair();
    polycube::write_mesh(folder / "p.off", polycube);
    polycube::write_mesh(folder / "s.off", shape);
    run("remesh " + (folder / "s.off") + " --polycube " + (folder / "p.off") +
        " --hexes 1500 --max-hausdorff 100 --format msh --format inp --format su2 --format foam" +
        " --format json --format xyz --format blockmesh -q -o " + (folder / "out"));
    polycube::RemeshOptions options = coarse();
    options.simplify = {};
    options.max_hausdorff = 1.0;
    const polycube::Remeshed result = polycube::remesh({polycube, shape}, options);
    REQUIRE(result.hexes);
    polycube::write_mesh(folder / "hexes.vtu", result.hexes->mesh, result.hexes->fields());
    polycube::write_mesh(folder / "hexes.mesh", result.hexes->mesh);
    polycube::write_mesh(folder / "quads.obj", result.quads.mesh);
    polycube::write_mesh(folder / "layout.obj", result.layout.patches);
    polycube::write_mesh(folder / "layout.vtk", result.layout.blocks, result.layout.block_fields());
    for (const char* file : {"hexes.msh", "hexes.inp", "hexes.su2", "case.foam", "blocks.json", "hexes.xyz",
                             "case.blockmesh"}) {
        polycube::write_solver(folder / file, *result.hexes);
    }
    for (const char* file : {"hexes.vtu", "hexes.mesh", "quads.obj", "layout.obj", "layout.vtk", "hexes.msh",
                             "hexes.inp", "hexes.su2", "blocks.json", "hexes.xyz"}) {
        same(folder / file, folder / (std::string("out/") + file));
    }
    for (const char* file : {"points", "faces", "owner", "neighbour", "boundary", "cellZones"}) {
        const std::string within = std::string("/constant/polyMesh/") + file;
        same(folder / ("case.foam" + within), folder / ("out/foam" + within));
    }
    for (const char* file : {"/system/blockMeshDict", "/constant/triSurface/boundary.obj",
                             "/constant/triSurface/between.obj"}) {
        same(folder / (std::string("case.blockmesh") + file), folder / (std::string("out/blockmesh") + file));
    }
}

TEST_CASE("groups of faces and texture coordinates are written as the command writes them") {
    const Folder folder("groups");
    const auto& [polycube, shape] = pair();
    polycube::write_mesh(folder / "p.off", polycube);
    std::vector<std::int32_t> part(shape.cell_count());
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = i < part.size() / 3 ? 4 : 7;
    polycube::write_mesh(folder / "s.vtk", shape, {{"part", part}});
    polycube::write_mesh(folder / "s.off", shape);
    run("remesh " + (folder / "s.off") + " --polycube " + (folder / "p.off") + " --hexes 1500 --max-hausdorff 100" +
        " --uv --format msh --format su2 --groups " + (folder / "s.vtk") + " -q -o " + (folder / "out"));
    polycube::RemeshOptions options = coarse();
    options.simplify = {};
    options.max_hausdorff = 1.0;
    const polycube::Remeshed result = polycube::remesh({polycube, shape}, options);
    for (const char* file : {"hexes.msh", "hexes.su2"}) {
        polycube::write_solver(folder / file, *result.hexes, folder / "s.vtk");
        same(folder / file, folder / (std::string("out/") + file));
    }
    polycube::write_textured(folder / "quads.obj", result.quads);
    same(folder / "quads.obj", folder / "out/quads.obj");
    CHECK_THROWS_AS(polycube::write_solver(folder / "no.msh", *result.hexes, folder / "s.off"), polycube::Error);
}
