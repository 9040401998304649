// The sky behind a picture, interpolated between few rays, is that of a ray through every pixel's middle.
#include "core/draw/sky_pixels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/draw/march_bins.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

struct Sight {
    double sun, up, fov;
    int width, height;
};

View view_of(const Sight& sight) {
    Camera camera;
    camera.automatic = false;
    camera.eye = {0, 0, 0};
    camera.target = {0, std::sin(sight.up), std::cos(sight.up)};
    camera.up = {0, 1, 0};
    camera.fov = sight.fov;
    ImageSettings image;
    image.width = sight.width;
    image.height = sight.height;
    return resolve_view(camera, image, {});
}

SkyDome sky_of(double elevation) {
    SceneDraft draft;
    draft.clouds.emplace_back();
    draft.sun.elevation = elevation;
    return outside_of(draft).sky;
}

// The greatest difference of a row's pixel from its own ray, over its radiance.
double worst(const SkyPixels& behind, const SkyDome& sky, const View& view, const Sight& sight) {
    double worst = 0;
    std::vector<glm::vec3> row(static_cast<std::size_t>(sight.width));
    for (int y = 0; y < sight.height; ++y) {
        behind.row(y, row);
        for (int x = 0; x < sight.width; ++x) {
            const double u = ((x + 0.5) / sight.width * 2 - 1) * view.tan_half_fov * view.aspect;
            const double v = (1 - (y + 0.5) / sight.height * 2) * view.tan_half_fov;
            const glm::dvec3 ray =
                sky_radiance(sky, glm::normalize(view.forward + u * view.right + v * view.up));
            for (int c = 0; c < 3; ++c)
                worst = std::max(
                    worst,
                    std::abs(static_cast<double>(row[static_cast<std::size_t>(x)][c]) - ray[c]) /
                        std::max(ray[c], 1e-9));
        }
    }
    return worst;
}

// Towards the sun, across the horizon, at the zenith, in few pixels and through a telescope.
TEST(SkyPixels, IsTheSkyThatEveryPixelsOwnRaySees) {
    for (const Sight sight :
         {Sight{30, 0.5, 50, 320, 200}, Sight{2, 0.05, 90, 321, 203}, Sight{-4, 0, 60, 200, 160},
          Sight{60, 1.5, 100, 160, 160}, Sight{40, 0.7, 2, 100, 100}, Sight{12, 0.2, 40, 17, 9},
          Sight{12, -0.6, 70, 120, 80}, Sight{85, 0.3, 45, 1, 1}}) {
        const SkyDome sky = sky_of(sight.sun);
        const View view = view_of(sight);
        const SkyPixels behind(sky, view, sight.width, sight.height, true, 1);
        // Four rays a block are looked at, not all of them.
        EXPECT_LT(worst(behind, sky, view, sight), 5 * SkyPixels::kAgreement)
            << "sun " << sight.sun << ", up " << sight.up << ", " << behind.smooth_share();
    }
}

TEST(SkyPixels, IsInterpolatedNearlyEverywhereInALargePicture) {
    const Sight sight{30, 0.4, 40, 800, 600};
    const SkyPixels behind(sky_of(sight.sun), view_of(sight), sight.width, sight.height, true, 2);
    EXPECT_GT(behind.smooth_share(), 0.9);
}

// Of some blocks it finds what it finds of all, and leaves the others alone.
TEST(SkyPixels, OfWantedBlocksIsTheSame) {
    const Sight sight{8, 0.1, 60, 150, 90};
    const SkyDome sky = sky_of(sight.sun);
    const View view = view_of(sight);
    std::vector<std::uint8_t> wanted(
        static_cast<std::size_t>(blocks_in(sight.width) * blocks_in(sight.height)));
    for (const std::size_t one : {0U, 7U, 23U, 24U, 40U, 59U}) wanted[one] = 1;
    const SkyPixels all(sky, view, sight.width, sight.height, true, 2);
    const SkyPixels some(sky, view, sight.width, sight.height, true, 2, wanted);
    const glm::vec3 untouched(-1);
    for (int y = 0; y < sight.height; ++y) {
        std::vector<glm::vec3> a(150), b(150, untouched);
        all.row(y, a);
        some.row(y, b);
        for (std::size_t x = 0; x < a.size(); ++x)
            ASSERT_EQ(b[x], is_wanted(wanted, sight.width, x, static_cast<std::size_t>(y))
                                ? a[x]
                                : untouched)
                << x << ' ' << y;
    }
}

TEST(SkyPixels, IsTheSameForEveryNumberOfThreads) {
    const Sight sight{8, 0.1, 60, 150, 90};
    const SkyDome sky = sky_of(sight.sun);
    const View view = view_of(sight);
    const SkyPixels one(sky, view, sight.width, sight.height, true, 1);
    const SkyPixels three(sky, view, sight.width, sight.height, true, 3);
    std::vector<glm::vec3> a(150), b(150);
    for (int y = 0; y < sight.height; ++y) {
        one.row(y, a);
        three.row(y, b);
        EXPECT_EQ(a, b) << y;
    }
}

// Frames of a sequence are drafts of a valid scene: their sky is not computed again, unless the sun has moved.
TEST(Validate, TakesTheSkyThatADraftHasFromAnotherScene) {
    SceneDraft draft;
    draft.clouds.emplace_back();
    const Scene first = validate(draft).value();
    const Scene same = validate(*first).value();
    EXPECT_EQ(same->sky.air, first->sky.air);
    draft = *first;
    draft.sun.elevation += 1;
    const Scene later = validate(draft).value();
    EXPECT_NE(later->sky.air, first->sky.air);
    draft.sky.air = nullptr;
    EXPECT_EQ(sky_radiance(outside_of(later).sky, {0, 1, 0}),
              sky_radiance(outside_of(draft).sky, {0, 1, 0}));
    draft = *first;
    draft.sky.turbidity = 4;
    EXPECT_NE(validate(draft).value()->sky.air, first->sky.air);
}

}  // namespace
}  // namespace awan
