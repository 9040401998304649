// Gardner's general quadrics, sines by hand, patterns over one plane, and limits; ellipsoids that are joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/generate/ellipsoids/lattice.h"
#include "core/looks/gardner.h"
#include "core/looks/looks.h"
#include "tests/ellipsoids_scenes.h"
#include "tests/random_models_ellipsoids.h"
#include "tests/scenes.h"

namespace awan {
namespace {

using namespace ellipsoids;
using test::Dice;

Ellipsoid ball(const glm::dvec3& center) {
    Ellipsoid one;
    one.center = center;
    return one;
}

// Q of the source at a place of ours: its X, Y, Z are our x, z, y.
double printed(const Quadric& q, const glm::dvec3& p) {
    const double x = p.x, y = p.z, z = p.y;
    return q.q1 * x * x + q.q2 * y * y + q.q3 * z * z + q.q4 * x * y + q.q5 * y * z + q.q6 * x * z +
           q.q7 * x + q.q8 * y + q.q9 * z + q.q0;
}

// One with all ten coefficients, by its value at ten places at most: sum of the squares of three random linear forms.
Quadric random_quadric(Dice& dice) {
    Quadric q{0, 0, 0, 0, 0, 0, 0, 0, 0, -dice.between(1, 4)};
    for (int i = 0; i < 3; ++i) {
        const double a = dice.between(-1, 1), b = dice.between(-1, 1), c = dice.between(-1, 1),
                     d = dice.between(-1, 1);
        q.q1 += a * a;
        q.q2 += b * b;
        q.q3 += c * c;
        q.q4 += 2 * a * b;
        q.q5 += 2 * b * c;
        q.q6 += 2 * a * c;
        q.q7 += 2 * a * d;
        q.q8 += 2 * b * d;
        q.q9 += 2 * c * d;
        q.q0 += d * d;
    }
    return q;
}

TEST(EllipsoidsGeneral, QuadricsAreTheSurfacesOfTheirEquations) {
    Dice dice(1);
    int checked = 0;
    for (int i = 0; i < 300; ++i) {
        Quadric q = random_quadric(dice);
        // The same surface: only ratios count.
        const double by = dice.chance(0.5) ? -3 : 0.01;
        for (double* c : {&q.q1, &q.q2, &q.q3, &q.q4, &q.q5, &q.q6, &q.q7, &q.q8, &q.q9, &q.q0})
            *c *= by;
        const auto shape = shape_of(q);
        if (!shape || std::max({shape->radii.x, shape->radii.y, shape->radii.z}) > 100) continue;
        ++checked;
        EllipsoidsCloud cloud;
        cloud.quadrics.push_back(q);
        const std::vector<PlacedEllipsoid> placed = placed_ellipsoids(cloud, 1);
        ASSERT_EQ(placed.size(), 1u);
        const double within = std::abs(printed(q, placed[0].center));
        for (int k = 0; k < 20; ++k) {
            const glm::dvec3 p = placed[0].from_unit(dice.on_sphere());
            ASSERT_NEAR(printed(q, p) / within, 0, 1e-9);
            ASSERT_LT(glm::length(placed[0].to_unit(p)) - 1, 1e-9);
        }
    }
    EXPECT_GT(checked, 150);
    EXPECT_FALSE(shape_of({1, 1, -1, 0, 0, 0, 0, 0, 0, -1}));  // a hyperboloid
    EXPECT_FALSE(shape_of({1, 1, 1, 0, 0, 0, 0, 0, 0, 1}));    // of no points
    EXPECT_FALSE(shape_of({1, 1, 0, 0, 0, 0, 0, 0, 0, -1}));   // a cylinder
}

// The limb curve of the source, from the equation alone: lines of sight touch the surface where the discriminant of
// Q(eye + t d) = 0 is 0.
TEST(EllipsoidsGeneral, TheLimbOfATiltedQuadricIsWhereLinesOfSightTouchIt) {
    Dice dice(2);
    int inside = 0, outside = 0;
    for (int i = 0; i < 200; ++i) {
        const Quadric q = random_quadric(dice);
        EllipsoidsCloud cloud;
        cloud.quadrics.push_back(q);
        const auto placed = placed_ellipsoids(cloud, 1);
        if (placed.empty()) continue;
        const glm::dvec3 eye = placed[0].from_unit(3.0 * dice.on_sphere());
        gardner::UnitSphere sphere;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 e(0);
            e[axis] = 1;
            sphere.to_unit[axis] = placed[0].direction_to_unit(e);
        }
        sphere.eye = placed[0].to_unit(eye);
        const glm::dvec3 to = placed[0].from_unit(dice.between(0, 2) * dice.on_sphere());
        const glm::dvec3 d = glm::normalize(to - eye);
        const double c = printed(q, eye), with = printed(q, eye + d), against = printed(q, eye - d);
        const double b = (with - against) / 2, a = (with + against) / 2 - c;
        const double discriminant = b * b - 4 * a * c;
        const auto hit = gardner::hit(sphere, d);
        if (discriminant < 0) {
            EXPECT_FALSE(hit);
            ++outside;
            continue;
        }
        if (!hit) continue;  // behind the eye
        ++inside;
        EXPECT_NEAR(printed(q, eye + hit->distance * d), 0, 1e-7 * std::abs(c));
        // Normalised: 1 through the centre. Both are the discriminant's share of its largest along d.
        const double most = -4 * a * printed(q, placed[0].center);
        EXPECT_NEAR(hit->limb, discriminant / most, 1e-5);
    }
    EXPECT_GT(inside, 30);
    EXPECT_GT(outside, 30);
}

TEST(EllipsoidsGeneral, AxesTurnAboutZThenXThenY) {
    const auto near = [](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::length(a - b) < 1e-15;
    };
    EXPECT_TRUE(near(turned_axes(90, 0, 0) * glm::dvec3(1, 0, 0), {0, 1, 0}));
    EXPECT_TRUE(near(turned_axes(0, 90, 0) * glm::dvec3(0, 1, 0), {0, 0, 1}));
    EXPECT_TRUE(near(turned_axes(0, 0, 90) * glm::dvec3(0, 0, 1), {1, 0, 0}));
    EXPECT_TRUE(near(turned_axes(90, 90, 90) * glm::dvec3(1, 0, 0), {1, 0, 0}));
    EXPECT_EQ(turned_axes(0, 0, 0), glm::dmat3(1));
}

// Tilted by as much as is said at most, and linked as before.
TEST(EllipsoidsGeneral, FormationsTilt) {
    EllipsoidsCloud cloud = test::with_formation(FormationKind::kCombined, 200);
    for (const PlacedEllipsoid& one : placed_ellipsoids(cloud, 3))
        EXPECT_EQ(one.axes, glm::dmat3(1));
    cloud.formations[0].tilt = 30;
    double most = 1;
    for (const PlacedEllipsoid& one : placed_ellipsoids(cloud, 3))
        most = std::min(most, one.axes[1].y);
    EXPECT_GE(most, std::cos(30 * std::numbers::pi / 180) - 1e-12);
    EXPECT_LT(most, std::cos(27 * std::numbers::pi / 180));
}

// --- sines by hand

// T as printed, term by term: phases of the other axis's frequency before, F0 = F1 / 2; k left out.
double by_formula(const SineTexture& texture, const glm::dvec3& p, bool in_space) {
    using std::numbers::pi;
    constexpr double kDegrees = pi / 180;
    double a = 0, b = 0;
    for (std::size_t i = 0; i < texture.sines.size(); ++i) {
        const Sine& s = texture.sines[i];
        const double fy_before =
            i > 0 ? texture.sines[i - 1].frequency_z : texture.sines[0].frequency_z / 2;
        const double fx_before =
            i > 0 ? texture.sines[i - 1].frequency_x : texture.sines[0].frequency_x / 2;
        double px = pi / 2 * std::sin(fy_before * p.z), py = pi / 2 * std::sin(fx_before * p.x);
        const double height = in_space ? pi * std::sin(s.frequency_x * p.y / 2) : 0;
        px += height + s.phase_x * kDegrees;
        py += height + s.phase_z * kDegrees;
        a += s.amplitude * (std::sin(s.frequency_x * p.x + px) + texture.offset);
        b += s.amplitude * (std::sin(s.frequency_z * p.z + py) + texture.offset);
    }
    return std::max(a, 0.0) * std::max(b, 0.0);
}

TEST(EllipsoidsGeneral, SinesByHandAreTheSumsOfTheSource) {
    Dice dice(5);
    for (int i = 0; i < 40; ++i) {
        SineTexture texture;
        texture.offset = dice.between(0.3, 1.5);
        for (int k = 1 + dice.below(8); k > 0; --k)
            texture.sines.push_back({dice.between(0.1, 2), dice.log_between(0.1, 10),
                                     dice.log_between(0.1, 10), dice.any(360), dice.any(360)});
        for (const bool in_space : {true, false}) {
            const TextureFunction function = texture_function(texture, in_space);
            double most = 0;
            for (int k = 0; k < 3000; ++k) {
                const glm::dvec3 p = dice.any_vector(30);
                const double t = texture_at(function, p).mean;
                ASSERT_NEAR(t, function.scale * by_formula(texture, p, in_space), 1e-6);
                most = std::max(most, t);
            }
            // k: hardly more than 1 is found, and half of it easily.
            EXPECT_LT(most, 1.15);
            EXPECT_GT(most, 0.4);
        }
    }
}

// The rule, written out by hand, is the rule: F doubled, C times .707.
TEST(EllipsoidsGeneral, TheRuleByHandIsTheRule) {
    SineTexture rule;
    rule.terms = 6;
    rule.frequency_x = 0.7;
    rule.frequency_z = 0.4;
    SineTexture hand = rule;
    double c = 1, f = 1;
    for (int i = 0; i < 6; ++i, c *= 0.707, f *= 2) hand.sines.push_back({c, 0.7 * f, 0.4 * f});
    Dice dice(6);
    for (const TextureForm form : {TextureForm::kClean, TextureForm::kPrinted})
        for (const bool in_space : {true, false}) {
            rule.form = hand.form = form;
            const TextureFunction a = texture_function(rule, in_space),
                                  b = texture_function(hand, in_space);
            EXPECT_NEAR(b.scale / a.scale, 1, 0.06);
            for (int i = 0; i < 500; ++i) {
                const glm::dvec3 p = dice.any_vector(20);
                for (const double blur : {0.0, 0.01}) {
                    const TextureValue x = texture_at(a, p, blur, blur);
                    const TextureValue y = texture_at(b, p, blur, blur);
                    ASSERT_NEAR(x.mean / a.scale, y.mean / b.scale, 1e-5);
                    ASSERT_NEAR(x.variance / (a.scale * a.scale), y.variance / (b.scale * b.scale),
                                1e-4);
                }
            }
        }
}

// --- patterns, limits, horizon

TEST(EllipsoidsGeneral, PatternsHaveTheirPartOfThePlane) {
    SkyPlane plane;
    PlanePattern& one = plane.patterns.emplace_back();
    one.x = 100;
    one.radius_x = 20;
    one.radius_z = 10;
    one.edge = 0.5;
    one.threshold = 0.1;
    EXPECT_EQ(share_of(one, {100, 7, 0}), 1);
    EXPECT_EQ(share_of(one, {110, 0, 0}), 1);
    EXPECT_NEAR(share_of(one, {115, 0, 0}), 0.5, 1e-12);
    EXPECT_EQ(share_of(one, {120, 0, 0}), 0);
    EXPECT_EQ(share_of(one, {100, 0, 10}), 0);
    const PlaneTexture texture = plane_texture(plane, glm::dvec3(0));
    const auto parts = [&](const glm::dvec3& p) {
        return parts_of(plane, texture, p,
                        [&](const TextureFunction& f) { return texture_at(f, p); });
    };
    Dice dice(7);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 p(dice.between(70, 130), 0, dice.between(-15, 15));
        const double w = share_of(one, p);
        const double own = opacity(texture_at(texture.own, p), plane.threshold, plane.range);
        const double other = opacity(texture_at(texture.patterns[0], p), 0.1, one.range);
        EXPECT_NEAR(parts(p).opacity(0, 0, 1), w * other + (1 - w) * own, 1e-12);
        EXPECT_NEAR(
            parts(p).texture(),
            w * texture_at(texture.patterns[0], p).mean + (1 - w) * texture_at(texture.own, p).mean,
            1e-12);
    }
}

// 0 <= TR <= 1 of the source, with other ends.
TEST(EllipsoidsGeneral, TranslucenceStaysBetweenItsLimits) {
    EXPECT_EQ(limited(0.3, 0, 1), 0.3);
    EXPECT_EQ(limited(1, 0.2, 1), 0.8);
    EXPECT_DOUBLE_EQ(limited(0, 0, 0.7), 0.3);
    EllipsoidsCloud cloud = test::with_ellipsoid(ball({0, 0, 0}));
    cloud.translucence.least = 0.25;
    cloud.translucence.most = 0.75;
    const auto placed = placed_ellipsoids(cloud, 1);
    const LatticeField field =
        opacity_of(placed, 0, 24, texture_function(cloud.texture, true), 1, {});
    float low = 1, high = 0;
    for (const float value : field.values) {
        if (value > 0) low = std::min(low, value);
        high = std::max(high, value);
    }
    EXPECT_EQ(low, 0.25F);
    EXPECT_EQ(high, 0.75F);
}

Image look_of(EllipsoidsCloud cloud, const glm::dvec3& eye, const glm::dvec3& target) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.look = Look::kGardner;
    Cloud& one = draft.clouds.emplace_back();
    one.model = CloudModel::kEllipsoids;
    one.ellipsoids = std::make_shared<EllipsoidsCloud>(std::move(cloud));
    draft.camera.automatic = false;
    draft.camera.eye = eye;
    draft.camera.target = target;
    draft.image.width = 96;
    draft.image.height = 96;
    draft.image.background = Background::kTransparent;
    const Scene scene = test::valid(draft);
    auto image = gardner_look(scene, resolve_view(scene->camera, scene->image, {}), 1, {});
    EXPECT_TRUE(image.ok());
    return *std::move(image);
}

TEST(EllipsoidsGeneral, APlaneFadesOutAtItsHorizon) {
    EllipsoidsCloud cloud;
    SkyPlane& plane = cloud.plane.emplace();
    plane.threshold = -5;  // opaque all over
    plane.horizon = 40;
    const Image image = look_of(cloud, {0, 0, 0}, {0, 10, -30});
    const double tan_half = std::tan(20 * std::numbers::pi / 180);
    const glm::dvec3 forward = glm::normalize(glm::dvec3(0, 10, -30)), right(1, 0, 0),
                     up = glm::cross(right, forward);
    int faded = 0;
    for (int y = 0; y < 96; ++y) {
        const double v = (1 - (y + 0.5) / 96 * 2) * tan_half, u = (48.5 / 96 * 2 - 1) * tan_half;
        const glm::dvec3 d = glm::normalize(forward + u * right + v * up);
        if (d.y <= 0) continue;
        const double away = 10 / d.y * std::hypot(d.x, d.z);
        const double left = std::clamp(2 - 2 * away / 40, 0.0, 1.0);
        const float alpha = image.pixels[4 * (static_cast<std::size_t>(y) * 96 + 48) + 3];
        EXPECT_NEAR(alpha, left, 1e-4) << y;
        faded += left > 0 && left < 1 ? 1 : 0;
    }
    EXPECT_GT(faded, 5);
}

// --- joined ellipsoids

// Two balls side by side: as printed both limb curves are near 0 where they meet, and the matter between them is gone.
TEST(EllipsoidsGeneral, JoinedEllipsoidsHaveNoGapBetweenThem) {
    EllipsoidsCloud cloud;
    cloud.ellipsoids = {ball({-0.8, 0, 0}), ball({0.8, 0, 0})};
    cloud.texture.offset = 100;  // flat: T is .96 at least
    cloud.translucence = {0, 2.2, 0.2};
    const auto placed = placed_ellipsoids(cloud, 1);
    const TextureFunction texture = texture_function(cloud.texture, true);
    const auto middle = [&](double join) {
        const LatticeField field = opacity_of(placed, join, 36, texture, 1, {});
        return field.values[field.index(field.nx / 2, field.ny / 2, field.nz / 2)];
    };
    EXPECT_EQ(middle(0), 0);
    EXPECT_GT(middle(1), 0.5F);
    EXPECT_EQ(joined_limb(0.3, 0.5, 0), 0.3);
    EXPECT_EQ(joined_limb(0.3, 0.5, 0.5), 0.55);
    EXPECT_EQ(joined_limb(0.8, 0.9, 1), 1);
}

// Where one wall comes out of another, the printed rule makes a crease: brightness jumps from one pixel to the next.
TEST(EllipsoidsGeneral, JoinedEllipsoidsHaveNoCreaseBetweenThem) {
    const auto steepest = [](double join) {
        EllipsoidsCloud cloud;
        cloud.ellipsoids = {ball({-0.6, 0, 0}), ball({0.6, 0, 0})};
        cloud = test::opaque(cloud);
        cloud.shading.texture = 0;
        cloud.join = join;
        const Image image = look_of(cloud, {0, 0, 4}, {0, 0, 0});
        double most = 0;
        // Along the middle row, well within the outline.
        for (std::size_t x = 36; x < 60; ++x) {
            const std::size_t at = 4 * (48 * 96 + x);
            most = std::max(most, std::abs(static_cast<double>(image.pixels[at]) -
                                           static_cast<double>(image.pixels[at + 4])) /
                                      static_cast<double>(image.pixels[at]));
        }
        return most;
    };
    EXPECT_GT(steepest(0), 2 * steepest(1));
    EXPECT_EQ(gardner::joined_share(3, 3, 0.5), 1);
    EXPECT_EQ(gardner::joined_share(3, 3.25, 0.5), 0.5);
    EXPECT_EQ(gardner::joined_share(3, 4, 0.5), 0);
    EXPECT_EQ(gardner::joined_share(3, 3, 0), 0);
}

}  // namespace
}  // namespace awan
