#include "core/generate/automaton/cells_to_particles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/parallel.h"
#include "core/generate/automaton/density_planes.h"
#include "core/generate/automaton/metaball.h"
#include "core/scene/automaton.h"

namespace awan::automaton {
namespace {

// Mass, first and second moments of the matter in one block, in cells from the corner of the grid.
struct Moments {
    double mass = 0, square = 0;
    glm::dvec3 first{0};
};

struct Piece {
    std::vector<glm::dvec3> positions;
    std::vector<float> radii, densities;
};

struct Making {
    const AutomatonCloud& cloud;
    const AutomatonGrid grid;
    // The variance of a single cell's Gaussian, cells^2.
    double variance;

    // Adds a block's Gaussian. Wider ones, of s = .5 or .6 of a side, as a smooth lattice would ask for, make a
    // picture's error two to four times as large.
    void add(const Moments& block, Piece& piece) const {
        const glm::dvec3 middle = block.first / block.mass;
        const double within = std::max(block.square / block.mass - glm::dot(middle, middle), 0.0);
        const double s = std::sqrt(variance + within / 3);
        const glm::dvec3 corner(cloud.cells.x / 2, 0, cloud.cells.z / 2);
        piece.positions.push_back(cloud.cell * (middle - corner));
        piece.radii.push_back(static_cast<float>(cloud.cell * 2 * s));
        const double root = std::sqrt(2 * std::numbers::pi) * s;
        piece.densities.push_back(static_cast<float>(block.mass / (root * root * root)));
    }
};

// Planes first .. last - 1, which are whole blocks.
void make_piece(const Making& making, const CellDensity& density, std::size_t block,
                std::size_t first, std::size_t last, Piece& piece) {
    const AutomatonGrid& grid = making.grid;
    DensityPlanes densities(making.cloud, grid, density);
    const std::size_t wide = (grid.nx + block - 1) / block, high = (grid.ny + block - 1) / block;
    std::vector<Moments> blocks;
    for (std::size_t k = first; k < last; ++k) {
        if (k % block == 0) blocks.assign(wide * high, {});
        densities.go_to(k);
        for (std::size_t j = 0; j < grid.ny; ++j) {
            if (densities.row_is_empty(j)) continue;
            for (std::size_t i = 0; i < grid.nx; ++i) {
                const double q = densities(i, j);
                if (!(q > making.cloud.threshold)) continue;
                const glm::dvec3 p(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5,
                                   static_cast<double>(k) + 0.5);
                Moments& into = blocks[j / block * wide + i / block];
                into.mass += q;
                into.first += q * p;
                into.square += q * glm::dot(p, p);
            }
        }
        if ((k + 1) % block != 0 && k + 1 != last) continue;
        for (const Moments& one : blocks)
            if (one.mass > 0) making.add(one, piece);
    }
}

// How far pictures of blocks' Gaussians are from those of the cells', root mean square of the difference over that of
// the picture: the largest that automaton_bench (Blocks) finds of clouds some 20 cells across, which is as fine as
// they get. From 16 on little of such a cloud is left.
double error_of_blocks(std::size_t block) {
    // Of blocks of 1, 2, 4, 8 and 16 cells.
    constexpr std::array<double, 5> kErrors = {0, 0.04, 0.14, 0.32, 0.6};
    const auto doublings = static_cast<std::size_t>(std::countr_zero(block));
    return doublings < kErrors.size() ? kErrors[doublings] : 1;
}

}  // namespace

Result<CellParticles> cells_to_particles(const AutomatonCloud& cloud, const CellDensity& density,
                                         std::uint64_t most, int threads,
                                         const Deadline& deadline) {
    const AutomatonGrid grid(cloud.cells);
    const Making making{cloud, grid,
                        kMetaballVariance * cloud.metaball_radius * cloud.metaball_radius};
    const double work = static_cast<double>(grid.all_words()) * 64 * 2;
    for (std::size_t block = 1;; block *= 2) {
        // Planes of one piece of work: 16 or more, since each begins with smoothing a few planes of its neighbours'.
        const std::size_t planes = (16 + block - 1) / block * block;
        std::vector<Piece> pieces((grid.nz + planes - 1) / planes);
        std::atomic<std::uint64_t> count{0};
        std::atomic<bool> late{false};
        parallel_for(useful_threads(threads, work), pieces.size(), [&](std::size_t n) {
            if (late.load(std::memory_order_relaxed) || deadline.over()) late = true;
            // They are already too many; that does not depend on which pieces were counted first.
            if (late.load(std::memory_order_relaxed) || count > most) return;
            make_piece(making, density, block, n * planes, std::min((n + 1) * planes, grid.nz),
                       pieces[n]);
            count += pieces[n].positions.size();
        });
        if (auto error = deadline.over()) return *error;
        if (count > most) continue;
        CellParticles made;
        made.block = block;
        made.error = error_of_blocks(block);
        made.particles.positions.reserve(count);
        made.particles.radii.reserve(count);
        made.particles.densities.reserve(count);
        for (Piece& piece : pieces) {
            const auto append = [](auto& to, const auto& from) {
                to.insert(to.end(), from.begin(), from.end());
            };
            append(made.particles.positions, piece.positions);
            append(made.particles.radii, piece.radii);
            append(made.particles.densities, piece.densities);
            piece = {};
        }
        return made;
    }
}

}  // namespace awan::automaton
