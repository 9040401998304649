// The light of a cloud as a volume, where it has a closed form.
#include "core/light/light_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/generate/generate.h"
#include "core/light/transport.h"
#include "core/scene/outside.h"
#include "core/scene/validate.h"
#include "core/survey/volume.h"

namespace awan {
namespace {

SceneDraft cloud(double density) {
    SceneDraft draft;
    draft.top_level_cubes = false;
    draft.clouds.resize(1);
    draft.clouds[0].model = CloudModel::kParticles;
    draft.clouds[0].ready.positions = {{0, 0, 0}, {1, 0.5, 0}};
    draft.clouds[0].ready.radii = {2, 1.5};
    draft.density = density;
    draft.detail.reset();
    draft.sky.physical = false;
    return draft;
}

struct Volume {
    DensityVolume density;
    std::vector<float> light;
};

Volume volume_of(const SceneDraft& draft) {
    const Scene scene = *validate(draft);
    const ParticleSet particles = *generate(scene, 2, {});
    const Survey seen = *survey(scene, particles, 2, {});
    TransportSettings settings;
    settings.cells = 24;
    const auto light = transport_light(scene, particles, seen, settings, 2, {});
    EXPECT_TRUE(light.ok());
    Volume volume{density_volume(particles, 20), {}};
    volume.light = light_volume(scene, *light, volume.density, 2);
    EXPECT_EQ(volume.light, light_volume(scene, *light, volume.density, 1));
    return volume;
}

// Nothing is absorbed under an even sky: all matter is as bright as the sky, however deep it lies.
TEST(LightVolume, IsTheSkysWhereNothingIsAbsorbed) {
    for (const double density : {0.01, 3.0})
        for (const double g : {0.0, 0.85}) {
            SceneDraft draft = cloud(density);
            draft.medium.albedo = 1;
            draft.medium.g = g;
            draft.sun.intensity = 0;
            draft.sky.zenith = draft.sky.horizon = {1, 1, 1};
            draft.sky.intensity = 0.5;
            const Volume volume = volume_of(draft);
            std::size_t filled = 0;
            double sum = 0;
            for (std::size_t i = 0; i < volume.light.size(); ++i) {
                if (!(volume.density.extinction[i] > 0)) {
                    ASSERT_EQ(volume.light[i], 0);
                    continue;
                }
                ++filled;
                sum += static_cast<double>(volume.light[i]);
                // A grid by itself is some percent too dark where matter is deep (core/README.md).
                ASSERT_NEAR(volume.light[i], 0.5F, 0.05F) << density << ' ' << g;
            }
            EXPECT_NEAR(sum / static_cast<double>(filled), 0.5, density < 1 ? 0.002 : 0.02) << g;
            EXPECT_GT(filled, 1000U);
        }
}

// In thin matter the sun's light is what it is outside: the albedo times its irradiance over the sphere.
TEST(LightVolume, IsTheSunsInThinMatter) {
    SceneDraft draft = cloud(1e-4);
    draft.medium.albedo = 0.8;
    draft.sky.none = true;
    const Volume volume = volume_of(draft);
    const double exact = 0.8 * luminance(outside_of(*validate(draft)).sun) / (4 * std::numbers::pi);
    for (std::size_t i = 0; i < volume.light.size(); ++i) {
        if (!(volume.density.extinction[i] > 0)) continue;
        ASSERT_NEAR(static_cast<double>(volume.light[i]) / exact, 1, 0.005);
    }
}

// Deep matter is bright on the sun's side and dark behind.
TEST(LightVolume, FallsOffAwayFromTheSun) {
    SceneDraft draft = cloud(5);
    draft.sky.none = true;
    draft.sun.elevation = 90;
    const Volume volume = volume_of(draft);
    struct Half {
        double light = 0, matter = 0;
    } above, below;
    const glm::ivec3 n = volume.density.cells;
    for (std::size_t i = 0; i < volume.light.size(); ++i) {
        const int y = static_cast<int>(i) / n.x % n.y;
        const auto extinction = static_cast<double>(volume.density.extinction[i]);
        Half& half = 2 * y > n.y ? above : below;
        half.light += static_cast<double>(volume.light[i]) * extinction;
        half.matter += extinction;
    }
    EXPECT_GT(above.light / above.matter, 1.5 * below.light / below.matter);
}

}  // namespace
}  // namespace awan
