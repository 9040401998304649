#include "core/generate/implicit/sampling.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>

#include "core/base/parallel.h"
#include "core/scene/limits.h"

namespace awan::implicit {
namespace {

// Cells of a piece of work: near enough to each other to share their elements.
constexpr int kBlock[3] = {32, 8, 8};

int blocks_along(int cells, int axis) {
    return (cells + kBlock[axis] - 1) / kBlock[axis];
}

void sample_block(const ImplicitField& field, const int first[3], LatticeField& lattice) {
    const int last[3] = {std::min(first[0] + kBlock[0], lattice.nx),
                         std::min(first[1] + kBlock[1], lattice.ny),
                         std::min(first[2] + kBlock[2], lattice.nz)};
    const auto place = [&](int i, int j, int k) {
        return lattice.origin + lattice.cell * glm::dvec3(i, j, k);
    };
    Box box;
    box.add(place(first[0], first[1], first[2]));
    box.add(place(last[0] - 1, last[1] - 1, last[2] - 1));
    const std::vector<std::uint32_t> near = elements_near(field, box);
    for (int k = first[2]; k < last[2]; ++k)
        for (int j = first[1]; j < last[1]; ++j)
            row_densities(field, near, {place(first[0], j, k), lattice.cell, last[0] - first[0]},
                          &lattice.values[lattice.index(first[0], j, k)]);
}

// Whether there is any density in, or a cell beside, what a block of finer(lattice) covers.
bool any_near(const LatticeField& lattice, const int first[3]) {
    const int n[3] = {lattice.nx, lattice.ny, lattice.nz};
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::max(first[axis] / 2 - 1, 0);
        high[axis] = std::min((first[axis] + kBlock[axis]) / 2 + 1, n[axis]);
    }
    for (int k = low[2]; k < high[2]; ++k)
        for (int j = low[1]; j < high[1]; ++j)
            for (int i = low[0]; i < high[0]; ++i)
                if (lattice.values[lattice.index(i, j, k)] > 0) return true;
    return false;
}

}  // namespace

LatticeField lattice_over(const ImplicitField& field, std::uint64_t resolution) {
    LatticeField lattice;
    const Box box = box_of(field);
    if (box.empty()) return lattice;
    const glm::dvec3 size = box.max - box.min;
    const double longest = std::max({size.x, size.y, size.z});
    const auto counts = [&](double cell) {
        // A longest side of exactly so many cells must not become one more by rounding.
        const glm::dvec3 n = glm::ceil(size / cell - 1e-6);
        return glm::clamp(n, 1.0, static_cast<double>(resolution));
    };
    lattice.cell = longest / static_cast<double>(resolution);
    glm::dvec3 n = counts(lattice.cell);
    while (n.x * n.y * n.z > static_cast<double>(limits::kMaxImplicitCells))
        lattice.cell *= 1.01, n = counts(lattice.cell);
    lattice.cell = std::clamp(lattice.cell, limits::kMinRadius / (2 * kLatticeS) * 1.001,
                              limits::kMaxRadius / (2 * kLatticeS) * 0.999);
    n = counts(lattice.cell);
    lattice.nx = static_cast<int>(n.x), lattice.ny = static_cast<int>(n.y);
    lattice.nz = static_cast<int>(n.z);
    lattice.origin =
        (box.min + box.max) / 2.0 -
        lattice.cell * 0.5 * glm::dvec3(lattice.nx - 1, lattice.ny - 1, lattice.nz - 1);
    return lattice;
}

LatticeField finer(const LatticeField& lattice) {
    LatticeField fine;
    fine.cell = lattice.cell / 2;
    fine.origin = lattice.origin - 0.25 * lattice.cell;
    fine.nx = 2 * lattice.nx, fine.ny = 2 * lattice.ny, fine.nz = 2 * lattice.nz;
    return fine;
}

Status sample(const ImplicitField& field, int threads, const Deadline& deadline,
              LatticeField& lattice, const LatticeField* where) {
    lattice.values.assign(static_cast<std::size_t>(lattice.nx) *
                              static_cast<std::size_t>(lattice.ny) *
                              static_cast<std::size_t>(lattice.nz),
                          0.0f);
    const int bx = blocks_along(lattice.nx, 0), by = blocks_along(lattice.ny, 1),
              bz = blocks_along(lattice.nz, 2);
    std::atomic<bool> late{false};
    parallel_for(
        threads,
        static_cast<std::size_t>(bx) * static_cast<std::size_t>(by) * static_cast<std::size_t>(bz),
        [&](std::size_t i) {
            if (late.load(std::memory_order_relaxed) || deadline.over()) {
                late = true;
                return;
            }
            const int block = static_cast<int>(i);
            const int first[3] = {block % bx * kBlock[0], block / bx % by * kBlock[1],
                                  block / (bx * by) * kBlock[2]};
            if (where == nullptr || any_near(*where, first)) sample_block(field, first, lattice);
        });
    return deadline.over();
}

void take_means(const LatticeField& fine, int threads, LatticeField& lattice) {
    parallel_for(threads, static_cast<std::size_t>(lattice.nz), [&](std::size_t layer) {
        const int k = static_cast<int>(layer);
        for (int j = 0; j < lattice.ny; ++j)
            for (int i = 0; i < lattice.nx; ++i) {
                float sum = 0;
                for (int row = 0; row < 4; ++row) {
                    const std::size_t at = fine.index(2 * i, 2 * j + (row & 1), 2 * k + (row >> 1));
                    sum += fine.values[at] + fine.values[at + 1];
                }
                lattice.values[lattice.index(i, j, k)] = sum / 8;
            }
    });
}

}  // namespace awan::implicit
