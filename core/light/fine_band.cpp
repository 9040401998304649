#include "core/light/fine_band.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/generate/detail.h"
#include "core/light/diffusion.h"
#include "core/plan/transport_settings.h"

namespace awan {
namespace {

// Lumps of less scaled depth across one of the grid's cells are seen well enough.
constexpr double kShallow = 0.5;
// Of the residual, relative to the source: the solve begins near its end, and what is left is smooth.
constexpr double kTolerance = 0.1;
constexpr int kMaxSweeps = 10;
// Along the longest side of SunDepth, that detail may ask for: 28 MB.
constexpr int kMostSunCells = 192;
// Of the preconditioner's own solve.
constexpr double kSpreadTolerance = 0.05;

// The eight cells of the grid around the middle of a fine cell, along one axis: the lower of two, and how far it is
// from it to the next (0..1).
struct Between {
    int low, high;
    float part;
};
std::vector<Between> between_cells(int cells, int sub) {
    std::vector<Between> all(static_cast<std::size_t>(cells) * static_cast<std::size_t>(sub));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double at = std::clamp((static_cast<double>(i) + 0.5) / sub - 0.5, 0.0, cells - 1.0);
        const int low = std::min(static_cast<int>(at), std::max(cells - 2, 0));
        all[i] = {low, std::min(low + 1, cells - 1), static_cast<float>(at - low)};
    }
    return all;
}

// Trilinear from the grid's cells to the fine ones.
class Finer {
  public:
    Finer(const glm::ivec3& cells, int sub) : cells_(cells) {
        for (int axis = 0; axis < 3; ++axis)
            along_[static_cast<std::size_t>(axis)] = between_cells(cells[axis], sub);
    }
    // value(i): of a cell of the grid; put(i, v): takes that of a fine one.
    template <typename Value, typename Put>
    void each(int threads, const Value& value, const Put& put) const {
        const std::vector<Between>&x = along_[0], &y = along_[1], &z = along_[2];
        parallel_for(threads, z.size(), [&](std::size_t k) {
            for (std::size_t j = 0; j < y.size(); ++j) {
                const auto row = [&](int ys, int zs) {
                    return (static_cast<std::size_t>(zs) * static_cast<std::size_t>(cells_.y) +
                            static_cast<std::size_t>(ys)) *
                           static_cast<std::size_t>(cells_.x);
                };
                const std::size_t rows[4] = {row(y[j].low, z[k].low), row(y[j].high, z[k].low),
                                             row(y[j].low, z[k].high), row(y[j].high, z[k].high)};
                for (std::size_t i = 0; i < x.size(); ++i) {
                    const auto at = [&](int line) {
                        const auto low = value(rows[line] + static_cast<std::size_t>(x[i].low));
                        return low +
                               (value(rows[line] + static_cast<std::size_t>(x[i].high)) - low) *
                                   x[i].part;
                    };
                    const auto near = at(0) + (at(1) - at(0)) * y[j].part;
                    const auto far = at(2) + (at(3) - at(2)) * y[j].part;
                    put((k * y.size() + j) * x.size() + i, near + (far - near) * z[k].part);
                }
            }
        });
    }

  private:
    glm::ivec3 cells_;
    std::array<std::vector<Between>, 3> along_;
};

using Moments = std::array<float, kHarmonics>;

// Empty cells get the mean of the cells around them that are not, since the eye interpolates between all: at the edges
// of lumps it sees the lumps' light. Those far from all others get `otherwise`.
void fill_empty(const SweepGrid& grid, const std::vector<Moments>& otherwise, int threads,
                std::vector<Moments>& moments) {
    const glm::ivec3 n = grid.cells;
    const auto index = [&](int i, int j, int k) {
        return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n.y) +
                static_cast<std::size_t>(j)) *
                   static_cast<std::size_t>(n.x) +
               static_cast<std::size_t>(i);
    };
    parallel_for(threads, static_cast<std::size_t>(n.z), [&](std::size_t layer) {
        const int k = static_cast<int>(layer);
        for (int j = 0; j < n.y; ++j)
            for (int i = 0; i < n.x; ++i) {
                const std::size_t to = index(i, j, k);
                if (grid.depth[to] > 0) continue;
                Moments sum{};
                int count = 0;
                for (int z = std::max(k - 1, 0); z <= std::min(k + 1, n.z - 1); ++z)
                    for (int y = std::max(j - 1, 0); y <= std::min(j + 1, n.y - 1); ++y)
                        for (int x = std::max(i - 1, 0); x <= std::min(i + 1, n.x - 1); ++x) {
                            const std::size_t from = index(x, y, z);
                            if (!(grid.depth[from] > 0)) continue;
                            ++count;
                            for (std::size_t m = 0; m < kHarmonics; ++m) sum[m] += moments[from][m];
                        }
                if (count == 0) {
                    moments[to] = otherwise[to];
                    continue;
                }
                for (std::size_t m = 0; m < kHarmonics; ++m)
                    moments[to][m] = sum[m] / static_cast<float>(count);
            }
    });
}

std::vector<Moments> finer_moments(const Finer& finer, const LightBand& band, std::size_t count,
                                   int threads) {
    std::vector<Moments> fine(count);
    for (std::size_t m = 0; m < kHarmonics; ++m)
        finer.each(
            threads, [&](std::size_t i) { return band.moments[i][m]; },
            [&](std::size_t i, float value) { fine[i][m] = value; });
    return fine;
}

// The fine cells as a grid of their own.
PartGrid grid_of_fine(const PartGrid& grid) {
    PartGrid fine;
    fine.lattice = fine.fine = grid.fine;
    fine.extinction = fine.fine_extinction = grid.fine_extinction;
    return fine;
}

// The cell of the grid that each of the fine ones is in.
template <typename Put>
void each_fine_cell(const glm::ivec3& cells, int sub, const Put& put) {
    const glm::ivec3 n = cells * sub;
    std::size_t fine = 0;
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j) {
            const std::size_t row =
                (static_cast<std::size_t>(k / sub) * static_cast<std::size_t>(cells.y) +
                 static_cast<std::size_t>(j / sub)) *
                static_cast<std::size_t>(cells.x);
            for (int i = 0; i < n.x; ++i, ++fine)
                put(fine, row + static_cast<std::size_t>(i / sub));
        }
}

}  // namespace

bool needs_fine_light(const DetailField* detail, const PartGrid& grid, double scaled) {
    return detail != nullptr && grid.sub > 1 && grid.fine.size() <= kMostFineCells &&
           longest(grid.fine.cell) <= detail->bump &&
           static_cast<double>(detail->edge) * longest(grid.lattice.cell) * scaled > kShallow;
}

FineLight fine_light_on(const PartGrid& grid) {
    FineLight light;
    light.origin = grid.fine.origin;
    light.cell = grid.fine.cell;
    light.cells = grid.fine.cells;
    return light;
}

Result<SolvedBand> fine_band(const BandProblem& problem, const LightBand& coarse,
                             const PartGrid& grid, const SunDepth& sun,
                             const std::vector<glm::vec3>& albedo, int channel,
                             const Ordinates& ordinates, int threads, const Deadline& deadline) {
    const Matter& whole = problem.matter;
    const glm::ivec3 cells = whole.grid.cells;
    const int sub = grid.sub;
    const PartGrid fine = grid_of_fine(grid);
    std::vector<glm::vec3> fine_albedo(albedo.empty() ? 0 : fine.extinction.size());
    if (!albedo.empty())
        each_fine_cell(cells, sub,
                       [&](std::size_t i, std::size_t in) { fine_albedo[i] = albedo[in]; });
    Matter matter = matter_of(fine, problem.split, fine_albedo, channel);
    matter.grid.skip_empty = true;
    const std::vector<float> beam =
        beam_source(fine, sun, problem.split.scaled(), threads, deadline);
    if (Status failed = deadline.over()) return *failed;

    const Finer finer(cells, sub);
    BandProblem inner{matter, problem.split};
    inner.beam = &beam;
    inner.beam_direction = problem.beam_direction;
    inner.inflow = problem.inflow;
    const std::vector<Moments> guess = finer_moments(finer, coarse, matter.grid.size(), threads);
    inner.guess = guess;
    // They have no radiance of their own in this solve.
    for (std::size_t i = 0; i < guess.size(); ++i)
        if (matter.grid.depth[i] == 0) inner.guess[i] = {};
    inner.tolerance = kTolerance;
    inner.max_sweeps = kMaxSweeps;
    // Light that fine cells of side h scatter, q = (emission a volume) h, is `sub` times the mean q to a cell of side
    // sub h.
    const Diffusion diffusion = make_diffusion(cells, whole.grid.sides, whole.grid.depth,
                                               whole.scattered, problem.split.moment[1]);
    std::vector<float> gathered(whole.grid.size()), spread(whole.grid.size());
    inner.spread = [&](std::span<const float> unsettled, std::span<float> addition) {
        std::fill(gathered.begin(), gathered.end(), 0.F);
        const auto share = 1 / static_cast<float>(sub * sub);
        each_fine_cell(cells, sub, [&](std::size_t i, std::size_t in) {
            gathered[in] += share * unsettled[i];
        });
        solve_diffusion(diffusion, gathered, kSpreadTolerance, spread);
        finer.each(
            threads, [&](std::size_t i) { return spread[i]; },
            [&](std::size_t i, float value) { addition[i] = value; });
    };
    auto solved = solve_band(inner, ordinates, threads, deadline);
    if (solved.ok()) fill_empty(matter.grid, guess, threads, solved->band.moments);
    return solved;
}

int sun_cells_in(const DetailField* detail, int cells) {
    return detail != nullptr ? std::max(cells, std::min(2 * cells, kMostSunCells)) : cells;
}

}  // namespace awan
