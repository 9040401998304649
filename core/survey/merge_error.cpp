#include "core/survey/merge_error.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/survey/gauss.h"

namespace awan {
namespace {

constexpr std::size_t kMergePoints = 48;
// Where a particle is cut off, in s.
constexpr double kMergeCut = 4;
// How far from a particle rays begin, in radii of the widest.
constexpr double kBeside = 1.5;
constexpr std::size_t kInARow = 1024;
// The error of a picture to that of transmittances at single points: a pixel's light comes from many of them. Measured
// on clouds of 100 thousand to 1.3 million particles, each far less deep than the cloud: 1/15 to 1/11.
constexpr double kPictureError = 0.125;

// A ball that holds a block's particles out to their cut.
struct Ball {
    glm::dvec3 center{0};
    double radius = 0;
};
Ball ball_of(const ParticleSet& particles, const MergeBlocks& blocks, std::size_t block) {
    glm::dvec3 low(1e300), high(-1e300);
    for (std::size_t n = blocks.first[block]; n < blocks.first[block + 1]; ++n) {
        const std::size_t i = blocks.order[n];
        const glm::dvec3 reach(kMergeCut * gaussian_s(particles, i));
        low = glm::min(low, particles.center[i] - reach);
        high = glm::max(high, particles.center[i] + reach);
    }
    return {0.5 * (low + high), 0.5 * glm::length(high - low)};
}

float transmittance(const ParticleSet& particles, const MergeBlocks& blocks,
                    const std::vector<Ball>& balls, const MergeRay& ray) {
    double depth = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const glm::dvec3 to_ball = balls[b].center - ray.from;
        const double ahead = glm::dot(to_ball, ray.direction), r = balls[b].radius;
        if (ahead < -r || glm::dot(to_ball, to_ball) - ahead * ahead > r * r) continue;
        for (std::size_t n = blocks.first[b]; n < blocks.first[b + 1]; ++n) {
            const std::size_t i = blocks.order[n];
            const glm::dvec3 to = particles.center[i] - ray.from;
            const double along = glm::dot(to, ray.direction), s = gaussian_s(particles, i);
            const double aside2 = glm::dot(to, to) - along * along;
            if (aside2 > kMergeCut * kMergeCut * s * s || along < -kMergeCut * s) continue;
            depth += central_depth(particles, i) * exact::seeded_exp(-0.5 * aside2 / (s * s)) *
                     normal_cdf(along / s);
        }
    }
    return static_cast<float>(exact::seeded_exp(-depth));
}

}  // namespace

std::vector<MergeRay> merge_rays(const ParticleSet& particles, const glm::dvec3& to_sun) {
    const glm::dvec3 around[] = {{0.8, 0.36, 0.48},    {-0.64, 0.48, 0.6}, {0.6, -0.48, 0.64},
                                 {-0.48, -0.36, -0.8}, {0.36, 0.8, -0.48}, {-0.8, 0.0, -0.6}};
    std::vector<MergeRay> rays;
    double whole = 0, mass = 0;
    float widest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        whole += gaussian_mass(particles, i);
        widest = std::max(widest, particles.radius[i]);
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
        mass += gaussian_mass(particles, i);
        const auto drawn = static_cast<double>(rays.size() / 2) + 0.5;
        if (mass * static_cast<double>(kMergePoints) < whole * drawn) continue;
        // Beside the particle: within it, its own matter would count for more than it does in a picture.
        const std::size_t turn = rays.size() / 2 % std::size(around);
        const glm::dvec3 from =
            particles.center[i] + kBeside * static_cast<double>(widest) * around[turn];
        rays.push_back({from, to_sun});
        rays.push_back({from, around[(turn + 1) % std::size(around)]});
    }
    return rays;
}

std::vector<float> transmittances(const ParticleSet& particles, const MergeBlocks& blocks,
                                  const std::vector<MergeRay>& rays, int threads) {
    std::vector<Ball> balls(blocks.size());
    parallel_for(threads, balls.size(),
                 [&](std::size_t b) { balls[b] = ball_of(particles, blocks, b); });
    std::vector<float> through(rays.size());
    parallel_for(threads, rays.size(), [&](std::size_t i) {
        through[i] = transmittance(particles, blocks, balls, rays[i]);
    });
    return through;
}

MergeBlocks in_their_order(const ParticleSet& particles) {
    MergeBlocks blocks;
    blocks.order.resize(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (i % kInARow == 0) {
            blocks.first.push_back(static_cast<std::uint32_t>(i));
            blocks.places.push_back({kMergeClasses, glm::ivec3(0)});
        }
        blocks.order[i] = static_cast<std::uint32_t>(i);
    }
    blocks.first.push_back(static_cast<std::uint32_t>(particles.size()));
    return blocks;
}

double error_of_merging(const std::vector<float>& exact, const std::vector<float>& merged) {
    double off = 0, whole = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double t = static_cast<double>(exact[i]),
                     difference = static_cast<double>(merged[i]) - t;
        off += difference * difference;
        whole += t * t;
    }
    return whole > 0 ? kPictureError * std::sqrt(off / whole) : 0;
}

}  // namespace awan
