#include "core/truth/pixel_paths.h"

#include <algorithm>
#include <cmath>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/truth/oracles.h"
#include "core/truth/pixel_area.h"
#include "core/truth/primary_ray.h"

namespace awan::truth {
namespace {

// Paths that are walked together: the last of them leave lanes idle, so that there should be many.
constexpr std::size_t kTogether = 4096;
// Parts of a pixel that is seen by rays at random (pixel_area.h). With detail every ray's depth has to be tabulated, so
// that there are about as many rays as paths, each part having four to sixteen: more would take away little of the
// noise.
constexpr std::uint32_t kMostParts = 256, kFewestParts = 1, kPathsAPart = 16;
// Of a path's key: what its walk is keyed by.
constexpr std::uint64_t kWalk = 0x3a1c;
// Of the light behind the clouds: below, it is not traced.
constexpr double kDark = 1e-9;

// A pixel's middle ray and how much of what lies behind the clouds is seen in the pixel. Lengths in cells.
struct Sight {
    glm::dvec3 eye;
    glm::dvec3 direction;
    // Distance of the ground; infinite: there is none on the ray.
    double ground;
    // Share of the light from behind that gets through the clouds, of each half's rays.
    std::array<double, 2> through;
    std::optional<HazePath> haze;
};

Sight sight_of(const Picture& picture, const glm::dvec3& eye, const glm::dvec3& direction,
               double ground, const std::array<double, 2>& through) {
    Sight sight{eye, direction, ground, through, {}};
    const double height = picture.view.eye.y;
    if (picture.air) sight.haze.emplace(picture.air->haze, height, direction.y);
    return sight;
}

// The rays that a pixel is seen by. primary: of each, where there is detail; else EMPTY.
struct PixelRays {
    AreaRays area;
    std::vector<PrimaryRay> primary;
};

// The rays of a pixel that meet matter, for paths to be shared out among them by what they keep from the eye.
class CloudRays {
  public:
    CloudRays(const Picture& picture, const glm::dvec3& eye, PixelRays rays)
        : picture_(picture), eye_(eye) {
        for (std::size_t i = 0; i < rays.area.rays.size(); ++i) {
            const AreaRay& ray = rays.area.rays[i];
            const double covered = ray.share * -exact::expm1(-ray.depth);
            through_ += ray.share * exact::exp(-ray.depth);
            rest_ -= ray.share;
            if (!(covered > 0)) continue;
            covered_ += covered;
            rays_.push_back({ray.direction, covered_, covered, {}, {}});
            if (!rays.primary.empty()) rays_.back().primary = std::move(rays.primary[i]);
        }
    }

    // Share of the light from behind that the clouds keep away, and 1 less that with all its digits.
    double covered() const { return covered_; }
    double through() const { return through_ + std::max(rest_, 0.0); }

    struct Met {
        const Sight& sight;
        double t;  // NaN: the ray meets nothing after all
    };
    // Where the light that is at `share` of all (0..1), ray by ray and front to back, has its first meeting.
    Met meeting(double share) {
        const double at = share * covered_;
        const auto above =
            std::upper_bound(rays_.begin(), rays_.end() - 1, at,
                             [](double value, const Ray& ray) { return value < ray.up_to; });
        Ray& ray = *above;
        if (!ray.sight) {
            const double ground = ground_ahead(picture_.setting, eye_, ray.direction);
            ray.sight = sight_of(picture_, eye_, ray.direction, ground, {});
            if (!ray.primary) ray.primary.emplace(picture_.matter, eye_, ray.direction, ground);
        }
        const double own =
            std::clamp((at - (ray.up_to - ray.covered)) / ray.covered, 1e-12, 1 - 1e-12);
        return {*ray.sight, ray.primary->meets() ? ray.primary->first_meeting(own) : NAN};
    }

  private:
    struct Ray {
        glm::dvec3 direction;
        double up_to, covered;  // sum of `covered` up to this one
        std::optional<Sight> sight;
        std::optional<PrimaryRay> primary;
    };
    const Picture& picture_;
    glm::dvec3 eye_;
    std::vector<Ray> rays_;
    double covered_ = 0, through_ = 0, rest_ = 1;
};

// Light from distance t as the eye gets it: dimmed by the haze before it, with that haze's own light.
struct Through {
    double scale = 1;
    glm::dvec3 plus{0};
};
Through through_haze(const Picture& picture, const Sight& sight, double t, PathRandom& random) {
    if (!sight.haze) return {};
    const double end = t * picture.matter.cell;
    return {sight.haze->transmittance(end), haze_light(*picture.air, picture.setting, *sight.haze,
                                                       sight.eye, sight.direction, end, random)};
}

// Calls path(random, stratum, half, key) for each of samples / 2 paths of both halves; stratum is uniform in (0, 1) and
// spread evenly over them. False: out of time.
template <typename Path>
bool each_path(std::uint64_t key, std::uint32_t samples, const Path& path) {
    const std::uint32_t each = samples / 2;
    for (std::uint32_t half = 0; half < 2; ++half)
        for (std::uint32_t i = 0; i < each; ++i) {
            const std::uint64_t own = keyed(keyed(key, half), i);
            PathRandom random(own);
            if (!path(random, (i + random.unit()) / each, half, keyed(own, kWalk))) return false;
        }
    return true;
}

// Pixels that show little matter get fewer paths, in proportion below an alpha of 5%, a 16th at least:
// their noise is small against the picture's.
std::uint32_t worthwhile_paths(std::uint32_t samples, double covered) {
    const double share = std::clamp(20 * covered, 1.0 / 16, 1.0);
    return 2 * std::max(static_cast<std::uint32_t>(std::ceil(share * (samples / 2))), 1u);
}

// Light from the clouds. rays: of each half. False: out of time.
bool add_clouds(PixelPaths& all, std::array<CloudRays*, 2> rays, std::uint64_t key, Pixel& pixel) {
    const Picture& picture = all.picture();
    const double covered = 0.5 * (rays[0]->covered() + rays[1]->covered());
    if (!(covered > 0)) return true;
    const std::uint32_t paths = worthwhile_paths(picture.samples, covered);
    pixel.paths = paths;
    return each_path(
        key, paths,
        [&](PathRandom& random, double stratum, std::uint32_t half, std::uint64_t walk_key) {
            const double seen = rays[half]->covered() / (paths / 2);
            if (!(seen > 0)) return true;
            const CloudRays::Met met = rays[half]->meeting(stratum);
            if (std::isnan(met.t)) return true;
            const Sight& sight = met.sight;
            const Through through = through_haze(picture, sight, met.t, random);
            return all.add(
                {sight.eye + met.t * sight.direction, sight.direction, walk_key, false},
                {&pixel, half, glm::dvec3(seen * through.scale), seen * through.plus, true});
        });
}

// A part of a pixel, and the paths that go to what is seen in it behind the clouds.
struct Behind {
    double share = 1;  // of the pixel
    std::uint32_t paths = 2;
    std::uint64_t key = 0;
};

// Light that comes through the clouds from the ground, which the ray meets. False: out of time.
bool add_ground(PixelPaths& all, const Sight& sight, const Behind& behind, Pixel& pixel) {
    const Picture& picture = all.picture();
    if (!(std::max(sight.through[0], sight.through[1]) > kDark)) return true;
    glm::dvec3 place = sight.eye + sight.ground * sight.direction;
    if (picture.setting.relief) {
        const Matter& m = picture.matter;
        place =
            (above_ground(*picture.setting.relief, m.origin + m.cell * place) - m.origin) / m.cell;
    } else {
        place.y = picture.setting.ground_height;
    }
    return each_path(
        behind.key, behind.paths,
        [&](PathRandom& random, double, std::uint32_t half, std::uint64_t walk_key) {
            const double seen = behind.share * sight.through[half] / (behind.paths / 2);
            const Through through = through_haze(picture, sight, sight.ground, random);
            return all.add(
                {place, sight.direction, walk_key, true},
                {&pixel, half, glm::dvec3(seen * through.scale), seen * through.plus, false});
        });
}

// Light that comes through the clouds from the sky, or, where no sky is drawn, from the haze alone. False: out of time.
bool add_sky(const Picture& picture, const Sight& sight, const Behind& behind, Pixel& pixel) {
    const glm::dvec3 sky =
        picture.opaque ? sky_radiance(picture.setting, sight.direction) : glm::dvec3(0);
    if (!sight.haze || !(std::max(sight.through[0], sight.through[1]) > kDark)) {
        // It is known, without a path.
        for (std::size_t half = 0; half < 2; ++half)
            pixel.half[half] += behind.share * sight.through[half] * sky;
        return true;
    }
    return each_path(behind.key, behind.paths,
                     [&](PathRandom& random, double, std::uint32_t half, std::uint64_t) {
                         const Through through = through_haze(picture, sight, sight.ground, random);
                         pixel.half[half] += behind.share * sight.through[half] /
                                             (behind.paths / 2) *
                                             (through.scale * sky + through.plus);
                         return true;
                     });
}

// covered: by the clouds.
double alpha_of(const Picture& picture, const Sight& sight, double covered, double through) {
    if (picture.opaque) return 1;
    if (!sight.haze) return covered;
    return 1 - through * sight.haze->transmittance(sight.ground * picture.matter.cell);
}

// Rays a side of a pixel, evenly spread, by which it is seen what stands behind the clouds: haze and ground change
// within a pixel at the horizon.
int sides_behind(const Picture& picture, bool ground) {
    if (!picture.whole_pixels || !(picture.air || ground)) return 1;
    constexpr int kMost = 4;
    int sides = 1;
    while (sides < kMost &&
           2U * static_cast<std::uint32_t>((sides + 1) * (sides + 1)) <= picture.samples)
        ++sides;
    return sides;
}

// Gaussians alone have their depth in closed form, their detail has not.
PixelRays rays_of(const Picture& picture, const ParticleSet& near, int x, int y,
                  const PixelRay& middle, const glm::dvec3& eye, std::uint64_t key) {
    const Matter& matter = picture.matter;
    const std::function<double(const glm::dvec3&)> end = [&](const glm::dvec3& d) {
        return ground_ahead(picture.setting, eye, d) * matter.cell;
    };
    PixelRays found;
    AreaRays& area = found.area;
    // Where no particle comes near the pixel there is nothing to look for.
    if (near.size() == 0) return found;
    if (picture.whole_pixels) {
        // Bumps rise and fall as a Gaussian of about a quarter of their width does.
        const double smallest = matter.detail ? 0.25 * matter.detail->bump : INFINITY;
        const std::uint32_t parts =
            matter.detail ? std::clamp(picture.samples / kPathsAPart, kFewestParts, kMostParts)
                          : kMostParts;
        area = area_rays(picture.view, picture.width, picture.height, x, y, near, parts, smallest,
                         matter.detail ? nullptr : end, key);
    } else {
        const glm::dvec3 d = middle.direction;
        area.rays = {{d, 1, line_optical_depth(near, middle.origin, d, 0, end(d))}};
    }
    if (matter.detail)
        for (AreaRay& ray : area.rays) {
            found.primary.emplace_back(matter, eye, ray.direction,
                                       end(ray.direction) / matter.cell);
            ray.depth = found.primary.back().depth();
        }
    return found;
}

}  // namespace

bool PixelPaths::add(const Start& start, const Path& path) {
    starts_.push_back(start);
    paths_.push_back(path);
    return starts_.size() < kTogether || finish();
}

bool PixelPaths::finish() {
    brought_.assign(starts_.size(), {});
    Tally unused;
    if (!walk(picture_.setting, starts_, brought_, unused, [&] { return picture_.over(); }))
        return false;
    // In the order in which they began, so that sums have the same bytes.
    for (std::size_t i = 0; i < paths_.size(); ++i) {
        const Path& path = paths_[i];
        path.pixel->half[path.half] += path.scale * brought_[i].radiance + path.plus;
        if (path.met_cloud) path.pixel->scatterings += brought_[i].scatterings;
    }
    starts_.clear();
    paths_.clear();
    return true;
}

bool PixelPaths::begin(const ParticleSet& near, int x, int y, Pixel& pixel) {
    if (picture_.over()) return false;
    const Picture& picture = picture_;
    const Matter& matter = picture.matter;
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x);
    const std::uint64_t key = keyed(keyed(picture.seed, 0x7247), at);
    const PixelRay ray = pixel_ray(picture.view, picture.width, picture.height, x, y);
    const glm::dvec3 eye = (ray.origin - matter.origin) / matter.cell;
    PixelRays rays = rays_of(picture, near, x, y, ray, eye, keyed(key, 2));
    const bool random = rays.area.random;
    CloudRays first(picture, eye, std::move(rays));
    // Rays at random are noise: the halves have their own.
    std::optional<CloudRays> second;
    if (random) second.emplace(picture, eye, rays_of(picture, near, x, y, ray, eye, keyed(key, 3)));
    const std::array<CloudRays*, 2> clouds{&first, second ? &*second : &first};
    const std::uint64_t behind = keyed(key, 1);
    if (!add_clouds(*this, clouds, key, pixel)) return false;
    const int sides = sides_behind(picture, picture.opaque && picture.setting.has_ground);
    const double share = 1.0 / (sides * sides);
    const auto paths =
        std::max(picture.samples / static_cast<std::uint32_t>(sides * sides) / 2, 1U) * 2;
    for (int k = 0; k < sides * sides; ++k) {
        const glm::dvec2 aside((k % sides + 0.5) / sides - 0.5, (k / sides + 0.5) / sides - 0.5);
        const glm::dvec3 direction =
            sides == 1
                ? ray.direction
                : pixel_ray(picture.view, picture.width, picture.height, x + aside.x, y + aside.y)
                      .direction;
        const double ground = ground_ahead(picture.setting, eye, direction);
        const Sight sight =
            sight_of(picture, eye, direction, ground, {clouds[0]->through(), clouds[1]->through()});
        for (std::size_t half = 0; half < 2; ++half)
            pixel.alpha[half] +=
                share * alpha_of(picture, sight, clouds[half]->covered(), clouds[half]->through());
        const Behind part{share, paths,
                          sides == 1 ? behind : keyed(behind, static_cast<std::uint64_t>(k))};
        // A picture without a background shows no ground.
        if (!(picture.opaque && std::isfinite(ground) ? add_ground(*this, sight, part, pixel)
                                                      : add_sky(picture, sight, part, pixel)))
            return false;
    }
    return true;
}

}  // namespace awan::truth
