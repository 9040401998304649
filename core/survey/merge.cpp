#include "core/survey/merge.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
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
// Lattices of wider classes have, together, about half as many nodes as that of the narrowest.
constexpr double kOfAllClasses = 1.55;
// Share of the mass below which particles may be widened however many nodes there are room for.
constexpr double kLittleMass = 0.01;
// Nodes of a class to those of the next wider one.
constexpr double kFiner = 2.8284271247461903;
// How often narrower classes are tried where merging costs too much.
constexpr int kTries = 4;
// Of the particles, those whose places tell how much space is filled; and cells that are counted among them.
constexpr std::size_t kSampled = 131072, kEnoughCells = 6000;
// Classes above that of the widest particle: where there are too many nodes, all are widened.
constexpr int kWider = 8;
// The error of a picture where no more than kLittleMass is widened (merge_test).
constexpr double kErrorOfNodes = 0.01;
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

// The narrowest class whose lattices come to about kManyNodes.
int class_of_many_nodes(const ParticleSet& particles, const MergeScales& scales, int narrowest) {
    int k = kMergeClasses;
    std::size_t cells = 0;
    while (k > narrowest && cells < kEnoughCells)
        cells = filled_cells(particles, scales.origin, scales.cell(--k));
    // Finer cells than these the sampled particles do not tell from empty ones, but the volume stays.
    for (double nodes = kFiner * kOfAllClasses * static_cast<double>(cells);
         k > narrowest && nodes < kManyNodes; --k)
        nodes *= kFiner;
    return k;
}

}  // namespace

Result<ParticleSet> merged(ParticleSet particles, const glm::dvec3& to_sun, double most_error,
                           int threads, const Deadline& deadline) {
    if (particles.size() < kFewParticles || !particles.color.empty() || !particles.paint.empty())
        return particles;
    float widest = 0;
    for (const float radius : particles.radius) widest = std::max(widest, radius);
    const glm::dvec3 origin = bounds_of(particles).min;
    double least = 0.5 * static_cast<double>(widest);
    for (int k = 0; k < kMergeClasses - 1 - kWider; ++k) least /= 1.4142135623730951;
    const MergeScales all = merge_scales(origin, least);
    const int narrowest = class_of_little_mass(particles, all);
    if (auto error = deadline.over()) return *error;
    int k = class_of_many_nodes(particles, all, narrowest);
    std::vector<MergeRay> rays;
    std::vector<float> exact;
    for (int tried = 0; tried < kTries && k >= narrowest; ++tried, --k) {
        if (auto error = deadline.over()) return *error;
        const MergeScales scales = merge_scales(origin, all.least[static_cast<std::size_t>(k)]);
        const MergeBlocks blocks = merge_blocks(particles, scales, threads);
        if (blocks.size() == 0) break;
        ParticleSet fewer = on_merge_lattices(particles, scales, blocks, threads);
        if (static_cast<double>(fewer.size()) > kLeft * static_cast<double>(particles.size()))
            break;
        double error = kErrorOfNodes;
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
