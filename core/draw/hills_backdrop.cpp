#include "core/draw/hills_backdrop.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/parallel.h"
#include "core/draw/march_bins.h"
#include "core/scene/outside.h"
#include "core/survey/relief_ray.h"

namespace awan {
namespace {

// Neighbours whose distances or luminances differ by more than these shares of the greater are looked at closely.
constexpr float kFarApart = 0.06F, kUneven = 0.1F;

// Where in the sun's disc a pixel's quarters take its light from: together they stand for all of it.
constexpr glm::dvec2 kAside[4] = {{0.63, 0.26}, {-0.26, 0.63}, {0.26, -0.63}, {-0.63, -0.26}};

float luminance_of(const BackdropSample& sample) {
    return 0.2126F * sample.rgb[0] + 0.7152F * sample.rgb[1] + 0.0722F * sample.rgb[2];
}

bool differ(const BackdropSample& a, const BackdropSample& b) {
    if (std::isinf(a.distance) != std::isinf(b.distance)) return true;
    if (std::isinf(a.distance)) return false;
    if (std::abs(a.distance - b.distance) > kFarApart * std::max(a.distance, b.distance))
        return true;
    const float one = luminance_of(a), other = luminance_of(b);
    return std::abs(one - other) > kUneven * std::max(one, other);
}

}  // namespace

HillsInView::HillsInView(const Scene& scene, const View& view, const GroundLight& ground,
                         const ReliefLight* light)
    : sky_(outside_of(scene).sky),
      eye_(view.eye),
      ground_(ground),
      light_(light),
      seen_(view.eye.y > ground.height) {}

double HillsInView::ahead(const glm::dvec3& direction) const {
    return seen_ ? ground_ahead(*ground_.relief, eye_, direction)
                 : std::numeric_limits<double>::infinity();
}

glm::dvec3 HillsInView::radiance(const glm::dvec3& direction, double distance,
                                 const glm::dvec2& aside) const {
    if (light_ == nullptr) return glm::dvec3(0);
    if (std::isinf(distance)) return sky_radiance(sky_, direction);
    return radiance_at(*light_, ground_, eye_ + distance * direction, aside);
}

Backdrop hills_backdrop(const Scene& scene, const View& view, int width, int height,
                        const GroundLight& ground, const ReliefLight* light, const Air* air,
                        int threads, std::span<const std::uint8_t> wanted) {
    const HillsInView hills(scene, view, ground, light);
    const PictureRays picture = picture_rays(view, width, height);
    const auto sample_at = [&](double x, double y, const glm::dvec2& aside) {
        const glm::dvec3 d = glm::normalize(picture.corner + x * picture.per_x + y * picture.per_y);
        const double t = hills.ahead(d);
        glm::dvec3 seen = hills.radiance(d, t, aside);
        BackdropSample sample;
        sample.distance = static_cast<float>(t);
        if (air != nullptr) {
            const AirBefore before =
                std::isinf(t) ? whole_air(*air, d.y, x, y)
                              : air_before(*air, HazeRay(air->haze, view.eye.y, d.y), x, y, t);
            sample.opacity = static_cast<float>(before.opacity);
            sample.lost = static_cast<float>(before.lost);
            seen *= 1 - before.opacity;
        }
        for (int c = 0; c < 3; ++c) sample.rgb[c] = static_cast<float>(seen[c]);
        return sample;
    };

    const auto across = static_cast<std::size_t>(width), down = static_cast<std::size_t>(height);
    std::vector<BackdropSample> middles(across * down);
    parallel_for(threads, down, [&](std::size_t row) {
        for (std::size_t x = 0; x < across; ++x)
            if (is_wanted(wanted, width, x, row))
                middles[row * across + x] = sample_at(
                    static_cast<double>(x) + 0.5, static_cast<double>(row) + 0.5, glm::dvec2(0));
    });

    Backdrop backdrop;
    backdrop.width = width;
    backdrop.height = height;
    backdrop.quarters_of.assign(across * down, 0);
    std::uint32_t divided = 0;
    std::vector<std::size_t> which;
    for (std::size_t y = 0; y < down; ++y)
        for (std::size_t x = 0; x < across; ++x) {
            if (!is_wanted(wanted, width, x, y)) continue;
            const std::size_t at = y * across + x;
            const bool uneven = (x > 0 && differ(middles[at], middles[at - 1])) ||
                                (x + 1 < across && differ(middles[at], middles[at + 1])) ||
                                (y > 0 && differ(middles[at], middles[at - across])) ||
                                (y + 1 < down && differ(middles[at], middles[at + across]));
            if (!uneven) continue;
            backdrop.quarters_of[at] = ++divided;
            which.push_back(at);
        }
    backdrop.quarters.resize(which.size());
    parallel_for(threads, (which.size() + 63) / 64, [&](std::size_t part) {
        for (std::size_t i = 64 * part; i < std::min(which.size(), 64 * part + 64); ++i)
            for (int q = 0; q < 4; ++q)
                backdrop.quarters[i][static_cast<std::size_t>(q)] = sample_at(
                    static_cast<double>(which[i] % across) + 0.25 + 0.5 * (q % 2),
                    static_cast<double>(which[i] / across) + 0.25 + 0.5 * (q / 2), kAside[q]);
    });

    backdrop.rgb.resize(3 * across * down);
    backdrop.distance.resize(across * down);
    if (air != nullptr) {
        backdrop.opacity.resize(across * down);
        backdrop.lost.resize(across * down);
    }
    for (std::size_t at = 0; at < middles.size(); ++at) {
        BackdropSample mean = middles[at];
        if (backdrop.quarters_of[at] != 0) {
            const auto& quarters = backdrop.quarters[backdrop.quarters_of[at] - 1];
            mean.rgb[0] = mean.rgb[1] = mean.rgb[2] = mean.opacity = mean.lost = 0;
            for (const BackdropSample& one : quarters) {
                for (int c = 0; c < 3; ++c) mean.rgb[c] += 0.25F * one.rgb[c];
                mean.opacity += 0.25F * one.opacity;
                mean.lost += 0.25F * one.lost;
            }
        }
        for (std::size_t c = 0; c < 3; ++c) backdrop.rgb[3 * at + c] = mean.rgb[c];
        backdrop.distance[at] = mean.distance;
        if (air == nullptr) continue;
        backdrop.opacity[at] = mean.opacity;
        backdrop.lost[at] = mean.lost;
    }
    return backdrop;
}

}  // namespace awan
