#include "core/draw/behind_peak.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/draw/hills_backdrop.h"
#include "core/light/legendre.h"
#include "core/scene/outside.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// Rings around a direction, and directions on each.
constexpr int kRings = 24, kSpokes = 10;
// Each ring is turned by this share of a spoke's gap, the golden section, against the one within.
constexpr double kTurn = 0.618033988749895;
// Of the grid of directions on which the mean is taken, radians; at most so many along a side.
constexpr double kGridAngle = 0.07;
constexpr int kMostGrid = 64;
// Of the Legendre sum.
constexpr int kMostTerms = 1000;
constexpr double kNegligible = 1e-4;
// Of x: e^50 is as good as without end.
constexpr double kMostDepth = 50;

// How much of the light of each Legendre order is left.
std::vector<double> kept_by_peak(const Medium& medium, const Peak& peak, double x) {
    const double whole = exact::expm1(x);
    std::vector<double> kept;
    for (int l = 0; l < kMostTerms; ++l) {
        const double ratio = l < peak.from ? 1 : phase_moment(medium, l) / peak.share;
        kept.push_back(whole > 0 ? exact::expm1(x * ratio) / whole : ratio);
        if (l > peak.from && std::abs(kept.back()) < kNegligible) break;
    }
    return kept;
}

// The share of the light that turns by less than `angle`: half the sum over l of kept_l (P_(l-1) - P_(l+1)), with
// P_(-1) = 1.
double share_within(const std::vector<double>& kept, double angle) {
    const double mu = exact::cos(angle);
    double before = 1, p = 1, sum = 0;
    for (std::size_t l = 0; l < kept.size(); ++l) {
        const auto n = static_cast<double>(l);
        const double next = ((2 * n + 1) * mu * p - n * (l == 0 ? 0 : before)) / (n + 1);
        sum += kept[l] * (before - next);
        before = p;
        p = next;
    }
    return 0.5 * sum;
}

// Of the light around a direction, as light is turned that went through the peak once, and often.
struct Means {
    glm::vec3 once, often;
};

// A direction's neighbours, and what their light is. Rings of `once` and `often` are the same but for their shares.
class Around {
  public:
    Around(const Scene& scene, const SkyDome& sky, const View& view, const GroundLight& ground,
           const std::vector<Ring>& once, const std::vector<Ring>& often, bool from_sky,
           bool from_ground, const ReliefLight* hills)
        : eye_(view.eye),
          ground_(ground),
          sky_(sky),
          grounded_(scene->ground && view.eye.y > scene->ground->height),
          from_sky_(from_sky),
          from_ground_(from_ground) {
        if (hills != nullptr && ground.relief && grounded_)
            hills_.emplace(scene, view, ground, hills);
        double turn = 0;
        for (std::size_t i = 0; i < once.size(); ++i) {
            const double angle = once[i].angle;
            for (int s = 0; s < kSpokes; ++s) {
                const double at = 2 * std::numbers::pi * (s + turn) / kSpokes;
                turns_.push_back({{exact::sin(angle) * exact::cos(at),
                                   exact::sin(angle) * exact::sin(at), exact::cos(angle)},
                                  once[i].share / kSpokes,
                                  often[i].share / kSpokes});
            }
            turn += kTurn;
        }
    }
    Means mean(const glm::dvec3& direction) const {
        const SideAxes side = side_axes(direction);
        glm::dvec3 once(0), often(0);
        for (const Turn& turn : turns_) {
            const glm::dvec3 light =
                radiance(turn.to.x * side.u + turn.to.y * side.v + turn.to.z * direction);
            once += turn.once * light;
            often += turn.often * light;
        }
        return {glm::vec3(once), glm::vec3(often)};
    }

  private:
    glm::dvec3 radiance(const glm::dvec3& d) const {
        if (hills_) {
            const double distance = hills_->ahead(d);
            const bool wanted = std::isinf(distance) ? from_sky_ : from_ground_;
            return wanted ? hills_->radiance(d, distance) : glm::dvec3(0);
        }
        if (!grounded_ || !(d.y < 0)) return from_sky_ ? sky_radiance(sky_, d) : glm::dvec3(0);
        if (!from_ground_) return glm::dvec3(0);
        const double distance = (ground_.height - eye_.y) / d.y;
        return radiance_at(ground_, eye_.x + distance * d.x, eye_.z + distance * d.z);
    }
    glm::dvec3 eye_;
    const GroundLight& ground_;
    const SkyDome& sky_;
    bool grounded_, from_sky_, from_ground_;
    std::optional<HillsInView> hills_;
    struct Turn {
        glm::dvec3 to;
        double once, often;  // share
    };
    std::vector<Turn> turns_;
};

// Points along a side of the picture whose half angle has this tangent.
int points_along(double tangent) {
    return std::clamp(static_cast<int>(std::ceil(2 * exact::atan(tangent) / kGridAngle)), 1,
                      kMostGrid) +
           1;
}

}  // namespace

double depth_of_most(const Medium& medium, const Peak& peak) {
    return std::min(-exact::log(std::max(1 - medium.albedo * peak.share, 0.0)), kMostDepth);
}

std::vector<Ring> rings_of_peak(const Medium& medium, const Peak& peak, double x, int count) {
    const std::vector<double> kept = kept_by_peak(medium, peak, x);
    // Close together where the peak is.
    const auto angle_at = [&](double i) { return std::numbers::pi * (i / count) * (i / count); };
    std::vector<Ring> rings;
    double within = 0;
    for (int i = 1; i <= count; ++i) {
        const double share = i == count ? 1 : share_within(kept, angle_at(i));
        rings.push_back({angle_at(i - 0.5), share - within});
        within = share;
    }
    return rings;
}

namespace {

// Of a grid of directions, on every pixel: linear between them.
std::vector<float> on_pixels(const std::vector<glm::vec3>& means, int across, int down, int width,
                             int height, int threads) {
    const auto columns = static_cast<std::size_t>(width);
    std::vector<float> rgb(3 * columns * static_cast<std::size_t>(height));
    const auto between = [](std::size_t pixel, int pixels, int points) {
        const double at = (static_cast<double>(pixel) + 0.5) / pixels * (points - 1);
        const int low = std::min(static_cast<int>(at), points - 2);
        return std::pair(static_cast<std::size_t>(low), static_cast<float>(at - low));
    };
    parallel_for(threads, static_cast<std::size_t>(height), [&](std::size_t y) {
        const auto [j, t] = between(y, height, down);
        std::size_t to = 3 * columns * y;
        for (std::size_t x = 0; x < columns; ++x) {
            const auto [i, s] = between(x, width, across);
            const glm::vec3* const row = &means[j * static_cast<std::size_t>(across) + i];
            const glm::vec3* const next = row + across;
            const glm::vec3 mean =
                glm::mix(glm::mix(row[0], row[1], s), glm::mix(next[0], next[1], s), t);
            for (int c = 0; c < 3; ++c) rgb[to++] = mean[c];
        }
    });
    return rgb;
}

}  // namespace

BehindPeak behind_through_peak(const Scene& scene, const View& view, int width, int height,
                               const GroundLight& ground, const Peak& peak, bool from_sky,
                               bool from_ground, int threads, const ReliefLight* hills) {
    const SkyDome sky = outside_of(scene).sky;
    const double most = depth_of_most(scene->medium, peak);
    const Around around(scene, sky, view, ground, rings_of_peak(scene->medium, peak, 0, kRings),
                        rings_of_peak(scene->medium, peak, most, kRings), from_sky, from_ground,
                        hills);
    const double tan = view.tan_half_fov, wide = tan * view.aspect;
    const int across = points_along(wide), down = points_along(tan);
    const auto columns = static_cast<std::size_t>(across);
    std::vector<glm::vec3> once(columns * static_cast<std::size_t>(down)), often(once.size());
    parallel_for(threads, once.size(), [&](std::size_t i) {
        const double u = (2.0 * static_cast<double>(i % columns) / (across - 1) - 1) * wide,
                     v = (1 - 2.0 * static_cast<double>(i / columns) / (down - 1)) * tan;
        const Means means =
            around.mean(glm::normalize(view.forward + u * view.right + v * view.up));
        once[i] = means.once;
        often[i] = means.often;
    });
    return {on_pixels(once, across, down, width, height, threads),
            on_pixels(often, across, down, width, height, threads)};
}

}  // namespace awan
