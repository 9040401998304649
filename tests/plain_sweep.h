// The sweep of core/light/sweep.h as it is defined, without a thought of time: what the fast one is held against.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "core/light/sweep.h"

namespace awan::test {

// A grid with flat cells, thin, thick and empty ones, that emit unevenly.
struct Uneven {
    SweepGrid grid;
    std::vector<float> source, scale, even;
};
inline Uneven uneven(const glm::ivec3& cells, int harmonics) {
    Uneven made;
    made.grid.cells = cells;
    made.grid.harmonics = harmonics;
    made.grid.sides = {1.5F, 1, 2.25F};
    const auto size = static_cast<std::size_t>(cells.x * cells.y * cells.z);
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t kind = i * 2654435761u >> 7;
        made.grid.depth.push_back(kind % 4 == 0 ? 0.F : 0.01F * static_cast<float>(kind % 900));
        const bool emits = made.grid.depth.back() > 0;
        made.scale.push_back(emits ? 0.5F + 0.1F * static_cast<float>(kind % 7) : 0.F);
        made.even.push_back(emits ? 0.2F * static_cast<float>(kind % 5) : 0.F);
        for (int m = 0; m < harmonics; ++m)
            made.source.push_back((m == 0 ? 2.F : 0.3F) * std::sin(static_cast<float>(kind % 1000) +
                                                                   static_cast<float>(m)));
    }
    return made;
}

// One direction after the other, cell by cell, in double: what sweep.h says, written down as it stands.
inline std::vector<double> plain_sweep(const Uneven& scene, const SweepSource& source,
                                       const Ordinates& ordinates, const Inflow& inflow) {
    const SweepGrid& grid = scene.grid;
    const glm::ivec3 n = grid.cells;
    const auto count = static_cast<std::size_t>(grid.harmonics);
    std::vector<double> moments(grid.size() * count);
    for (const Ordinates::Octant& octant : ordinates.octants)
        for (std::size_t d = 0; d < kDirections; ++d) {
            const double in = inflow(octant.direction[d]);
            const glm::dvec3 c = glm::abs(octant.direction[d]) / glm::dvec3(grid.sides);
            std::vector<double> along_y(static_cast<std::size_t>(n.x), in),
                along_z(static_cast<std::size_t>(n.x * n.y), in);
            for (int kk = 0; kk < n.z; ++kk) {
                const int k = octant.sign.z > 0 ? kk : n.z - 1 - kk;
                std::fill(along_y.begin(), along_y.end(), in);
                for (int jj = 0; jj < n.y; ++jj) {
                    const int j = octant.sign.y > 0 ? jj : n.y - 1 - jj;
                    double along_x = in;
                    for (int ii = 0; ii < n.x; ++ii) {
                        const int i = octant.sign.x > 0 ? ii : n.x - 1 - ii;
                        const auto cell = static_cast<std::size_t>((k * n.y + j) * n.x + i);
                        const double s = static_cast<double>(grid.depth[cell]);
                        double q =
                            static_cast<double>(source.even.empty() ? 0 : source.even[cell]) *
                            static_cast<double>(octant.value[0][d]);
                        const double scale =
                            source.scale.empty() ? 1 : static_cast<double>(source.scale[cell]);
                        for (std::size_t m = 0; m < count; ++m)
                            q += scale * static_cast<double>(source.weight[m]) *
                                 static_cast<double>(source.moments[cell * count + m]) *
                                 static_cast<double>(octant.value[m][d]);
                        double* const into[3] = {&along_x, &along_y[static_cast<std::size_t>(i)],
                                                 &along_z[static_cast<std::size_t>(j * n.x + i)]};
                        double above = q, below = s, per_theta[3];
                        for (int axis = 0; axis < 3; ++axis) {
                            per_theta[axis] = (6 * c[axis] + s) / (3 * c[axis] + s);
                            above += c[axis] * per_theta[axis] * *into[axis];
                            below += c[axis] * per_theta[axis];
                        }
                        const double psi = above / below;
                        for (int axis = 0; axis < 3; ++axis)
                            *into[axis] += (psi - *into[axis]) * per_theta[axis];
                        if (grid.skip_empty && grid.depth[cell] == 0) continue;
                        for (std::size_t m = 0; m < count; ++m)
                            moments[cell * count + m] +=
                                psi * static_cast<double>(octant.weighted[d][m]);
                    }
                }
            }
        }
    return moments;
}

}  // namespace awan::test
