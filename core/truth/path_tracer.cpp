#include "core/truth/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <optional>

#include "core/base/parallel.h"
#include "core/generate/keyed_random.h"
#include "core/truth/haze_walk.h"
#include "core/truth/oracles.h"
#include "core/truth/primary_ray.h"
#include "core/truth/walk.h"

namespace awan {
namespace {

using truth::Matter;
using truth::Setting;
using truth::Tally;

constexpr int kTile = 8;             // pixels; particles are looked up by tile
constexpr std::uint32_t kLook = 32;  // paths between two looks at the deadline

struct Sums {
    glm::dvec3 half[2] = {glm::dvec3(0), glm::dvec3(0)};
};

void store(Image& image, std::size_t pixel, const glm::dvec3& rgb, double alpha) {
    float* out = image.pixels.data() + 4 * pixel;
    out[0] = static_cast<float>(rgb.x);
    out[1] = static_cast<float>(rgb.y);
    out[2] = static_cast<float>(rgb.z);
    out[3] = static_cast<float>(alpha);
}

// Both halves of one pixel by `path(random, stratum)`, the mean of samples / 2 paths each; stratum is uniform in (0, 1) and
// spread evenly over them. False: out of time.
template <typename Path>
bool average(std::uint64_t key, std::uint32_t samples, const Deadline& deadline,
             std::atomic<bool>& stop, Sums& sums, const Path& path) {
    const std::uint32_t each = samples / 2;
    for (std::uint32_t half = 0; half < 2; ++half) {
        glm::dvec3 sum(0);
        for (std::uint32_t i = 0; i < each; ++i) {
            if (i % kLook == 0) {
                if (stop.load(std::memory_order_relaxed) || deadline.over()) {
                    stop = true;
                    return false;
                }
            }
            truth::PathRandom random(keyed(keyed(key, half), i));
            sum += path(random, (i + random.unit()) / each);
        }
        sums.half[half] += sum / static_cast<double>(each);
    }
    return true;
}

// Pixels that show little matter get fewer paths, in proportion below an alpha of 5%, a 16th at least:
// their noise is small against the picture's.
std::uint32_t worthwhile_paths(std::uint32_t samples, double covered) {
    const double share = std::clamp(20 * covered, 1.0 / 16, 1.0);
    return 2 * std::max(static_cast<std::uint32_t>(std::ceil(share * (samples / 2))), 1u);
}

}  // namespace

Result<TruthImage> trace_truth(const Scene& scene, const ParticleSet& particles, const View& view,
                               const TruthOptions& options, const Progress& progress,
                               const Deadline& deadline) {
    const int width = scene->image.width, height = scene->image.height;
    const bool opaque = scene->image.background == Background::kSky;
    TruthImage truth;
    for (Image* image : {&truth.half_a, &truth.half_b}) {
        *image = {width, height, opaque, {}};
        image->pixels.resize(4 * image->pixel_count());
    }
    const auto matter =
        truth::make_matter(particles, sun_direction(scene->sun), options.threads, deadline);
    if (!matter.ok()) return matter.error();
    const Setting setting = truth::setting_of(scene, *matter, options);
    const std::uint32_t samples = std::max(options.samples / 2, 1u) * 2;
    const auto air = options.eye_effects.aerial_perspective
                         ? truth::haze_of(scene, options.eye_effects.light_shafts)
                         : std::optional<truth::HazeSetting>();

    const int across = (width + kTile - 1) / kTile, down = (height + kTile - 1) / kTile;
    const std::size_t tiles = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
    std::vector<double> tile_scatterings(tiles, 0.0), tile_paths(tiles, 0.0);
    std::atomic<bool> stop{false};
    std::atomic<std::size_t> finished{0};
    std::mutex telling;

    const auto pixel = [&](const ParticleSet& near, std::size_t tile, int x, int y) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x);
        const std::uint64_t key = keyed(keyed(options.seed, 0x7247), at);
        const PixelRay ray = pixel_ray(view, width, height, x, y);
        const glm::dvec3 o = (ray.origin - matter->origin) / matter->cell;
        const double ground = ground_ahead(setting, o, ray.direction);  // cells
        const truth::PrimaryRay primary(*matter, o, ray.direction, ground);
        // Gaussians alone have it in closed form.
        const double depth = matter->detail ? primary.depth()
                                            : line_optical_depth(near, ray.origin, ray.direction, 0,
                                                                 ground * matter->cell);
        const double covered = -std::expm1(-depth), through = std::exp(-depth);
        Sums sums;
        Tally tally;
        std::optional<truth::HazePath> haze;
        if (air) haze.emplace(air->haze, ray.origin.y, ray.direction.y);
        // Light from distance t (cells) as the eye gets it, through the haze and with its light.
        const auto seen = [&](const glm::dvec3& light, double t, truth::PathRandom& random) {
            if (!haze) return light;
            const double end = t * matter->cell;
            return light * haze->transmittance(end) +
                   haze_light(*air, setting, *haze, o, ray.direction, end, random);
        };
        if (covered > 0 && primary.meets()) {
            const std::uint32_t paths = worthwhile_paths(samples, covered);
            const bool done = average(
                key, paths, deadline, stop, sums, [&](truth::PathRandom& random, double stratum) {
                    const double t = primary.first_meeting(stratum);
                    const glm::dvec3 p = o + t * ray.direction;
                    const glm::dvec3 light =
                        walk_from_matter(setting, p, ray.direction, random, tally);
                    return covered * seen(light, t, random);
                });
            if (!done) return;
            tile_paths[tile] += paths;
            tile_scatterings[tile] += tally.scatterings;
        }
        if (haze && through > 1e-9 && (!opaque || std::isinf(ground))) {
            const glm::dvec3 sky = opaque ? sky_radiance(setting, ray.direction) : glm::dvec3(0);
            const bool done = average(keyed(key, 1), samples, deadline, stop, sums,
                                      [&](truth::PathRandom& random, double) {
                                          return through * seen(sky, ground, random);
                                      });
            if (!done) return;
        } else if (opaque && std::isinf(ground)) {
            for (glm::dvec3& half : sums.half)
                half += through * sky_radiance(setting, ray.direction);
        } else if (opaque && through > 1e-9) {
            glm::dvec3 p = o + ground * ray.direction;
            p.y = setting.ground_height;
            Tally unused;
            const bool done = average(keyed(key, 1), samples, deadline, stop, sums,
                                      [&](truth::PathRandom& random, double) {
                                          const glm::dvec3 light =
                                              walk_from_ground(setting, p, random, unused);
                                          return through * seen(light, ground, random);
                                      });
            if (!done) return;
        }
        const double clear = through * (haze ? haze->transmittance(ground * matter->cell) : 1.0);
        const double alpha = opaque ? 1 : haze ? 1 - clear : covered;
        store(truth.half_a, at, sums.half[0], alpha);
        store(truth.half_b, at, sums.half[1], alpha);
    };

    parallel_for(options.threads, tiles, [&](std::size_t tile) {
        if (stop.load(std::memory_order_relaxed)) return;
        const int left = static_cast<int>(tile % static_cast<std::size_t>(across)) * kTile;
        const int top = static_cast<int>(tile / static_cast<std::size_t>(across)) * kTile;
        const int right = std::min(left + kTile, width), bottom = std::min(top + kTile, height);
        const ParticleSet near = truth::particles_near(
            particles, view.eye,
            {pixel_ray(view, width, height, left, top).direction,
             pixel_ray(view, width, height, right - 1, top).direction,
             pixel_ray(view, width, height, left, bottom - 1).direction,
             pixel_ray(view, width, height, right - 1, bottom - 1).direction});
        for (int y = top; y < bottom; ++y)
            for (int x = left; x < right && !stop; ++x) pixel(near, tile, x, y);
        const std::size_t count = ++finished;
        if (!progress || stop) return;
        // Counted again under the lock, so that what is told only rises.
        const std::lock_guard lock(telling);
        progress(static_cast<double>(std::max(count, finished.load())) /
                 static_cast<double>(tiles));
    });
    if (stop) {
        if (auto error = deadline.over()) return *error;
        return Error{ErrorCode::kOverDeadline, "", "the reference ran out of time"};
    }
    double paths = 0;
    for (std::size_t i = 0; i < tiles; ++i) {
        paths += tile_paths[i];
        truth.scatterings += tile_scatterings[i];
    }
    if (paths > 0) truth.scatterings /= paths;
    return truth;
}

Image mean_of(const TruthImage& truth) {
    Image mean = truth.half_a;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (mean.pixels[i] + truth.half_b.pixels[i]);
    return mean;
}

}  // namespace awan
