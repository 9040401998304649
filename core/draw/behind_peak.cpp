#include "core/draw/behind_peak.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/parallel.h"
#include "core/light/legendre.h"
#include "core/scene/outside.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// Rings around a direction, and directions on each.
constexpr int kRings = 8, kSpokes = 10;
// Each ring is turned by this share of a spoke's gap, the golden section, against the one within.
constexpr double kTurn = 0.618033988749895;
// Of the grid of directions on which the mean is taken, radians; at most so many along a side.
constexpr double kGridAngle = 0.07;
constexpr int kMostGrid = 64;
// Of the table of the share within an angle; of the Legendre sum.
constexpr int kAngles = 256, kMostTerms = 1000;
constexpr double kNegligible = 1e-4;

// How much of the light of each Legendre order is left.
std::vector<double> kept_by_peak(const Medium& medium, const Peak& peak) {
    const double scattered = medium.albedo * peak.share, k = 1 - scattered;
    const double depth = scattered < 1 ? -std::log(k) / scattered : 50;
    const double whole = std::expm1(std::min(scattered * depth, 50.0));
    std::vector<double> kept;
    for (int l = 0; l < kMostTerms; ++l) {
        const double ratio = l < peak.from ? 1 : phase_moment(medium, l) / peak.share;
        kept.push_back(std::expm1(std::min(scattered * depth, 50.0) * ratio) / whole);
        if (l > peak.from && std::abs(kept.back()) < kNegligible) break;
    }
    return kept;
}

// The share of the light that turns by less than `angle`: half the sum over l of kept_l (P_(l-1) - P_(l+1)), with
// P_(-1) = 1.
double share_within(const std::vector<double>& kept, double angle) {
    const double mu = std::cos(angle);
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

// A direction's neighbours, and what their light is.
class Around {
  public:
    Around(const Scene& scene, const View& view, const GroundLight& ground, const Peak& peak,
           bool from_sky, bool from_ground)
        : eye_(view.eye),
          ground_(ground),
          sky_(outside_of(scene).sky),
          grounded_(scene->ground && view.eye.y > scene->ground->height),
          from_sky_(from_sky),
          from_ground_(from_ground) {
        const std::vector<double> rings = rings_of_peak(scene->medium, peak, kRings);
        for (int r = 0; r < kRings; ++r)
            for (int s = 0; s < kSpokes; ++s) {
                const double turn = 2 * std::numbers::pi * (s + kTurn * r) / kSpokes,
                             angle = rings[static_cast<std::size_t>(r)];
                turns_.push_back({std::sin(angle) * std::cos(turn),
                                  std::sin(angle) * std::sin(turn), std::cos(angle)});
            }
    }
    glm::vec3 mean(const glm::dvec3& direction) const {
        const SideAxes side = side_axes(direction);
        glm::dvec3 sum(0);
        for (const glm::dvec3& turn : turns_)
            sum += radiance(turn.x * side.u + turn.y * side.v + turn.z * direction);
        return glm::vec3(sum / static_cast<double>(turns_.size()));
    }

  private:
    glm::dvec3 radiance(const glm::dvec3& d) const {
        if (!grounded_ || !(d.y < 0)) return from_sky_ ? sky_radiance(sky_, d) : glm::dvec3(0);
        if (!from_ground_) return glm::dvec3(0);
        const double distance = (ground_.height - eye_.y) / d.y;
        return radiance_at(ground_, eye_.x + distance * d.x, eye_.z + distance * d.z);
    }
    glm::dvec3 eye_;
    const GroundLight& ground_;
    SkyDome sky_;
    bool grounded_, from_sky_, from_ground_;
    std::vector<glm::dvec3> turns_;
};

// Points along a side of the picture whose half angle has this tangent.
int points_along(double tangent) {
    return std::clamp(static_cast<int>(std::ceil(2 * std::atan(tangent) / kGridAngle)), 1,
                      kMostGrid) +
           1;
}

}  // namespace

std::vector<double> rings_of_peak(const Medium& medium, const Peak& peak, int count) {
    const std::vector<double> kept = kept_by_peak(medium, peak);
    std::vector<double> rings;
    double last_angle = 0, last_share = 0;
    for (int i = 1; i <= kAngles && static_cast<int>(rings.size()) < count; ++i) {
        const double at = static_cast<double>(i) / kAngles, angle = std::numbers::pi * at * at;
        const double share = i == kAngles ? 1 : share_within(kept, angle);
        // The sum over the orders up to L is cut off, and ripples.
        if (!(share > last_share)) continue;
        while (static_cast<int>(rings.size()) < count) {
            const double wanted = (static_cast<double>(rings.size()) + 0.5) / count;
            if (wanted > share) break;
            rings.push_back(last_angle +
                            (angle - last_angle) * (wanted - last_share) / (share - last_share));
        }
        last_angle = angle;
        last_share = share;
    }
    rings.resize(static_cast<std::size_t>(count), std::numbers::pi);
    return rings;
}

std::vector<float> behind_through_peak(const Scene& scene, const View& view, int width, int height,
                                       const GroundLight& ground, const Peak& peak, bool from_sky,
                                       bool from_ground, int threads) {
    const Around around(scene, view, ground, peak, from_sky, from_ground);
    const double tan = view.tan_half_fov, wide = tan * view.aspect;
    const int across = points_along(wide), down = points_along(tan);
    std::vector<glm::vec3> means(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    parallel_for(threads, means.size(), [&](std::size_t i) {
        const auto columns = static_cast<std::size_t>(across);
        const double u = (2.0 * static_cast<double>(i % columns) / (across - 1) - 1) * wide,
                     v = (1 - 2.0 * static_cast<double>(i / columns) / (down - 1)) * tan;
        means[i] = around.mean(glm::normalize(view.forward + u * view.right + v * view.up));
    });
    std::vector<float> rgb(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const auto between = [](int pixel, int pixels, int points) {
        const double at = (pixel + 0.5) / pixels * (points - 1);
        const int low = std::min(static_cast<int>(at), points - 2);
        return std::pair(static_cast<std::size_t>(low), static_cast<float>(at - low));
    };
    std::size_t to = 0;
    for (int y = 0; y < height; ++y) {
        const auto [j, t] = between(y, height, down);
        for (int x = 0; x < width; ++x) {
            const auto [i, s] = between(x, width, across);
            const glm::vec3* const row = &means[j * static_cast<std::size_t>(across) + i];
            const glm::vec3* const next = row + across;
            const glm::vec3 mean =
                glm::mix(glm::mix(row[0], row[1], s), glm::mix(next[0], next[1], s), t);
            for (int c = 0; c < 3; ++c) rgb[to++] = mean[c];
        }
    }
    return rgb;
}

}  // namespace awan
