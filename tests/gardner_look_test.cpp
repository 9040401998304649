// Gardner's look: shading, rays against ellipsoids, the limb curve, the picture's laws.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/looks/gardner.h"
#include "core/looks/looks.h"
#include "core/scene/outside.h"
#include "tests/ellipsoids_scenes.h"
#include "tests/random_models_ellipsoids.h"

namespace awan {
namespace {

using ellipsoids::PlacedEllipsoid;

using namespace test;
using namespace gardner;

constexpr double kDegree = std::numbers::pi / 180;

// --- shading

TEST(GardnerShading, IsTheEquationOfTheSourceAtItsLimits) {
    const auto i = [](double s, double t, double a) {
        return intensity({s, t, a, 1}, 0.25, 0.5, 0.75);  // Id, Is, It
    };
    EXPECT_DOUBLE_EQ(i(0.3, 0.4, 1), 1);       // all ambient
    EXPECT_DOUBLE_EQ(i(0, 0, 0), 0.25);        // Lambert
    EXPECT_DOUBLE_EQ(i(1, 0, 0), 0.5);         // specular
    EXPECT_DOUBLE_EQ(i(0.5, 1, 0), 0.75);      // texture alone
    EXPECT_DOUBLE_EQ(i(0, 0.5, 0), 0.5);       // half and half
    EXPECT_DOUBLE_EQ(i(0.5, 0, 0.5), 0.6875);  // .5 * .375 + .5
    EXPECT_DOUBLE_EQ(intensity({0.2, 0.3, 0.4, 1}, 1, 1, 1), 1);
    EXPECT_DOUBLE_EQ(intensity({0.2, 0.3, 0.4, 1}, 0, 0, 0), 0.4);
}

TEST(GardnerShading, DiffuseAndSpecularFaceTheSun) {
    const glm::dvec3 up(0, 1, 0), side(1, 0, 0);
    EXPECT_DOUBLE_EQ(diffuse(up, up), 1);
    EXPECT_DOUBLE_EQ(diffuse(up, side), 0);
    EXPECT_DOUBLE_EQ(diffuse(up, -up), 0);
    EXPECT_DOUBLE_EQ(specular(up, up, up, 4), 1);
    EXPECT_DOUBLE_EQ(specular(up, -up, up, 4), 0);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(1, 1, 0)), mirror(-sun.x, sun.y, 0);
    EXPECT_NEAR(specular(up, sun, mirror, 30), 1, 1e-12);
    EXPECT_NEAR(specular(up, sun, up, 2), 0.5, 1e-12);  // 45 degrees off
}

// --- rays

PlacedEllipsoid random_one(Dice& dice) {
    PlacedEllipsoid one;
    one.center = {dice.between(-2, 2), dice.between(-2, 2), dice.between(-2, 2)};
    one.radii = {dice.between(0.2, 2), dice.between(0.2, 2), dice.between(0.2, 2)};
    one.axes = ellipsoids::turned_axes(dice.between(-180, 180), dice.between(-180, 180),
                                       dice.between(-180, 180));
    return one;
}

// In a cloud of its own, with no texture.
UnitSphere seen_from(const PlacedEllipsoid& one, const glm::dvec3& eye) {
    UnitSphere sphere;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 e(0);
        e[axis] = 1;
        sphere.to_unit[axis] = one.to_unit(one.center + e);
    }
    sphere.eye = one.to_unit(eye);
    return sphere;
}

TEST(GardnerRays, MeetAnEllipsoidWhereSmallStepsDo) {
    Dice dice(1);
    int met = 0;
    for (int i = 0; i < 400; ++i) {
        const PlacedEllipsoid one = random_one(dice);
        const glm::dvec3 eye = dice.between(0, 5) * dice.on_sphere();
        const glm::dvec3 way = glm::normalize(one.center + 1.5 * dice.on_sphere() - eye);
        const auto side = [&](double t) {
            const glm::dvec3 u = one.to_unit(eye + t * way);
            return glm::dot(u, u) - 1;
        };
        // The first change of side, by steps, then halved.
        double found = -1;
        for (double t = 0; t < 12; t += 0.002)
            if ((side(t) > 0) != (side(t + 0.002) > 0)) {
                double low = t, high = t + 0.002;
                for (int k = 0; k < 40; ++k) {
                    const double middle = (low + high) / 2;
                    ((side(low) > 0) == (side(middle) > 0) ? low : high) = middle;
                }
                found = low;
                break;
            }
        const auto hit_there = hit(seen_from(one, eye), way);
        if (found < 0) {
            // Steps may miss a chord of less than a step; the limb is then next to nothing.
            if (hit_there) {
                EXPECT_LT(hit_there->limb, 1e-4);
            }
            continue;
        }
        ++met;
        ASSERT_TRUE(hit_there);
        EXPECT_NEAR(hit_there->distance, found, 1e-8);
        EXPECT_NEAR(glm::length(hit_there->at), 1, 1e-12);
        EXPECT_LT(glm::length(one.from_unit(hit_there->at) - (eye + found * way)), 1e-7);
    }
    EXPECT_GT(met, 60);
}

TEST(GardnerRays, KeepTheirDigitsFromFarAway) {
    PlacedEllipsoid one;
    const glm::dvec3 eye(0, 0, 1e8);
    for (const double b : {0.0, 0.3, 0.9}) {
        const glm::dvec3 way = glm::normalize(glm::dvec3(b, 0, 0) - eye);
        const auto met = hit(seen_from(one, eye), way);
        ASSERT_TRUE(met);
        EXPECT_NEAR(met->limb, 1 - b * b, 1e-6);  // a direction has 16 digits, 1e8 takes 8
        EXPECT_NEAR(met->at.x, b, 1e-6);
    }
}

TEST(GardnerRays, LimbIsOneAtTheCentreAndZeroOnTheSilhouette) {
    Dice dice(2);
    for (int i = 0; i < 300; ++i) {
        const PlacedEllipsoid one = random_one(dice);
        const glm::dvec3 eye = one.center + dice.between(2.5, 9) * dice.on_sphere();
        const UnitSphere sphere = seen_from(one, eye);
        const auto centre = hit(sphere, glm::normalize(one.center - eye));
        ASSERT_TRUE(centre);
        EXPECT_NEAR(centre->limb, 1, 1e-12);
        // From the centre of the view outward to where it is missed: the limb goes to 0 as the square of b goes to 1.
        const glm::dvec3 forward = glm::normalize(one.center - eye);
        const glm::dvec3 side = glm::normalize(glm::cross(forward, dice.on_sphere()));
        double in = 0, out = 10, last = 1;
        for (int k = 0; k < 60; ++k) {
            const double middle = (in + out) / 2;
            const auto met = hit(sphere, glm::normalize(forward + middle * side));
            (met ? in : out) = middle;
            if (met) last = met->limb;
        }
        EXPECT_LT(last, 1e-9);
        // Falls all the way.
        double before = 1 + 1e-12;
        for (int k = 0; k <= 20; ++k) {
            const auto met = hit(sphere, glm::normalize(forward + 0.999 * k / 20 * in * side));
            ASSERT_TRUE(met);
            EXPECT_LT(met->limb, before);
            before = met->limb;
        }
    }
}

View view_of(const glm::dvec3& eye, const glm::dvec3& target) {
    Camera camera;
    camera.automatic = false;
    camera.eye = eye;
    camera.target = target;
    camera.fov = 60;
    ImageSettings image;
    return resolve_view(camera, image, {});
}

TEST(GardnerRays, ThePrintedLimbCurveHasTheSameSilhouette) {
    Dice dice(3);
    for (int i = 0; i < 200; ++i) {
        const PlacedEllipsoid one = random_one(dice);
        const glm::dvec3 eye = one.center + dice.between(3, 9) * dice.on_sphere();
        const View view = view_of(eye, one.center + 0.3 * dice.on_sphere());
        const UnitSphere sphere = seen_from(one, eye);
        const auto curve = limb_on_picture(sphere, view);
        ASSERT_TRUE(curve);
        double largest = 0;
        for (int k = 0; k < 400; ++k) {
            const double x = dice.between(-0.9, 0.9), z = dice.between(-0.7, 0.7);
            const double f = (*curve)(x, z);
            largest = std::max(largest, f);
            const auto met =
                hit(sphere, glm::normalize(view.forward + x * view.right + z * view.up));
            if (std::abs(f) > 1e-9) {
                EXPECT_EQ(f > 0, met.has_value());
            }
        }
        EXPECT_LE(largest, 1 + 1e-9) << "its value at its own centre is 1";
        // From far away, where rays are parallel, the two are one.
        const glm::dvec3 far = one.center + 1e5 * dice.on_sphere();
        const View distant = view_of(far, one.center);
        const UnitSphere from_far = seen_from(one, far);
        const auto same = limb_on_picture(from_far, distant);
        ASSERT_TRUE(same);
        for (int k = 0; k < 20; ++k) {
            const double x = dice.between(-2e-5, 2e-5), z = dice.between(-2e-5, 2e-5);
            const auto met =
                hit(from_far, glm::normalize(distant.forward + x * distant.right + z * distant.up));
            if (met) {
                EXPECT_NEAR(met->limb, (*same)(x, z), 1e-4);
            }
        }
    }
}

TEST(GardnerRays, ThePrintedLimbCurveFailsBesideTheEye) {
    // An ellipsoid that reaches behind the eye, beside it: its silhouette is a hyperbola, or all the picture is inside;
    // ours has its values from 0 to 1 there.
    PlacedEllipsoid one;
    one.radii = {1, 1, 5};
    const glm::dvec3 eye(2, 0, 2);
    const View view = view_of(eye, {1, 0, -3});
    const UnitSphere sphere = seen_from(one, eye);
    EXPECT_FALSE(limb_on_picture(sphere, view));
    EXPECT_TRUE(hit(sphere, glm::normalize(glm::dvec3(0, 0, -5) - eye + glm::dvec3(0, 0, 0.1))));
    EXPECT_FALSE(limb_on_picture(seen_from(one, {0, 0, 0}), view)) << "inside";
    EXPECT_TRUE(hit(seen_from(one, {0, 0, 0}), view.forward)) << "inside";
}

}  // namespace
}  // namespace awan
