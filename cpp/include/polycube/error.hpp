/// @file
/// The one exception type: what kind, where, what is wrong, and what to do about it.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace polycube {

/// The closed set of things that can go wrong.
enum class ErrorKind : std::uint8_t {
    io,           ///< A file could not be read, created, written or renamed.
    parse,        ///< A file's text or bytes do not follow its format.
    unsupported,  ///< The format, cell kind or option is not supported.
    mesh,         ///< The mesh cannot be used: empty, NaN, open, non-manifold, badly oriented, indices out of range.
    polycube,     ///< The mesh is not a polycube.
    mismatch,     ///< Shape, labels or result do not belong to the polycube.
    option,       ///< An option is out of its range or contradicts another.
    infeasible,   ///< No integer polycube satisfies the constraints.
    cancelled,    ///< The caller cancelled.
    internal,     ///< A fault of this library, such as a panic of the core.
};

/// The name of a kind as reports write it, such as "mesh".
const char* name_of(ErrorKind kind) noexcept;

/// What a `Place` names. Elements count from 0 in the mesh as given, lines from 1.
enum class Element : std::uint8_t {
    none,           ///< No element in particular.
    vertex,         ///< A vertex of the mesh.
    edge,           ///< A mesh edge, by its two vertices.
    face,           ///< A boundary face; of a surface mesh these are its cells.
    cell,           ///< A cell of the mesh.
    polycube_edge,  ///< An edge of the structure.
    facet,          ///< A facet of the structure.
    line,           ///< A line of a text file.
};

/// The element that an error is about.
struct Place {
    Element element = Element::none;
    /// Its number; of a mesh edge its first vertex.
    std::uint64_t index = 0;
    /// The second vertex of a mesh edge, otherwise 0.
    std::uint64_t second = 0;
};

/// "vertex 5", "edge 3-8"; empty for `Element::none`.
std::string to_string(const Place& place);

/// What every function of this library throws. `what()` is place, message and remedy in one line.
class Error : public std::runtime_error {
 public:
    Error(ErrorKind kind, const Place& place, const std::string& message, const std::string& remedy = {});
    /// An error without a place.
    Error(ErrorKind kind, const std::string& message, const std::string& remedy = {});

    /// Which of the closed set of kinds this is.
    ErrorKind kind() const noexcept { return kind_; }
    /// The element concerned.
    const Place& place() const noexcept { return place_; }
    /// What is wrong, in plain words.
    const std::string& message() const noexcept { return message_; }
    /// What the user can do about it; empty where nothing can be advised.
    const std::string& remedy() const noexcept { return remedy_; }

 private:
    ErrorKind kind_;
    Place place_;
    std::string message_;
    std::string remedy_;
};

}  // namespace polycube
