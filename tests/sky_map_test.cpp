// The map of the sky: that it holds the light that the rest of the program has, where it says.
#include "core/draw/sky_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/light/ground_light.h"
#include "core/scene/outside.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

Scene under(double elevation, bool physical, std::optional<double> ground = {}) {
    SceneDraft draft;
    draft.clouds.resize(1);
    draft.sun.elevation = elevation;
    draft.sun.azimuth = 90;
    draft.sky.physical = physical;
    if (ground) draft.ground = Ground{.height = *ground};
    return *validate(draft);
}

Image map_of(const Scene& scene, int width, int threads = 2) {
    auto map = sky_map(scene, width, threads, {});
    EXPECT_TRUE(map.ok());
    return *std::move(map);
}

// Of a level plane that looks up, by the map's pixels alone.
glm::dvec3 irradiance_of(const Image& map) {
    glm::dvec3 sum(0);
    for (int y = 0; y < map.height / 2; ++y) {
        const double top = std::sin(std::numbers::pi * (0.5 - static_cast<double>(y) / map.height)),
                     bottom = std::sin(std::numbers::pi * (0.5 - (y + 1.0) / map.height));
        // The integral of sine times cosine of the latitude over the row, for one pixel.
        const double weight = (top * top - bottom * bottom) / 2 * 2 * std::numbers::pi / map.width;
        for (int x = 0; x < map.width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                sum[static_cast<int>(c)] +=
                    weight * static_cast<double>(
                                 map.pixels[4 * (static_cast<std::size_t>(y * map.width + x)) + c]);
    }
    return sum;
}

TEST(SkyMap, LightsTheGroundAsTheLightPassDoes) {
    for (const double elevation : {3.0, 20.0, 60.0, 90.0})
        for (const bool physical : {true, false})
            for (const int width : {64, 512}) {
                const Scene scene = under(elevation, physical, -5.0);
                const glm::dvec3 exact = bare_ground(*scene).sky;
                const glm::dvec3 own = irradiance_of(map_of(scene, width));
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(own[c] / exact[c], 1, 0.01)
                        << elevation << ' ' << physical << ' ' << width << ' ' << c;
            }
}

TEST(SkyMap, LooksWhereItSays) {
    // A sun on the +x side, low: the sky is brightest near it, a quarter from the left.
    const Scene scene = under(10, true);
    const Image map = map_of(scene, 256);
    EXPECT_EQ(map.height, 128);
    int brightest = 0;
    for (int i = 0; i < static_cast<int>(map.pixel_count()); ++i)
        if (map.pixels[4 * static_cast<std::size_t>(i) + 2] >
            map.pixels[4 * static_cast<std::size_t>(brightest) + 2])
            brightest = i;
    EXPECT_NEAR(brightest % 256, 64, 2);
    EXPECT_NEAR(brightest / 256, 64 * 80.0 / 90, 6);
    // And each pixel is the sky's radiance from there.
    const SkyDome sky = outside_of(scene).sky;
    for (const int x : {10, 100, 200})
        for (const int y : {5, 30, 60}) {
            const double latitude = std::numbers::pi * (0.5 - (y + 0.5) / 128),
                         longitude = std::numbers::pi * (1 - 2 * (x + 0.5) / 256);
            const glm::dvec3 d(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                               std::cos(latitude) * std::cos(longitude));
            const double exact = sky_radiance(sky, d).y;
            EXPECT_NEAR(
                static_cast<double>(map.pixels[4 * static_cast<std::size_t>(y * 256 + x) + 1]) /
                    exact,
                1, 0.02);
        }
}

TEST(SkyMap, HasTheGroundBelowTheHorizon) {
    const Scene scene = under(40, true, -5.0);
    const Image map = map_of(scene, 64);
    const glm::dvec3 exact = radiance_at(bare_ground(*scene), 0, 0);
    EXPECT_GT(exact.y, 0);
    for (std::size_t i = map.pixel_count() / 2; i < map.pixel_count(); ++i)
        ASSERT_NEAR(static_cast<double>(map.pixels[4 * i + 1]), exact.y, 1e-6 * exact.y);
}

TEST(SkyMap, IsTheSameForAnyThreadsAndLooksAtItsDeadline) {
    const Scene scene = under(20, true);
    EXPECT_EQ(map_of(scene, 128, 1).pixels, map_of(scene, 128, 4).pixels);
    Deadline over;
    over.until = Deadline::Clock::now();
    EXPECT_EQ(sky_map(scene, 128, 2, over).error().code, ErrorCode::kOverDeadline);
}

}  // namespace
}  // namespace awan
