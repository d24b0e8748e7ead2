#include <polycube/quality.hpp>

#include "bridge.hpp"

namespace polycube {

std::vector<double> scaled_jacobians(const Mesh& mesh) {
    return internal::vector(internal::call([&] { return bridge::scaled_jacobians(internal::view(mesh)); }));
}

}  // namespace polycube
