#include <polycube/simplify.hpp>

#include "bridge.hpp"

namespace polycube {

bool Guides::empty() const noexcept {
    return fixed.empty() && fixed_faces.empty() && together.empty() && apart.empty() && symmetry.empty();
}

namespace internal {

Distortion distortion(const bridge::DistortionData& data) noexcept {
    return {data.angle, data.size, data.worst_angle, data.worst_size, data.worst_cell};
}

namespace {

bridge::GuidesData guides(const Guides& guides) {
    bridge::GuidesData data;
    for (const std::uint32_t facet : guides.fixed) data.fixed.push_back(facet);
    for (const std::uint32_t face : guides.fixed_faces) data.fixed_faces.push_back(face);
    for (const std::vector<std::uint32_t>& group : guides.together) {
        for (const std::uint32_t facet : group) data.together.push_back(facet);
        data.together_ends.push_back(data.together.size());
    }
    for (const auto& [first, second] : guides.apart) data.apart.push_back({first, second});
    for (const auto& [axis, at] : guides.symmetry) data.symmetry.push_back({axis, at});
    return data;
}

Report report(const bridge::ReportData& data) {
    Report report;
    report.scale = data.scale;
    report.valid = data.valid;
    report.before = counts(data.before);
    if (data.valid) report.after = counts(data.after);
    for (const auto& r : data.rounds) report.rounds.push_back({r.lambda, r.pairs, r.alignments, counts(r.counts)});
    for (const auto& t : data.front) report.front.push_back({t.count, t.displacement});
    if (data.has_chosen) report.chosen = data.chosen;
    if (data.has_bound) report.bound = LowerBound{data.bound, data.proven};
    report.seconds = {data.seconds.structure, data.seconds.align, data.seconds.morph, data.seconds.total};
    report.max_displacement = data.max_displacement;
    report.flipped_cells = vector(data.flipped_cells);
    report.flipped_faces = vector(data.flipped_faces);
    report.deviation_degrees = data.deviation_degrees;
    report.deviation_distance = data.deviation_distance;
    if (data.distortion.size() == 2) {
        report.distortion_before = distortion(data.distortion[0]);
        report.distortion_after = distortion(data.distortion[1]);
    }
    report.notes = strings(data.notes);
    return report;
}

}  // namespace

bridge::InputView view(const Input& input) {
    if (input.polycube == nullptr) throw Error(ErrorKind::option, "there is no polycube", "set Input::polycube");
    const Mesh& shape = input.shape == nullptr ? *input.polycube : *input.shape;
    static const std::vector<std::int8_t> none;
    const std::vector<std::int8_t>& labels = input.labels == nullptr ? none : *input.labels;
    return {view(*input.polycube), input.shape != nullptr, view(shape), input.labels != nullptr, slice(labels)};
}

Counts counts(const bridge::CountsData& data) noexcept {
    return {data.surface_patches, data.blocks, data.blocks_padded};
}

bridge::ToleranceData tolerance(const Tolerance& tolerance) noexcept {
    return {tolerance.degrees, tolerance.distance, tolerance.merge};
}

bridge::OptionsData options(const Options& options) {
    bridge::OptionsData data;
    data.strategy = static_cast<std::uint8_t>(options.strategy);
    data.scale = real(options.scale);
    data.lambda_min = options.lambda_min;
    data.solver = static_cast<std::uint8_t>(options.solver);
    data.has_objective = options.objective.has_value();
    data.objective = static_cast<std::uint8_t>(options.objective.value_or(Objective::blocks_padded));
    data.steps_per_level = options.effort.steps_per_level;
    data.proof_nodes = options.effort.proof_nodes;
    data.time_limit = real(options.effort.time_limit);
    data.simplicity = real(options.simplicity);
    data.max_displacement = real(options.max_displacement);
    data.max_distortion = real(options.max_distortion);
    data.no_repair = options.no_repair;
    data.tolerance = tolerance(options.tolerance);
    data.guides = guides(options.guides);
    return data;
}

Simplified simplified(rust::Box<bridge::Simplified> core) {
    const bridge::SimplifiedData data = call([&] { return core->data(); });
    Simplified::State state{
        std::move(core),           report(data.report), std::string(data.report_json), mesh(data.polycube),
        vector(data.levels),       vector(data.labels), vector(data.facet_of_face),    vector(data.patch_of_face),
        vector(data.block_of_face)};
    return Simplified(std::make_shared<const Simplified::State>(std::move(state)));
}

}  // namespace internal

const Report& Simplified::report() const noexcept { return state_->report; }
const std::string& Simplified::report_json() const noexcept { return state_->json; }
const std::vector<std::int64_t>& Simplified::levels() const noexcept { return state_->levels; }
const std::vector<std::int8_t>& Simplified::labels() const noexcept { return state_->labels; }
const std::vector<std::uint32_t>& Simplified::facet_of_face() const noexcept { return state_->facet_of_face; }
const std::vector<std::uint32_t>& Simplified::patch_of_face() const noexcept { return state_->patch_of_face; }
const std::vector<std::uint32_t>& Simplified::block_of_face() const noexcept { return state_->block_of_face; }

const Mesh& Simplified::polycube() const {
    if (valid()) return state_->polycube;
    throw Error(ErrorKind::polycube, "rounding to the lattice broke the polycube",
                "use the strategy best or paper, or a finer lattice");
}

Simplified Simplified::at(const Input& input, double simplicity, const Context& context) const {
    const auto work = [&](const auto& listener) {
        return state_->core->at(internal::view(input), simplicity, listener);
    };
    return internal::simplified(internal::call(context, work));
}

Simplified Simplified::rescaled(const Input& input, double scale, const Context& context) const {
    const auto work = [&](const auto& listener) {
        return state_->core->rescaled(internal::view(input), scale, listener);
    };
    return internal::simplified(internal::call(context, work));
}

Simplified simplify(const Input& input, const Options& options, const Context& context) {
    const bridge::OptionsData data = internal::options(options);
    const auto work = [&](const auto& listener) { return bridge::simplify(internal::view(input), data, listener); };
    return internal::simplified(internal::call(context, work));
}

}  // namespace polycube
