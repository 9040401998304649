#include "core/survey/lattice_detail.h"

#include "core/base/parallel.h"
#include "core/generate/detail.h"

namespace awan {

void add_detail(const ParticleSet& particles, const Lattice& lattice, int threads,
                std::vector<float>& extinction) {
    if (!particles.detail || longest(lattice.cell) > particles.detail->bump) return;
    const DetailField& field = *particles.detail;
    const auto row = static_cast<std::size_t>(lattice.cells.x);
    parallel_for(threads, extinction.size() / row, [&](std::size_t line) {
        const auto j = static_cast<double>(line % static_cast<std::size_t>(lattice.cells.y));
        const auto k = static_cast<double>(line / static_cast<std::size_t>(lattice.cells.y));
        for (std::size_t i = 0; i < row; ++i) {
            float& one = extinction[line * row + i];
            if (!(one > 0)) continue;
            const glm::dvec3 middle = lattice.at({static_cast<double>(i) + 0.5, j + 0.5, k + 0.5});
            one = detailed(field, one, one < field.edge ? bumps_at(field, middle) : 0.5F);
        }
    });
}

}  // namespace awan
