#include "core/generate/automaton/cells.h"

#include <atomic>
#include <cmath>

#include "core/base/parallel.h"
#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/skies.h"

namespace awan::automaton {
namespace {

// Planes of one piece of work: each begins with smoothing a few planes of its neighbours'.
constexpr std::size_t kPlanes = 16;

void add_cells(const AutomatonCloud& cloud, const Skies& skies, std::size_t first, std::size_t last,
               std::vector<Cell>& cells) {
    const AutomatonGrid grid(cloud.cells);
    DensityPlanes densities(cloud, grid, skies.density());
    for (std::size_t k = first; k < last; ++k) {
        densities.go_to(k);
        for (std::size_t j = 0; j < grid.ny; ++j) {
            // A cell with cloud has density of its own.
            if (densities.row_is_empty(j)) continue;
            const std::uint64_t* const bits = skies.now[0].data() + grid.row(j, k) * grid.words;
            for (std::size_t i = 0; i < grid.nx; ++i) {
                const double q = densities(i, j);
                const bool has_cloud = (bits[i / 64] >> (i % 64) & 1) != 0;
                if (!(q > cloud.threshold) && !has_cloud) continue;
                cells.push_back({static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j),
                                 static_cast<std::uint16_t>(k), has_cloud, static_cast<float>(q)});
            }
        }
    }
}

}  // namespace

Result<std::vector<Cell>> cells_of(const AutomatonCloud& cloud, const ModelRequest& request,
                                   bool hold, const Deadline& deadline) {
    const double steps = automaton_steps_at(cloud, request.time);
    const auto skies =
        skies_at(cloud, request.key, hold ? std::floor(steps) : steps, request.threads, deadline);
    if (!skies.ok()) return skies.error();
    const AutomatonGrid grid(cloud.cells);
    std::vector<std::vector<Cell>> pieces((grid.nz + kPlanes - 1) / kPlanes);
    std::atomic<bool> late{false};
    const double work = static_cast<double>(grid.all_words()) * 64 * 2;
    parallel_for(useful_threads(request.threads, work), pieces.size(), [&](std::size_t n) {
        if (late.load(std::memory_order_relaxed) || deadline.over()) {
            late = true;
            return;
        }
        add_cells(cloud, *skies, n * kPlanes, std::min((n + 1) * kPlanes, grid.nz), pieces[n]);
    });
    if (auto error = deadline.over()) return *error;
    std::vector<Cell> cells;
    for (const auto& piece : pieces) cells.insert(cells.end(), piece.begin(), piece.end());
    return cells;
}

Result<std::vector<AutomatonEllipsoid>> ellipsoids_at(const AutomatonCloud& cloud,
                                                      std::uint64_t key, double time,
                                                      const Deadline& deadline) {
    const std::vector<AutomatonEllipsoid> first = first_ellipsoids(cloud, key);
    std::vector<AutomatonEllipsoid> now = first;
    if (cloud.wind.ellipsoids.empty()) return now;
    const auto steps = static_cast<std::uint64_t>(std::floor(automaton_steps_at(cloud, time)));
    for (std::uint64_t step = 0; step < steps; ++step) {
        if (auto late = deadline.over()) return *late;
        move_ellipsoids(cloud, first, key, step, now);
    }
    return now;
}

}  // namespace awan::automaton
