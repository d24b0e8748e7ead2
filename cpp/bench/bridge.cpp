// What the way from C++ to the core and back adds to the core's own time, measured in the same calls:
//
//     bridge POLYCUBE SHAPE
//
// prints one line of JSON: seconds of the core and of the whole call, the median of 9 calls each.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <polycube/polycube.hpp>
#include <vector>

namespace {

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    const auto [polycube, shape] = polycube::read_pair(argv[1], argv[2]);
    std::vector<double> core, added;
    for (int i = 0; i < 9; ++i) {
        const double start = seconds();
        const polycube::Simplified result =
            polycube::simplify({polycube, shape}, {}, polycube::Context([](const char*, double) { return true; }));
        core.push_back(result.report().seconds.total);
        added.push_back(seconds() - start - core.back());
    }
    std::printf("{\"core\": %.6f, \"added\": %.6f}\n", median(core), median(added));
    return 0;
}
