// A console host: reads a shape and its polycube with OpenMesh, simplifies with a progress line, stops on Ctrl-C, and
// writes the quadrilateral and the hexahedral mesh, of about HEXES hexahedra.
//
//     simplify_off SHAPE.off POLYCUBE.off FOLDER [HEXES]
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <polycube/openmesh.hpp>
#include <polycube/polycube.hpp>

namespace {

using Triangles = OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;
using Polygons = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

// What Ctrl-C cancels. A signal handler can reach nothing but what is static.
const polycube::Context* running = nullptr;

void stop(int) {
    if (running != nullptr) running->cancel();
}

bool show(const char* stage, double progress) {
    std::fprintf(stderr, "\r%3.0f %% %-12s", 100.0 * progress, stage);
    return true;
}

polycube::Mesh read(const char* path) {
    Triangles mesh;
    if (!OpenMesh::IO::read_mesh(mesh, path)) {
        throw polycube::Error(polycube::ErrorKind::io, std::string("OpenMesh cannot read ") + path);
    }
    return polycube::openmesh::from(mesh);
}

void write(const polycube::Remeshed& result, const std::string& folder) {
    auto quads = polycube::openmesh::to<Polygons>(result.quads.mesh);
    polycube::openmesh::set_face_property(quads, polycube::openmesh::patch_property, result.quads.patch_id);
    if (!OpenMesh::IO::write_mesh(quads, folder + "/quads.off", OpenMesh::IO::Options::Default, 17)) {
        throw polycube::Error(polycube::ErrorKind::io, "OpenMesh cannot write " + folder + "/quads.off");
    }
    if (result.hexes) polycube::write_mesh(folder + "/hexes.vtu", result.hexes->mesh, result.hexes->fields());
}

int run(const char* shape_file, const char* polycube_file, const std::string& folder,
        const polycube::RemeshOptions& options) {
    const polycube::Mesh shape = read(shape_file), polycube = read(polycube_file);
    const polycube::Context context(show);
    running = &context;
    std::signal(SIGINT, stop);
    const polycube::Remeshed result = polycube::remesh({polycube, shape}, options, context);
    write(result, folder);
    const polycube::Report& report = result.simplified.report();
    std::cerr << '\r';
    std::cout << report.before.blocks_padded << " blocks before, " << report.after->blocks_padded << " after; "
              << result.report.quads << " quadrilaterals, " << result.report.hexes << " hexahedra\n";
    for (const std::string& fault : result.report.faults) std::cout << "warning: " << fault << '\n';
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4 && argc != 5) {
        std::cerr << "usage: simplify_off SHAPE.off POLYCUBE.off FOLDER [HEXES]\n";
        return 2;
    }
    polycube::RemeshOptions options;
    if (argc == 5) options.size = {polycube::Size::Kind::hexes, std::atof(argv[4])};
    try {
        return run(argv[1], argv[2], argv[3], options);
    } catch (const polycube::Error& error) {
        std::cerr << '\r' << polycube::name_of(error.kind()) << ": " << error.what() << '\n';
        return error.kind() == polycube::ErrorKind::cancelled ? 130 : 1;
    }
}
