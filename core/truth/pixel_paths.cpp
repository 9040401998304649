#include "core/truth/pixel_paths.h"

#include <algorithm>
#include <cmath>

#include "core/generate/keyed_random.h"
#include "core/truth/oracles.h"
#include "core/truth/primary_ray.h"

namespace awan::truth {
namespace {

// Paths between two looks at the deadline.
constexpr std::uint32_t kLook = 32;
// Of the light behind the clouds: below, it is not traced.
constexpr double kDark = 1e-9;

// A pixel's ray and how much of what lies along it is seen. Lengths in cells.
struct Sight {
    glm::dvec3 eye;
    glm::dvec3 direction;
    // Distance of the ground; infinite: there is none on the ray.
    double ground;
    // Share of the light from behind that the clouds keep away, exact.
    double covered;
    // 1 - covered, with all its digits.
    double through;
    std::optional<HazePath> haze;
};

Sight sight_of(const Picture& picture, const PixelRay& ray, const glm::dvec3& eye, double ground,
               double depth) {
    Sight sight{eye, ray.direction, ground, -std::expm1(-depth), std::exp(-depth), {}};
    if (picture.air) sight.haze.emplace(picture.air->haze, ray.origin.y, ray.direction.y);
    return sight;
}

// Light from distance t as the eye gets it: dimmed by the haze before it, with that haze's own light.
glm::dvec3 through_haze(const Picture& picture, const Sight& sight, const glm::dvec3& light,
                        double t, PathRandom& random) {
    if (!sight.haze) return light;
    const double end = t * picture.matter.cell;
    return light * sight.haze->transmittance(end) + haze_light(*picture.air, picture.setting,
                                                               *sight.haze, sight.eye,
                                                               sight.direction, end, random);
}

// Adds the mean of samples / 2 paths to each half of a pixel. path(random, stratum): the radiance of one; stratum is
// uniform in (0, 1) and spread evenly over them. False: out of time.
template <typename Path>
bool add_mean(const Picture& picture, std::uint64_t key, std::uint32_t samples, Pixel& pixel,
              const Path& path) {
    const std::uint32_t each = samples / 2;
    for (std::uint32_t half = 0; half < 2; ++half) {
        glm::dvec3 sum(0);
        for (std::uint32_t i = 0; i < each; ++i) {
            if (i % kLook == 0 && picture.over()) return false;
            PathRandom random(keyed(keyed(key, half), i));
            sum += path(random, (i + random.unit()) / each);
        }
        pixel.half[half] += sum / static_cast<double>(each);
    }
    return true;
}

// Pixels that show little matter get fewer paths, in proportion below an alpha of 5%, a 16th at least:
// their noise is small against the picture's.
std::uint32_t worthwhile_paths(std::uint32_t samples, double covered) {
    const double share = std::clamp(20 * covered, 1.0 / 16, 1.0);
    return 2 * std::max(static_cast<std::uint32_t>(std::ceil(share * (samples / 2))), 1u);
}

// Light from the clouds. False: out of time.
bool add_clouds(const Picture& picture, const Sight& sight, const PrimaryRay& primary,
                std::uint64_t key, Pixel& pixel) {
    if (!(sight.covered > 0) || !primary.meets()) return true;
    Tally tally;
    const std::uint32_t paths = worthwhile_paths(picture.samples, sight.covered);
    const auto path = [&](PathRandom& random, double stratum) {
        const double t = primary.first_meeting(stratum);
        const glm::dvec3 light = walk_from_matter(picture.setting, sight.eye + t * sight.direction,
                                                  sight.direction, random, tally);
        return sight.covered * through_haze(picture, sight, light, t, random);
    };
    if (!add_mean(picture, key, paths, pixel, path)) return false;
    pixel.paths = paths;
    pixel.scatterings = tally.scatterings;
    return true;
}

// Light that comes through the clouds from the ground, which the ray meets. False: out of time.
bool add_ground(const Picture& picture, const Sight& sight, std::uint64_t key, Pixel& pixel) {
    if (!(sight.through > kDark)) return true;
    glm::dvec3 place = sight.eye + sight.ground * sight.direction;
    place.y = picture.setting.ground_height;
    Tally unused;
    return add_mean(picture, key, picture.samples, pixel, [&](PathRandom& random, double) {
        const glm::dvec3 light = walk_from_ground(picture.setting, place, random, unused);
        return sight.through * through_haze(picture, sight, light, sight.ground, random);
    });
}

// Light that comes through the clouds from the sky, or, where no sky is drawn, from the haze alone. False: out of time.
bool add_sky(const Picture& picture, const Sight& sight, std::uint64_t key, Pixel& pixel) {
    const glm::dvec3 sky =
        picture.opaque ? sky_radiance(picture.setting, sight.direction) : glm::dvec3(0);
    if (!sight.haze || !(sight.through > kDark)) {
        // It is known, without a path.
        for (glm::dvec3& half : pixel.half) half += sight.through * sky;
        return true;
    }
    return add_mean(picture, key, picture.samples, pixel, [&](PathRandom& random, double) {
        return sight.through * through_haze(picture, sight, sky, sight.ground, random);
    });
}

double alpha_of(const Picture& picture, const Sight& sight) {
    if (picture.opaque) return 1;
    if (!sight.haze) return sight.covered;
    return 1 - sight.through * sight.haze->transmittance(sight.ground * picture.matter.cell);
}

}  // namespace

std::optional<Pixel> trace_pixel(const Picture& picture, const ParticleSet& near, int x, int y) {
    if (picture.over()) return std::nullopt;
    const Matter& matter = picture.matter;
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x);
    const std::uint64_t key = keyed(keyed(picture.seed, 0x7247), at);
    const PixelRay ray = pixel_ray(picture.view, picture.width, picture.height, x, y);
    const glm::dvec3 eye = (ray.origin - matter.origin) / matter.cell;
    const double ground = ground_ahead(picture.setting, eye, ray.direction);
    // Where no particle comes near the ray there is nothing to look for.
    const double end = near.size() == 0 ? 0 : ground;
    const PrimaryRay primary(matter, eye, ray.direction, end);
    // Gaussians alone have their depth in closed form, their detail has not.
    const double depth = matter.detail ? primary.depth()
                                       : line_optical_depth(near, ray.origin, ray.direction, 0,
                                                            ground * matter.cell);
    const Sight sight = sight_of(picture, ray, eye, ground, depth);
    Pixel pixel;
    if (!add_clouds(picture, sight, primary, key, pixel)) return std::nullopt;
    // A picture without a background shows no ground.
    const bool in_time = picture.opaque && std::isfinite(ground)
                             ? add_ground(picture, sight, keyed(key, 1), pixel)
                             : add_sky(picture, sight, keyed(key, 1), pixel);
    if (!in_time) return std::nullopt;
    pixel.alpha = alpha_of(picture, sight);
    return pixel;
}

}  // namespace awan::truth
