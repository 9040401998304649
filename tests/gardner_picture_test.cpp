// Pictures of Gardner's look: what they show, that they are finite, free of aliases at the horizon, and the same for
// all threads.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "core/looks/gardner.h"
#include "core/looks/looks.h"
#include "tests/ellipsoids_scenes.h"
#include "tests/random_models_ellipsoids.h"

namespace awan {
namespace {

using ellipsoids::placed_ellipsoids;
using ellipsoids::PlacedEllipsoid;

using namespace test;

SceneDraft look_of(EllipsoidsCloud model) {
    SceneDraft draft = scene_of(std::move(model));
    draft.look = Look::kGardner;
    draft.image.background = Background::kTransparent;
    draft.camera.automatic = false;
    draft.camera.eye = {0, 0, 10};
    return draft;
}

Image picture_of(const SceneDraft& draft, int threads = 1) {
    const Scene scene = valid(draft);
    const View view = resolve_view(draft.camera, draft.image, {glm::dvec3(-1), glm::dvec3(1)});
    auto image = draw_look(scene, view, threads, {});
    EXPECT_TRUE(image.ok());
    return *std::move(image);
}

void expect_finite(const Image& image, const char* what, std::uint64_t seed = 0) {
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        ASSERT_TRUE(std::isfinite(image.pixels[i]) && image.pixels[i] >= 0) << what << " " << seed;
        if (i % 4 == 3) {
            ASSERT_LE(image.pixels[i], 1) << what << " " << seed;
        }
    }
}

TEST(GardnerPicture, AnOpaqueBallCoversItsDiscAndNoMore) {
    const SceneDraft draft = look_of(opaque(with_ellipsoid({{0, 0, 0}, {1, 1, 1}, 0, {}, {}, {}})));
    const Image image = picture_of(draft);
    double covered = 0;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) covered += image.pixels[4 * i + 3];
    // The disc's angular radius is asin(1/10); a pixel is 2 tan(20 deg)/48 high.
    const double radius = std::tan(std::asin(0.1)) / (2 * std::tan(20 * 0.017453292519943295) / 48);
    EXPECT_NEAR(covered, std::numbers::pi * radius * radius, 2 * std::numbers::pi * radius * 0.5)
        << "within half a pixel all round";
    EXPECT_EQ(pixel(image, 32, 24).a, 1);
    EXPECT_EQ(pixel(image, 0, 0).a, 0);
    EXPECT_EQ(pixel(image, 0, 0).r, 0);
}

TEST(GardnerPicture, ItsLitSideFacesTheSunAndWhiteIsWhereExposureExpectsIt) {
    EllipsoidsCloud model = opaque(with_ellipsoid({{0, 0, 0}, {1, 1, 1}, 0, {}, {}, {}}));
    model.shading = {0, 0, 0.2, 1};
    SceneDraft draft = look_of(model);
    draft.sun.direction = glm::dvec3(1, 0, 0);
    draft.sun.color = glm::dvec3(1);
    draft.sun.intensity = 3.14159265358979324;
    draft.sky.none = true;
    const Image image = picture_of(draft);
    // I = .2 + .8 n.l, white is half of irradiance / pi.
    for (const int x : {28, 32, 36}) {
        const View view = resolve_view(draft.camera, draft.image, {});
        const Ray one = ray(view, image, x, 24);
        const double b = glm::dot(one.eye, one.direction);
        const double t = -b - std::sqrt(b * b - glm::dot(one.eye, one.eye) + 1);
        const double lit = std::max((one.eye + t * one.direction).x, 0.0);
        EXPECT_NEAR(pixel(image, x, 24).r, 0.5 * (0.2 + 0.8 * lit), 1e-6) << x;
    }
}

TEST(GardnerPicture, NearHidesFarWhateverTheOrder) {
    EllipsoidsCloud model = opaque(with_ellipsoid({{0, 0, 3}, {0.5, 0.5, 0.5}, 0, {}, {}, {}}));
    model.ellipsoids.push_back({{0, 0, -3}, {4, 4, 1}, 0, {}, {}, {}});
    EllipsoidsCloud swapped = model;
    std::swap(swapped.ellipsoids[0], swapped.ellipsoids[1]);
    EllipsoidsCloud front = model;
    front.ellipsoids.pop_back();
    const Image a = picture_of(look_of(model)), b = picture_of(look_of(swapped));
    EXPECT_EQ(a.pixels, b.pixels);
    const Image alone = picture_of(look_of(front));
    EXPECT_EQ(pixel(a, 32, 24).r, pixel(alone, 32, 24).r);
}

TEST(GardnerPicture, MovesWithItsCloudAndItsTexture) {
    SceneDraft draft = look_of(with_ellipsoid({{0, 0, 0}, {2, 2, 2}, 0, {}, {}, {}}));
    const Image still = picture_of(draft);
    draft.time = 2;
    EXPECT_EQ(picture_of(draft).pixels, still.pixels) << "nothing moves";
    draft.clouds[0].velocity = {1, 0.5, -2};
    draft.camera.eye += 2.0 * draft.clouds[0].velocity;
    draft.camera.target += 2.0 * draft.clouds[0].velocity;
    const Image followed = picture_of(draft);
    for (std::size_t i = 0; i < still.pixels.size(); ++i)
        ASSERT_NEAR(followed.pixels[i], still.pixels[i], 1e-4f);
    EllipsoidsCloud drifting = *draft.clouds[0].ellipsoids;
    drifting.drift = {0.4, 0, 0};
    draft.clouds[0].ellipsoids = std::make_shared<const EllipsoidsCloud>(drifting);
    EXPECT_NE(picture_of(draft).pixels, followed.pixels);
}

TEST(GardnerPicture, TurnsAndScalesWithItsCloud) {
    // A cloud turned and made larger, seen by an eye that turns and steps back with it, and lit from overhead.
    SceneDraft draft = look_of(with_formation(FormationKind::kCombined, 8));
    draft.sun.elevation = 90;
    draft.camera.eye = {0, 2, 14};
    const Image plain = picture_of(draft);
    draft.clouds[0].scale = 3;
    draft.clouds[0].rotate_y = 90;
    draft.clouds[0].translate = {100, 0, 0};
    draft.camera.eye = {100 + 42, 6, 0};
    draft.camera.target = {100, 0, 0};
    const Image turned = picture_of(draft);
    double wrong = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i)
        wrong += std::abs(static_cast<double>(plain.pixels[i] - turned.pixels[i]));
    EXPECT_LT(wrong / static_cast<double>(plain.pixels.size()), 1e-3);
}

TEST(GardnerPicture, ThePlaneIsSeenFromBelowAndAboveAndNotPastTheHorizon) {
    EllipsoidsCloud model;
    model.plane.emplace().altitude = 10;
    SceneDraft draft = look_of(opaque(model));
    draft.camera.target = {0, 0, 0};
    const Image below = picture_of(draft);  // level: the upper half
    EXPECT_EQ(pixel(below, 32, 2).a, 1);
    EXPECT_EQ(pixel(below, 32, 23).a, 1) << "to the horizon";
    EXPECT_EQ(pixel(below, 32, 24).a, 0);
    draft.camera.eye.y = draft.camera.target.y = 20;
    const Image above = picture_of(draft);
    EXPECT_EQ(pixel(above, 32, 23).a, 0);
    EXPECT_EQ(pixel(above, 32, 45).a, 1);
    draft.camera.eye.y = draft.camera.target.y = 10;  // in it: it has no thickness
    const Image within = picture_of(draft);
    for (std::size_t i = 3; i < within.pixels.size(); i += 4) EXPECT_EQ(within.pixels[i], 0);
    // Hidden by the ground from above it.
    draft.camera.eye.y = draft.camera.target.y = 20;
    draft.ground = Ground{15, glm::dvec3(0.5)};
    const Image hidden = picture_of(draft);
    for (std::size_t i = 3; i < hidden.pixels.size(); i += 4) EXPECT_EQ(hidden.pixels[i], 0);
}

TEST(GardnerPicture, TheSkyPlaneHasNoAliases) {
    // Against the mean of 16 x 16 points a pixel: with the terms that a pixel cannot show faded out, and their spread
    // in the translucence, the error is a small part of that of single points.
    EllipsoidsCloud model;
    SkyPlane& plane = model.plane.emplace();
    plane.altitude = 3;
    plane.texture.frequency_x = plane.texture.frequency_z = 1;
    SceneDraft draft = look_of(model);
    draft.camera.eye = {0, 0, 0};
    draft.camera.target = {0, 1, -6};
    const Image ours = picture_of(draft);
    SceneDraft large = draft;
    constexpr int kFiner = 16;
    large.image.width *= kFiner;
    large.image.height *= kFiner;
    const Image fine = picture_of(large, 2);
    double wrong = 0, wrong_points = 0;
    int rows = 0;
    // From the horizon (about row 36) to where pixels are a tenth of a unit.
    for (int y = 4; y < 48; ++y) {
        double row = 0, row_points = 0;
        for (int x = 0; x < 64; ++x) {
            double mean = 0;
            for (int j = 0; j < kFiner; ++j)
                for (int i = 0; i < kFiner; ++i)
                    mean += pixel(fine, x * kFiner + i, y * kFiner + j).a / (kFiner * kFiner);
            const double point = pixel(fine, x * kFiner + 8, y * kFiner + 8).a;
            row += std::pow(pixel(ours, x, y).a - mean, 2);
            row_points += std::pow(point - mean, 2);
        }
        wrong += row;
        wrong_points += row_points;
        ++rows;
    }
    const double rms = std::sqrt(wrong / (64 * rows)),
                 points = std::sqrt(wrong_points / (64 * rows));
    EXPECT_LT(rms, 0.5 * points) << rms << " against " << points;
    EXPECT_LT(rms, 0.08);
    RecordProperty("rms", std::to_string(rms));
    RecordProperty("points", std::to_string(points));
}

TEST(GardnerPicture, FiniteFromInsideFromTheSurfaceAndFromTheCentre) {
    for (const double at : {0.0, 0.5, 1.0, 1.0 + 1e-15, 1.0 - 1e-15}) {
        EllipsoidsCloud model = with_ellipsoid({{0, 0, 0}, {1, 1, 1}, 0, {}, {}, {}});
        model.plane.emplace().altitude = 0;
        for (const bool solid : {false, true}) {
            SceneDraft draft = look_of(solid ? opaque(model) : model);
            draft.camera.eye = {0, 0, at};
            draft.camera.target = {0, 0.1, -5};
            const Image image = picture_of(draft);
            expect_finite(image, "inside");
            if (solid && at < 0.9) {
                EXPECT_EQ(pixel(image, 32, 24).a, 1) << "the far wall";
            }
        }
    }
}

TEST(GardnerPicture, RandomCloudsAreFiniteAndTheSameForAllThreads) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Dice dice(seed + 1000);
        Whereabouts where;
        where.size = dice.log_between(1e-3, 1e5);
        where.middle = dice.chance(0.3) ? dice.any_vector(1e8) : glm::dvec3(0);
        SceneDraft draft = test::plain_draft();
        draft.top_level_cubes = false;
        draft.look = Look::kGardner;
        for (int k = 1 + dice.below(2); k > 0; --k)
            draft.clouds.push_back(random_ellipsoids(dice, where));
        draft.seed = seed;
        draft.time = dice.either({0, 1, -1e6});
        random_picture(dice, draft.image, true);
        random_camera(dice, where, draft, draft.camera);
        if (dice.chance(0.3)) draft.ground = Ground{where.middle.y - where.size, glm::dvec3(0.3)};
        if (dice.chance(0.2)) draft.sun.intensity = 0;
        if (dice.chance(0.2)) draft.sky.none = true;
        if (dice.chance(0.3)) draft.sun.elevation = dice.either({-90, 0, 90});
        const Image one = picture_of(draft);
        expect_finite(one, "seed", seed);
        for (const int threads : {2, 7}) {
            const Image other = picture_of(draft, threads);
            ASSERT_EQ(std::memcmp(one.pixels.data(), other.pixels.data(),
                                  one.pixels.size() * sizeof(float)),
                      0)
                << seed;
        }
    }
}

TEST(GardnerPicture, BoxesHoldAllThatShows) {
    // The same picture with every ellipsoid tested in every pixel.
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        Dice dice(seed);
        EllipsoidsCloud model;
        for (int i = 0; i < 6; ++i)
            model.ellipsoids.push_back(
                {4.0 * dice.on_sphere(),
                 {dice.between(0.1, 3), dice.between(0.1, 3), dice.between(0.1, 3)},
                 dice.between(0, 360),
                 {},
                 {},
                 {}});
        SceneDraft draft = look_of(opaque(model));
        draft.camera.eye = 5.0 * dice.on_sphere();
        draft.camera.target = draft.camera.eye + dice.on_sphere();
        if (std::abs(draft.camera.target.y - draft.camera.eye.y) > 0.99) continue;
        draft.camera.fov = dice.between(5, 160);
        const Scene scene = valid(draft);
        const View view = resolve_view(draft.camera, draft.image, {});
        const Image image = picture_of(draft);
        const auto all = placed_ellipsoids(model, 0);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const Ray one = ray(view, image, x, y);
                bool met = false;
                for (const PlacedEllipsoid& e : all) {
                    const glm::dvec3 o = e.to_unit(one.eye);
                    const glm::dvec3 d = e.to_unit(one.eye + one.direction) - o;
                    const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1;
                    const double root = b * b - a * c;
                    // Clear of the edge by more than rounding.
                    met = met || (root > 1e-9 * a && -b + std::sqrt(root) > 1e-9);
                }
                if (met) {
                    ASSERT_EQ(pixel(image, x, y).a, 1) << seed << " " << x << " " << y;
                }
            }
    }
}

TEST(GardnerPicture, TheEstimateGrowsWithWhatThereIs) {
    const auto estimate = [](std::uint64_t count, int width) {
        SceneDraft draft = look_of(with_formation(FormationKind::kCombined, count));
        draft.image.width = width;
        draft.image.height = width * 3 / 4;
        draft.camera.eye = {0, 0, 60};
        const Scene scene = valid(draft);
        return look_time_ms(scene, resolve_view(draft.camera, draft.image, {}), 1);
    };
    EXPECT_GT(estimate(10, 64), 0);
    EXPECT_GT(estimate(100, 64), estimate(10, 64));
    EXPECT_GT(estimate(10, 640), 10 * estimate(10, 64));
}

TEST(GardnerPicture, GivesUpWhenNobodyWaits) {
    Deadline over;
    over.until = Deadline::Clock::now();
    const SceneDraft draft = look_of({});
    const Scene scene = valid(draft);
    const auto image = draw_look(scene, resolve_view(draft.camera, draft.image, {}), 2, over);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().code, ErrorCode::kOverDeadline);
}

}  // namespace
}  // namespace awan
