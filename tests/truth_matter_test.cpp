// Matter as the paths of the truth see it, and phase functions, against what is known exactly.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/truth/flight.h"
#include "core/truth/oracles.h"
#include "core/truth/primary_ray.h"
#include "tests/truth_scenes.h"

namespace awan {
namespace {

using std::numbers::pi;
using test::any_direction;
using test::Ball;
using test::particles_of;
using test::simpson;
using truth::PathRandom;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// --- optical depth

TEST(OpticalDepth, OfOneGaussianIsItsQuadrature) {
    const ParticleSet one = particles_of({{{0.5, -0.25, 1}, 2, 0.75}});
    const glm::dvec3 o(-3, 1, -6), d = glm::normalize(glm::dvec3(0.6, -0.1, 1));
    for (const auto& [from, to] : {std::pair{0.0, 20.0}, {6.0, 7.5}, {7.0, 7.001}, {9.0, 14.0}}) {
        const double sum =
            simpson(from, to, 4000, [&](double t) { return extinction_at(one, o + t * d); });
        EXPECT_NEAR(line_optical_depth(one, o, d, from, to) / sum, 1, 1e-9) << from;
    }
}

TEST(OpticalDepth, OfTheWholeLineIsKnown) {
    const ParticleSet one = particles_of({{{0, 0, 0}, 2, 0.75}});
    const double central = 0.75 * std::sqrt(2 * pi);
    EXPECT_NEAR(line_optical_depth(one, {0, 0, -50}, {0, 0, 1}, 0, kInfinite) / central, 1, 1e-12);
    EXPECT_NEAR(line_optical_depth(one, {0, 0, 0}, {0, 0, 1}, 0, kInfinite) / central, 0.5, 1e-12);
    EXPECT_NEAR(
        line_optical_depth(one, {3, 0, -50}, {0, 0, 1}, 0, kInfinite) / (central * std::exp(-4.5)),
        1, 1e-12);
    // 12 s aside, and from 12 s behind: tails keep their relative accuracy.
    EXPECT_NEAR(line_optical_depth(one, {12, 0, -50}, {0, 0, 1}, 0, kInfinite) /
                    (central * std::exp(-72.0)),
                1, 1e-12);
    EXPECT_NEAR(line_optical_depth(one, {0, 0, 12}, {0, 0, 1}, 0, kInfinite) /
                    (0.5 * central * std::erfc(12 / std::sqrt(2.0))),
                1, 1e-12);
}

TEST(OpticalDepth, AddsUpAlongALine) {
    const ParticleSet cloud = particles_of(test::table_4_4());
    const glm::dvec3 o(-12, -2, 1), d = glm::normalize(glm::dvec3(1, 0.03, -0.05));
    double pieces = 0;
    for (int i = 0; i < 500; ++i)
        pieces += line_optical_depth(cloud, o, d, 0.06 * i, 0.06 * (i + 1));
    EXPECT_NEAR(pieces / line_optical_depth(cloud, o, d, 0, 30), 1, 1e-12);
}

// --- phase functions

TEST(Phase, MeanIsOneAndMeanCosineIsG) {
    for (const PhaseFunction phase :
         {PhaseFunction::kHenyeyGreenstein, PhaseFunction::kCornetteShanks})
        for (const double g : {0.0, 1e-4, 0.3, -0.5, 0.85, -0.85, 0.99, 0.999, -0.999}) {
            Medium medium;
            medium.g = g;
            medium.phase = phase;
            // Cosines spaced by 1 - cos = 2 x^6, which spreads the peak at either end out.
            double sum = 0, cosines = 0;
            for (const double sign : {1.0, -1.0}) {
                const auto at = [&](double x, double power) {
                    const double cosine = sign * (1 - std::pow(x, 6));
                    return phase_value(medium, cosine) * std::pow(cosine, power) * 3 *
                           std::pow(x, 5);
                };
                sum += simpson(0, 1, 20000, [&](double x) { return at(x, 0); });
                cosines += simpson(0, 1, 20000, [&](double x) { return at(x, 1); });
            }
            EXPECT_NEAR(sum, 1, 1e-6) << g;
            // Cornette & Shanks 1992, eq. 10.
            const double mean = phase == PhaseFunction::kHenyeyGreenstein
                                    ? g
                                    : g * 3 * (4 + g * g) / (5 * (2 + g * g));
            EXPECT_NEAR(cosines, mean, 1e-6) << g;
        }
}

TEST(Phase, SamplesHaveTheMeanCosineAndTheDensity) {
    for (const bool cornette : {false, true})
        for (const double g : {0.0, 1e-9, 1e-4, -1e-4, 0.5, -0.7, 0.85, 0.999, -0.999}) {
            const truth::PhaseLaw law{g, cornette};
            PathRandom random(7);
            const int n = 200'000;
            double sum = 0, square = 0, beyond = 0;
            for (int i = 0; i < n; ++i) {
                const glm::dvec3 d = any_direction(random);
                const glm::dvec3 e = scattered(law, d, random);
                ASSERT_NEAR(glm::length(e), 1, 1e-9);
                const double cosine = glm::dot(d, e);
                sum += cosine;
                square += cosine * cosine;
                beyond += cosine > 0.8;
            }
            const double mean = cornette ? g * 3 * (4 + g * g) / (5 * (2 + g * g)) : g;
            const double noise = std::sqrt(std::max(square / n - mean * mean, 1e-12) / n);
            EXPECT_NEAR(sum / n, mean, 5 * noise) << g;
            const double share =
                0.5 * simpson(0.8, 1, 100'000, [&](double c) { return phase_value(law, c); });
            if (std::abs(g) < 0.99) {
                EXPECT_NEAR(beyond / n, share, 5 * std::sqrt(0.25 / n)) << g;
            }
        }
}

// --- matter as the paths see it

struct MatterErrors {
    double peak = 0, extinction = 0, depth = 0;  // depth: over max(.5%, .005) of the exact one
};

MatterErrors matter_errors(const ParticleSet& particles, const glm::dvec3& to_sun, int points) {
    const truth::Matter matter = truth::make_matter(particles, to_sun, 1, {}).value();
    PathRandom random(3);
    MatterErrors errors;
    for (int i = 0; i < points; ++i) {
        // Half of the points anywhere, half about the particles.
        glm::dvec3 p = glm::dvec3(random.unit(), random.unit(), random.unit()) * matter.top;
        if (i % 2 == 1) {
            const auto k =
                static_cast<std::size_t>(random.unit() * static_cast<double>(particles.size()));
            const double reach = 2.0 * static_cast<double>(particles.radius[k]) * random.unit();
            p = (particles.center[k] - matter.origin + reach * any_direction(random)) / matter.cell;
        }
        const glm::dvec3 q = matter.origin + matter.cell * p;
        // As far as coordinates go: what double makes of q.
        const glm::dvec3 back = (q - matter.origin) / matter.cell;
        const double exact = extinction_at(particles, q);
        errors.peak = std::max(errors.peak, exact);
        errors.extinction = std::max(
            errors.extinction, std::abs(truth::extinction(matter, back) / matter.cell - exact));
        const double depth = line_optical_depth(particles, q, to_sun, 0, kInfinite);
        errors.depth = std::max(errors.depth, std::abs(truth::depth_to_sun(matter, back) - depth) /
                                                  std::max(0.005 * depth, 0.005));
    }
    return errors;
}

void expect_true_matter(const ParticleSet& particles, const char* what, double ripple = 0.005) {
    const MatterErrors errors =
        matter_errors(particles, glm::normalize(glm::dvec3(0.5, 0.7, 0.4)), 2000);
    EXPECT_GT(errors.peak, 0) << what;
    EXPECT_LT(errors.extinction / errors.peak, ripple) << what;
    EXPECT_LT(errors.depth, 1) << what;
}

TEST(Matter, IsThatOfTheParticles) {
    expect_true_matter(particles_of({{{0, 0, 0}, 2, 0.5}}), "one");
    expect_true_matter(particles_of({{{1, 2, 3}, 1e-6, 1e6}}), "very small");
    expect_true_matter(particles_of({{{1, 2, 3}, 1e6, 1e-6}}), "very large");
    expect_true_matter(particles_of({{{0, 0, 0}, 2, 0.5}, {{1e6, 0, 0}, 1, 0.5}}), "far apart");
    expect_true_matter(particles_of({{{0, 0, 0}, 100, 0.01}, {{60, 0, 0}, 0.02, 40}}), "unlike");
    expect_true_matter(
        particles_of({{{1e9, -1e9, 1e9}, 200, 0.005}, {{1e9 - 300, -1e9, 1e9}, 100, 0.008}}),
        "offset");
    expect_true_matter(particles_of(std::vector<Ball>(3000, {{0, 1, 0}, 1, 0.001})), "coincident");
}

TEST(Matter, OfTable44) {
    // Its smallest particles are two cells wide: there the lattice ripples, by nothing in the mean.
    expect_true_matter(particles_of(test::table_4_4()), "table 4.4", 0.04);
}

TEST(Matter, OfManySmallParticles) {
    SceneDraft draft = test::balls({});
    draft.clouds[0].model = CloudModel::kCubes;
    draft.clouds[0].ready = {};
    draft.clouds[0].cubes = {{20'000, {10, 6, 8}, {0, 0, 0}, 0.5, 1, {}}};
    draft.density = 0.2;
    const MatterErrors errors = matter_errors(particles_of(draft), {0, 1, 0}, 400);
    EXPECT_LT(errors.extinction / errors.peak,
              0.3);              // at the centres of those narrower than a cell
    EXPECT_LT(errors.depth, 4);  // 2% or .02
}

TEST(Matter, ColorsAreMeansByExtinction) {
    const ParticleSet two = particles_of(
        {{{0, 0, 0}, 2, 1, {1, 0.5f, 0}}, {{1, 0, 0}, 2, 1, {0, 0.5f, 1}}, {{0, 0, 0}, 0.01, 0}});
    const truth::Matter matter = truth::make_matter(two, {0, 1, 0}, 1, {}).value();
    const auto at = [&](double x) {
        return truth::color_at(matter, (glm::dvec3(x, 0, 0) - matter.origin) / matter.cell);
    };
    EXPECT_NEAR(at(0.5).x, 0.5, 0.005);
    EXPECT_NEAR(at(0.5).y, 0.5, 1e-5);
    EXPECT_NEAR(at(0).x, 1 / (1 + std::exp(-0.5)), 0.005);
    EXPECT_NEAR(at(0).z, 1 - 1 / (1 + std::exp(-0.5)), 0.005);
}

TEST(Matter, FreeFlightsLeaveTheTransmittance) {
    // On the lattice, listed, and both.
    for (const auto& list : std::vector<std::vector<Ball>>{
             {{{0, 0, 0}, 2, 0.5}},
             {{{0, 0, 0}, 2, 0.5}, {{200, 0, 0}, 1, 0.7}, {{-300, 0.5, 0}, 1.5, 0.3}},
             {{{0, 0, 0}, 100, 0.004}, {{60, 0, 0}, 0.02, 60}}}) {
        const ParticleSet particles = particles_of(list);
        const truth::Matter matter = truth::make_matter(particles, {0, 1, 0}, 1, {}).value();
        const glm::dvec3 o(-1e3, 0.003, -0.002), d(1, 0, 0);
        const double exact = std::exp(-line_optical_depth(particles, o, d, 0, kInfinite));
        const glm::dvec3 start = (o - matter.origin) / matter.cell;
        PathRandom random(11);
        const int n = 200'000;
        int left = 0;
        double before = 0;
        for (int i = 0; i < n; ++i) {
            double t = 0;
            const bool met = truth::fly(matter, matter.axes * start + matter.shift, matter.axes * d,
                                        kInfinite, random, t);
            left += !met;
            before += met && (t * matter.cell < 1e3);
        }
        EXPECT_NEAR(left / static_cast<double>(n), exact, 4.5 * std::sqrt(0.25 / n) + 0.001);
        const double half = 1 - std::exp(-line_optical_depth(particles, o, d, 0, 1e3));
        EXPECT_NEAR(before / n, half, 4.5 * std::sqrt(0.25 / n) + 0.001);
        // The tabulated first meeting has the same distribution.
        const truth::PrimaryRay primary(matter, start, d, kInfinite);
        const double share = half / (1 - exact);
        const double t = primary.first_meeting(share) * matter.cell;
        EXPECT_NEAR((1 - std::exp(-line_optical_depth(particles, o, d, 0, t))) / (1 - exact), share,
                    0.004);
    }
}

}  // namespace
}  // namespace awan
