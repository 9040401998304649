#include "core/survey/merge.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/generate/keyed_random.h"
#include "core/survey/merge_error.h"
#include "core/survey/merge_lattice.h"

namespace awan {
namespace {

// About how many nodes there may be where particles have to be widened for it.
constexpr double kManyNodes = 30000;
// Share of the mass below which particles may be widened however many nodes there are room for.
constexpr double kLittleMass = 0.01;
// How often narrower classes are tried where merging costs too much.
constexpr int kTries = 4;
// Of the particles, those whose places tell how much space is filled; and cells that are counted among them.
constexpr std::size_t kSampled = 131072, kEnoughCells = 6000;
// The error of a picture where no more than kLittleMass is widened (merge_test).
constexpr double kErrorOfNodes = 0.01;
// By how much of s the edge of a cloud moves inward where classes are coarse and it lies at a distance of one s, in the
// tails; it goes with the third power of the distance. Fine classes do so many times better. On clouds of depth 20 to
// 400 pictures were off by a fifth to a half of what comes of it, their silhouettes alone by as much.
constexpr double kEdgeMoves = 0.003, kFinerTails = 4;
// Where the edge costs less, classes are coarse.
constexpr double kEdgeMayCost = 0.04;
// More particles than this share of them left, and merging is not worth its error.
constexpr double kLeft = 0.5;

// The narrowest class by the mass, as octaves' halves below the widest s.
int class_of_little_mass(const ParticleSet& particles, const MergeScales& from_widest) {
    std::array<double, kMergeClasses + 1> mass{};
    double whole = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto k = static_cast<std::size_t>(merge_class(from_widest, gaussian_s(particles, i)));
        mass[k] += gaussian_mass(particles, i);
        whole += gaussian_mass(particles, i);
    }
    double below = 0;
    int k = 0;
    while (k < kMergeClasses && below + mass[static_cast<std::size_t>(k)] < kLittleMass * whole)
        below += mass[static_cast<std::size_t>(k++)];
    return k;
}

// How many cells of a side have particles in them, of those that are sampled. Cells far apart may count as one.
std::size_t filled_cells(const ParticleSet& particles, const glm::dvec3& origin, double cell) {
    std::vector<std::uint64_t> filled;
    const std::size_t stride = std::max<std::size_t>(1, particles.size() / kSampled);
    for (std::size_t i = 0; i < particles.size(); i += stride) {
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double at = std::floor((particles.center[i][axis] - origin[axis]) / cell);
            key = key << 21 | (static_cast<std::uint64_t>(std::min(at, 9e15)) & 0x1fffff);
        }
        filled.push_back(key);
    }
    std::sort(filled.begin(), filled.end());
    return static_cast<std::size_t>(std::unique(filled.begin(), filled.end()) - filled.begin());
}

// The largest depth along a few lines through particles that are drawn by their masses, axis by axis.
double depth_through(const ParticleSet& particles) {
    constexpr std::size_t kLines = 6;
    std::array<glm::dvec3, kLines> through{};
    std::array<double, kLines> depth{};
    double whole = 0, mass = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) whole += gaussian_mass(particles, i);
    std::size_t lines = 0;
    for (std::size_t i = 0; i < particles.size() && lines < kLines; ++i) {
        mass += gaussian_mass(particles, i);
        while (lines < kLines && mass * kLines >= whole * (static_cast<double>(lines) + 0.5))
            through[lines++] = particles.center[i];
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i), whole_depth = central_depth(particles, i);
        for (std::size_t line = 0; line < lines; ++line) {
            glm::dvec3 aside = particles.center[i] - through[line];
            aside[static_cast<int>(line % 3)] = 0;
            const double far = glm::dot(aside, aside) / (s * s);
            if (far < 36) depth[line] += whole_depth * exact::seeded_exp(-0.5 * far);
        }
    }
    return *std::max_element(depth.begin(), depth.end());
}

// What coarse classes cost a picture at its edge: that lies where the depth is about 1, the farther out in the tails of
// the widest Gaussians the deeper the cloud is, and moves inward. Of pictures, as their root mean square.
double error_of_edge(const ParticleSet& particles, double widest_s) {
    const Bounds bounds = bounds_of(particles);
    const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
    const double narrowest = std::max(std::min({half.x, half.y, half.z}), 1e-300);
    const double away = std::sqrt(2 * exact::log(std::max(depth_through(particles), 1.0)));
    return 2 * kEdgeMoves * away * away * away * widest_s / narrowest;
}

// Of the lattices of class k and of all wider ones together, in nodes of that of class k.
double nodes_of_all(const MergeScales& scales, int k) {
    double sum = 0;
    for (int wider = k; wider <= std::max(k, kWidestClass); ++wider)
        sum += exact::pow(scales.cell(k) / scales.cell(wider), 3);
    return sum;
}

// The narrowest class whose lattices come to about kManyNodes.
int class_of_many_nodes(const ParticleSet& particles, const MergeScales& scales, int narrowest) {
    int k = kMergeClasses;
    std::size_t cells = 0;
    while (k > narrowest && cells < kEnoughCells)
        cells = filled_cells(particles, scales.origin, scales.cell(--k));
    // Finer cells than these the sampled particles do not tell from empty ones, but the volume stays.
    const double counted = static_cast<double>(cells) * exact::pow(scales.cell(k), 3);
    while (k > narrowest &&
           counted / exact::pow(scales.cell(k - 1), 3) * nodes_of_all(scales, k - 1) < kManyNodes)
        --k;
    return k;
}

}  // namespace

Result<ParticleSet> merged(ParticleSet particles, const glm::dvec3& to_sun, double most_error,
                           int threads, const Deadline& deadline) {
    if (particles.size() < kFewParticles || !particles.color.empty() || !particles.paint.empty())
        return particles;
    float widest = 0;
    for (const float radius : particles.radius) widest = std::max(widest, radius);
    const double widest_s = 0.5 * static_cast<double>(widest);
    double at_edge = error_of_edge(particles, widest_s);
    const bool fine = at_edge > std::min(kEdgeMayCost, most_error);
    if (fine) at_edge /= kFinerTails;
    const MergeScales all = merge_scales(bounds_of(particles).min, widest_s, fine);
    const int narrowest = class_of_little_mass(particles, all);
    if (auto error = deadline.over()) return *error;
    int k = class_of_many_nodes(particles, all, narrowest);
    std::vector<MergeRay> rays;
    std::vector<float> exact;
    for (int tried = 0; tried < kTries && k >= narrowest; ++tried, --k) {
        if (auto error = deadline.over()) return *error;
        const MergeScales scales = from_class(all, k);
        const MergeBlocks blocks = merge_blocks(particles, scales, threads);
        if (blocks.size() == 0) break;
        ParticleSet fewer = on_merge_lattices(particles, scales, blocks, threads);
        if (static_cast<double>(fewer.size()) > kLeft * static_cast<double>(particles.size()))
            break;
        double error = std::max(kErrorOfNodes, at_edge);
        if (k > narrowest) {
            if (rays.empty()) {
                rays = merge_rays(particles, to_sun);
                exact = transmittances(particles, blocks, rays, threads);
            }
            error = exact::hypot(
                error, error_of_merging(
                           exact, transmittances(fewer, in_their_order(fewer), rays, threads)));
        }
        if (error > most_error) continue;
        fewer.cloud_density = particles.cloud_density;
        fewer.error = exact::hypot(particles.error, error);
        fewer.variant = keyed(particles.variant, std::bit_cast<std::uint64_t>(scales.least[0]));
        fewer.whole = std::make_shared<const ParticleSet>(std::move(particles));
        return fewer;
    }
    return particles;
}

}  // namespace awan
