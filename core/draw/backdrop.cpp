#include "core/draw/backdrop.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/parallel.h"
#include "core/draw/hills_backdrop.h"
#include "core/draw/march_bins.h"
#include "core/draw/sky_pixels.h"
#include "core/survey/ground_view.h"

namespace awan {
namespace {

bool above_ground(const Scene& scene, const View& view) {
    return scene->ground && view.eye.y > scene->ground->height;
}

}  // namespace

bool wants_backdrop(const Scene& scene, const View& view) {
    const Sky& sky = scene->sky;
    return (sky.physical && !sky.none) || above_ground(scene, view);
}

Backdrop make_backdrop(const Scene& scene, const View& view, int width, int height,
                       const GroundLight& ground, int threads, const Air* air,
                       const ReliefLight* hills, std::span<const std::uint8_t> wanted) {
    if (ground.relief) {
        if (hills != nullptr)
            return hills_backdrop(scene, view, width, height, ground, hills, air, threads, wanted);
        const ReliefLight light = relief_light(scene, ground, threads);
        return hills_backdrop(scene, view, width, height, ground, &light, air, threads, wanted);
    }
    Backdrop backdrop;
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    backdrop.width = width;
    backdrop.height = height;
    backdrop.rgb.resize(3 * pixels);
    const bool grounded = above_ground(scene, view);
    if (grounded) backdrop.distance.resize(pixels);
    const SkyPixels sky(outside_of(scene).sky, view, width, height, !grounded, threads, wanted);
    parallel_for(threads, static_cast<std::size_t>(height), [&](std::size_t row) {
        const std::size_t first = row * static_cast<std::size_t>(width);
        std::vector<glm::vec3> seen(static_cast<std::size_t>(width));
        sky.row(static_cast<int>(row), seen);
        if (grounded) {
            const double v =
                (1 - (static_cast<double>(row) + 0.5) / height * 2) * view.tan_half_fov;
            for (int x = 0; x < width; ++x) {
                if (!is_wanted(wanted, width, static_cast<std::size_t>(x), row)) continue;
                const double u = ((x + 0.5) / width * 2 - 1) * view.tan_half_fov * view.aspect;
                const glm::dvec3 d = glm::normalize(view.forward + u * view.right + v * view.up);
                const auto i = static_cast<std::size_t>(x);
                double distance = std::numeric_limits<double>::infinity();
                if (d.y < 0) {
                    distance = (ground.height - view.eye.y) / d.y;
                    seen[i] = glm::vec3(radiance_at(ground, view.eye.x + distance * d.x,
                                                    view.eye.z + distance * d.z));
                }
                backdrop.distance[first + i] = static_cast<float>(distance);
            }
        }
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                backdrop.rgb[3 * (first + i) + c] = seen[i][static_cast<int>(c)];
    });
    return backdrop;
}

void lay_under(Image& picture, const Backdrop& backdrop) {
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        float* const pixel = picture.pixels.data() + 4 * i;
        for (std::size_t c = 0; c < 3; ++c) pixel[c] += (1 - pixel[3]) * backdrop.rgb[3 * i + c];
        pixel[3] = 1;
    }
    picture.opaque = true;
}

bool matter_below_ground(const Scene& scene, const View& view, const ParticleSet& particles) {
    return above_ground(scene, view) &&
           (has_terrain(*scene) || reaches_below(particles, scene->ground->height));
}

}  // namespace awan
