// Hard cases of matter through both passes on every kind of rung, against exact optical depths. Those of light are in
// hard_cases_light_test.cpp; each row is named after the one of the table in core/README.md that it covers.
#include "tests/hard_cases.h"

#include <random>

namespace awan {
namespace {

using test::Ball;
using test::HardCase;

const double kPerDepth = 1 / std::sqrt(2 * std::numbers::pi);  // density x s for optical depth 1

SceneDraft picture(const std::vector<Ball>& list, int width = 24, int height = 18) {
    SceneDraft draft = test::balls(list);
    draft.image.background = Background::kTransparent;
    draft.image.width = width;
    draft.image.height = height;
    return draft;
}

// A ball of radius 2 s = 4 whose middle has this optical depth, seen from 20.
SceneDraft deep(double depth) {
    SceneDraft draft = picture({{{0, 0, 0}, 4, 1}});
    draft.density = depth * kPerDepth / 2;
    return draft;
}

SceneDraft seen_from(SceneDraft draft, glm::dvec3 eye, glm::dvec3 target, double fov = 40) {
    draft.camera.eye = eye;
    draft.camera.target = target;
    draft.camera.fov = fov;
    return draft;
}

SceneDraft sized(SceneDraft draft, int width, int height) {
    draft.image.width = width;
    draft.image.height = height;
    return draft;
}

SceneDraft moved(SceneDraft draft, glm::dvec3 by) {
    for (glm::dvec3& p : draft.clouds[0].ready.positions) p += by;
    draft.camera.eye += by;
    draft.camera.target += by;
    return draft;
}

const std::vector<Ball>& some_balls() {
    static const std::vector<Ball> list = {
        {{0, 0, 0}, 4, 0.5}, {{3, 1, -2}, 2, 3}, {{-2, -1, 5}, 1, 0.2}};
    return list;
}

// `count` flat layers along the view, nearest first or last, of optical depth `depth` in all at the picture's middle.
SceneDraft layers(int count, double depth) {
    std::vector<Ball> list;
    for (int i = 0; i < count; ++i)
        list.push_back({{0, 0, 5 - 10.0 * i / count}, 6, depth * kPerDepth / 3 / count});
    SceneDraft draft = picture(list, 4, 3);
    draft.camera.fov = 15;  // each layer is wider than a pixel
    return draft;
}

// Uniformly filled, 10 x 10 and 1e-6 thick. Radii are drawn from 0 up: the smallest particles are widened to .6 pixels.
SceneDraft slab(int particles, double radius) {
    SceneDraft draft = picture({});
    Cloud& cloud = draft.clouds[0];
    cloud = {};
    cloud.cubes.push_back(
        {static_cast<std::uint64_t>(particles), {10, 1e-6, 10}, {0, 0, 0}, radius, 1, {}});
    cloud.density = 0.3 / radius;
    return draft;
}

SceneDraft cube_of(std::uint64_t particles, double radius, double density, int width, int height) {
    SceneDraft draft = slab(1, 1);
    draft.clouds[0].cubes[0] = {particles, {8, 8, 8}, {0, 0, 0}, radius, 1, {}};
    draft.clouds[0].density = density;
    draft.image.width = width;
    draft.image.height = height;
    return draft;
}

SceneDraft coincident(int count) {
    std::vector<Ball> list;
    for (int i = 0; i < count; ++i)
        list.push_back({{0, 0, 0}, 4, 2. / count, glm::vec3(i < count / 2 ? 1 : 0)});
    return picture(list);
}

const std::vector<HardCase> kCases = {
    {"huge tau", "tau_1e2", [] { return deep(1e2); }},
    {"huge tau", "tau_1e4", [] { return sized(deep(1e4), 8, 6); }},
    {"huge tau", "tau_1e12",
     [] {
         return sized(seen_from(picture({{{0, 0, 0}, 1e6, 1e6}}), {0, 0, 4e6}, {0, 0, 0}), 4, 3);
     }},
    {"tiny tau", "tau_1e_12", [] { return deep(1e-12); }, {.alpha_splats = 0}},
    {"tiny tau", "tau_1e_8", [] { return deep(1e-8); }, {.alpha_splats = 0}},
    {"tiny tau", "tau_1e_6", [] { return deep(1e-6); }, {.alpha_splats = .1}},
    {
        "tiny tau",
        "tau_1e_3",
        [] { return deep(1e-3); },
    },
    {"closest approach b^2", "at_distance_1e4",
     [] {
         return seen_from(picture(some_balls()), {0, 0, 1e4}, {0, 0, 0}, .06);
     }},
    {"closest approach b^2", "at_distance_9e8",
     [] {
         return seen_from(picture({{{0, 0, 0}, 2e5, 1e-5}}), {0, 0, 9e8}, {0, 0, 0}, .06);
     }},
    {"camera in or at a particle", "at_the_centre",
     [] {
         return seen_from(picture({{{0, 0, 0}, 4, .5}}), {0, 0, 0}, {0, 0, -1});
     }},
    {"camera in or at a particle", "a_hair_from_the_centre",
     [] {
         return seen_from(picture({{{0, 0, 0}, 4, .5}}), {1e-9, 0, 1e-9}, {0, 0, -1}, 120);
     }},
    {"camera in or at a particle", "one_s_before_it",
     [] {
         return seen_from(picture(some_balls()), {0, 0, 2}, {0, 0, 0}, 100);
     }},
    {"camera in or at a particle", "one_s_behind_it",
     [] {
         return seen_from(picture(some_balls()), {0, .5, -2}, {0, .5, -9}, 100);
     }},
    {"camera in or at a particle", "at_one_of_radius_1e_6",
     [] {
         return seen_from(picture({{{0, 0, 0}, 1e-6, 1e6}, {{0, 0, 0}, 3, 1}}), {0, 0, 0},
                          {0, 0, -1});
     }},
    {"radius 0, 1e-23, 1e20", "radius_1e_6",
     [] {
         return seen_from(picture({{{0, 0, 0}, 1e-6, 1e6}}), {0, 0, 1e-5}, {0, 0, 0});
     }},
    {"radius 0, 1e-23, 1e20", "radius_1e6",
     [] {
         return seen_from(picture({{{0, 0, 0}, 1e6, 1e-6}}), {0, 0, 5e6}, {0, 0, 0});
     }},
    {"radius 0, 1e-23, 1e20",
     "radii_1e_6_to_1e6",
     [] {
         return picture({{{0, 0, 0}, 1e-6, 1e5},
                         {{1, 0, 0}, 1, 1},
                         {{-1, 0, 0}, 1e-3, 10},
                         {{0, 2, 0}, 1e3, 1e-4},
                         {{0, 2, 0}, 1e6, 1e-7}});
     },
     {.alpha_splats = 2e-3}},
    {"radius 0, 1e-23, 1e20",
     "specks_of_a_thousandth_of_a_pixel",
     [] { return cube_of(3000, 1e-3, 100, 24, 18); },
     // The oracle's own rays miss them (sub_pixel_test).
     {.alpha_splats = 0, .alpha_march = 0, .alpha_truth = 0}},
    {"coordinates offset by 1e6..1e9", "offset_1e6",
     [] {
         return moved(picture(some_balls()), {1e6, -1e6, 1e6});
     }},
    {"coordinates offset by 1e6..1e9", "offset_9e8",
     [] {
         return moved(picture(some_balls()), {9e8, 9e8, -9e8});
     }},
    {"coordinates offset by 1e6..1e9", "neighbours_2e9_apart",
     [] {
         return picture({{{1e9, 0, 0}, 1, 1}, {{-1e9, 0, 0}, 1, 1}, {{0, 0, 0}, 4, 1}});
     }},
    {"thousands coincident",
     "coincident_4000",
     [] { return coincident(4000); },
     {.alpha_march = 3e-3}},
    {"slab 1e-6 thick",
     "grazing_in_the_plane",
     [] {
         return seen_from(sized(slab(300, .5), 96, 72), {0, 0, 9}, {0, 0, 0});
     },
     {.alpha_splats = 5e-3}},
    {"slab 1e-6 thick",
     "grazing_1e_6_above",
     [] {
         return seen_from(sized(slab(300, .5), 96, 72), {0, 1e-6, 5}, {0, 0, 0});
     },
     {.alpha_splats = 5e-3}},
    {"slab 1e-6 thick",
     "particles_thinner_than_it",
     [] {
         return seen_from(slab(3000, 1e-6), {0, 1, 5}, {0, 0, 0});
     },
     {.alpha_splats = 0, .alpha_march = 0, .alpha_truth = 0}},
    {"slab 1e-6 thick",
     "from_above",
     [] {
         SceneDraft draft = seen_from(sized(slab(300, .5), 96, 72), {0, 9, 0}, {0, 0, 0});
         draft.camera.up = {0, 0, 1};
         return draft;
     },
     {.alpha_splats = .06, .alpha_march = .06}},
    {"segment OD by 1 - erf",
     "5_5_s_behind_the_eye",
     [] {
         return seen_from(picture({{{0, 0, 0}, 2, 1e6}}), {0, 0, -5.5}, {0, 0, -9});
     },
     {.alpha_splats = .1, .alpha_march = .05}},
    {"segment OD by 1 - erf",
     "3_s_behind_the_eye",
     [] {
         return seen_from(picture({{{0, 0, 0}, 2, 100}}), {0, 0, -3}, {0, 0, -9});
     },
     {.alpha_splats = .01, .alpha_march = .01}},
    {"rejection with p = 1e-6", "a_dense_speck_in_a_thin_ball",
     [] {
         return seen_from(picture({{{0, 0, 0}, 8, .1}, {{1, 0, 0}, .1, 1e5}}), {0, 0, 20},
                          {1, 0, 0}, 1);
     }},
    {"rejection with p = 1e-6",
     "printed_fill_that_misses_its_cube",
     [] {
         SceneDraft draft = cube_of(300, 1, .5, 400, 300);
         draft.clouds[0].fill = Fill::kPrinted;
         draft.clouds[0].cubes[0].size = {1e-3, 1e-3, 8};
         return draft;
     },
     {.alpha_splats = .04, .alpha_march = .01}},
    {"Gaussian cut at r = 2s", "its_edge",
     [] {
         return seen_from(picture({{{0, 0, 0}, 4, .5}}, 64, 1), {0, 0, 40}, {0, 0, 0}, .5);
     }},
    {"Gaussian cut at r = 2s",
     "many_edges",
     [] { return cube_of(2000, 1, .2, 200, 150); },
     {.alpha_splats = 5e-3, .alpha_march = 2e-3}},
    {"N thin layers, tau = 1, blended",
     "1e5_layers_tau_1",
     [] { return layers(test::or_fewer(100'000, 2'000), 1); },
     {.alpha_splats = 3e-3, .alpha_march = 2e-3}},
    {"N thin layers, tau = 1, blended",
     "1e5_layers_tau_50",
     [] { return layers(test::or_fewer(100'000, 2'000), 50); },
     {.alpha_splats = 3e-3, .alpha_march = 2e-3}},
    {"-",
     "no_particle",
     [] { return picture({}); },
     {.alpha_splats = 0, .alpha_march = 0, .alpha_truth = 0}},
    {"-", "density_0", [] { return deep(0); }, {}},
    {"-", "one_particle", [] { return deep(1); }},
    {"-",
     "a_million_particles",
     [] {
         return seen_from(cube_of(test::or_fewer(1'000'000u, 100'000u), .16, .3, 6, 4), {0, 0, 20},
                          {0, 0, 0}, 1);
     },
     {.alpha_splats = .01, .alpha_march = .01}},
    {"-", "all_behind_the_eye",
     [] {
         return seen_from(picture({{{0, 0, 30}, 1, 1}, {{4, 4, 25}, 2, 1}}), {0, 0, 0}, {0, 0, -1});
     }},
    {"-", "one_fills_space",
     [] {
         return seen_from(picture({{{0, 0, 0}, 1e6, 3e-6}}), {3, 4, 5}, {0, 0, 0}, 90);
     }},
    {"-", "picture_1x1",
     [] {
         return seen_from(sized(deep(1), 1, 1), {0, 0, 20}, {0, 0, 0}, 5);
     }},
    {"-", "picture_1x8192", [] { return sized(deep(1), 1, 8192); }},
    {"-", "picture_8192x16", [] { return sized(deep(1), 8192, 16); }},
    {"-", "fov_0_01",
     [] {
         return seen_from(deep(1), {0, 0, 2e4}, {0, 0, 0}, .01);
     }},
    {"-", "fov_170",
     [] {
         return seen_from(sized(deep(1), 128, 96), {0, 0, 3}, {0, 0, 0}, 170);
     }},
    {"-",
     "fov_170_among_many",
     [] {
         return seen_from(cube_of(300, 1.5, .3, 320, 240), {0, 0, 0}, {1, 1, 1}, 170);
     },
     {.alpha_splats = 5e-3, .alpha_march = 5e-3}},
};

class Matter : public ::testing::TestWithParam<test::CaseOnRung> {};
TEST_P(Matter, IsAsDeepAsItIs) {
    test::expect_hard_case(*GetParam().hard, GetParam().rung);
}
INSTANTIATE_TEST_SUITE_P(HardCases, Matter, ::testing::ValuesIn(test::on_all_rungs(kCases)),
                         test::name_of);

// --- two pictures that must be one

double largest_difference(const Image& a, const Image& b) {
    double worst = 0, brightest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        worst = std::max(worst, static_cast<double>(std::abs(a.pixels[i] - b.pixels[i])));
        brightest = std::max(brightest, static_cast<double>(a.pixels[i]));
    }
    return worst / brightest;
}

struct Pair {
    const char* name;
    std::function<SceneDraft()> one, other;
    double bound_splats, bound_march;  // of the brightest sample
};
struct PairOnRung {
    const Pair* pair;
    const char* rung;
};
void PrintTo(const PairOnRung& which, std::ostream* out) {
    *out << which.pair->name << " / " << which.rung;
}

SceneDraft shuffled(bool turned) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-4, 4);
    std::vector<Ball> list;
    for (int i = 0; i < 200; ++i) {
        list.push_back({{place(random), place(random), place(random)}, 1 + .2 * place(random), 1});
        if (i % 4 == 0) list.push_back(list.back());  // ties
    }
    if (turned) std::shuffle(list.begin(), list.end(), random);
    return picture(list);
}

SceneDraft twins(bool swapped) {
    // As far from the eye, overlapping, black and white.
    std::vector<Ball> list = {{{1, 0, 0}, 4, 1, glm::vec3(1)}, {{-1, 0, 0}, 4, 1, glm::vec3(0)}};
    if (swapped) std::swap(list[0], list[1]);
    return picture(list);
}

const std::vector<Pair> kPairs = {
    {"ties_in_another_order", [] { return shuffled(false); }, [] { return shuffled(true); }, 1e-5,
     1e-5},
    // Splats have no order of their own at one distance: what they make of it is bounded by what one hides of the
    // other.
    {"twins_in_another_order", [] { return twins(false); }, [] { return twins(true); }, .5, 1e-5},
    {"offset_9e8_is_the_same_picture", [] { return picture(some_balls()); },
     [] {
         return moved(picture(some_balls()), {9e8, 9e8, -9e8});
     },
     2e-6, 2e-5},
    // Each of them is cut where it is faint by itself, at 3.5 s; the one deep ball is not.
    {"coincident_4000_are_one_of_the_mean_colour", [] { return coincident(4000); },
     [] {
         return picture({{{0, 0, 0}, 4, 2, glm::vec3(.5)}});
     },
     // Rounding may decide which pixels are sharp enough for more rays.
     2e-2, 1e-2},
};

std::vector<PairOnRung> pairs_on_rungs() {
    std::vector<PairOnRung> all;
    for (const Pair& pair : kPairs)
        for (const char* rung : {"harris", "single", "transport-16", "transport-24"})
            all.push_back({&pair, rung});
    return all;
}

class SamePicture : public ::testing::TestWithParam<PairOnRung> {};
TEST_P(SamePicture, WithinRounding) {
    const auto [pair, rung] = GetParam();
    const double bound =
        find_rung(rung)->method == Method::kSplats ? pair->bound_splats : pair->bound_march;
    EXPECT_LE(largest_difference(test::render_on(pair->one(), rung, 2).rendered.image,
                                 test::render_on(pair->other(), rung, 2).rendered.image),
              bound);
}
INSTANTIATE_TEST_SUITE_P(HardCases, SamePicture, ::testing::ValuesIn(pairs_on_rungs()),
                         [](const auto& info) {
                             std::string name =
                                 std::string(info.param.pair->name) + "__" + info.param.rung;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// Rows whose stable form is to refuse.
TEST(HardCases, WhatCannotBeIsRefused) {
    const auto refused = [](const char* what, const std::function<void(SceneDraft&)>& change) {
        SceneDraft draft = picture({{{0, 0, 0}, 4, 1}});
        change(draft);
        EXPECT_FALSE(validate(draft).ok()) << what;
    };
    const auto radius = [](float r) {
        return [r](SceneDraft& draft) { draft.clouds[0].ready.radii[0] = r; };
    };
    refused("radius 0", radius(0));
    refused("radius 1e-23", radius(1e-23F));
    refused("radius 1e20", radius(1e20F));
    refused("NaN radius", radius(NAN));
    refused("NaN or ties in a sort: NaN position",
            [](SceneDraft& draft) { draft.clouds[0].ready.positions[0].x = NAN; });
    refused("NaN density", [](SceneDraft& draft) { draft.clouds[0].ready.densities[0] = NAN; });
    refused("Henyey-Greenstein g = 1", [](SceneDraft& draft) { draft.medium.g = 1; });
    refused("Henyey-Greenstein g = -1", [](SceneDraft& draft) { draft.medium.g = -1; });
}

}  // namespace
}  // namespace awan
