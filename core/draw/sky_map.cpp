#include "core/draw/sky_map.h"

#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/light/ground_light.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// Samples from left to right of a map, at least: the bright sky around a low sun is some degrees wide.
constexpr int kSamplesAround = 1024;

// What is seen from a place above the ground, far from any cloud.
class AllAround {
  public:
    explicit AllAround(const Scene& scene) : sky_(outside_of(scene).sky) {
        const GroundLight ground = bare_ground(*scene);
        if (ground.present) ground_ = radiance_at(ground, 0, 0);
    }

    glm::dvec3 radiance(const glm::dvec3& direction) const {
        return ground_ && direction.y < 0 ? *ground_ : sky_radiance(sky_, direction);
    }

  private:
    SkyDome sky_;
    std::optional<glm::dvec3> ground_;
};

}  // namespace

Result<Image> sky_map(const Scene& scene, int width, int threads, const Deadline& deadline) {
    if (auto error = deadline.over()) return *error;
    Image map{width, width / 2, true, {}};
    map.pixels.resize(4 * map.pixel_count());
    const AllAround around(scene);
    const int samples = (kSamplesAround + width - 1) / width;
    std::atomic<bool> late = false;
    parallel_for(threads, static_cast<std::size_t>(map.height), [&](std::size_t row) {
        if (late || deadline.over()) {
            late = true;
            return;
        }
        float* pixel = map.pixels.data() + 4 * row * static_cast<std::size_t>(width);
        for (int x = 0; x < width; ++x, pixel += 4) {
            glm::dvec3 sum(0);
            double weights = 0;
            for (int i = 0; i < samples * samples; ++i) {
                const double down = static_cast<double>(row) + (i / samples + 0.5) / samples;
                const double across = x + (i % samples + 0.5) / samples;
                const double latitude = std::numbers::pi * (0.5 - down / map.height);
                const double longitude = std::numbers::pi * (1 - 2 * across / width);
                const double level = exact::cos(latitude);  // and the sample's share of the sphere
                sum += level * around.radiance({level * exact::sin(longitude), exact::sin(latitude),
                                                level * exact::cos(longitude)});
                weights += level;
            }
            for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(sum[c] / weights);
            pixel[3] = 1;
        }
    });
    if (late)
        if (auto error = deadline.over()) return *error;
    return map;
}

}  // namespace awan
