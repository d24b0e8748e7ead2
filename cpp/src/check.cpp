#include <polycube/check.hpp>

#include "bridge.hpp"

namespace polycube {
namespace {

Violation violation(const bridge::ViolationData& data) {
    Violation violation;
    violation.rule = std::string(data.rule);
    violation.in_shape = data.in_shape;
    violation.message = std::string(data.message);
    violation.remedy = std::string(data.remedy);
    violation.place = {static_cast<Element>(data.place.element), data.place.index, data.place.second};
    if (data.at.size() == 3) violation.at = {data.at[0], data.at[1], data.at[2]};
    violation.faces = internal::vector(data.faces);
    return violation;
}

Structure structure(const bridge::StructureData& data) {
    Structure structure;
    for (const auto& level : data.levels) structure.levels.push_back({level.axis, level.coordinate});
    for (const auto& facet : data.facets) structure.facets.push_back({facet.label, facet.level, facet.loops});
    for (const auto& corner : data.corners) structure.corners.push_back({corner.vertex, corner.valence, corner.levels});
    for (const auto& edge : data.edges) {
        structure.edges.push_back({edge.axis, edge.corners, edge.facets, internal::vector(edge.vertices)});
    }
    structure.counts = internal::counts(data.counts);
    structure.components = data.components;
    structure.genus = data.genus;
    structure.deviation_degrees = data.deviation_degrees;
    structure.deviation_distance = data.deviation_distance;
    structure.label_of_face = internal::vector(data.label_of_face);
    structure.facet_of_face = internal::vector(data.facet_of_face);
    structure.patch_of_face = internal::vector(data.patch_of_face);
    structure.block_of_face = internal::vector(data.block_of_face);
    return structure;
}

}  // namespace

Checked check(const Input& input, const Tolerance& tolerance, const Context& context) {
    const auto work = [&](const auto& listener) {
        return bridge::check(internal::view(input), internal::tolerance(tolerance), listener);
    };
    const bridge::CheckedData data = internal::call(context, work);
    Checked checked;
    for (const auto& one : data.violations) checked.violations.push_back(violation(one));
    if (checked.valid()) checked.structure = structure(data.structure);
    return checked;
}

}  // namespace polycube
