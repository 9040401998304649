// The transport pass against laws: nothing here knows how it is made.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/generate/gaussian.h"
#include "core/light/diffusion.h"
#include "core/light/gmres.h"
#include "core/light/legendre.h"
#include "core/light/light_cache.h"
#include "core/light/ordinates.h"
#include "core/light/sun_depth.h"
#include "core/light/transport.h"
#include "core/survey/lattice.h"
#include "core/truth/oracles.h"
#include "tests/scenes.h"

namespace awan {
namespace {

constexpr double kPi = std::numbers::pi;

struct Solved {
    Planned planned;
    TransportLight light;
};

Solved solve(const SceneDraft& draft, int cells, int threads = 2, double tolerance = 1e-3) {
    const Scene scene = test::valid(draft);
    auto planned = plan_scene(scene, threads, {});
    EXPECT_TRUE(planned.ok());
    TransportSettings settings;
    settings.cells = cells;
    settings.tolerance = tolerance;
    auto light = transport_light(scene, planned->particles, planned->survey, settings, threads, {});
    EXPECT_TRUE(light.ok());
    return {*std::move(planned), *std::move(light)};
}

// Mean radiance in each cell over what a furnace of radiance 1 would give.
std::pair<double, double> furnace_range(const TransportLight& light, double albedo) {
    double low = 1e9, high = -1e9;
    for (const auto& moments : light.bands.at(0).moments) {
        const double mean = static_cast<double>(moments[0]) * 0.28209479177387814 /
                            (albedo * (1 - light.peak_share));
        low = std::min(low, mean);
        high = std::max(high, mean);
    }
    return {low, high};
}

SceneDraft furnace(double g, double density) {
    SceneDraft draft = test::table_4_4();
    draft.medium.g = g;
    draft.medium.albedo = 1;
    draft.density = density;
    draft.sun.intensity = 0;
    draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
    draft.sky.intensity = 1;
    return draft;
}

TEST(Ordinates, IntegrateHarmonicsUpToTheThirdOrderExactly) {
    const Ordinates ordinates = make_ordinates();
    for (std::size_t a = 0; a < 16; ++a)
        for (std::size_t b = 0; b < 16; ++b) {
            double sum = 0;
            for (const auto& octant : ordinates.octants)
                for (std::size_t d = 0; d < kDirections; ++d)
                    sum += static_cast<double>(octant.value[a][d] * octant.weighted[d][b]);
            EXPECT_NEAR(sum, a == b ? 1 : 0, 1e-5) << a << " " << b;
        }
}

TEST(Legendre, MomentsAreThoseOfThePhaseFunction) {
    for (const PhaseFunction phase :
         {PhaseFunction::kHenyeyGreenstein, PhaseFunction::kCornetteShanks})
        for (const double g : {-.8, 0., .3, .85}) {
            Medium medium;
            medium.g = g;
            medium.phase = phase;
            for (unsigned l = 0; l <= 5; ++l) {
                double sum = 0;
                constexpr int kSteps = 40000;
                for (int i = 0; i < kSteps; ++i) {
                    const double cosine = -1 + 2 * (i + 0.5) / kSteps;
                    sum += phase_value(medium, cosine) * std::legendre(l, cosine) / kSteps;
                }
                EXPECT_NEAR(phase_moment(medium, static_cast<int>(l)), sum, 1e-4)
                    << "g " << g << " l " << l;
            }
        }
}

TEST(Lattice, KeepsTheMassWhateverItsAxes) {
    const auto planned = plan_scene(test::valid(test::table_4_4()), 1, {});
    const ParticleSet& particles = planned->particles;
    const glm::dvec3 w = glm::normalize(glm::dvec3(.3, -.8, .5));
    const glm::dvec3 u = glm::normalize(glm::cross(w, glm::dvec3(1, 0, 0))), v = glm::cross(w, u);
    for (const double rest : {1e-9, .5}) {
        const Lattice lattice = lattice_around_matter(particles, u, v, w, rest, 40, 1);
        double mass = 0;
        for (const float cell : extinction_in(particles, lattice, 2))
            mass += static_cast<double>(cell) * std::pow(lattice.cell.x, 3);
        if (rest < 1e-6)
            EXPECT_NEAR(mass / planned->survey.total_mass, 1, 1e-4);
        else
            EXPECT_GT(mass / planned->survey.total_mass, .9);
    }
}

// Cells are cubes: what they are too long goes to both ends. Within the coarse cells that its box is found by, 32
// along.
TEST(Lattice, StandsAboutTheMiddleOfWhatItHolds) {
    SceneDraft draft = test::balls({{{-6, 1, 2}, 2, 1}, {{6, 1, 2}, 2, 1}});
    const auto planned = plan_scene(test::valid(draft), 1, {});
    for (const int count : {8, 13, 24, 50}) {
        const Lattice lattice = lattice_around_matter(planned->particles, {1, 0, 0}, {0, 1, 0},
                                                      {0, 0, 1}, 1e-3, count, 1);
        const glm::dvec3 middle = lattice.at(0.5 * glm::dvec3(lattice.cells));
        EXPECT_LT(glm::length(middle - glm::dvec3(0, 1, 2)), 0.5 * 20 / 32) << count;
    }
}

// A flat field of Gaussians, uneven across it.
ParticleSet flat_field() {
    std::vector<test::Ball> list;
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 16; ++j)
            list.push_back({{2. * i, .3 * std::sin(3. * i + j), 2. * j}, 3, 1 + .5 * std::sin(i)});
    return plan_scene(test::valid(test::balls(list)), 1, {})->particles;
}

TEST(Lattice, CellsAreAsFlatAsTheMatter) {
    const ParticleSet field = flat_field();
    const MatterBox box = box_around_matter(field, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, .01, 1);
    const Lattice cubic = cubic_cells(box, 32), fitted = fitted_cells(box, 32);
    EXPECT_GT(fitted.cells.y, 1.5 * cubic.cells.y);
    EXPECT_LT(fitted.cell.y, .5 * fitted.cell.x);
    EXPECT_LE(fitted.size(), cubic.size());
    double mass = 0, whole = 0;
    for (const float cell : extinction_in(field, fitted, 1))
        mass += static_cast<double>(cell) * fitted.cell.x * fitted.cell.y * fitted.cell.z;
    for (std::size_t i = 0; i < field.size(); ++i) whole += gaussian_mass(field, i);
    EXPECT_NEAR(mass / whole, 1, .01);

    const auto ball = plan_scene(test::valid(test::balls({{{0, 0, 0}, 4, 1}})), 1, {})->particles;
    const MatterBox round = box_around_matter(ball, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, .01, 1);
    EXPECT_EQ(fitted_cells(round, 24).cells, cubic_cells(round, 24).cells);
}

TEST(SunDepth, IsTheLineIntegralInFlatMatterToo) {
    const ParticleSet field = flat_field();
    for (const glm::dvec3 way :
         {glm::dvec3(0, 1, 0), glm::dvec3(.8, .6, 0), glm::dvec3(-.6, -.4, .7)}) {
        const glm::dvec3 towards = glm::normalize(way);
        const SunDepth sun = sun_depth(field, towards, 96, 2);
        EXPECT_EQ(sun.v, glm::dvec3(1, 0, 0)) << "it lies in the matter";
        double worst = 0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 at(15 + 15 * std::sin(i * 12.9), 4 * std::sin(i * 78.2),
                                15 + 15 * std::sin(i * 37.7));
            const double exact = line_optical_depth(field, at, towards, 0, INFINITY);
            worst = std::max(worst, std::abs(depth_at(sun, at) - exact) / (.1 + exact));
        }
        EXPECT_LT(worst, .05);
    }
}

// Small clouds far apart, under a sun that shines between them.
TEST(SunDepth, IsFineWhereCloudsAreFewAndFlat) {
    std::vector<test::Ball> list;
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
            list.push_back({{6 * i + std::sin(5. * j), .3 * std::sin(3. * i + j), 6. * j}, 1.2, 2});
    const ParticleSet field = plan_scene(test::valid(test::balls(list)), 1, {})->particles;
    const glm::dvec3 towards = glm::normalize(glm::dvec3(.3, .05, 1));
    const SunDepth sun = sun_depth(field, towards, 96, 2);
    double sum = 0;
    constexpr int kPoints = 400;
    for (int i = 0; i < kPoints; ++i) {
        const test::Ball& ball = list[static_cast<std::size_t>(i) % list.size()];
        const glm::dvec3 at =
            ball.center + glm::dvec3(std::sin(i * 12.9), std::sin(i * 78.2), std::sin(i * 37.7));
        const double exact = line_optical_depth(field, at, towards, 0, INFINITY);
        const double off = std::exp(-depth_at(sun, at)) - std::exp(-exact);
        sum += off * off;
    }
    EXPECT_LT(std::sqrt(sum / kPoints), .015);
}

TEST(Lattice, FlatMatterHasAsManyCellsAsCompact) {
    EXPECT_EQ(spread_count({8, 4, 4}, 64, 4), 64);
    EXPECT_EQ(spread_count({5, 5, 5}, 64, 4), 64);
    const glm::dvec3 flat(40, 5, 40);
    const int count = spread_count(flat, 64, 4);
    EXPECT_NEAR(count * count * (count * 5. / 40), .25 * 64 * 64 * 64, 6000);
    EXPECT_EQ(spread_count({100, .001, 100}, 64, 4), 256);
    EXPECT_EQ(spread_count({100, .001, 100}, 64, 1.5), 96);
    EXPECT_EQ(spread_count({0, 0, 0}, 64, 4), 64);
}

TEST(SunDepth, IsTheLineIntegral) {
    SceneDraft draft = test::table_4_4();
    const auto planned = plan_scene(test::valid(draft), 1, {});
    const glm::dvec3 towards = sun_direction(draft.sun);
    const SunDepth sun = sun_depth(planned->particles, towards, 96, 2);
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 middle = .5 * (planned->survey.bounds.min + planned->survey.bounds.max);
        const glm::dvec3 half = .5 * (planned->survey.bounds.max - planned->survey.bounds.min);
        const glm::dvec3 at =
            middle + half * glm::dvec3(std::sin(i * 12.9), std::sin(i * 78.2), std::sin(i * 37.7));
        const double exact = line_optical_depth(planned->particles, at, towards, 0, INFINITY);
        worst = std::max(worst, std::abs(depth_at(sun, at) - exact) / (.05 + exact));
    }
    EXPECT_LT(worst, .05);  // the lattice is 96 cells; what is cut off is .01
}

TEST(Gmres, SolvesWithAndWithoutAPreconditioner) {
    // A plain tridiagonal system whose solution is known.
    constexpr std::size_t kSize = 300;
    std::vector<float> wanted(kSize), right(kSize), x(kSize);
    for (std::size_t i = 0; i < kSize; ++i)
        wanted[i] = static_cast<float>(std::sin(.1 * double(i)));
    const Product product = [](std::span<const float> from, std::span<const float> addition,
                               std::span<float> to) -> Status {
        const auto at = [&](std::size_t i) {
            return i < from.size() ? from[i] + (addition.empty() ? 0.F : addition[i]) : 0.F;
        };
        for (std::size_t i = 0; i < from.size(); ++i)
            to[i] = 2.2F * at(i) - (i > 0 ? at(i - 1) : 0.F) - .9F * at(i + 1);
        return std::nullopt;
    };
    ASSERT_FALSE(product(wanted, {}, right));
    const Preconditioner some{1, [](std::span<const float> v, std::span<float> a) {
                                  for (std::size_t i = 0; i < v.size(); ++i) a[i] = -.5F * v[i];
                              }};
    for (const Preconditioner& preconditioner : {Preconditioner{}, some}) {
        const auto outcome = gmres(product, preconditioner, right, {1e-5, 400, 20}, 2, x);
        ASSERT_TRUE(outcome.ok());
        EXPECT_LE(outcome->residual, 1e-5);
        for (std::size_t i = 0; i < kSize; ++i) EXPECT_NEAR(x[i], wanted[i], 1e-3);
    }
}

TEST(Diffusion, SolvesItsOwnEquation) {
    const glm::ivec3 cells(7, 5, 6);
    std::vector<float> depth(210), scattered(210), source(210), value(210);
    for (std::size_t i = 0; i < depth.size(); ++i) {
        depth[i] = static_cast<float>(1 + i % 3);
        scattered[i] = .99F * depth[i];
        source[i] = static_cast<float>(i % 5);
    }
    const Diffusion diffusion = make_diffusion(cells, glm::vec3(1), depth, scattered, .5);
    solve_diffusion(diffusion, source, 1e-5, value);
    // Balance of every cell, by hand.
    const auto at = [&](int x, int y, int z) {
        return static_cast<std::size_t>((z * cells.y + y) * cells.x + x);
    };
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const std::size_t i = at(x, y, z);
                float sum = diffusion.diagonal[i] * value[i];
                if (x > 0) sum -= diffusion.across[0][at(x - 1, y, z)] * value[at(x - 1, y, z)];
                if (x + 1 < cells.x) sum -= diffusion.across[0][i] * value[at(x + 1, y, z)];
                if (y > 0) sum -= diffusion.across[1][at(x, y - 1, z)] * value[at(x, y - 1, z)];
                if (y + 1 < cells.y) sum -= diffusion.across[1][i] * value[at(x, y + 1, z)];
                if (z > 0) sum -= diffusion.across[2][at(x, y, z - 1)] * value[at(x, y, z - 1)];
                if (z + 1 < cells.z) sum -= diffusion.across[2][i] * value[at(x, y, z + 1)];
                EXPECT_NEAR(sum, source[i], 2e-3);
            }
}

// A cloud that absorbs nothing under a sky of radiance 1 from all sides is as bright as the sky, everywhere.
TEST(Transport, WhiteFurnace) {
    for (const double g : {0., .5, .85})
        for (const double density : {.02, .2, 2.}) {
            const Solved solved = solve(furnace(g, density), 24, 2, density < 1 ? 1e-4 : 2e-5);
            const auto [low, high] = furnace_range(solved.light, 1);
            // Optical depth 3 and 30 within 1%. At 300 light takes 1e5 scatterings to the middle, and what a residual
            // leaves there is a thousand times as much, where nobody sees it.
            const double bound = density < 1 ? .01 : .05;
            EXPECT_GT(low, 1 - bound) << "g " << g << " density " << density;
            EXPECT_LT(high, 1 + bound) << "g " << g << " density " << density;
        }
}

// What a cloud takes from the sun leaves it again, or is absorbed: with albedo a the scattered power cannot be more
// than the power that falls on it times a / (1 - a), nor negative anywhere by more than the scheme's ripples.
TEST(Transport, DarkMatterIsDarkAndThinMatterHoldsNoLight) {
    SceneDraft draft = test::table_4_4();
    draft.sky.none = true;
    draft.medium.albedo = 0;
    for (const LightBand& band : solve(draft, 16).light.bands)
        for (const auto& moments : band.moments) EXPECT_EQ(moments[0], 0);
    draft.medium.albedo = 1;
    draft.density = 1e-6;
    for (const LightBand& band : solve(draft, 16).light.bands)
        for (const auto& moments : band.moments) EXPECT_LT(std::abs(moments[0]), 1e-4);
}

TEST(Transport, TheSameBytesForEveryNumberOfThreads) {
    const SceneDraft draft = test::table_4_4();
    const Solved one = solve(draft, 16, 1);
    for (const int threads : {2, 3, 7}) {
        const Solved many = solve(draft, 16, threads);
        ASSERT_EQ(one.light.bands.size(), many.light.bands.size());
        for (std::size_t b = 0; b < one.light.bands.size(); ++b)
            EXPECT_EQ(one.light.bands[b].moments, many.light.bands[b].moments);
        EXPECT_EQ(one.light.sun.depth, many.light.sun.depth);
    }
}

TEST(Transport, DoesNotDependOnTheCamera) {
    SceneDraft draft = test::table_4_4();
    const Solved first = solve(draft, 16);
    draft.camera.automatic = false;
    draft.camera.eye = {0, 0, 0};
    draft.camera.target = {1, 0, 0};
    draft.image.width = 17;
    const Solved second = solve(draft, 16);
    EXPECT_EQ(first.light.bands[0].moments, second.light.bands[0].moments);
}

TEST(Transport, StopsAtTheDeadline) {
    const Scene scene = test::valid(test::table_4_4());
    const auto planned = plan_scene(scene, 1, {});
    Deadline over;
    over.until = Deadline::Clock::now();
    const auto light = transport_light(scene, planned->particles, planned->survey, {}, 2, over);
    ASSERT_FALSE(light.ok());
    EXPECT_EQ(light.error().code, ErrorCode::kOverDeadline);
}

// Farther than float32 reaches: the same light at the origin and 1e9 units away.
TEST(Transport, FarFromTheOrigin) {
    SceneDraft draft = test::table_4_4();
    draft.top_level_cubes = false;
    const Solved here = solve(draft, 16);
    draft.clouds[0].translate = {9e8, -8e8, 5e8};
    const Solved there = solve(draft, 16);
    ASSERT_EQ(here.light.cells, there.light.cells);
    for (std::size_t i = 0; i < here.light.bands[0].moments.size(); ++i)
        EXPECT_NEAR(here.light.bands[0].moments[i][0], there.light.bands[0].moments[i][0], 1e-3);
}

// A sky that is switched off gives no light, through the forward peak neither: all that is left is the sun's.
TEST(Transport, ASkyThatIsSwitchedOffGivesNoLight) {
    SceneDraft draft = test::table_4_4();
    draft.accuracy.rung = "transport-16";
    draft.image.width = 40;
    draft.image.height = 30;
    draft.image.background = Background::kTransparent;
    test::effect(draft, Effect::kSkyLight) = Switch::kOff;
    const auto off = render_scene(test::valid(draft), {}, {});
    test::effect(draft, Effect::kSkyLight) = Switch::kAuto;
    const auto on = render_scene(test::valid(draft), {}, {});
    draft.sky.none = true;
    const auto none = render_scene(test::valid(draft), {}, {});
    ASSERT_TRUE(off.ok() && none.ok() && on.ok());
    EXPECT_EQ(off->image.pixels, none->image.pixels);
    EXPECT_NE(on->image.pixels, none->image.pixels);
}

TEST(LightCache, KeyIsTheLightsOwn) {
    SceneDraft draft = test::table_4_4();
    const std::string key = light_key(test::valid(draft), {});
    SceneDraft moved = draft;
    moved.camera.automatic = false;
    moved.camera.eye = {0, 0, 30};
    moved.image.width = 33;
    EXPECT_EQ(light_key(test::valid(moved), {}), key);
    for (const auto& change : std::vector<std::function<void(SceneDraft&)>>{
             [](SceneDraft& d) { d.sun.azimuth += 1; }, [](SceneDraft& d) { d.medium.g = .5; },
             [](SceneDraft& d) { d.density = .3; }, [](SceneDraft& d) { d.seed = 2; },
             [](SceneDraft& d) { d.sky.none = true; },
             [](SceneDraft& d) { d.clouds[0].cubes[1].center.x += 1; }}) {
        SceneDraft other = draft;
        change(other);
        EXPECT_NE(light_key(test::valid(other), {}), key);
    }
    TransportSettings finer;
    finer.cells = 48;
    EXPECT_NE(light_key(test::valid(draft), finer), key);
}

}  // namespace
}  // namespace awan
