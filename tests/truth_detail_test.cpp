// The path tracer's matter with detail, against sums over the particles that know nothing of its lattice.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/truth/flight.h"
#include "core/truth/matter.h"
#include "core/truth/oracles.h"
#include "core/truth/primary_ray.h"
#include "tests/scenes.h"

namespace awan {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Table 4.4 with detail, as it is planned.
Planned detailed_cloud(double amount) {
    SceneDraft draft = test::table_4_4();
    draft.density = 0.06;
    draft.detail = Detail{amount, 1.2};
    draft.image.width = draft.image.height = 64;
    draft.accuracy.rung = "truth";
    auto planned = plan_scene(test::valid(draft), 2, {});
    EXPECT_TRUE(planned.ok());
    return *std::move(planned);
}

// Of the particles' sum with its lumps, by the midpoints of two hundred steps a bump.
double quadrature(const ParticleSet& particles, const glm::dvec3& o, const glm::dvec3& d,
                  double length) {
    const DetailField& field = *particles.detail;
    const auto steps = static_cast<int>(std::ceil(length / (field.bump / 200)));
    const double step = length / steps;
    double depth = 0;
    for (int i = 0; i < steps; ++i) {
        const glm::dvec3 p = o + (i + 0.5) * step * d;
        const auto smooth = static_cast<float>(extinction_at(particles, p));
        depth += step * static_cast<double>(detailed(field, smooth, bumps_at(field, p)));
    }
    return depth;
}

// Enough to leave the cloud.
double far_out(const ParticleSet& particles, const glm::dvec3& o) {
    double far = 0;
    for (std::size_t i = 0; i < particles.size(); ++i)
        far = std::max(far, glm::length(particles.center[i] - o) +
                                2.5 * static_cast<double>(particles.radius[i]));
    return far;
}

struct Apart {
    double largest = 0, mean = 0;
};

TEST(DetailInTruth, SunComesThroughAsItMust) {
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.5, 0.7, 0.4));
    for (const double amount : {0.4, 1.0}) {
        const Planned planned = detailed_cloud(amount);
        const ParticleSet& particles = planned.particles;
        ASSERT_TRUE(particles.detail);
        const truth::Matter matter = truth::make_matter(particles, to_sun, 2, {}).value();
        constexpr int kPlaces = 24, kFlights = 4000;
        Apart apart;
        double partly = 0;
        for (int place = 0; place < kPlaces; ++place) {
            truth::PathRandom random(static_cast<std::uint64_t>(place) + 7);
            // About a particle, from its middle out to where it is thin.
            const auto near = static_cast<std::size_t>(random.unit() * 0.9999 *
                                                       static_cast<double>(particles.size()));
            const glm::dvec3 off(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
            const glm::dvec3 p =
                particles.center[near] + 2.0 * static_cast<double>(particles.radius[near]) * off;
            const double exact = std::exp(-quadrature(particles, p, to_sun, far_out(particles, p)));
            const glm::dvec3 q = matter.axes * ((p - matter.origin) / matter.cell) + matter.shift;
            int through = 0;
            double unused;
            for (int i = 0; i < kFlights; ++i)
                through +=
                    truth::fly(matter, q, matter.axes * to_sun, kInfinite, random, unused) ? 0 : 1;
            const double found = through / double{kFlights};
            apart.largest = std::max(apart.largest, std::abs(found - exact));
            apart.mean += (found - exact) / kPlaces;
            partly += exact > 0.05 && exact < 0.95 ? 1 : 0;
        }
        // Four standard errors of one place at worst, and of the mean.
        EXPECT_LT(apart.largest, 4 * std::sqrt(0.25 / kFlights)) << amount;
        EXPECT_LT(std::abs(apart.mean), 4 * std::sqrt(0.25 / kFlights / kPlaces)) << amount;
        EXPECT_GT(partly, kPlaces / 4) << amount;
    }
}

TEST(DetailInTruth, EyeSeesTheDepthThatItMust) {
    const Planned planned = detailed_cloud(0.8);
    const ParticleSet& particles = planned.particles;
    const truth::Matter matter =
        truth::make_matter(particles, glm::normalize(glm::dvec3(0.3, 0.9, 0.1)), 2, {}).value();
    const View& view = planned.survey.view;
    Apart apart;
    int rays = 0;
    for (int x = 4; x < 64; x += 9)
        for (int y = 4; y < 64; y += 9) {
            const PixelRay ray = pixel_ray(view, 64, 64, x, y);
            const double exact = std::exp(
                -quadrature(particles, ray.origin, ray.direction, far_out(particles, ray.origin)));
            const truth::PrimaryRay primary(matter, (ray.origin - matter.origin) / matter.cell,
                                            ray.direction, kInfinite);
            const double off = std::exp(-primary.depth()) - exact;
            apart.largest = std::max(apart.largest, std::abs(off));
            apart.mean += off;
            ++rays;
        }
    EXPECT_LT(apart.largest, 0.03);
    EXPECT_LT(std::abs(apart.mean) / rays, 0.002);
}

}  // namespace
}  // namespace awan
