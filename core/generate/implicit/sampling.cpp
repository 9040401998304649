#include "core/generate/implicit/sampling.h"

#include <algorithm>
#include <atomic>
#include <cmath>

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

// Sums along an axis. `group` cells of a side of the lattice become one.
std::vector<double> columns(const LatticeField& lattice, int axis, int group) {
    const int n[3] = {lattice.nx, lattice.ny, lattice.nz};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto side = [&](int a) { return (n[a] + group - 1) / group; };
    std::vector<double> sums(static_cast<std::size_t>(side(u)) * static_cast<std::size_t>(side(v)));
    int at[3];
    for (at[2] = 0; at[2] < n[2]; ++at[2])
        for (at[1] = 0; at[1] < n[1]; ++at[1])
            for (at[0] = 0; at[0] < n[0]; ++at[0])
                sums[static_cast<std::size_t>(at[v] / group) * static_cast<std::size_t>(side(u)) +
                     static_cast<std::size_t>(at[u] / group)] +=
                    static_cast<double>(lattice.values[lattice.index(at[0], at[1], at[2])]);
    return sums;
}

}  // namespace

LatticeField lattice_over(const ImplicitField& field, std::uint64_t resolution) {
    LatticeField lattice;
    const Box box = box_of(field);
    if (box.empty()) return lattice;
    const glm::dvec3 size = box.max - box.min;
    const double longest = std::max({size.x, size.y, size.z});
    lattice.cell = std::clamp(longest / static_cast<double>(resolution),
                              limits::kMinRadius / (2 * kLatticeS) * 1.001,
                              limits::kMaxRadius / (2 * kLatticeS) * 0.999);
    const auto cells = [&](double length) {
        // A longest side of exactly so many cells must not become one more by rounding.
        const double count = std::ceil(length / lattice.cell - 1e-6);
        return static_cast<int>(std::clamp(count, 1.0, static_cast<double>(resolution)));
    };
    lattice.nx = cells(size.x), lattice.ny = cells(size.y), lattice.nz = cells(size.z);
    lattice.origin =
        (box.min + box.max) / 2.0 -
        lattice.cell * 0.5 * glm::dvec3(lattice.nx - 1, lattice.ny - 1, lattice.nz - 1);
    return lattice;
}

LatticeField coarser(const LatticeField& lattice) {
    LatticeField half;
    half.cell = 2 * lattice.cell;
    half.origin = lattice.origin + 0.5 * lattice.cell;
    half.nx = (lattice.nx + 1) / 2, half.ny = (lattice.ny + 1) / 2, half.nz = (lattice.nz + 1) / 2;
    return half;
}

Status sample(const ImplicitField& field, int threads, const Deadline& deadline,
              LatticeField& lattice) {
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
            sample_block(field, first, lattice);
        });
    return deadline.over();
}

double picture_difference(const LatticeField& fine, const LatticeField& coarse, int group) {
    const double cells = static_cast<double>(group) * group * group;
    double thin = 0, all_thin = 0, deep = 0, all_deep = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<double> a = columns(fine, axis, group), b = columns(coarse, axis, 1);
        const double most = *std::max_element(a.begin(), a.end());
        if (!(most > 0)) continue;
        // By the library's exponential: the error is a figure for people, so its last bit does not matter.
        const auto opacity = [&](double sum) { return 1 - std::exp(-kOpaque * sum / most); };
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double other = cells * b[i], d = a[i] - other;
            const double o = opacity(a[i]), e = o - opacity(other);
            thin += d * d, all_thin += a[i] * a[i];
            deep += e * e, all_deep += o * o;
        }
    }
    if (!(all_thin > 0)) return 0;
    return std::sqrt(std::max(thin / all_thin, deep / all_deep));
}

// What a lattice is wrong by is about its difference from one twice as coarse, times kOfDifference, and, where both
// lack the octaves that make the shape, kOfLeftOut of what these would change. The two are chosen so that no preset
// is wrong by more, neither in fields against lattices four times as fine nor in lit pictures (64 cells against 160).
double sampling_error(const LatticeField& lattice, const LatticeField& half,
                      const ImplicitField& field) {
    constexpr double kOfDifference = 0.8, kOfLeftOut = 0.8;
    const double difference = picture_difference(lattice, half, 2);
    if (!(difference > 0)) return 0;
    // The density is (blend + (1 - blend) t)^exponent; this is what it varies by, with what t lacks.
    const Octaves& octaves = field.octaves;
    double mean = static_cast<double>(octaves.rest);
    for (int o = 0; o < octaves.count; ++o)
        mean += static_cast<double>(kMeanAbsNoise * octaves.weight[static_cast<std::size_t>(o)]);
    const double turbulent = 1 - static_cast<double>(field.blend);
    const double left_out = static_cast<double>(field.exponent) * turbulent *
                            static_cast<double>(octaves.rest_rms) /
                            (static_cast<double>(field.blend) + turbulent * mean);
    return std::hypot(kOfDifference * difference, kOfLeftOut * left_out);
}

}  // namespace awan::implicit
