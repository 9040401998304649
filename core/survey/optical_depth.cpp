#include "core/survey/optical_depth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/survey/gauss.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// Of the largest alpha: what counts as cloud in a picture.
constexpr double kCoveredShare = 0.05;

// Coarsens a raster of `side` lines until the work fits; work(side) = line-particle pairs.
template <typename Work>
int affordable_side(int side, double most, const Work& work) {
    while (side > 8 && work(side) > most) side = side * 3 / 4;
    return side;
}

struct Raster {
    int width, height;
    std::vector<double> depth;
    double largest() const {
        return depth.empty() ? 0 : *std::max_element(depth.begin(), depth.end());
    }
};

}  // namespace

double parallel_optical_depth(const ParticleSet& particles, glm::dvec3 direction) {
    if (particles.size() == 0) return 0;
    const SideAxes axes = side_axes(direction);
    // Rebased, so that far clouds keep their digits.
    const glm::dvec3 origin = particles.center[0];
    glm::dvec2 low(0), high(0);
    double largest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 p = particles.center[i] - origin;
        const glm::dvec2 q(glm::dot(p, axes.u), glm::dot(p, axes.v));
        low = glm::min(low, q);
        high = glm::max(high, q);
        // A line that no raster can miss.
        largest = std::max(largest, central_depth(particles, i));
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, 1e-300});
    const int side = affordable_side(kRasterSide, kMaxLineWork, [&](int n) {
        double work = 0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const double reach =
                std::min<double>(n, 2 * kGaussianCut * gaussian_s(particles, i) / extent * n + 1);
            work += reach * reach;
        }
        return work;
    });
    const double step = extent / side;
    Raster raster{
        side, side,
        std::vector<double>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0)};
    std::vector<double> along_x(static_cast<std::size_t>(side));
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i), depth = central_depth(particles, i);
        const glm::dvec3 p = particles.center[i] - origin;
        const double x = (glm::dot(p, axes.u) - low.x) / step - 0.5,
                     y = (glm::dot(p, axes.v) - low.y) / step - 0.5;
        const double reach = kGaussianCut * s / step, inverse = 0.5 * (step / s) * (step / s);
        const int x0 = static_cast<int>(std::ceil(std::max(0.0, x - reach)));
        const int x1 = static_cast<int>(std::floor(std::min(side - 1.0, x + reach)));
        const int y0 = static_cast<int>(std::ceil(std::max(0.0, y - reach)));
        const int y1 = static_cast<int>(std::floor(std::min(side - 1.0, y + reach)));
        for (int a = x0; a <= x1; ++a)
            along_x[static_cast<std::size_t>(a)] = exact::exp(-(a - x) * (a - x) * inverse);
        for (int b = y0; b <= y1; ++b) {
            const double row = depth * exact::exp(-(b - y) * (b - y) * inverse);
            double* out =
                raster.depth.data() + static_cast<std::size_t>(b) * static_cast<std::size_t>(side);
            for (int a = x0; a <= x1; ++a) out[a] += row * along_x[static_cast<std::size_t>(a)];
        }
    }
    return std::max(largest, raster.largest());
}

EyeDepth eye_optical_depth(const ParticleSet& particles, const View& view) {
    const double tan_x = view.tan_half_fov * view.aspect, tan_y = view.tan_half_fov;
    struct Box {
        int x0, x1, y0, y1;
        // Right, up, forward from the eye.
        glm::dvec3 q;
    };
    const auto box_of = [&](std::size_t i, int width, int height) {
        const glm::dvec3 p = particles.center[i] - view.eye;
        Box box{0,
                -1,
                0,
                -1,
                {glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward)}};
        const double reach = kGaussianCut * gaussian_s(particles, i);
        const Interval x = disc_slopes(box.q.x, box.q.z, reach),
                       y = disc_slopes(box.q.y, box.q.z, reach);
        const auto column = [&](double slope) {
            return (std::clamp(slope / tan_x, -1.1, 1.1) + 1) / 2 * width - 0.5;
        };
        const auto row = [&](double slope) {
            return (std::clamp(slope / tan_y, -1.1, 1.1) + 1) / 2 * height - 0.5;
        };
        if (x.low > x.high || y.low > y.high) return box;
        box.x0 = std::max(0, static_cast<int>(std::ceil(column(x.low))));
        box.x1 = std::min(width - 1, static_cast<int>(std::floor(column(x.high))));
        box.y0 = std::max(0, static_cast<int>(std::ceil(row(y.low))));
        box.y1 = std::min(height - 1, static_cast<int>(std::floor(row(y.high))));
        return box;
    };
    const auto raster_size = [&](int side) {
        const double shorter = view.aspect >= 1 ? side / view.aspect : side * view.aspect;
        const int other = std::clamp(static_cast<int>(std::lround(shorter)), 1, side);
        return view.aspect >= 1 ? glm::ivec2(side, other) : glm::ivec2(other, side);
    };
    const int side = affordable_side(kRasterSide, kMaxRayWork, [&](int n) {
        const glm::ivec2 size = raster_size(n);
        double work = 0;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const Box box = box_of(i, size.x, size.y);
            work += std::max(0.0, box.x1 - box.x0 + 1.0) * std::max(0.0, box.y1 - box.y0 + 1.0);
        }
        return work;
    });
    const glm::ivec2 size = raster_size(side);
    Raster raster{size.x, size.y,
                  std::vector<double>(
                      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y), 0.0)};
    std::vector<glm::dvec3> rays;
    for (int b = 0; b < size.y; ++b)
        for (int a = 0; a < size.x; ++a)
            rays.push_back(glm::normalize(glm::dvec3(((a + 0.5) / size.x * 2 - 1) * tan_x,
                                                     ((b + 0.5) / size.y * 2 - 1) * tan_y, 1)));
    EyeDepth eye;
    double& largest = eye.largest;
    double pairs = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const Box box = box_of(i, size.x, size.y);
        pairs += std::max(0.0, box.x1 - box.x0 + 1.0) * std::max(0.0, box.y1 - box.y0 + 1.0);
        const double s = gaussian_s(particles, i), depth = central_depth(particles, i);
        const glm::dvec3 q = box.q;
        // The ray through a particle's own centre, when it is in the picture: no raster can miss
        // it.
        if (q.z > 0 && std::abs(q.x) <= tan_x * q.z && std::abs(q.y) <= tan_y * q.z)
            largest = std::max(largest, depth * normal_cdf(glm::length(q) / s));
        for (int b = box.y0; b <= box.y1; ++b)
            for (int a = box.x0; a <= box.x1; ++a) {
                const auto at = static_cast<std::size_t>(b) * static_cast<std::size_t>(size.x) +
                                static_cast<std::size_t>(a);
                const glm::dvec3 d = rays[at];
                const double t = glm::dot(q, d);
                const glm::dvec3 miss = (q - d * t) / s;
                raster.depth[at] +=
                    depth * exact::exp(-0.5 * glm::dot(miss, miss)) * normal_cdf(t / s);
            }
    }
    largest = std::max(largest, raster.largest());
    const double lines = static_cast<double>(raster.depth.size());
    eye.particles_per_pixel = pairs / lines;
    double sum = 0, covered = 0;
    for (const double depth : raster.depth)
        if (-exact::expm1(-depth) > kCoveredShare * -exact::expm1(-largest)) {
            covered += 1;
            sum += depth;
        }
    eye.covered = covered / lines;
    eye.mean = covered > 0 ? sum / covered : largest;
    return eye;
}

}  // namespace awan
