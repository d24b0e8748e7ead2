// The adapters of the installed package.
#include <polycube/cgal.hpp>
#include <polycube/openmesh.hpp>
#include <polycube/polycube.hpp>

int main() {
    const polycube::Mesh shape = polycube::example("ring").second;
    const auto mesh = polycube::openmesh::to<OpenMesh::TriMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>>(shape);
    const bool same = polycube::openmesh::from(mesh).cells == shape.cells;
    return same && polycube::cgal::check_surface(shape).good() ? 0 : 1;
}
