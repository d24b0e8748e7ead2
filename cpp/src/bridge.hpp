// How the library calls its core: errors and panics become `Error`, progress reaches the `Context`.
#pragma once

#include <atomic>
#include <exception>
#include <polycube/context.hpp>
#include <polycube/error.hpp>
#include <polycube/make.hpp>
#include <polycube/mesh.hpp>
#include <polycube/simplify.hpp>
#include <string>
#include <utility>
#include <vector>

#include "polycube-cxx/src/lib.rs.h"
#include "rust/cxx.h"

namespace polycube {

struct Context::State {
    Progress callback;
    std::atomic<bool> cancelled{false};
    std::atomic<double> progress{0.0};
};

struct Simplified::State {
    rust::Box<bridge::Simplified> core;
    Report report;
    std::string json;
    Mesh polycube;
    std::vector<std::int64_t> levels;
    std::vector<std::int8_t> labels;
    std::vector<std::uint32_t> facet_of_face;
    std::vector<std::uint32_t> patch_of_face;
    std::vector<std::uint32_t> block_of_face;
};

namespace internal {

// Hears of a running call on behalf of a context.
class Listener final : public bridge::Observer {
 public:
    explicit Listener(const Context& context) noexcept : state_(context.state()) {}
    bool is_cancelled() const noexcept override { return state_.cancelled; }
    bool report(rust::Str stage, double progress) const noexcept override;
    // Throws again what the callback threw.
    void rethrow() const;

 private:
    Context::State& state_;
    mutable std::exception_ptr thrown_;
};

// The error that a failed call of the bridge stands for.
Error decode(const rust::Error& error);

// Calls the bridge and returns what it gives, or throws an `Error`.
template <class Call>
auto call(const Call& work) -> decltype(work()) {
    try {
        return work();
    } catch (const rust::Error& error) {
        throw decode(error);
    }
}

// Calls the bridge with a listener.
template <class Call>
auto call(const Context& context, const Call& work) {
    const Listener listener(context);
    try {
        auto result = work(listener);
        listener.rethrow();
        return result;
    } catch (const rust::Error& error) {
        listener.rethrow();
        throw decode(error);
    }
}

// UTF-8 text. Throws `Error` for other text.
rust::Str text(const std::string& text);

template <class T>
rust::Slice<const T> slice(const std::vector<T>& values) {
    return {values.data(), values.size()};
}

template <class T>
std::vector<T> vector(const rust::Vec<T>& values) {
    return {values.begin(), values.end()};
}

std::vector<std::string> strings(const rust::Vec<rust::String>& values);

bridge::MeshView view(const Mesh& mesh);
bridge::InputView view(const Input& input);
Mesh mesh(const bridge::MeshData& data);
Counts counts(const bridge::CountsData& data) noexcept;
bridge::ToleranceData tolerance(const Tolerance& tolerance) noexcept;
Distortion distortion(const bridge::DistortionData& data) noexcept;
bridge::OptionsData options(const Options& options);
bridge::MakeOptionsData options(const MakeOptions& options);
Made made(const bridge::MadeData& data);
Simplified simplified(rust::Box<bridge::Simplified> core);

inline bridge::Real real(const std::optional<double>& value) noexcept {
    return {value.has_value(), value.value_or(0.0)};
}

inline std::optional<double> real(const bridge::Real& value) noexcept {
    return value.some ? std::optional<double>(value.value) : std::nullopt;
}

}  // namespace internal
}  // namespace polycube
