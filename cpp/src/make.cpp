#include <algorithm>
#include <iterator>
#include <polycube/make.hpp>

#include "bridge.hpp"

namespace polycube {
namespace internal {

bridge::MakeOptionsData options(const MakeOptions& options) {
    bridge::MakeOptionsData data = {options.detail, options.corners.has_value(), options.corners.value_or(0),
                                    options.axes == Axes::best, options.labels.has_value(), {}, options.no_repair};
    if (options.labels) std::copy(options.labels->begin(), options.labels->end(), std::back_inserter(data.labels));
    return data;
}

Made made(const bridge::MadeData& data) {
    MakeReport report;
    report.repairs = strings(data.repairs);
    report.corners = data.corners;
    report.edges = data.edges;
    report.facets = data.facets;
    report.genus = data.genus;
    report.added = data.added;
    report.misfit = data.misfit;
    report.squashed = data.squashed;
    if (!data.distortion.empty()) report.distortion = distortion(data.distortion[0]);
    report.folded = vector(data.folded);
    report.seconds = data.seconds;
    return {mesh(data.polycube), mesh(data.shape), vector(data.labels), std::move(report),
            std::string(data.report_json)};
}

}  // namespace internal

Made make(const Mesh& shape, const MakeOptions& options, const Context& context) {
    const bridge::MakeOptionsData data = internal::options(options);
    const auto work = [&](const auto& listener) { return bridge::make(internal::view(shape), data, listener); };
    return internal::made(internal::call(context, work));
}

}  // namespace polycube
