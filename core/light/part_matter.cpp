#include "core/light/part_matter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/plan/transport_settings.h"
#include "core/survey/lattice_detail.h"

namespace awan {
namespace {

// Optical depth of matter that the grid may leave outside. Up to here what smaller cells gain is more than what the
// matter outside loses. Of a thin cloud's depth it is no more than a share.
constexpr double kLeftOut = 0.5;
constexpr double kLeftOutShare = 0.02;

// Most work (lattice_work, core/survey/lattice.h) to fill the grid, and the finer one that the beam is taken from.
// A great many particles, each large beside a cell, pass it: what they add up to is smooth, and coarser cells show it.
constexpr double kMaxCoarseWork = 6e8;
constexpr double kMaxFineWork = 3e8;

Lattice above(double floor, Lattice lattice) {
    if (!(lattice.origin.y < floor)) return lattice;
    const double top = lattice.origin.y + lattice.cell.y * lattice.cells.y;
    lattice.origin.y = floor;
    lattice.cells.y = std::max(1, static_cast<int>(std::ceil((top - floor) / lattice.cell.y)));
    return lattice;
}

std::size_t index(const glm::ivec3& cells, int i, int j, int k) {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(cells.y) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(cells.x) +
           static_cast<std::size_t>(i);
}

// Means over blocks of sub^3 cells. `cells`: how many blocks.
std::vector<float> block_means(const std::vector<float>& fine, const glm::ivec3& cells, int sub) {
    std::vector<float> means(fine.size() / static_cast<std::size_t>(sub * sub * sub));
    const glm::ivec3 n = cells * sub;
    const float* from = fine.data();
    for (int k = 0; k < n.z; ++k)
        for (int j = 0; j < n.y; ++j) {
            float* to = means.data() + index(cells, 0, j / sub, k / sub);
            for (int i = 0; i < cells.x; ++i, ++to)
                for (int within = 0; within < sub; ++within) *to += *from++;
        }
    const auto scale = static_cast<float>(1.0 / (sub * sub * sub));
    for (float& mean : means) mean *= scale;
    return means;
}

}  // namespace

PartGrid grid_of_part(const LightPart& part, int cells, double floor, int threads) {
    PartGrid grid;
    const double rest = std::min(kLeftOut, kLeftOutShare * part.deepest);
    const MatterBox box =
        box_around_matter(part.own, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, rest, threads);
    // Lumps of detail are as wide as they are high, however flat the cloud is.
    grid.lattice =
        above(floor, within_work(part.own, box, spread_count(box.size, cells, kMostGridSpread),
                                 kMaxCoarseWork, part.all.detail ? cubic_cells : fitted_cells));
    const Lattice& lattice = grid.lattice;
    grid.sub = fine_cells_a_side(cells);
    const auto fine_cells = [&] {
        return static_cast<double>(lattice.size()) * grid.sub * grid.sub * grid.sub;
    };
    if (part.all.detail && grid.sub > 2 && fine_cells() > kMostFineCells) --grid.sub;
    while (grid.sub > 1 && lattice_work(part.all, lattice.cell / static_cast<double>(grid.sub),
                                        lattice.cells * grid.sub) > kMaxFineWork)
        --grid.sub;
    grid.fine = lattice;
    grid.fine.cell = lattice.cell / static_cast<double>(grid.sub);
    grid.fine.cells = lattice.cells * grid.sub;
    grid.fine_extinction = extinction_in(part.all, grid.fine, threads);
    if (part.all.detail) {
        const auto start = Deadline::Clock::now();
        add_detail(part.all, grid.fine, threads, grid.fine_extinction);
        grid.detail_ms = ms_since(start);
    }
    grid.extinction = block_means(grid.fine_extinction, lattice.cells, grid.sub);
    return grid;
}

std::vector<glm::vec3> colored_albedo(const ParticleSet& particles, const Lattice& lattice,
                                      const std::vector<float>& extinction, double white,
                                      int threads) {
    const auto all = static_cast<float>(white);
    std::vector<glm::vec3> albedo(extinction.size(), glm::vec3(all));
    for (int c = 0; c < 3; ++c) {
        const std::vector<float> tinted = colored_extinction_in(particles, lattice, c, threads);
        for (std::size_t i = 0; i < extinction.size(); ++i)
            if (extinction[i] > 0)
                albedo[i][c] = all * std::clamp(tinted[i] / extinction[i], 0.F, 1.F);
    }
    return albedo;
}

Matter matter_of(const PartGrid& grid, const ScatteringSplit& split,
                 const std::vector<glm::vec3>& albedo, int channel) {
    const double f = split.peak_share, side = shortest(grid.lattice.cell);
    Matter matter;
    matter.grid.cells = grid.lattice.cells;
    matter.grid.sides = glm::vec3(grid.lattice.cell / side);
    matter.grid.harmonics = split.harmonics;
    matter.grid.depth.resize(grid.extinction.size());
    matter.albedo.resize(grid.extinction.size());
    matter.scattered.resize(grid.extinction.size());
    for (std::size_t i = 0; i < grid.extinction.size(); ++i) {
        const double a = albedo.empty() ? split.albedo : static_cast<double>(albedo[i][channel]);
        const double depth = std::min(static_cast<double>(grid.extinction[i]) * side * (1 - a * f),
                                      static_cast<double>(kMaxCellDepth));
        matter.grid.depth[i] = static_cast<float>(depth);
        matter.albedo[i] = static_cast<float>(a);
        matter.scattered[i] = static_cast<float>(depth * a * (1 - f) / (1 - a * f));
    }
    return matter;
}

}  // namespace awan
