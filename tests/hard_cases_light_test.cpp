// Hard cases of light through both passes on every kind of rung: sunlight scattered once by quadrature where matter is
// thin or the rung is `single`, a furnace and the bounds of tests/physical_bounds.h elsewhere. Rows: see
// hard_cases_test.cpp.
#include "tests/hard_cases.h"

namespace awan {
namespace {

using test::Ball;
using test::HardCase;

const double kPerDepth = 1 / std::sqrt(2 * std::numbers::pi);  // density x s for optical depth 1

struct Lit {
    double depth = 1e-3;  // of the ball's middle
    double g = .85;
    glm::dvec3 sun{.6, .7, .4};
    PhaseFunction phase = PhaseFunction::kHenyeyGreenstein;
    double albedo = 1;
};

// One ball of s = 2 in the sun, seen from 20 along -z.
SceneDraft ball(const Lit& lit, int width = 16, int height = 12) {
    SceneDraft draft = test::balls({{{0, 0, 0}, 4, lit.depth * kPerDepth / 2}});
    draft.image.background = Background::kTransparent;
    draft.image.width = width;
    draft.image.height = height;
    draft.medium.g = lit.g;
    draft.medium.phase = lit.phase;
    draft.medium.albedo = lit.albedo;
    draft.sun.direction = lit.sun;
    return draft;
}

constexpr PhaseFunction kCornetteShanks = PhaseFunction::kCornetteShanks;

SceneDraft cumulus(double density, double g) {
    SceneDraft draft = test::table_4_4();
    draft.density = density;
    draft.medium.g = g;
    draft.medium.albedo = 1;
    draft.image.background = Background::kTransparent;
    draft.image.width = 16;
    draft.image.height = 12;
    return draft;
}

SceneDraft furnace(double density, double g, double albedo = 1) {
    SceneDraft draft = cumulus(density, g);
    draft.medium.albedo = albedo;
    draft.sun.intensity = 0;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    return draft;
}

SceneDraft from(SceneDraft draft, glm::dvec3 eye) {
    draft.camera.automatic = false;
    draft.camera.eye = eye;
    draft.camera.target = eye + glm::dvec3(0, 0, -1);
    return draft;
}

SceneDraft colored() {
    std::vector<Ball> list = {{{0, 0, 0}, 4, 2e-4, {1, .5F, 0}},
                              {{1, 1, 0}, 2, 4e-4, {0, .25F, 1}}};
    SceneDraft draft = test::balls(list);
    draft.image.background = Background::kTransparent;
    draft.image.width = 16;
    draft.image.height = 12;
    return draft;
}

// Under the clear sky that belongs to the sun.
SceneDraft daylight(SceneDraft draft, double elevation, double turbidity) {
    draft.sun.direction.reset();
    draft.sun.elevation = elevation;
    draft.sun.auto_color = true;
    draft.sun.intensity = 40;
    draft.sky = {};
    draft.sky.physical = true;
    draft.sky.intensity = kPhysicalSkyIntensity;
    draft.sky.turbidity = turbidity;
    return draft;
}

// Thin matter: light is scattered once, on every rung.
constexpr test::CaseBounds kThin{.once = .01, .once_transport = .01, .once_harris = .01};
// Deep matter: only rung single has the oracle's light.
constexpr test::CaseBounds kDeep{.once = .03};
// Particles are thinner than these pictures' pixels, and widened.
constexpr test::CaseBounds kOnlyBounds{.alpha_splats = 0, .alpha_march = 0};

const std::vector<HardCase> kCases = {
    {"tiny tau",
     "once_tau_1e_12",
     [] { return ball({.depth = 1e-12}); },
     {.alpha_splats = 0, .once = .01, .once_transport = .01, .once_harris = .01}},
    {"tiny tau",
     "once_tau_1e_6",
     [] { return ball({.depth = 1e-6}); },
     {.alpha_splats = .1, .once = .01, .once_transport = .01, .once_harris = .01}},
    {"tiny tau", "once_tau_1e_3", [] { return ball({}); }, kThin},
    {"S = a tau as printed", "once_tau_1", [] { return ball({.depth = 1}); }, kDeep},
    {"S = a tau as printed", "once_tau_30", [] { return ball({.depth = 30}); }, kDeep},
    {"huge tau", "once_tau_1e4", [] { return ball({.depth = 1e4}, 8, 6); }, {.once = .2}},
    {"huge tau", "bright_tau_4e6", [] { return ball({.depth = 4e6}, 6, 4); }},
    {"huge tau", "furnace_tau_1e7", [] { return furnace(1e6, .85); }, kOnlyBounds},
    {"Harris gain", "furnace_density_0_2", [] { return furnace(.2, .85); }, kOnlyBounds},
    {"Harris gain", "furnace_density_2_g_0_99", [] { return furnace(2, .99); }, kOnlyBounds},
    {"Harris gain", "furnace_density_100", [] { return furnace(100, .85); }, kOnlyBounds},
    {"Harris gain", "furnace_isotropic", [] { return furnace(1, 0); }, kOnlyBounds},
    {"Harris gain", "furnace_backward", [] { return furnace(1, -.9); }, kOnlyBounds},
    {"Harris gain", "furnace_that_absorbs", [] { return furnace(.5, .85, .5); }, kOnlyBounds},
    {"Harris gain", "cumulus_g_0_999", [] { return cumulus(1, .999); }, kOnlyBounds},
    {"Harris gain", "cumulus_g_minus_0_999", [] { return cumulus(1, -.999); }, kOnlyBounds},
    {"Henyey-Greenstein near g = +-1", "g_0_999_into_the_sun",
     [] {
         return ball({.g = .999, .sun = {0, 0, -1}});
     },
     kThin},
    {"Henyey-Greenstein near g = +-1", "g_minus_0_999_sun_behind",
     [] {
         return ball({.g = -.999, .sun = {0, 0, 1}});
     },
     kThin},
    {"Henyey-Greenstein near g = +-1", "g_0_999_beside_the_sun",
     [] {
         return ball({.g = .999, .sun = {.02, .01, -1}});
     },
     kThin},
    {"Henyey-Greenstein near g = +-1", "g_0_999_across", [] { return ball({.g = .999}); }, kThin},
    {"Henyey-Greenstein near g = +-1", "g_0_999_deep_into_the_sun",
     [] {
         return ball({.depth = 3, .g = .999, .sun = {0, 0, -1}});
     },
     kDeep},
    {"Henyey-Greenstein near g = +-1", "cs_g_0_999_into_the_sun",
     [] {
         return ball({.g = .999, .sun = {0, 0, -1}, .phase = kCornetteShanks});
     },
     kThin},
    {"Henyey-Greenstein near g = +-1", "cs_g_minus_0_999_sun_behind",
     [] {
         return ball({.g = -.999, .sun = {0, 0, 1}, .phase = kCornetteShanks});
     },
     kThin},
    {"Henyey-Greenstein near g = +-1",
     "cs_g_0_999_across",
     [] { return ball({.g = .999, .phase = kCornetteShanks}); },
     {.once = .01, .once_transport = .02, .once_harris = .01}},
    {"sampling HG at small g",
     "g_0",
     [] { return ball({.depth = .01, .g = 0}); },
     {.once = .01, .once_transport = .02, .once_harris = .02, .once_truth = .05},
     400},
    {"sampling HG at small g",
     "g_1e_9",
     [] { return ball({.depth = .01, .g = 1e-9}); },
     {.once = .01, .once_transport = .02, .once_harris = .02, .once_truth = .05},
     400},
    {"sampling HG at small g",
     "g_5e_4",
     [] { return ball({.depth = .01, .g = 5e-4}); },
     {.once = .01, .once_transport = .02, .once_harris = .02, .once_truth = .05},
     400},
    {"sampling HG at small g",
     "cs_g_1e_9",
     [] { return ball({.depth = .01, .g = 1e-9, .phase = kCornetteShanks}); },
     {.once = .01, .once_transport = .02, .once_harris = .02, .once_truth = .05},
     400},
    {"sun parallel to up", "sun_up",
     [] {
         return ball({.sun = {0, 1, 0}});
     },
     kThin},
    {"sun parallel to up", "sun_down",
     [] {
         return ball({.sun = {0, -1, 0}});
     },
     kThin},
    {"sun parallel to up", "sun_a_hair_off_down",
     [] {
         return ball({.sun = {0, -1, 1e-9}});
     },
     kThin},
    {"sun parallel to up", "sun_up_deep",
     [] {
         return ball({.depth = 5, .sun = {0, 1, 0}});
     },
     kDeep},
    {"sun parallel to up", "sun_along_minus_z_deep",
     [] {
         return ball({.depth = 5, .sun = {0, 0, -1}});
     },
     kDeep},
    {"sun parallel to up", "sun_along_z_deep",
     [] {
         return ball({.depth = 5, .sun = {0, 0, 1}});
     },
     kDeep},
    {"camera in or at a particle", "once_from_the_centre",
     [] {
         return from(ball({.depth = 2}), {0, 0, 0});
     },
     kDeep},
    {"camera in or at a particle", "once_from_the_centre_thin",
     [] {
         return from(ball({}), {0, 0, 0});
     },
     kThin},
    {"step integration S sigma dt", "once_tau_2", [] { return ball({.depth = 2}); }, kDeep},
    {"step integration S sigma dt", "once_tau_100_backlit",
     [] {
         return ball({.depth = 100, .sun = {0, .3, -1}});
     },
     kDeep},
    // The core is a fifth as wide as a cell of the sun's lattice.
    {"step integration S sigma dt",
     "a_hard_core_in_a_veil",
     [] {
         SceneDraft draft = test::balls({{{0, 0, 0}, 6, .05}, {{0, 0, 0}, .2, 100}});
         draft.camera.fov = 3;
         draft.image.background = Background::kTransparent;
         draft.image.width = 16;
         draft.image.height = 12;
         return draft;
     },
     {.once = .35}},
    {"-", "albedo_0", [] { return ball({.depth = 1, .albedo = 0}); }},
    {"-", "albedo_a_half", [] { return ball({.albedo = .5}); }, kThin},
    {"-", "black_sun",
     [] {
         SceneDraft draft = ball({});
         draft.sun.intensity = 0;
         return draft;
     }},
    {"-", "sun_color_black",
     [] {
         SceneDraft draft = ball({});
         draft.sun.color = glm::dvec3(0);
         return draft;
     }},
    {"-", "brightest_sun",
     [] {
         SceneDraft draft = ball({});
         draft.sun.color = glm::dvec3(1e3);
         draft.sun.intensity = 1e6;
         return draft;
     },
     kThin},
    {"-", "no_sky_and_black_sun_over_a_sky_background",
     [] {
         SceneDraft draft = ball({.depth = 1});
         draft.sun.intensity = 0;
         draft.image.background = Background::kSky;
         return draft;
     }},
    {"-", "daylight_at_the_zenith", [] { return daylight(ball({.depth = 2}), 90, 2); }},
    {"-", "daylight_on_the_horizon", [] { return daylight(ball({.depth = 2}), 0, 10); }},
    {"-", "twilight", [] { return daylight(ball({.depth = 2}), -9, 2); }},
    {"-", "night", [] { return daylight(ball({.depth = 2}), -90, 2); }},
    {"-", "brightest_daylight",
     [] {
         SceneDraft draft = daylight(ball({.depth = 2}), 45, 3);
         draft.sun.intensity = draft.sky.intensity = 1e6;
         return draft;
     }},
    // Channels of the sun that are nearly out, where colours measure the sky by the sun.
    {"-", "coloured_particles_at_sunset", [] { return daylight(colored(), 0, 10); }},
    {"-", "coloured_particles_as_the_sun_sets", [] { return daylight(colored(), -.999, 2); }},
    {"-",
     "coloured_particles",
     [] { return colored(); },
     {.once = .01, .once_transport = .03, .once_harris = .01}},
    {"-",
     "coloured_black_channel",
     [] {
         SceneDraft draft = colored();
         for (auto& c : draft.clouds[0].ready.colors) c.x = 0;
         return draft;
     },
     {.once = .01, .once_transport = .03, .once_harris = .01}},
};

class Light : public ::testing::TestWithParam<test::CaseOnRung> {};
TEST_P(Light, IsWhatThereCanBe) {
    test::expect_hard_case(*GetParam().hard, GetParam().rung);
}
INSTANTIATE_TEST_SUITE_P(HardCases, Light, ::testing::ValuesIn(test::on_all_rungs(kCases)),
                         test::name_of);

// A furnace is no brighter than its walls, and where nothing absorbs no darker either: on finer grids, too.
TEST(HardCases, AFurnaceIsAsBrightAsItsWalls) {
    for (const char* rung : {"transport-16", "transport-24", "transport-32"})
        for (const double g : {-.9, 0., .85, .999})
            for (const double density : {1e-3, .2, 5., 1e5}) {
                if (test::kSanitized && std::string(rung) == "transport-32") continue;
                const SceneDraft draft = furnace(density, g);
                const auto outcome = test::render_on(draft, rung, 2);
                test::expect_within_bounds(draft, outcome.rendered);
                const Image& image = outcome.rendered.image;
                for (int y = 0; y < image.height; ++y)
                    for (int x = 0; x < image.width; ++x) {
                        const test::Pixel p = test::pixel(image, x, y);
                        EXPECT_NEAR(p.g, p.a, .05) << rung << " g " << g << " density " << density
                                                   << " at " << x << " " << y;
                    }
            }
}

}  // namespace
}  // namespace awan
