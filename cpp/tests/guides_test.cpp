#include <cmath>

#include "helpers.hpp"

using polycube::Checked;
using polycube::ErrorKind;
using polycube::Guides;
using polycube::Input;
using polycube::Mesh;
using polycube::Options;
using polycube::Simplified;

namespace {

Input input() { return {pair().first, pair().second}; }

const polycube::Structure& structure() {
    static const Checked checked = polycube::check(input());
    return *checked.structure;
}

Options with(Guides guides) {
    Options options = quick();
    options.guides = std::move(guides);
    return options;
}

std::int64_t level(const Simplified& result, std::uint32_t facet) {
    return result.levels()[structure().facets[facet].level];
}

bool moved(const Simplified& result, std::uint32_t facet) {
    const double before = structure().levels[structure().facets[facet].level].coordinate * result.report().scale;
    return std::abs(static_cast<double>(level(result, facet)) - before) > 0.5;
}

// Two facets of one axis that the search brings into one plane but that were not in one before.
std::array<std::uint32_t, 2> merged(const Simplified& result) {
    const auto& facets = structure().facets;
    for (std::uint32_t a = 0; a < facets.size(); ++a) {
        for (std::uint32_t b = a + 1; b < facets.size(); ++b) {
            const bool one_axis = facets[a].label / 2 == facets[b].label / 2;
            const double apart =
                structure().levels[facets[a].level].coordinate - structure().levels[facets[b].level].coordinate;
            if (one_axis && apart != 0.0 && level(result, a) == level(result, b)) return {a, b};
        }
    }
    FAIL("nothing was aligned");
    return {};
}

}  // namespace

TEST_CASE("locked facets and the facets of locked faces stay") {
    const Simplified free = polycube::simplify(input(), quick());
    std::uint32_t facet = 0;
    while (!moved(free, facet)) ++facet;
    Guides guides;
    guides.fixed = {facet};
    const Simplified locked = polycube::simplify(input(), with(guides));
    CHECK(!moved(locked, facet));
    Guides by_face;
    for (std::uint32_t face = 0; by_face.empty(); ++face) {
        if (structure().facet_of_face[face] == facet) by_face.fixed_faces = {face};
    }
    CHECK(polycube::simplify(input(), with(by_face)).levels() == locked.levels());
    const auto filtered = polycube::filter::simplify({pair().first, pair().second, {}, by_face.fixed_faces},
                                                     {polycube::RemeshOptions{quick(), {}, 1, false, 0.005}, true});
    CHECK(filtered.simplified.levels() == locked.levels());
}

TEST_CASE("pairs are kept apart or brought together") {
    const std::array<std::uint32_t, 2> facets = merged(polycube::simplify(input(), quick()));
    Guides guides;
    guides.apart = {facets};
    const Simplified apart = polycube::simplify(input(), with(guides));
    CHECK(level(apart, facets[0]) != level(apart, facets[1]));
    Guides group;
    group.together = {{facets[0], facets[1]}};
    const Simplified together = polycube::simplify(input(), with(group));
    CHECK(level(together, facets[0]) == level(together, facets[1]));
    group.apart = guides.apart;
    CHECK_THROWS_AS(polycube::simplify(input(), with(group)), polycube::Error);
}

TEST_CASE("a plane of symmetry is kept") {
    // Seed 0 has all parts aligned and is symmetric about the origin.
    const Mesh mesh = polycube::example("cube-spikes", 0).first;
    Guides guides;
    guides.symmetry = {{0, 0.0}};
    CHECK(polycube::simplify(Input(mesh), with(guides)).valid());
    guides.symmetry = {{0, 7.0}};
    CHECK_THROWS_AS(polycube::simplify(Input(mesh), with(guides)), polycube::Error);
}

TEST_CASE("guides that name nothing are refused") {
    const auto kind = [](const Guides& guides) {
        return error_of([&] { polycube::simplify(input(), with(guides)); }).kind();
    };
    Guides guides;
    guides.fixed = {4000000};
    CHECK(kind(guides) == ErrorKind::option);
    guides = {};
    guides.fixed_faces = {4000000};
    CHECK(kind(guides) == ErrorKind::option);
    guides = {};
    guides.apart = {{0, 4000000}};
    CHECK(kind(guides) == ErrorKind::option);
    guides = {};
    guides.together = {{0, 4000000}};
    CHECK(kind(guides) == ErrorKind::option);
    guides = {};
    guides.symmetry = {{3, 0.0}};
    CHECK(kind(guides) == ErrorKind::option);
    CHECK(Guides{}.empty());
    CHECK(!guides.empty());
}

TEST_CASE("the front is walked without a search, to what a search with that simplicity gives") {
    const Simplified result = polycube::simplify(input(), quick());
    REQUIRE(result.report().front.size() > 1);
    CHECK(result.report().chosen == 0);
    double last = INFINITY;
    for (const double simplicity : {1.0, 0.5, 0.0}) {
        const Simplified point = result.at(input(), simplicity);
        CHECK(point.valid());
        CHECK(point.report().front.size() == result.report().front.size());
        Options options = quick();
        options.simplicity = simplicity;
        CHECK(polycube::simplify(input(), options).polycube().points == point.polycube().points);
        REQUIRE(point.report().chosen);
        const double displacement = point.report().front[*point.report().chosen].displacement;
        CHECK(displacement <= last);
        last = displacement;
    }
    CHECK(error_of([&] { result.at(input(), 2.0); }).kind() == ErrorKind::option);
    CHECK(error_of([&] { result.at(Input(box()), 1.0); }).kind() == ErrorKind::mismatch);
    const polycube::Context context;
    context.cancel();
    CHECK(error_of([&] { result.at(input(), 0.5, context); }).kind() == ErrorKind::cancelled);
    const polycube::filter::Pair document{pair().first, pair().second, {}, {}};
    polycube::filter::Settings settings;
    settings.options.simplify = quick();
    const auto shown = polycube::filter::simplify(document, settings);
    CHECK(polycube::filter::slide(document, shown, 0.0, settings).simplified.levels() ==
          result.at(input(), 0.0).levels());
}

TEST_CASE("a bound on distortion is kept") {
    const Simplified free = polycube::simplify(input(), quick());
    Options options = quick();
    options.max_distortion = free.report().distortion_before->angle + 1e-3;
    const Simplified bounded = polycube::simplify(input(), options);
    CHECK(bounded.report().distortion_after->angle <= free.report().distortion_after->angle);
    options.max_distortion = 0.5;
    CHECK(error_of([&] { polycube::simplify(input(), options); }).kind() == ErrorKind::option);
}
