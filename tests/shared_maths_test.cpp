// The shaders' own text, compiled as C++, against double precision: integrals, limits,
// cancellation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/light/light.h"
#include "core/shaders/shared.h"

namespace awan {
namespace {

glm::vec3 at_angle(double angle) {
    return {static_cast<float>(std::sin(angle)), 0.F, static_cast<float>(std::cos(angle))};
}
const glm::vec3 kAhead(0, 0, 1);

// Integral over the sphere / 4 pi of f(cos) p, on a grid refined towards both poles.
template <typename Phase, typename Weight>
double sphere_mean(const Phase& phase, const Weight& weight) {
    double sum = 0;
    constexpr int kSteps = 20000;
    for (int half = 0; half < 2; ++half)
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + 0.5) / kSteps;  // angle = pi/2 t^4 from the pole
            const double from_pole = std::numbers::pi / 2 * std::pow(t, 4);
            const double angle = half == 0 ? from_pole : std::numbers::pi - from_pole;
            const double width = std::numbers::pi / 2 * 4 * std::pow(t, 3) / kSteps;
            sum += 0.5 * std::sin(angle) * width * static_cast<double>(phase(at_angle(angle))) *
                   weight(std::cos(angle));
        }
    return sum;
}

TEST(Phase, MeanOverTheSphereIsOneAndMeanCosineIsG) {
    for (const float g : {0.F, 0.3F, -0.3F, 0.85F, -0.85F, 0.99F, 0.999F, -0.999F}) {
        const auto hg = [&](glm::vec3 ray) { return shader::henyey_greenstein(kAhead, ray, g); };
        EXPECT_NEAR(sphere_mean(hg, [](double) { return 1.0; }), 1, 2e-3) << g;
        EXPECT_NEAR(sphere_mean(hg, [](double c) { return c; }), static_cast<double>(g), 2e-3) << g;
        const auto cs = [&](glm::vec3 ray) { return shader::cornette_shanks(kAhead, ray, g); };
        EXPECT_NEAR(sphere_mean(cs, [](double) { return 1.0; }), 1, 2e-3) << g;
    }
}

TEST(Phase, PrintedCornetteShanksIsNotNormalised) {
    const float g = 0.5F;
    const auto printed = [&](glm::vec3 ray) {
        return shader::cornette_shanks(kAhead, ray, g) * (2 + g * g) / (1 + g * g);
    };
    EXPECT_GT(sphere_mean(printed, [](double) { return 1.0; }), 1.5);
}

TEST(Phase, CornetteShanksAtZeroIsRayleigh) {
    for (double angle = 0; angle < 3.2; angle += 0.1)
        EXPECT_NEAR(static_cast<double>(shader::cornette_shanks(kAhead, at_angle(angle), 0)),
                    0.75 * (1 + std::pow(std::cos(angle), 2)), 1e-6);
}

TEST(Phase, FiniteStraightAheadAndBackForEveryAllowedG) {
    for (const float g : {0.999F, -0.999F})
        for (const glm::vec3 ray : {kAhead, -kAhead}) {
            const double p = static_cast<double>(shader::henyey_greenstein(kAhead, ray, g));
            EXPECT_TRUE(std::isfinite(p));
            const double cosine = static_cast<double>(ray.z), gd = static_cast<double>(g);
            const double exact = (1 - gd * gd) / std::pow(1 + gd * gd - 2 * gd * cosine, 1.5);
            EXPECT_NEAR(p / exact, 1, 1e-3);  // g itself is rounded: 1 - |g| to 6e-5
        }
}

TEST(Optics, OneMinusExpKeepsItsDigits) {
    for (double tau = 1e-30; tau < 1e30; tau *= 1.3) {
        const double exact = -std::expm1(-static_cast<double>(static_cast<float>(tau)));
        EXPECT_NEAR(static_cast<double>(shader::one_minus_exp(static_cast<float>(tau))) / exact, 1,
                    3e-6)
            << tau;
        EXPECT_NEAR(
            static_cast<double>(shader::one_minus_exp(glm::vec4(static_cast<float>(tau))).z) /
                exact,
            1, 3e-6);
    }
    EXPECT_EQ(shader::one_minus_exp(0.F), 0.F);
}

TEST(Optics, NormalCdf) {
    for (double x = -6; x < 6; x += 0.01) {
        const double exact = 0.5 * std::erfc(-x / std::numbers::sqrt2);
        EXPECT_NEAR(static_cast<double>(shader::normal_cdf(glm::vec4(static_cast<float>(x))).x),
                    exact, 3e-7)
            << x;
    }
}

TEST(Sky, MeanAboveIsTheMean) {
    const glm::vec3 zenith(0.1F, 0.2F, 0.8F), horizon(0.7F, 0.8F, 0.9F);
    glm::dvec3 sum(0);
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i)
        sum += glm::dvec3(
                   shader::sky_radiance((static_cast<float>(i) + 0.5F) / kSteps, zenith, horizon)) /
               double{kSteps};
    const glm::dvec3 mean(shader::sky_mean_above(zenith, horizon));
    EXPECT_LT(glm::length(sum - mean), 1e-5);
}

TEST(Gathering, FractionIsThePhaseFunctionsOwn) {
    for (const double g : {0.0, 0.2, 0.85, -0.5, 0.999}) {
        const Medium medium{1, g, PhaseFunction::kHenyeyGreenstein};
        for (const double angle : {0.1, 0.7, std::numbers::pi / 2, 2.5, std::numbers::pi}) {
            const double mu = std::cos(angle);
            const double exact = g == 0 ? (1 - mu) / 2
                                        : (1 - g * g) / (2 * g) *
                                              (1 / (1 - g) - 1 / std::sqrt(1 + g * g - 2 * g * mu));
            EXPECT_NEAR(gathering_fraction(medium, angle), exact, 1e-4) << g << " " << angle;
        }
        EXPECT_LE(gathering_fraction({1, g, PhaseFunction::kCornetteShanks}, std::numbers::pi), 1);
        EXPECT_NEAR(gathering_fraction({1, g, PhaseFunction::kCornetteShanks}, std::numbers::pi), 1,
                    1e-4);
    }
}

}  // namespace
}  // namespace awan
