// The macrostructure of implicit clouds, their densities and their warps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/implicit/sampling.h"
#include "tests/implicit_clouds.h"

namespace awan {
namespace {

using implicit::ImplicitField;
using implicit::lattice_over;
using implicit::prepare_field;
using implicit::sample;

using test::all_over;
using test::ball;
using test::bare;
using test::density;
using test::printed_cubic;
using test::skeleton;
constexpr double kPi = std::numbers::pi;

TEST(WyvillCubic, IsThePrintedOneWithItsEnds) {
    const ImplicitCloud cloud = bare({ball({0, 0, 0}, 2)});
    EXPECT_EQ(density(cloud, {0, 0, 0}), 1);
    EXPECT_EQ(density(cloud, {2, 0, 0}), 0);
    EXPECT_EQ(density(cloud, {0, -2.001, 0}), 0);
    EXPECT_NEAR(density(cloud, {0, 0, 1}), 0.5, 1e-6);  // symmetrical about 1/2 at half the radius
    // Level at both ends: over .02 radii it changes by the second derivative's .02^2 * 22/9 and 10/3.
    EXPECT_NEAR(density(cloud, {0.04, 0, 0}), 1, 1e-3);
    EXPECT_NEAR(density(cloud, {1.96, 0, 0}), 0, 1.4e-3);
    for (double a = 0; a < 1.2; a += 0.01)
        EXPECT_NEAR(density(cloud, {0, 2 * a, 0}), printed_cubic(a), 1e-6) << a;  // floats
}

// Integral of the density over space by the lattice: for smooth fields with nothing at their edge, midpoints are better
// than the tolerances, which leave room for the kink in the second derivative at the reach.
double integral(const ImplicitCloud& cloud, std::uint64_t resolution = 96) {
    const ImplicitField field = prepare_field(cloud, test::kKey, 0);
    LatticeField lattice = lattice_over(field, resolution);
    EXPECT_FALSE(sample(field, 2, {}, lattice));
    return lattice_mass(lattice);
}

double simpson(double from, double to, const std::function<double(double)>& f) {
    constexpr int kSteps = 400;
    double sum = f(from) + f(to);
    for (int i = 1; i < kSteps; ++i) sum += (i % 2 ? 4 : 2) * f(from + (to - from) * i / kSteps);
    return sum * (to - from) / kSteps / 3;
}

TEST(Integral, OfASphereIsTheClosedForm) {
    // 736/2835 pi R^3, not the 748/405 pi R of Upchurch 2009.
    EXPECT_NEAR(integral(bare({ball({3, 1, -2}, 1.7)})) / (736.0 / 2835 * kPi * std::pow(1.7, 3)),
                1, 1e-4);
    const double by_quadrature =
        simpson(0, 1, [](double a) { return 4 * kPi * a * a * printed_cubic(a); });
    EXPECT_NEAR(by_quadrature, 736.0 / 2835 * kPi, 1e-9);
}

TEST(Integral, OfAnEllipsoidIsTheSpheresTimesItsAxesHoweverTurned) {
    ImplicitPrimitive egg = ball({3, 1, -2}, 2);
    egg.shape = ImplicitShape::kEllipsoid;
    egg.radii = {1.5, 0.4, 0.8};
    const double wanted = 736.0 / 2835 * kPi * 8 * 1.5 * 0.4 * 0.8;
    EXPECT_NEAR(integral(bare({egg})) / wanted, 1, 3e-4);
    egg.rotate = {20, -70, 130};
    EXPECT_NEAR(integral(bare({egg})) / wanted, 1, 3e-4);
}

TEST(Macrostructure, IsTurnedAboutXThenYThenZ) {
    // A rod along +z: about x by 90 degrees it comes to -y, where turning about y leaves it; about z it goes on to +x.
    ImplicitPrimitive rod = skeleton(ImplicitShape::kSegment, {{0, 0, 0}, {0, 0, 8}}, 1);
    rod.rotate = {90, 90, 0};
    EXPECT_GT(density(bare({rod}), {0, -6, 0}), 0.5);
    EXPECT_EQ(density(bare({rod}), {6, 0, 0}), 0);
    EXPECT_EQ(density(bare({rod}), {0, 6, 0}), 0);
    rod.rotate = {90, 0, 90};
    EXPECT_GT(density(bare({rod}), {6, 0, 0}), 0.5);
    EXPECT_EQ(density(bare({rod}), {0, -6, 0}), 0);
}

TEST(Integral, OfASegmentIsATubeAndABall) {
    const double r = 0.8, length = std::sqrt(9 + 1 + 4.0);
    const double wanted = 8.0 / 27 * kPi * r * r * length + 736.0 / 2835 * kPi * r * r * r;
    EXPECT_NEAR(
        integral(bare({skeleton(ImplicitShape::kSegment, {{0, 0, 0}, {3, 1, 2}}, r)})) / wanted, 1,
        5e-4);
}

TEST(Integral, OfASolidCylinderIsThatOfItsDistances) {
    const double r = 0.7, core = 0.5, length = 3;
    // Area at distance d: the side, the two ends, the two rims.
    const auto area = [&](double d) {
        return 2 * kPi * (core + d) * length + 2 * kPi * core * core + 2 * kPi * kPi * core * d +
               4 * kPi * d * d;
    };
    const double wanted = kPi * core * core * length +
                          simpson(0, r, [&](double d) { return area(d) * printed_cubic(d / r); });
    ImplicitPrimitive cylinder =
        skeleton(ImplicitShape::kCylinder, {{0, -1.5, 0}, {0, 1.5, 0}}, r, core);
    EXPECT_NEAR(integral(bare({cylinder})) / wanted, 1, 1e-3);
    cylinder.rotate = {0, 40, 65};
    EXPECT_NEAR(integral(bare({cylinder})) / wanted, 1, 1e-3);
}

TEST(Integral, OfASphereWithACoreIsThatOfItsDistances) {
    ImplicitPrimitive sphere = ball({0, 0, 0}, 0.9);
    sphere.core = 0.6;
    const double wanted = 4 * kPi / 3 * std::pow(0.6, 3) + simpson(0, 0.9, [](double d) {
                              return 4 * kPi * (0.6 + d) * (0.6 + d) * printed_cubic(d / 0.9);
                          });
    EXPECT_NEAR(integral(bare({sphere})) / wanted, 1, 5e-4);
}

TEST(Macrostructure, TheClosestPointOfASkeletonCounts) {
    const std::vector<glm::dvec3> points = {{0, 0, 0}, {2, 0, 0}, {2, 1.5, 0}, {0.5, 1.5, 1}};
    const ImplicitCloud cloud = bare({skeleton(ImplicitShape::kSegment, points, 1.2)});
    all_over({1, 0.7, 0.5}, 2.4, 500, [&](glm::dvec3 p) {
        double nearest = 1e9;  // of points close together on it
        for (std::size_t i = 1; i < points.size(); ++i)
            for (int step = 0; step <= 1000; ++step)
                nearest =
                    std::min(nearest, glm::distance(p, points[i - 1] + (points[i] - points[i - 1]) *
                                                                           (step / 1000.0)));
        // A thousandth of a piece aside, the distance is wrong by 1e-6 at most where h is not 1.
        EXPECT_NEAR(density(cloud, p), printed_cubic(nearest / 1.2), 1e-5);
    });
}

TEST(Macrostructure, IsTheSumOfItsPrimitivesAndNeverNegative) {
    const ImplicitPrimitive a = ball({-0.5, 0, 0}, 1.5, 0.8), b = ball({0.7, 0.2, 0}, 1.2, 1.7),
                            hole = ball({0, 0, 0}, 1, -2);
    all_over({0, 0, 0}, 2, 300, [&](glm::dvec3 p) {
        const auto h = [&](const ImplicitPrimitive& one) {
            return one.weight * printed_cubic(glm::distance(p, one.center) / one.radius);
        };
        EXPECT_NEAR(density(bare({a, b}), p), h(a) + h(b), 1e-6);
        EXPECT_NEAR(density(bare({a, b, hole}), p), std::max(0.0, h(a) + h(b) + h(hole)), 2e-6);
    });
}

TEST(Density, FollowsAmountExponentAndWeight) {
    for (const double exponent : {0.1, 0.5, 1.0, 2.3, 8.0})
        all_over({0, 0, 0}, 1, 60, [&](glm::dvec3 p) {
            ImplicitCloud cloud = bare({ball({0, 0, 0}, 1.5, 3)});
            cloud.amount = 0.4;
            cloud.exponent = exponent;
            const double wanted = std::pow(0.4 * 3 * printed_cubic(glm::length(p) / 1.5), exponent);
            // The logarithm's error, 1e-6, times the exponent; and what floats lose near the reach, where the base is
            // small.
            EXPECT_NEAR(density(cloud, p), wanted, 2e-5 * wanted + 1e-6) << exponent;
        });
    // Linear in weight at exponent 1.
    const double once = density(bare({ball({0, 0, 0}, 1.5, 0.7)}), {0.4, 0.5, 0});
    EXPECT_NEAR(density(bare({ball({0, 0, 0}, 1.5, 2.1)}), {0.4, 0.5, 0}), 3 * once, 1e-6);
}

TEST(Density, BlendsBetweenThePrimitivesAndTheTurbulence) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1)});
    const glm::dvec3 p(0.3, 0.1, -0.2);
    const double m = density(cloud, p);
    cloud.blend = 0.0;
    const double turbulent = density(cloud, p);  // t m
    EXPECT_GT(turbulent, 0);
    for (const double blend : {0.25, 0.4, 0.8}) {
        cloud.blend = blend;
        EXPECT_NEAR(density(cloud, p), blend * m + (1 - blend) * turbulent, 1e-6);
    }
    // Nothing stands outside the primitives, whatever the turbulence.
    cloud.blend = 0.0;
    EXPECT_EQ(density(cloud, {0.8, 0.7, 0}), 0);
}

TEST(Density, OfACloudDescribedLargerIsTheSameInItsPlaces) {
    ImplicitCloud small;  // the cumulus, with all its noise
    small.jet = glm::dvec3(0.5, 0.1, 0);
    small.ripple = glm::dvec3(0.4, 0, 0.6);
    small.ripple_depth = 0.5;
    ImplicitCloud large = small;
    large.primitives = resolved(small).primitives;
    small.primitives = large.primitives;
    for (ImplicitPrimitive& p : *large.primitives) p.center *= 8.0, p.radius *= 8;
    int inside = 0;
    all_over({0, 70, 0}, 250, 400, [&](glm::dvec3 p) {
        // Eight is a power of two: the same floats.
        EXPECT_EQ(density(small, p), density(large, 8.0 * p));
        inside += density(small, p) > 0;
    });
    EXPECT_GT(inside, 50);
}

TEST(Density, IsCutAtItsLimitAndFiniteAtTheEndsOfTheRanges) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1, 100), ball({0, 0, 0}, 1, 100)});
    cloud.amount = 100.0;
    for (const double exponent : {0.1, 1.0, 8.0}) {
        cloud.exponent = exponent;
        const double d = density(cloud, {0.1, 0, 0});
        EXPECT_TRUE(std::isfinite(d));
        EXPECT_LE(d, 1000);
        EXPECT_GT(d, 1);
    }
    cloud.amount = 0.0;
    cloud.exponent = 0.1;
    EXPECT_EQ(density(cloud, {0.1, 0, 0}), 0);
}

TEST(Base, NothingIsBelowIt) {
    ImplicitCloud cloud;
    cloud.base = 10.0;
    cloud.primitives = resolved(cloud).primitives;
    const ImplicitSettings s = resolved(cloud);
    all_over({0, 60, 0}, 300, 600, [&](glm::dvec3 p) {
        if (p.y < 10 - 0.25 * s.displacement * s.mean_radius) {
            EXPECT_EQ(density(cloud, p), 0);
        }
    });
    EXPECT_GT(density(cloud, {0, 60, 0}), 0);
}

TEST(Ripple, ModulatesWithItsWavelength) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 10)});
    cloud.ripple = glm::dvec3(0.2, 0, 0);  // 2 units
    cloud.ripple_depth = 1.0;
    cloud.ripple_turbulence = 0.0;
    const ImplicitCloud plain = bare({ball({0, 0, 0}, 10)});
    for (double x = -3; x < 3; x += 0.13)
        EXPECT_NEAR(density(cloud, {x, 0.5, 1}),
                    density(plain, {x, 0.5, 1}) * (0.5 + 0.5 * std::sin(2 * kPi * x / 2)), 1e-5);
}

}  // namespace
}  // namespace awan
