#include <array>
#include <polycube/error.hpp>
#include <polycube/polycube.hpp>

#include "bridge.hpp"

namespace polycube {
namespace {

std::string whole(const Place& place, const std::string& message, const std::string& remedy) {
    const std::string where = to_string(place);
    return (where.empty() ? "" : where + ": ") + message + (remedy.empty() ? "" : " (" + remedy + ")");
}

constexpr std::array<const char*, 10> kind_names = {"io",       "parse",  "unsupported", "mesh",      "polycube",
                                                    "mismatch", "option", "infeasible",  "cancelled", "internal"};
constexpr std::array<const char*, 8> element_names = {"",     "vertex",        "edge",  "face",
                                                      "cell", "polycube edge", "facet", "line"};

// The parts of a text between separators.
std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

}  // namespace

const char* name_of(ErrorKind kind) noexcept { return kind_names[static_cast<std::size_t>(kind)]; }

std::string to_string(const Place& place) {
    if (place.element == Element::none) return {};
    const std::string text =
        element_names[static_cast<std::size_t>(place.element)] + (" " + std::to_string(place.index));
    return place.element == Element::edge ? text + "-" + std::to_string(place.second) : text;
}

Error::Error(ErrorKind kind, const Place& place, const std::string& message, const std::string& remedy)
    : std::runtime_error(whole(place, message, remedy)),
      kind_(kind),
      place_(place),
      message_(message),
      remedy_(remedy) {}

Error::Error(ErrorKind kind, const std::string& message, const std::string& remedy)
    : Error(kind, Place{}, message, remedy) {}

const char* version() noexcept {
    static const std::string text(bridge::version());
    return text.c_str();
}

namespace internal {

Error decode(const rust::Error& error) {
    const std::vector<std::string> parts = split(error.what(), '\x1f');
    if (parts.size() != 6) return {ErrorKind::internal, error.what()};
    const Place place{static_cast<Element>(std::stoul(parts[1])), std::stoull(parts[2]), std::stoull(parts[3])};
    return {static_cast<ErrorKind>(std::stoul(parts[0])), place, parts[4], parts[5]};
}

rust::Str text(const std::string& text) {
    try {
        return text;
    } catch (const std::invalid_argument&) {
        throw Error(ErrorKind::option, "a text is not UTF-8", "convert names and paths to UTF-8");
    }
}

std::vector<std::string> strings(const rust::Vec<rust::String>& values) {
    std::vector<std::string> result;
    for (const rust::String& value : values) result.emplace_back(value);
    return result;
}

}  // namespace internal
}  // namespace polycube
