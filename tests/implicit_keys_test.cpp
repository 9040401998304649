// Keys of every parameter, squash and stretch, and particles that are moved elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <numbers>

#include "core/base/deadline.h"
#include "core/generate/implicit/field.h"
#include "core/generate/implicit/growth.h"
#include "core/generate/implicit/sampling.h"
#include "tests/implicit_clouds.h"

namespace awan {
namespace {

using implicit::box_of;
using implicit::prepare_field;
using test::all_over;
using test::ball;
using test::bare;
using test::density;
using test::printed_cubic;
using test::skeleton;

ImplicitKey key_at(double time) {
    ImplicitKey key;
    key.time = time;
    return key;
}

// The integral of the density over all of the cloud.
double mass_of(const ImplicitCloud& cloud, double time, std::uint64_t resolution = 72) {
    const implicit::ImplicitField field = prepare_field(cloud, test::kKey, time);
    LatticeField lattice = implicit::lattice_over(field, resolution);
    EXPECT_FALSE(implicit::sample(field, 1, Deadline(), lattice));
    double sum = 0;
    for (const float value : lattice.values) sum += static_cast<double>(value);
    return sum * std::pow(lattice.cell, 3);
}

// The clouds at times between keys are those that were described so.
void expect_same(const ImplicitCloud& keyed, double time, const ImplicitCloud& plain,
                 double tolerance = 2e-6) {
    int inside = 0;
    all_over({0, 0.5, 0}, 2, 1500, [&](glm::dvec3 p) {
        const double expected = density(plain, p);
        EXPECT_NEAR(density(keyed, p, time), expected, tolerance);
        inside += expected > 0 ? 1 : 0;
    });
    EXPECT_GT(inside, 10);
}

TEST(EveryKey, RadiiOfAnEllipsoid) {
    ImplicitPrimitive e = ball({0, 0.5, 0}, 1);
    e.shape = ImplicitShape::kEllipsoid;
    e.keys = {key_at(0), key_at(2)};
    e.keys[0].radii = glm::dvec3(1, 1, 1);
    e.keys[1].radii = glm::dvec3(2, 0.5, 1);
    ImplicitCloud cloud = bare({e});
    cloud.linear_keys = true;
    e.keys.clear();
    e.radii = {1.5, 0.75, 1};
    expect_same(cloud, 1, bare({e}));
    e.radii = {2, 0.5, 1};
    expect_same(cloud, 7, bare({e}));
}

TEST(EveryKey, EndsOfACylinderItsCoreAndItsTurn) {
    ImplicitPrimitive c = skeleton(ImplicitShape::kCylinder, {{-1, 0, 0}, {1, 0, 0}}, 0.6, 0.2);
    c.keys = {key_at(0), key_at(4)};
    c.keys[0].points = {{-1, 0, 0}, {1, 0, 0}};
    c.keys[1].points = {{-2, 0, 0}, {1, 1, 0}};
    c.keys[0].core = 0.2;
    c.keys[1].core = 0.6;
    c.keys[1].rotate = glm::dvec3(0, 0, 90);
    c.keys[0].rotate = glm::dvec3(0, 0, 0);
    ImplicitCloud cloud = bare({c});
    cloud.linear_keys = true;
    c.keys.clear();
    c.points = {{-1.25, 0, 0}, {1, 0.25, 0}};
    c.core = 0.3;
    c.rotate = {0, 0, 22.5};
    expect_same(cloud, 1, bare({c}), 5e-6);
    // Ease-in and ease-out: a quarter of the time is 5/32 of the way.
    cloud.linear_keys = false;
    const double t = 0.25 * 0.25 * (3 - 0.5);
    c.points = {{-1 - t, 0, 0}, {1, t, 0}};
    c.core = 0.2 + 0.4 * t;
    c.rotate = {0, 0, 90 * t};
    expect_same(cloud, 1, bare({c}), 5e-6);
}

TEST(EveryKey, PointsOfASkeleton) {
    ImplicitPrimitive s =
        skeleton(ImplicitShape::kSegment, {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}}, 0.5);
    s.keys = {key_at(0), key_at(2)};
    s.keys[0].points = {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}};
    s.keys[1].points = {{-1, 0, 0}, {0, 2, 0}, {1, 0, 0}};
    ImplicitCloud cloud = bare({s});
    cloud.linear_keys = true;
    s.keys.clear();
    s.points[1] = {0, 1, 0};
    expect_same(cloud, 1, bare({s}));
}

// Nothing of a cloud is outside its box, which is the same at all times, and what is near a place is found from it. At
// so many places at each time, up to `reach` from the middle.
void expect_the_box_holds(const ImplicitCloud& cloud, std::initializer_list<double> times,
                          glm::dvec3 middle, double reach, int places) {
    const implicit::Box box = box_of(prepare_field(cloud, test::kKey, 0));
    int inside = 0;
    for (const double time : times) {
        const implicit::ImplicitField field = prepare_field(cloud, test::kKey, time);
        EXPECT_EQ(box_of(field).min, box.min);
        EXPECT_EQ(box_of(field).max, box.max);
        all_over(middle, reach, places, [&](glm::dvec3 p) {
            if (implicit::density_at(field, p) <= 0) return;
            ++inside;
            for (int i = 0; i < 3; ++i) {
                EXPECT_GE(p[i], box.min[i] - 1e-4);
                EXPECT_LE(p[i], box.max[i] + 1e-4);
            }
            implicit::Box here;
            here.add(p);
            float one = 0;
            implicit::row_densities(field, implicit::elements_near(field, here), {p, 0, 1}, &one);
            EXPECT_NEAR(static_cast<double>(one), implicit::density_at(field, p), 1e-6);
        });
    }
    EXPECT_GT(inside, 50);
}

TEST(EveryKey, TheBoxHoldsAllTimes) {
    ImplicitPrimitive e = ball({0, 0, 0}, 1);
    e.shape = ImplicitShape::kEllipsoid;
    e.keys = {key_at(0), key_at(1), key_at(2)};
    e.keys[0].radii = glm::dvec3(2, 0.3, 1);
    e.keys[1].radii = glm::dvec3(0.3, 1.5, 1);
    e.keys[2].rotate = glm::dvec3(40, 200, 90);
    e.keys[1].center = glm::dvec3(1, 0, 0);
    ImplicitPrimitive s = skeleton(ImplicitShape::kSegment, {{-1, 0, 0}, {1, 0, 0}}, 0.5);
    s.keys = {key_at(0), key_at(2)};
    s.keys[0].points = {{-1, 0, 0}, {1, 2, 0}};
    s.keys[1].points = {{-1, -3, 0}, {2, 0, 0}};
    s.keys[1].core = 0.8;
    for (const bool turned : {false, true}) {
        if (turned) s.keys[0].rotate = glm::dvec3(0, 0, 120);
        ImplicitCloud cloud = bare({e, s});
        cloud.displacement = 0.3;
        cloud.keys.resize(2);
        cloud.keys[1].time = 2;
        cloud.keys[1].displacement = 1;
        cloud.keys[0].displacement = 0;
        cloud.keys[1].jet = glm::dvec3(2, 0, 0);
        cloud.keys[0].jet = glm::dvec3(0, 0, -1);
        cloud.squash = ImplicitSquash{{0.3, 0, 0}, {0.3, 1, 0.2}, 1, {{0, 0.5}, {1, 2}}};
        expect_the_box_holds(cloud, {-1.0, 0.0, 0.4, 1.0, 1.5, 2.0}, {0, 0, 0}, 9, 4000);
    }
}

TEST(EveryKey, OfTheCloudItself) {
    ImplicitCloud cloud = bare({ball({0, 0.5, 0}, 1.5), ball({1, 1, 0}, 1)});
    cloud.linear_keys = true;
    ImplicitCloudKey first, last;
    last.time = 2;
    first.amount = 1, last.amount = 2;
    first.exponent = 1, last.exponent = 2;
    first.blend = 1, last.blend = 0.5;
    first.displacement = 0, last.displacement = 0.4;
    last.jet = glm::dvec3(1, 0, 0), first.jet = glm::dvec3(0);
    first.stretch = 1, last.stretch = 3;
    first.warp = 0.5, last.warp = 0.5;
    cloud.keys = {first, last};
    ImplicitCloud half = cloud;
    half.keys.clear();
    half.amount = 1.5, half.exponent = 1.5, half.blend = 0.75, half.displacement = 0.2;
    half.jet = glm::dvec3(0.25, 0, 0);  // by half
    half.stretch = 2;
    half.swirl = cloud.swirl = 0;
    all_over({0, 0.5, 0}, 2, 500,
             [&](glm::dvec3 p) { EXPECT_NEAR(density(cloud, p, 1), density(half, p, 1), 1e-5); });
    cloud.keys[0].base = -1, cloud.keys[1].base = 1;
    half.base = 0;
    all_over({0, 0.5, 0}, 2, 500,
             [&](glm::dvec3 p) { EXPECT_NEAR(density(cloud, p, 1), density(half, p, 1), 1e-5); });
}

// Warps between keys are those that were described so: straight, and by smoothstep.
TEST(EveryKey, OfAttractorsAndVortices) {
    ImplicitCloud cloud = bare({ball({0, 0.5, 0}, 1.5), ball({1, 1, 0}, 1)});
    cloud.swirl = 0;
    ImplicitCloud plain = cloud;
    ImplicitAttractor attractor{{0, 1, 0}, 1, 2, {}};
    attractor.keys = {
        {0, glm::dvec3(0, 1, 0), 0.0, {}}, {1, {}, {}, 2.0}, {4, glm::dvec3(1, 1, 0), 2.0, 3.0}};
    ImplicitVortex vortex{{0, 0, 0}, {0, 1, 0}, 30, 2, {}};
    vortex.keys = {{0, {}, glm::dvec3(0, 1, 0), 0.0, {}}, {4, {}, glm::dvec3(1, 1, 0), 120.0, {}}};
    cloud.attractors = {attractor};
    cloud.vortices = {vortex};
    for (const bool linear : {true, false}) {
        cloud.linear_keys = linear;
        // At 2 s: half of the ways from 0 to 4; of the reach a third of that from 1 to 4.
        const double third = linear ? 1. / 3 : 1. / 9 * (3 - 2. / 3);
        plain.attractors = {{{0.5, 1, 0}, 1, 2 + third, {}}};
        plain.vortices = {{{0, 0, 0}, {0.5, 1, 0}, 60, 2, {}}};
        expect_same(cloud, 2, plain, 2e-5);
        // After the last key they stay.
        plain.attractors = {{{1, 1, 0}, 2, 3, {}}};
        plain.vortices = {{{0, 0, 0}, {1, 1, 0}, 120, 2, {}}};
        expect_same(cloud, 9, plain, 2e-5);
    }
    // Halfway between opposite axes there is none: that of the vortex holds.
    vortex.keys = {{0, {}, glm::dvec3(1, 0, 0), 90.0, {}}, {2, {}, glm::dvec3(-1, 0, 0), 90.0, {}}};
    cloud.attractors.clear();
    cloud.vortices = {vortex};
    plain.attractors.clear();
    plain.vortices = {{{0, 0, 0}, {0, 1, 0}, 90, 2, {}}};
    expect_same(cloud, 1, plain, 2e-5);
}

TEST(EveryKey, OfAGrowthAsItIsSeen) {
    ImplicitCloud cloud = bare({});
    cloud.primitives.reset();
    cloud.linear_keys = true;
    ImplicitGrowth growth;
    growth.radius = 0.3;
    cloud.growth = growth;
    ImplicitCloud plain = cloud;
    ImplicitGrowthKey first, last;
    first.radius = 0.2, last.radius = 0.4, last.time = 60;
    first.center = glm::dvec3(0, 0, 0), last.center = glm::dvec3(2, 0, 0);
    first.weight = 0, last.weight = 2;
    cloud.growth->keys = {first, last};
    plain.growth->center = {1, 0, 0};
    const auto at_30 = [&](const ImplicitCloud& one, const glm::dvec3& p) {
        return density(one, p, 30);
    };
    int inside = 0;
    all_over({1, 0.3, 0}, 1.2, 2000, [&](glm::dvec3 p) {
        const double expected = at_30(plain, p);
        EXPECT_NEAR(at_30(cloud, p), expected, 2e-5);
        inside += expected > 0 ? 1 : 0;
    });
    EXPECT_GT(inside, 10);
    EXPECT_EQ(density(cloud, {0, 0, 0}, 0), 0);
}

// What acts on the particles at a time: a force that ends, a rate that begins.
TEST(EveryKey, OfAGrowthAsItMoves) {
    ImplicitGrowth growth;
    growth.turbulence = growth.drag = 0;
    growth.velocity = glm::dvec3(0);
    growth.lifetime = 100;
    growth.rate = 0;
    // 1 / s^2 for 20 s of 60, in a step: after that they go on as fast as they are, 20, and have come 200 by then.
    ImplicitGrowthKey on, off;
    on.force = glm::dvec3(0, 1, 0), off.force = glm::dvec3(0);
    on.time = 20 - 1e-9, off.time = 20;
    growth.keys = {on, off};
    growth.force = {0, 0, 0};
    const auto before = implicit::grown(growth, 1, 0), after = implicit::grown(growth, 1, 22);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        EXPECT_NEAR(after[i].velocity.y, 20, 1e-6);
        EXPECT_EQ(after[i].velocity.x, 0);
    }
    // Children only from the key on that says so.
    ImplicitGrowth fertile;
    fertile.most = 200;
    ImplicitGrowthKey none, many;
    none.rate = 0, none.time = 10 - 1e-9, many.rate = 5, many.time = 10;
    fertile.keys = {none, many};
    EXPECT_EQ(implicit::grown(fertile, 1, 9.5).size(), fertile.seeds);
    EXPECT_GT(implicit::grown(fertile, 1, 24).size(), fertile.seeds + 20);
}

TEST(EveryKey, TheBoxHoldsAllTimesOfWarpsAndGrowths) {
    ImplicitCloud cloud = bare({});
    cloud.primitives.reset();
    cloud.growth = ImplicitGrowth{};
    cloud.growth->radius = 0.4;
    ImplicitGrowthKey first, last;
    first.radius = 0.6, last.radius = 0.1, last.time = 40;
    first.center = glm::dvec3(-1, 0, 0), last.center = glm::dvec3(2, 1, 0);
    last.force = glm::dvec3(0, 0, 0.05);
    cloud.growth->keys = {first, last};
    ImplicitAttractor attractor{{0, 1, 0}, 0, 2, {}};
    attractor.keys = {{0, glm::dvec3(-2, 0, 0), 2.0, 1.0}, {30, glm::dvec3(2, 1, 0), -0.9, 3.0}};
    ImplicitVortex vortex{{0, 0, 0}, {0, 1, 0}, 0, 0.5, {}};
    vortex.keys = {{10, {}, {}, 0.0, {}},
                   {50, glm::dvec3(1, 0, 1), glm::dvec3(0, 0, 1), 400.0, 3.0}};
    cloud.attractors = {attractor};
    cloud.vortices = {vortex};
    expect_the_box_holds(cloud, {-1.0, 0.0, 7.0, 20.0, 35.0, 50.0, 70.0}, {0, 0.5, 0}, 3, 8000);
}

// Squash and stretch keeps the volume, at every time, with all that the cloud has.
TEST(Squash, KeepsTheMass) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1), ball({0.8, 0.4, 0}, 0.8)});
    cloud.displacement = 0.3;
    cloud.swirl = 0;
    const double usual = mass_of(cloud, 0);
    cloud.squash = ImplicitSquash{{0, 0.2, 0}, {0.2, 1, 0}, 1, {{0, 0.5}, {1, 1}, {2, 2.5}}};
    for (const double time : {0.0, 0.3, 1.0, 1.7, 2.0})
        EXPECT_NEAR(mass_of(cloud, time), usual, 0.01 * usual) << time;
    // An ellipsoid whose semi-axes' product stays keeps it too, at its keys.
    ImplicitPrimitive e = ball({0, 0, 0}, 1);
    e.shape = ImplicitShape::kEllipsoid;
    e.keys = {key_at(0), key_at(1)};
    e.keys[0].radii = glm::dvec3(1);
    e.keys[1].radii = glm::dvec3(1 / std::sqrt(2.0), 2, 1 / std::sqrt(2.0));
    const ImplicitCloud stretched = bare({e});
    // Of a sphere: 4 pi R^3 times the integral of the cubic and a^2 from 0 to 1.
    const double sphere = 4 * std::numbers::pi * (1. / 3 - 22. / 45 + 17. / 63 - 4. / 81);
    EXPECT_NEAR(mass_of(stretched, 0), sphere, 0.01 * sphere);
    EXPECT_NEAR(mass_of(stretched, 1), sphere, 0.01 * sphere);
}

TEST(Squash, IsLongerAlongItsAxisAndNarrowerAcross) {
    ImplicitCloud cloud = bare({ball({0, 0, 0}, 1)});
    cloud.squash = ImplicitSquash{{0, 0, 0}, {0, 2, 0}, 4, {}};
    for (const double a : {0.2, 0.5, 0.9}) {
        EXPECT_NEAR(density(cloud, {0, 4 * a, 0}), printed_cubic(a), 1e-6);
        EXPECT_NEAR(density(cloud, {0.5 * a, 0, 0}), printed_cubic(a), 1e-6);
        EXPECT_NEAR(density(cloud, {0, 0, 0.5 * a}), printed_cubic(a), 1e-6);
    }
    // About its place, which stays.
    cloud.squash->at = {0, 1, 0};
    EXPECT_NEAR(density(cloud, {0, -3, 0}), 1, 1e-6);
}

// A table's particles: spheres where the rows say, between them in between; born from nothing, and at rest after.
TEST(Table, MovesSpheres) {
    ImplicitCloud cloud = bare({});
    cloud.primitives.reset();
    cloud.linear_keys = true;
    cloud.particles = {
        {2, 7, {4, 0, 0}, 1, 1}, {0, 7, {0, 0, 0}, 1, 1}, {1, 3, {0, 3, 0}, 0.5, 0.8}};
    EXPECT_NEAR(density(cloud, {0, 0, 0}, 0), 1, 1e-6);
    EXPECT_NEAR(density(cloud, {2, 0, 0}, 1), 1, 1e-6);
    EXPECT_NEAR(density(cloud, {2.5, 0, 0}, 1), printed_cubic(0.5), 1e-5);
    EXPECT_NEAR(density(cloud, {4, 0, 0}, 99), 1, 1e-6);  // dormant, not dead
    // Number 3 is not there at 0, half there at .5, there from 1 on.
    EXPECT_EQ(density(cloud, {0, 3, 0}, 0), 0);
    EXPECT_NEAR(density(cloud, {0, 3, 0}, 0.5), 0.4, 1e-6);
    EXPECT_NEAR(density(cloud, {0, 3, 0}, 1), 0.8, 1e-6);
    EXPECT_NEAR(density(cloud, {0, 3, 0}, 9), 0.8, 1e-6);
}

}  // namespace
}  // namespace awan
