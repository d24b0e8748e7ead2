#include <algorithm>
#include <cmath>

#include "bridge.hpp"
#include "helpers.hpp"

using polycube::Counts;
using polycube::Error;
using polycube::ErrorKind;
using polycube::Input;
using polycube::Mesh;
using polycube::Simplified;
using polycube::Strategy;

namespace {

Input input() { return {pair().first, pair().second}; }

}  // namespace

TEST_CASE("the defaults are those of the core") {
    using namespace polycube::bridge;
    const RemeshOptionsData core = default_remesh_options();
    const polycube::RemeshOptions own;
    CHECK(core.padding == own.padding);
    CHECK(core.surface_only == own.surface_only);
    CHECK(core.max_hausdorff == own.max_hausdorff);
    CHECK(core.has_size == own.size.has_value());
    const OptionsData ours = polycube::internal::options(own.simplify);
    for (const OptionsData& theirs : {default_options(), core.simplify}) {
        CHECK(ours.strategy == theirs.strategy);
        CHECK(ours.lambda_min == theirs.lambda_min);
        CHECK(ours.solver == theirs.solver);
        CHECK(ours.has_objective == theirs.has_objective);
        CHECK(ours.steps_per_level == theirs.steps_per_level);
        CHECK(ours.proof_nodes == theirs.proof_nodes);
        CHECK(ours.no_repair == theirs.no_repair);
        CHECK(ours.tolerance.degrees == theirs.tolerance.degrees);
        CHECK(ours.tolerance.distance == theirs.tolerance.distance);
        CHECK(ours.tolerance.merge == theirs.tolerance.merge);
        CHECK(ours.scale.some == theirs.scale.some);
        CHECK(ours.time_limit.some == theirs.time_limit.some);
        CHECK(ours.simplicity.some == theirs.simplicity.some);
        CHECK(ours.max_displacement.some == theirs.max_displacement.some);
        CHECK(ours.max_distortion.some == theirs.max_distortion.some);
    }
}

TEST_CASE("a polycube becomes coarser and stays one") {
    const Simplified result = polycube::simplify(input(), quick());
    const polycube::Report& report = result.report();
    REQUIRE(result.valid());
    REQUIRE(report.after);
    CHECK(report.after->surface_patches < report.before.surface_patches);
    CHECK(report.after->blocks_padded < report.before.blocks_padded);
    CHECK(report.before.blocks_padded > report.before.blocks);
    CHECK(report.max_displacement > 0.0);
    CHECK(report.seconds.total > 0.0);
    CHECK(report.distortion_before->angle >= 1.0);
    CHECK(report.distortion_after->angle >= 1.0);
    REQUIRE(report.bound);
    CHECK(report.bound->count <= report.after->surface_patches);
    CHECK(result.polycube().cells == pair().first.cells);
    CHECK(result.report_json().find("\"surface_patches\": " + std::to_string(report.after->surface_patches)) !=
          std::string::npos);
    // With its labels it is read again. What is wrong with its mesh are the elements that the report lists.
    Input written(result.polycube());
    written.labels = &result.labels();
    std::vector<std::uint32_t> flipped;
    const std::vector<polycube::Violation> violations = polycube::check(written).violations;
    for (const polycube::Violation& violation : violations) {
        CHECK(violation.rule == "flipped_face");
        flipped.push_back(static_cast<std::uint32_t>(violation.place.index));
    }
    CHECK(flipped == report.flipped_faces);
    // It has the counts that the report says, on integers, so that rounding changes nothing.
    polycube::Options naive;
    naive.strategy = Strategy::naive;
    const Simplified again = polycube::simplify(written, naive);
    CHECK(again.report().before.surface_patches == report.after->surface_patches);
    CHECK(again.report().before.blocks_padded == report.after->blocks_padded);
    CHECK(again.report().max_displacement == 0.0);
    CHECK(again.levels() == result.levels());
}

TEST_CASE("every face has its label, facet, patch and block") {
    const Simplified result = polycube::simplify(input(), quick());
    const std::size_t faces = pair().first.cell_count();
    CHECK(result.labels().size() == faces);
    CHECK(result.facet_of_face().size() == faces);
    REQUIRE(result.patch_of_face().size() == faces);
    REQUIRE(result.block_of_face().size() == faces);
    CHECK(*std::max_element(result.patch_of_face().begin(), result.patch_of_face().end()) <
          result.report().after->surface_patches);
    CHECK(*std::max_element(result.block_of_face().begin(), result.block_of_face().end()) <
          result.report().after->blocks);
}

TEST_CASE("another scale has the same blocks") {
    const Simplified result = polycube::simplify(input(), quick());
    const Simplified finer = result.rescaled(input(), 3.0 * result.report().scale);
    CHECK(finer.report().scale == 3.0 * result.report().scale);
    CHECK(finer.report().after->blocks_padded == result.report().after->blocks_padded);
    CHECK(finer.polycube().points != result.polycube().points);
    CHECK(error_of([&] { result.rescaled(input(), -1.0); }).kind() == ErrorKind::option);
    CHECK(error_of([&] { result.rescaled(Input(box()), 1.0); }).kind() == ErrorKind::mismatch);
}

TEST_CASE("naive rounding that breaks is told") {
    // Two floors a fifth of a step apart, over each other.
    const Mesh mesh = polycube::example("double-torus", 1).first;
    polycube::Options options;
    options.strategy = Strategy::naive;
    options.scale = 0.05;
    const Simplified result = polycube::simplify(Input(mesh), options);
    REQUIRE(!result.valid());
    CHECK(!result.report().after);
    CHECK(!result.report().notes.empty());
    CHECK(result.patch_of_face().empty());
    CHECK(error_of([&] { result.polycube(); }).kind() == ErrorKind::polycube);
}

TEST_CASE("strategies, objectives and solvers arrive") {
    polycube::Options options = quick();
    options.strategy = Strategy::paper;
    options.lambda_min = 1.0;
    const Simplified one = polycube::simplify(input(), options);
    CHECK(one.report().rounds.size() >= 1);
    CHECK(one.report().rounds[0].lambda == 1.0);
    CHECK(one.report().front.empty());
    options = quick();
    options.objective = polycube::Objective::blocks;
    options.max_displacement = 0.6;
    const Simplified near = polycube::simplify(input(), options);
    CHECK(!near.report().front.empty());
    options.max_displacement.reset();
    CHECK(near.report().max_displacement <= polycube::simplify(input(), options).report().max_displacement);
}

TEST_CASE("the same input gives the same bytes") {
    const Simplified a = polycube::simplify(input(), quick()), b = polycube::simplify(input(), quick());
    CHECK(a.polycube().points == b.polycube().points);
    CHECK(a.levels() == b.levels());
}

TEST_CASE("given labels decide") {
    const std::vector<std::int8_t> labels = polycube::check(input()).structure->label_of_face;
    Input labelled = input();
    labelled.labels = &labels;
    CHECK(polycube::simplify(labelled, quick()).levels() == polycube::simplify(input(), quick()).levels());
    const std::vector<std::int8_t> wrong(labels.size(), 0);
    labelled.labels = &wrong;
    CHECK(error_of([&] { polycube::simplify(labelled); }).kind() == ErrorKind::polycube);
}

TEST_CASE("a copy of a result outlives it") {
    std::optional<Simplified> result = polycube::simplify(Input(box()));
    const Simplified copy = *result;
    result.reset();
    CHECK(copy.report().after->blocks == 1);
    CHECK(copy.polycube().points == box().points);
}
