// What several tests need.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <optional>
#include <polycube/polycube.hpp>
#include <string>
#include <vector>

// The error that `work` throws; the test fails if it throws none.
template <class Work>
polycube::Error error_of(const Work& work) {
    try {
        work();
    } catch (const polycube::Error& error) {
        return error;
    }
    FAIL("no error was thrown");
    return {polycube::ErrorKind::internal, "none"};
}

// A box from the origin with these lengths, as 12 triangles.
inline polycube::Mesh box(double x = 1.0, double y = 1.0, double z = 1.0) {
    polycube::Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.points.insert(mesh.points.end(), {i & 1 ? x : 0.0, i & 2 ? y : 0.0, i & 4 ? z : 0.0});
    }
    mesh.cells = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return mesh;
}

// The example with the fewest triangles, and little search.
inline const std::pair<polycube::Mesh, polycube::Mesh>& pair() {
    static const auto pair = polycube::example("stepped-l");
    return pair;
}

inline polycube::Options quick() {
    polycube::Options options;
    options.effort.steps_per_level = 50;
    options.effort.proof_nodes = 10;
    return options;
}

inline polycube::RemeshOptions coarse() {
    polycube::RemeshOptions options;
    options.simplify = quick();
    options.size = polycube::Size{polycube::Size::Kind::hexes, 1500.0};
    // So few cannot be near to the shape, and no other blocks are looked for in vain.
    options.max_hausdorff = 1.0;
    return options;
}

// A folder that goes with its scope.
class Folder {
 public:
    explicit Folder(const std::string& name)
        : path_(std::filesystem::temp_directory_path() / ("polycube-" + name + "-" + std::to_string(++count()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { std::filesystem::remove_all(path_); }
    std::string operator/(const std::string& file) const { return (path_ / file).string(); }

 private:
    static int& count() {
        static int count = static_cast<int>(std::filesystem::hash_value(std::filesystem::current_path()) % 10000) * 100;
        return count;
    }
    std::filesystem::path path_;
};
