#include <polycube/example.hpp>
#include <polycube/mesh.hpp>

#include "bridge.hpp"

namespace polycube {

using internal::call;
using internal::slice;
using internal::text;

namespace internal {

bridge::MeshView view(const Mesh& mesh) {
    return {slice(mesh.points), static_cast<std::uint8_t>(mesh.kind), slice(mesh.cells)};
}

Mesh mesh(const bridge::MeshData& data) {
    return {vector(data.points), static_cast<CellKind>(data.kind), vector(data.cells)};
}

}  // namespace internal

namespace {

template <class T>
rust::Vec<T> copy(const std::vector<T>& values) {
    rust::Vec<T> result;
    result.reserve(values.size());
    for (const T value : values) result.push_back(value);
    return result;
}

bridge::FieldData field(const CellField& field) {
    text(field.name);
    bridge::FieldData data{field.name, false, {}, {}};
    if (const auto* real = std::get_if<std::vector<double>>(&field.values)) {
        data.is_real = true;
        data.real = copy(*real);
    } else {
        data.integer = copy(std::get<std::vector<std::int32_t>>(field.values));
    }
    return data;
}

rust::Vec<bridge::FieldData> fields_of(const std::vector<CellField>& fields) {
    rust::Vec<bridge::FieldData> result;
    for (const CellField& one : fields) result.push_back(field(one));
    return result;
}

std::pair<Mesh, Mesh> pair(const bridge::PairData& data) {
    return {internal::mesh(data.polycube), internal::mesh(data.shape)};
}

}  // namespace

Mesh read_mesh(const std::string& path) {
    return internal::mesh(call([&] { return bridge::read_mesh(text(path)); }));
}

std::pair<Mesh, Mesh> read_pair(const std::string& polycube, const std::string& shape) {
    return pair(call([&] { return bridge::read_pair(text(polycube), text(shape)); }));
}

void write_mesh(const std::string& path, const Mesh& mesh, const std::vector<CellField>& fields) {
    call([&] { bridge::write_mesh(text(path), internal::view(mesh), fields_of(fields)); });
}

Mesh read_mesh_bytes(const std::string& extension, const void* bytes, std::size_t size) {
    const rust::Slice<const std::uint8_t> data(static_cast<const std::uint8_t*>(bytes), size);
    return internal::mesh(call([&] { return bridge::read_mesh_bytes(text(extension), data); }));
}

std::vector<std::uint8_t> write_mesh_bytes(const std::string& extension, const Mesh& mesh,
                                           const std::vector<CellField>& fields) {
    const auto write = [&] {
        return bridge::write_mesh_bytes(text(extension), internal::view(mesh), fields_of(fields));
    };
    return internal::vector(call(write));
}

std::vector<std::int8_t> read_labels(const std::string& path, std::size_t face_count) {
    return internal::vector(call([&] { return bridge::read_labels(text(path), face_count); }));
}

void write_labels(const std::string& path, const std::vector<std::int8_t>& labels) {
    call([&] { bridge::write_labels(text(path), slice(labels)); });
}

Mesh boundary(const Mesh& mesh) {
    return internal::mesh(call([&] { return bridge::boundary(internal::view(mesh)); }));
}

std::vector<std::string> example_names() { return internal::strings(bridge::example_names()); }

std::pair<Mesh, Mesh> example(const std::string& name, std::uint64_t seed, CellKind kind) {
    return pair(call([&] { return bridge::example(text(name), seed, static_cast<std::uint8_t>(kind)); }));
}

}  // namespace polycube
