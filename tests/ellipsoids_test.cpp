// A cloud of ellipsoids as matter: formations, mass, bounds, limits, the same for all threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "core/generate/ellipsoids/lattice.h"
#include "core/generate/gaussian.h"
#include "core/generate/generate.h"
#include "core/generate/keyed_random.h"
#include "tests/ellipsoids_scenes.h"
#include "tests/random_models_ellipsoids.h"

namespace awan {
namespace {

using ellipsoids::limb_in_space;
using ellipsoids::opacity;
using ellipsoids::placed_ellipsoids;
using ellipsoids::PlacedEllipsoid;
using ellipsoids::texture_at;
using ellipsoids::texture_function;
using ellipsoids::TextureFunction;
using ellipsoids::threshold_at;

using namespace test;

ParticleSet generated(const SceneDraft& draft, int threads = 1, bool coarse = false) {
    auto set = generate(valid(draft), threads, {}, coarse);
    EXPECT_TRUE(set.ok());
    return *std::move(set);
}

bool same_bytes(const ParticleSet& a, const ParticleSet& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof x[0]) == 0);
    };
    return same(a.center, b.center) && same(a.radius, b.radius) && same(a.density, b.density);
}

double mass_of(const ParticleSet& set) {
    double mass = 0;
    for (std::size_t i = 0; i < set.size(); ++i) mass += gaussian_mass(set, i);
    return mass;
}

// --- formations

// Whether they share a point: the smallest of the larger of both distances, along the way between the centres.
bool overlap(const PlacedEllipsoid& a, const PlacedEllipsoid& b) {
    for (int i = 0; i <= 1000; ++i) {
        const glm::dvec3 p = a.center + (b.center - a.center) * (i / 1000.0);
        const glm::dvec3 u = a.to_unit(p), v = b.to_unit(p);
        if (glm::dot(u, u) <= 1 && glm::dot(v, v) <= 1) return true;
    }
    return false;
}

TEST(Formations, EllipsoidsAreLinked) {
    Dice dice(1);
    for (int k = 0; k < 100; ++k)
        for (const FormationKind kind :
             {FormationKind::kHorizontal, FormationKind::kVertical, FormationKind::kCombined}) {
            EllipsoidsCloud model = with_formation(kind, 30);
            Formation& formation = model.formations[0];
            formation.link = dice.between(limits::kMinLink, limits::kMaxLink);
            formation.variation = dice.between(0, limits::kMaxRadiusVariation);
            formation.spread = dice.between(0, 180);
            formation.radii = {dice.between(0.5, 3), dice.between(0.5, 3), dice.between(0.5, 3)};
            const auto all = placed_ellipsoids(model, static_cast<std::uint64_t>(k));
            ASSERT_EQ(all.size(), 30u);
            EXPECT_EQ(all[0].linked_to, -1);
            EXPECT_EQ(all[0].center, formation.center);
            for (std::size_t i = 1; i < all.size(); ++i) {
                ASSERT_GE(all[i].linked_to, 0);
                ASSERT_LT(all[i].linked_to, static_cast<int>(i));
                EXPECT_TRUE(overlap(all[i], all[static_cast<std::size_t>(all[i].linked_to)]));
            }
        }
}

TEST(Formations, HorizontalIsLevelVerticalClimbsCombinedHasBoth) {
    for (std::uint64_t key = 0; key < 50; ++key) {
        const auto level = placed_ellipsoids(with_formation(FormationKind::kHorizontal, 20), key);
        for (const PlacedEllipsoid& one : level) EXPECT_EQ(one.center.y, 0);
        const auto tower = placed_ellipsoids(with_formation(FormationKind::kVertical, 20), key);
        for (std::size_t i = 1; i < tower.size(); ++i)  // spread is below 90 degrees: always upward
            EXPECT_GT(tower[i].center.y,
                      tower[static_cast<std::size_t>(tower[i].linked_to)].center.y);
        const auto both = placed_ellipsoids(with_formation(FormationKind::kCombined, 20), key);
        std::size_t lying = 0;
        for (const PlacedEllipsoid& one : both) lying += one.center.y == 0;
        EXPECT_EQ(lying, 7u);  // a third, rounded up
    }
}

TEST(Formations, OneIsItsOwnWhateverStandsBesideIt) {
    EllipsoidsCloud alone = with_formation(FormationKind::kCombined, 10);
    EllipsoidsCloud longer = alone;
    longer.formations[0].count = 15;
    longer.formations.push_back(alone.formations[0]);
    longer.ellipsoids.push_back({});
    const auto few = placed_ellipsoids(with_formation(FormationKind::kVertical, 10), 7);
    EllipsoidsCloud more = with_formation(FormationKind::kVertical, 15);
    more.ellipsoids.push_back({});
    const auto many = placed_ellipsoids(more, 7);
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].center, many[i].center);
    const auto all = placed_ellipsoids(longer, 7);
    EXPECT_NE(all[1].center, all[16].center) << "two formations of equal figures differ";
}

TEST(Formations, AnEmptyCloudIsOneOfTheDefaults) {
    const auto all = placed_ellipsoids({}, 3);
    EXPECT_EQ(all.size(), Formation{}.count);
    EllipsoidsCloud sky;
    sky.plane.emplace();
    EXPECT_TRUE(placed_ellipsoids(sky, 3).empty());
}

TEST(Ellipsoids, UnitSpaceIsItsOwnInverse) {
    Dice dice(2);
    for (int i = 0; i < 1000; ++i) {
        PlacedEllipsoid one;
        one.center = dice.any_vector(100);
        one.radii = {dice.between(0.1, 5), dice.between(0.1, 5), dice.between(0.1, 5)};
        one.axes = ellipsoids::turned_axes(dice.between(-400, 400), dice.between(-400, 400),
                                           dice.between(-400, 400));
        const glm::dvec3 u = dice.on_sphere();
        const glm::dvec3 p = one.from_unit(u);
        EXPECT_LT(glm::length(one.to_unit(p) - u), 1e-12 * (1 + glm::length(one.center) / 0.1));
        const glm::dvec3 off = glm::abs(p - one.center);
        EXPECT_LE(off.x, one.half_box().x * (1 + 1e-12));
        EXPECT_LE(off.y, one.half_box().y * (1 + 1e-12));
        EXPECT_LE(off.z, one.half_box().z * (1 + 1e-12));
    }
}

// --- limb and translucence

TEST(Translucence, IsT1AtTheCentreAndT2OnTheSilhouette) {
    const Translucence t{0.2, 0.9, 0.1};
    EXPECT_DOUBLE_EQ(threshold_at(t, 1), 0.2);
    EXPECT_DOUBLE_EQ(threshold_at(t, 0), 0.9);
    // TR = clamp(1 - (It - T1 - (T2-T1)(1-g))/D, 0, 1) of Gardner 1985.
    for (const double g : {0.0, 0.3, 1.0})
        for (const double it : {0.0, 0.25, 0.5, 0.85, 1.0}) {
            const double tr = std::clamp(1 - (it - 0.2 - (0.9 - 0.2) * (1 - g)) / 0.1, 0.0, 1.0);
            EXPECT_NEAR(1 - opacity({it, 0}, threshold_at(t, g), 0.1), tr, 1e-12);
        }
    // The sense: where there is much texture it is opaque; at the edge less of it is.
    EXPECT_EQ(opacity({1, 0}, threshold_at(t, 1), 0.1), 1);
    EXPECT_EQ(opacity({0, 0}, threshold_at(t, 1), 0.1), 0);
    EXPECT_GT(opacity({0.5, 0}, threshold_at(t, 1), 0.1),
              opacity({0.5, 0}, threshold_at(t, 0), 0.1));
}

TEST(Translucence, LimbInSpaceHasTheRaysLimbAsItsLargestValue) {
    Dice dice(4);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 from = 3.0 * dice.on_sphere(), way = dice.on_sphere();
        const glm::dvec3 across = glm::cross(from, way);
        double most = -1e9;
        for (double t = -6; t < 6; t += 0.001) {
            const glm::dvec3 p = from + t * way;
            most = std::max(most, limb_in_space(glm::dot(p, p)));
        }
        EXPECT_NEAR(most, 1 - glm::dot(across, across), 1e-6);
    }
}

// --- matter

TEST(EllipsoidsVolume, OpaqueEllipsoidHasTheMassOfItsVolume) {
    const Ellipsoid one{{1, 2, 3}, {3, 1.5, 2}, 33, {}, {}, {}};
    EllipsoidsCloud model = opaque(with_ellipsoid(one));
    for (const std::uint64_t resolution : {32, 64, 128}) {
        model.resolution = resolution;
        SceneDraft draft = scene_of(model);
        draft.density = 0.5;
        const double expected = 0.5 * model.density * 4 / 3 * std::numbers::pi * 3 * 1.5 * 2;
        // Cells in or out by their middles: errors of the surface's cells cancel as the square root of their number,
        // r^2 of them: .3% at 32 and less beyond.
        EXPECT_NEAR(mass_of(generated(draft)) / expected, 1,
                    0.12 / static_cast<double>(resolution));
    }
}

TEST(EllipsoidsVolume, MassIsTheQuadratureOfTheTexturedOpacity) {
    EllipsoidsCloud model = with_ellipsoid({{0, 0, 0}, {2, 1.5, 1}, 20, {}, {}, {}});
    model.ellipsoids.push_back({{1.5, 0.5, 0}, {1, 1, 1.5}, 0, 0.2, {}, 0.3});
    model.texture.frequency_x = model.texture.frequency_z = 2;
    model.texture.terms = 4;  // all of it coarser than a cell below
    model.resolution = 96;
    SceneDraft draft = scene_of(model);
    draft.density = 1;
    const double made = mass_of(generated(draft));
    // A Monte Carlo sum of the rule itself, places by low discrepancy: good to .1%.
    const auto all = placed_ellipsoids(model, 0);
    const TextureFunction texture = texture_function(model.texture, true);
    ScrambledSobol points(9, 0);
    constexpr int kPoints = 400000;
    const glm::dvec3 low(-3, -2, -2), size(6, 4, 4);
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
        const auto u = points.next();
        const glm::dvec3 p = low + size * glm::dvec3(u[0], u[1], u[2]);
        double most = 0;
        for (const PlacedEllipsoid& one : all) {
            const glm::dvec3 q = one.to_unit(p);
            const double r2 = glm::dot(q, q);
            if (r2 > 1) continue;
            const Translucence& t = one.translucence;
            const double it = texture_at(texture, p).mean;
            most = std::max(
                most,
                std::clamp((it - t.threshold - (t.threshold_edge - t.threshold) * r2) / t.range,
                           0.0, 1.0));
        }
        sum += most;
    }
    const double expected = model.density * sum / kPoints * size.x * size.y * size.z;
    // Blur over a cell moves mass at the thresholds' bends a little.
    EXPECT_NEAR(made / expected, 1, 0.01);
}

TEST(EllipsoidsVolume, PlaneHasTheDepthOfItsSlab) {
    EllipsoidsCloud model;
    SkyPlane& plane = model.plane.emplace();
    plane.extent = 20;
    plane.altitude = 7;
    plane.resolution = 50;
    for (const double thickness : {0.1, 1.0, 3.0}) {  // below and above a cell
        plane.thickness = thickness;
        SceneDraft draft = scene_of(opaque(model));
        draft.density = 1;
        const ParticleSet set = generated(draft);
        // Fades to 0 over the outer tenth: the mean over the square of min(10 (1 - r), 1), r the larger of |x|, |z|.
        const double share = 0.81 + 2 * 10 * (0.5 * (1 - 0.81) - (1 - 0.729) / 3);
        const double expected = plane.density * 400 * thickness * share;
        // Middles of 2.5 cells stand for the ramp: .43% above it.
        EXPECT_NEAR(mass_of(set) / expected, 1, 6e-3) << thickness;
        const double cell = 0.4;
        const Bounds bounds = bounds_of(set);
        EXPECT_LT(bounds.max.y, 7 + thickness / 2 + 1.3 * cell + 1e-9);
        EXPECT_GT(bounds.min.y, 7 - thickness / 2 - 1.3 * cell - 1e-9);
        EXPECT_LT(bounds.max.x, 10 + 1.3 * cell);
    }
}

TEST(EllipsoidsVolume, ErrorFallsWithTheCells) {
    const auto error_at = [](std::uint64_t resolution) {
        EllipsoidsCloud model = with_formation(FormationKind::kCombined, 12);
        model.texture.terms = 4;
        model.resolution = resolution;
        return generated(scene_of(model)).error;
    };
    const double coarse = error_at(16), middle = error_at(48), fine = error_at(144);
    EXPECT_GT(coarse, middle);
    EXPECT_GT(middle, fine);
    EXPECT_LT(fine, 0.05);
    EXPECT_GT(fine, 0);
}

TEST(EllipsoidsVolume, StandsWhereTheTransformPutsItAndDriftsWithTime) {
    EllipsoidsCloud model = with_ellipsoid({{0, 0, 0}, {1, 1, 1}, 0, {}, {}, {}});
    model.drift = {0.5, 0, 0};
    SceneDraft draft = scene_of(model);
    const ParticleSet now = generated(draft);
    draft.time = 1;
    const ParticleSet later = generated(draft);
    EXPECT_FALSE(same_bytes(now, later)) << "the texture goes on";
    const Bounds a = bounds_of(now), b = bounds_of(later);
    EXPECT_LT(glm::length(a.max - b.max), 0.5) << "the ellipsoid stays";
    draft.clouds[0].velocity = {10, 0, 0};
    const Bounds moved = bounds_of(generated(draft));
    EXPECT_NEAR(moved.min.x - b.min.x, 10, 1e-9);
}

TEST(EllipsoidsVolume, CoarseHasTheSameBounds) {
    for (const std::uint64_t count : {5, 40, 64}) {
        SceneDraft draft = scene_of(opaque(with_formation(FormationKind::kCombined, count)));
        const Bounds fine = bounds_of(generated(draft));
        const ParticleSet few = generated(draft, 1, true);
        const Bounds coarse = bounds_of(few);
        EXPECT_LE(few.size(), 900u);
        const double size = glm::length(fine.max - fine.min);
        EXPECT_LT(glm::length(coarse.max - fine.max), 0.05 * size);
        EXPECT_LT(glm::length(coarse.min - fine.min), 0.05 * size);
    }
}

TEST(EllipsoidsVolume, SameBytesForEveryNumberOfThreads) {
    EllipsoidsCloud model = with_formation(FormationKind::kCombined, 20);
    model.plane.emplace();
    const SceneDraft draft = scene_of(model);
    const ParticleSet one = generated(draft, 1);
    EXPECT_GT(one.size(), 1000u);
    EXPECT_TRUE(same_bytes(one, generated(draft, 2)));
    EXPECT_TRUE(same_bytes(one, generated(draft, 7)));
    EXPECT_EQ(one.error, generated(draft, 7).error);
}

TEST(EllipsoidsVolume, GivesUpWhenNobodyWaits) {
    Deadline over;
    over.until = Deadline::Clock::now();
    const auto set = generate(valid(scene_of({})), 2, over);
    ASSERT_FALSE(set.ok());
    EXPECT_EQ(set.error().code, ErrorCode::kOverDeadline);
}

TEST(EllipsoidsVolume, RandomCloudsAreFiniteBoundedAndTheSameOnTwoThreads) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Dice dice(seed);
        Whereabouts where;
        where.size = dice.log_between(1e-2, 1e4);
        where.middle = dice.any_vector(1e6);
        SceneDraft draft;
        draft.top_level_cubes = false;
        draft.clouds.push_back(random_ellipsoids(dice, where));
        draft.seed = seed;
        draft.density = 0.1;
        draft.time = dice.either({0, 1, -1e6});
        const Cloud& cloud = draft.clouds[0];
        const Scene scene = valid(draft);
        const ParticleSet set = generated(draft);
        ASSERT_LE(set.size(), most_particles(*cloud.ellipsoids));
        ASSERT_TRUE(std::isfinite(set.error) && set.error >= 0) << seed;
        for (std::size_t i = 0; i < set.size(); ++i) {
            ASSERT_TRUE(std::isfinite(glm::length(set.center[i]))) << seed;
            const double radius = static_cast<double>(set.radius[i]);
            ASSERT_GE(radius, limits::kMinRadius) << seed;
            ASSERT_LE(radius, limits::kMaxRadius * cloud.scale) << seed;
            ASSERT_TRUE(set.density[i] >= 0 && std::isfinite(set.density[i])) << seed;
        }
        ASSERT_TRUE(same_bytes(set, generated(draft, 2))) << seed;
        if (set.size() == 0) continue;
        // Within the coarse bounds, a tenth of an ellipsoid and a cell's reach.
        const Bounds fine = bounds_of(set), coarse = bounds_of(generated(draft, 1, true));
        const double slack =
            0.1 * glm::length(coarse.max - coarse.min) +
            2 * static_cast<double>(*std::max_element(set.radius.begin(), set.radius.end()));
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_GE(fine.min[axis], coarse.min[axis] - slack) << seed;
            ASSERT_LE(fine.max[axis], coarse.max[axis] + slack) << seed;
        }
    }
}

TEST(EllipsoidsVolume, ExtremesEnd) {
    // The most ellipsoids, all of one place, thinnest and largest; the finest lattice.
    EllipsoidsCloud model = with_formation(FormationKind::kVertical, limits::kMaxEllipsoids);
    model.formations[0].link = limits::kMaxLink;
    model.formations[0].radii = {limits::kMaxEllipsoidRadius, limits::kMinEllipsoidRadius, 1};
    model.formations[0].variation = limits::kMaxRadiusVariation;
    model.resolution = 16;
    const ParticleSet set = generated(scene_of(model), 2);
    for (const double x : {limits::kMinEllipsoidRadius, limits::kMaxEllipsoidRadius}) {
        EllipsoidsCloud one = with_ellipsoid({{1e6, -1e6, 1e6}, {x, x, x}, 1e6, {}, {}, {}});
        one.resolution = limits::kMaxLatticeResolution;
        const ParticleSet made = generated(scene_of(opaque(one)), 2);
        EXPECT_GT(made.size(), 1'000'000u);
        EXPECT_LE(made.size(), limits::kMaxParticles);
        for (const float radius : made.radius) {
            ASSERT_GE(radius, static_cast<float>(limits::kMinRadius));
            ASSERT_LE(radius, static_cast<float>(limits::kMaxRadius));
        }
    }
}

}  // namespace
}  // namespace awan
