#include "core/survey/clumps.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <vector>

#include "core/base/exact_math.h"
#include "core/base/float_lanes.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/survey/lattice.h"

namespace awan {
namespace {

using simd::Floats;
using simd::kLanes;

constexpr std::size_t kPairs = std::size_t{1} << 17, kFewest = 8, kMost = 64;

// The variance along an axis of what a cell of side 1 does to matter: its own, and that of interpolating between cells.
constexpr double kCellVariance = 1.0 / 12 + 1.0 / 6;

// The particles for sixteen at a time, relative to a corner of theirs.
struct Gaussians {
    std::vector<Floats> x, y, z, s2, density;

    Gaussians(const ParticleSet& particles, const glm::dvec3& origin) {
        const std::size_t rows = (particles.size() + kLanes - 1) / kLanes;
        for (auto* column : {&x, &y, &z, &density}) column->resize(rows);
        // Those that are not there have no density, and some width.
        s2.assign(rows, simd::all(1.0f));
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const std::size_t row = i / kLanes;
            const auto lane = static_cast<int>(i % kLanes);
            const glm::vec3 at(particles.center[i] - origin);
            const auto s = static_cast<float>(gaussian_s(particles, i));
            x[row][lane] = at.x;
            y[row][lane] = at.y;
            z[row][lane] = at.z;
            s2[row][lane] = s * s;
            density[row][lane] = particles.density[i];
        }
    }
};

float sum_of(const Floats& lanes) {
    float sum = 0;
    for (int lane = 0; lane < kLanes; ++lane) sum += lanes[lane];
    return sum;
}

// exp(-x) for x >= 0 within a hundredth of 1: estimates want no more.
Floats falling(const Floats& x) {
    const Floats base = 1.0f / (1.0f + x * (1.0f / 16));
    const Floats to2 = base * base, to4 = to2 * to2, to8 = to4 * to4;
    return to8 * to8;
}

// Extinction at a point, as it is and as means over cells whose variances are `more`.
struct Seen {
    float as_it_is = 0;
    std::array<float, Clumps::kGrids> by_cells{};
};
Seen seen_at(const Gaussians& all, const glm::vec3& point,
             const std::array<float, Clumps::kGrids>& more) {
    Floats as_it_is{};
    std::array<Floats, Clumps::kGrids> by_cells{};
    for (std::size_t row = 0; row < all.x.size(); ++row) {
        const Floats dx = all.x[row] - point.x, dy = all.y[row] - point.y,
                     dz = all.z[row] - point.z;
        const Floats half = 0.5f * (dx * dx + dy * dy + dz * dz);
        as_it_is += all.density[row] * falling(half / all.s2[row]);
        for (std::size_t g = 0; g < more.size(); ++g) {
            const Floats wider = 1.0f / (all.s2[row] + more[g]);
            const Floats share = all.s2[row] * wider;
            by_cells[g] += all.density[row] * share * simd::sqrt(share) * falling(half * wider);
        }
    }
    Seen seen{sum_of(as_it_is), {}};
    for (std::size_t g = 0; g < more.size(); ++g) seen.by_cells[g] = sum_of(by_cells[g]);
    return seen;
}

double hidden_of(double depth) {
    return depth > 1e-6 ? 1 + exact::expm1(-depth) / depth : depth / 2;
}

}  // namespace

double Clumps::at(double cells) const {
    const double place =
        std::clamp(exact::log2(cells / kFewestCells), 0.0, static_cast<double>(kGrids - 1));
    const std::size_t low = std::min(static_cast<std::size_t>(place), kGrids - 2);
    const double part = place - static_cast<double>(low);
    return (1 - part) * hidden[low] + part * hidden[low + 1];
}

Clumps find_clumps(const ParticleSet& particles, const Islands& islands, int threads) {
    const std::size_t count = particles.size();
    const std::size_t looked_at = std::min(std::clamp(kPairs / count, kFewest, kMost), count);
    const Bounds bounds = bounds_of(particles);
    const Gaussians all(particles, bounds.min);
    struct Sample {
        double mass = 0;
        std::array<double, Clumps::kGrids> hidden{};
    };
    std::vector<Sample> samples(looked_at);
    parallel_for(threads, looked_at, [&](std::size_t k) {
        const std::size_t i = (2 * k + 1) * count / (2 * looked_at);
        glm::dvec3 size = bounds.max - bounds.min;
        if (!islands.nodes.empty()) {
            const Island& island =
                islands.list[static_cast<std::size_t>(island_at(islands, particles.center[i]))];
            size = island.high - island.low;
        }
        const double side = longest(size) / Clumps::kFewestCells;
        std::array<float, Clumps::kGrids> more{};
        for (std::size_t g = 0; g < more.size(); ++g) {
            const double cell = side / static_cast<double>(1u << g);
            more[g] = static_cast<float>(kCellVariance * cell * cell);
        }
        const Seen seen = seen_at(all, glm::vec3(particles.center[i] - bounds.min), more);
        const auto here = static_cast<double>(seen.as_it_is);
        Sample& sample = samples[k];
        sample.mass = gaussian_mass(particles, i);
        if (!(here > 0)) return;
        const double line = gaussian_s(particles, i) * std::sqrt(2 * std::numbers::pi);
        for (std::size_t g = 0; g < more.size(); ++g) {
            const double clump = std::max(here - static_cast<double>(seen.by_cells[g]), 0.0);
            sample.hidden[g] = clump / here * hidden_of(clump * line);
        }
    });
    Clumps clumps;
    double mass = 0;
    for (const Sample& sample : samples) mass += sample.mass;
    if (!(mass > 0)) return clumps;
    for (const Sample& sample : samples)
        for (std::size_t g = 0; g < Clumps::kGrids; ++g)
            clumps.hidden[g] += sample.mass / mass * sample.hidden[g];
    return clumps;
}

}  // namespace awan
