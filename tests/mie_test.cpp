// Light scattered by droplets of water: the series against published values, the phase function against its laws, the
// rungs against the truth.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/draw/march_phase.h"
#include "core/light/legendre.h"
#include "core/light/light.h"
#include "core/pipeline.h"
#include "core/scene/mie.h"
#include "core/shaders/shared.h"
#include "core/truth/oracles.h"
#include "core/truth/phase_law.h"
#include "tests/scenes.h"
#include "tests/truth_scenes.h"

namespace awan {
namespace {

using std::numbers::pi;

Medium droplets(double diameter) {
    Medium medium;
    medium.phase = PhaseFunction::kMie;
    medium.droplet = diameter;
    medium.droplets = std::make_shared<const DropletPhase>(droplet_phase(diameter));
    return medium;
}

double p_at(const Medium& medium, double degrees) {
    const double half = degrees * pi / 360;
    return phase_value(*medium.droplets, 2 * std::pow(std::sin(half), 2),
                       2 * std::pow(std::cos(half), 2));
}

// Bohren & Huffman 1983, appendix A (the first); Wiscombe 1979, test cases of MIEV0.
TEST(Mie, SeriesIsThePublishedOne) {
    struct Known {
        double x, index, scattered, back, asymmetry;
    };
    const double kBack10 = 4 * (4.322 * 4.322 + 4.868 * 4.868) / 100;
    for (const Known& known : {Known{2 * pi * .525 / .6328, 1.55, 3.10543, 2.92534, .63314},
                               {10, 1.5, 2.8820, kBack10, .742913},
                               {10, .75, 2.232265, .0465844, .896473},
                               {1000, .75, 1.997908, .939160, .844944}}) {
        const MieEfficiencies got = mie_efficiencies(mie_series(known.x, known.index));
        EXPECT_NEAR(got.scattered, known.scattered, 2e-5 * known.scattered) << known.x;
        EXPECT_NEAR(got.back, known.back, 2e-3 * known.back) << known.x;
        EXPECT_NEAR(got.asymmetry, known.asymmetry, 2e-5) << known.x;
    }
}

// Over all directions |S1|^2 + |S2|^2 is x^2 times the cross section's sum, and straight back what the efficiency says.
TEST(Mie, IntensitiesAreThoseOfTheSeries) {
    for (const double x : {.5, 5., 40.}) {
        const MieSeries series = mie_series(x, 1.333);
        constexpr std::size_t kSteps = 4000;
        std::vector<double> less(kSteps + 1), ahead(kSteps + 1), behind(kSteps + 1);
        for (std::size_t i = 0; i < kSteps; ++i) less[i] = (static_cast<double>(i) + .5) / kSteps;
        less[kSteps] = 0;
        add_intensities(series, 1, less, ahead, behind);
        double sum = 0, turned = 0;
        for (std::size_t i = 0; i < kSteps; ++i) {
            sum += (ahead[i] + behind[i]) / kSteps;
            turned += (ahead[i] - behind[i]) * (1 - less[i]) / kSteps;
        }
        const MieEfficiencies all = mie_efficiencies(series);
        EXPECT_NEAR(sum / (x * x * all.scattered), 1, 1e-3) << x;
        EXPECT_NEAR(turned / sum, all.asymmetry, 1e-3) << x;
        EXPECT_NEAR(2 * behind[kSteps] / (x * x * all.back), 1, 1e-9) << x;
    }
}

// Rayleigh's function is the limit of small spheres.
TEST(Mie, SmallSpheresAreRayleighs) {
    const std::vector<double> less{0, .3, .7, 1};
    std::vector<double> ahead(4), behind(4);
    add_intensities(mie_series(.01, 1.333), 1, less, ahead, behind);
    for (std::size_t i = 0; i < 4; ++i) {
        const double mu = 1 - less[i], wanted = ahead[3] * (1 + mu * mu);
        EXPECT_NEAR(ahead[i] / wanted, 1, 1e-3);
        EXPECT_NEAR(behind[i] / wanted, 1, 1e-3);
    }
}

TEST(Droplets, MeanIsOneAndMomentsAreTheFunctions) {
    for (const double diameter : {2., 10., 50.}) {
        const Medium medium = droplets(diameter);
        double sum[5] = {};
        constexpr int kSteps = 400'000;
        for (int i = 0; i < kSteps; ++i) {
            // Close together straight ahead.
            const double t = (i + .5) / kSteps, less = 2 * t * t * t * t, mu = 1 - less;
            const double light = .5 * phase_value(*medium.droplets, less, 2 - less) * 8 * t * t * t;
            for (unsigned l = 0; l < 5; ++l) sum[l] += light * std::legendre(l, mu) / kSteps;
        }
        EXPECT_NEAR(sum[0], 1, 1e-5);
        for (int l = 0; l < 5; ++l) EXPECT_NEAR(phase_moment(medium, l), sum[l], 1e-4) << l;
        // The series of all moments is the function again.
        for (const double angle : {0., 1., 5., 20., 100., 150., 177.}) {
            double series = 0, p = 1, before = 0;
            const double mu = std::cos(angle * pi / 180);
            for (std::size_t l = 0; l < medium.droplets->moment.size(); ++l) {
                const auto n = static_cast<double>(l);
                series += (2 * n + 1) * medium.droplets->moment[l] * p;
                const double next = ((2 * n + 1) * mu * p - n * before) / (n + 1);
                before = p;
                p = next;
            }
            const double exact = p_at(medium, angle);
            EXPECT_NEAR(series, exact, .01 * exact + 5e-3) << diameter << " at " << angle;
        }
    }
}

// Hansen & Travis 1974, Mayer et al. 2004: a mean cosine of .85 to .87 for the droplets of clouds.
TEST(Droplets, HaveTheMeanCosineOfClouds) {
    EXPECT_NEAR(asymmetry(droplets(10)), .85, .01);
    EXPECT_NEAR(asymmetry(droplets(20)), .865, .01);
    EXPECT_NEAR(asymmetry(droplets(40)), .873, .01);
}

// What a smooth fit lacks: a fogbow near 142 degrees that narrows as droplets grow, and a glory straight back.
TEST(Droplets, HaveAFogbowAndAGlory) {
    double bow_width = 90;
    for (const double diameter : {10., 20., 50.}) {
        const Medium medium = droplets(diameter);
        double most = 0, at = 0;
        for (double angle = 125; angle < 155; angle += .25)
            if (p_at(medium, angle) > most) {
                most = p_at(medium, angle);
                at = angle;
            }
        EXPECT_GT(at, 138) << diameter;
        EXPECT_LT(at, 146) << diameter;
        EXPECT_GT(most, 2.5 * p_at(medium, 125));
        EXPECT_GT(most, 1.4 * p_at(medium, 155));
        double low = at, high = at;
        while (p_at(medium, low) > .6 * most) low -= .1;
        while (p_at(medium, high) > .6 * most) high += .1;
        EXPECT_LT(high - low, bow_width);
        bow_width = high - low;
        EXPECT_GT(p_at(medium, 180), 3 * p_at(medium, 165));
    }
}

TEST(Droplets, TheFitOfSplatsIsNearTheFunction) {
    for (const double diameter : {3., 5., 10., 20., 40.}) {
        const Medium medium = droplets(diameter);
        const DropletFit fit = droplet_fit(diameter);
        const glm::vec4 figures(fit.narrow, fit.wide, fit.alpha, fit.share);
        double sum = 0, turned = 0;
        constexpr int kSteps = 200'000;
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + .5) / kSteps, less = 2 * t * t * t * t;
            const double mu = 1 - less, side = std::sqrt(less * (2 - less));
            const double p = shader::droplets(
                {0, 0, 1}, {static_cast<float>(side), 0, static_cast<float>(mu)}, figures);
            sum += 4 * p * t * t * t / kSteps;
            turned += 4 * p * t * t * t * mu / kSteps;
        }
        EXPECT_NEAR(sum, 1, 1e-3) << diameter;
        EXPECT_NEAR(turned, asymmetry(medium), .035) << diameter;
        for (const double angle : {5., 10., 20., 40.}) {
            const double half = angle * pi / 180;
            const double p = shader::droplets(
                {0, 0, 1},
                {static_cast<float>(std::sin(half)), 0, static_cast<float>(std::cos(half))},
                figures);
            EXPECT_NEAR(p / p_at(medium, angle), 1, .35) << diameter << " at " << angle;
        }
    }
}

TEST(Droplets, SharesWithinAnglesAreTheFunctions) {
    const Medium medium = droplets(20);
    double sum = 0;
    constexpr int kSteps = 100'000;
    for (int i = 0; i < kSteps; ++i) {
        const double t = (i + .5) / kSteps, less = 2 * t * t * t * t;
        if (i % 5000 == 0) {
            EXPECT_NEAR(gathering_fraction(medium, std::acos(1 - less)), sum, 1e-3);
        }
        sum += 4 * phase_value(*medium.droplets, less, 2 - less) * t * t * t / kSteps;
    }
    EXPECT_NEAR(gathering_fraction(medium, pi), 1, 1e-12);
}

// The truth's own values and samples.
TEST(Droplets, TruthDrawsThemByTheirDensity) {
    for (const double diameter : {5., 30.}) {
        const Medium medium = droplets(diameter);
        const truth::PhaseLaw law = truth::phase_law(medium);
        truth::PathRandom random(3);
        constexpr int kDraws = 200'000;
        const std::vector<double> edges{0, .2, .5, 1, 2, 5, 20, 90, 137, 145, 176, 180};
        std::vector<int> met(edges.size());
        for (int i = 0; i < kDraws; ++i) {
            const glm::dvec3 along = scattered(law, {.6, 0, .8}, random);
            ASSERT_NEAR(glm::length(along), 1, 1e-9);
            const double angle =
                2 * std::asin(std::min(1., .5 * glm::length(along - glm::dvec3(.6, 0, .8)))) * 180 /
                pi;
            ++met[static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end() - 1, angle) -
                                           edges.begin() - 1)];
        }
        for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
            const auto to = [&](double degrees) {
                return share_within(*medium.droplets,
                                    2 * std::pow(std::sin(degrees * pi / 360), 2));
            };
            const double share = to(edges[i + 1]) - to(edges[i]);
            EXPECT_NEAR(met[i] / double(kDraws), share, 5 * std::sqrt(share / kDraws))
                << diameter << " to " << edges[i + 1];
        }
        for (double angle = 0; angle <= 180; angle += 3)
            EXPECT_NEAR(truth::phase_value(law, std::cos(angle * pi / 180)) / p_at(medium, angle),
                        1, 1e-5);
    }
}

// A grid's picture against the paths', with the sun ahead and behind the eye.
TEST(Droplets, GridsAreTheTruths) {
    for (const double diameter : {6., 20., 45.})
        for (const double azimuth : {180., 0.}) {
            SceneDraft draft = test::balls({{{0, 0, 0}, 2, 1.5}, {{1, .5, 0}, 1.5, 1}});
            draft.medium = Medium{.albedo = 1, .phase = PhaseFunction::kMie, .droplet = diameter};
            // Ahead, out of the picture: within a degree of the sun a pixel's middle is not its mean.
            draft.sun.elevation = azimuth > 0 ? 25 : 4;
            draft.sun.azimuth = azimuth;
            draft.camera.eye = {0, 0, 12};
            draft.camera.fov = 26;
            draft.image.width = draft.image.height = 14;
            draft.image.background = Background::kTransparent;
            draft.accuracy.rung = "transport-24";
            const auto grid = render_scene(test::valid(draft), {}, {});
            ASSERT_TRUE(grid.ok());
            TruthOptions options;
            options.samples = 512;
            const double truth = test::mean_red(mean_of(test::traced(draft, options)));
            EXPECT_NEAR(test::mean_red(grid->image) / truth, 1, .03) << diameter << " " << azimuth;
        }
}

TEST(March, RestAndPeakAreTheDroplets) {
    const Medium medium = droplets(20);
    const Peak peak{4, phase_moment(medium, 4)};
    const PeakTable table = peak_table(medium, peak, 0, 2);
    for (double degrees = 0; degrees <= 180; degrees += .35) {
        const double half = degrees * pi / 360;
        const double ahead = 2 * std::sin(half), behind = 2 * std::cos(half);
        const RowAt row = row_at(table, ahead, behind);
        const auto at = static_cast<std::size_t>(row.row) * static_cast<std::size_t>(table.columns);
        const float low = table.values[at],
                    high = table.values[at + static_cast<std::size_t>(table.columns)];
        const double sum = rest_of_phase(rest_of(medium, peak), ahead, behind) +
                           static_cast<double>(low + row.share * (high - low));
        const double exact = phase_of_chords(medium, ahead, behind);
        ASSERT_NEAR(sum, exact, .03 * exact + 3e-4) << degrees;
    }
}

}  // namespace
}  // namespace awan
