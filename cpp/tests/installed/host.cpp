// What any host does first; also built with pkg-config and with add_subdirectory.
#include <cstdio>
#include <polycube/polycube.hpp>

int main() {
    const auto [polycube, shape] = polycube::example("stepped-l");
    polycube::Options options;
    options.effort.steps_per_level = 20;
    const polycube::Simplified result = polycube::simplify({polycube, shape}, options);
    std::printf("%s: %lu patches before, %lu after\n", polycube::version(),
                static_cast<unsigned long>(result.report().before.surface_patches),
                static_cast<unsigned long>(result.report().after->surface_patches));
    try {
        polycube::read_mesh("no such file.obj");
    } catch (const polycube::Error& error) {
        return error.kind() == polycube::ErrorKind::io && result.valid() ? 0 : 1;
    }
    return 1;
}
