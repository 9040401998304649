#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "core/base/instruction_sets.h"
#include "core/base/lane_exp.h"
#include "core/base/parallel.h"
#include "core/light/part_matter.h"

namespace awan {
namespace {

using simd::Floats;
using simd::Ints;
using simd::kLanes;

// A row of fine cells along x, and the sun's depth about it.
struct BeamRow {
    const float* extinction;  // of each cell
    float* left;              // what the beam leaves in each
    int count;
    const float* depth;  // SunDepth's; null: there is no matter
    glm::ivec3 nodes;
    glm::vec3 first, step;  // nodes: the middle of the first cell, and from one cell to the next
    float scaled;           // share of the depth that dims light
    float way;              // of the beam through a cell, scene units
    float per_way;          // the cell's side over that
};

// The sun's depth at sixteen places, in nodes, trilinear; outside, the nearest node's.
AWAN_INLINE Floats depth_between(const BeamRow& row, const Floats at[3]) {
    const int stride[3] = {1, row.nodes.x, row.nodes.x * row.nodes.y};
    Ints index = {};
    Floats t[3];
    int next[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int last = row.nodes[axis] - 1;
        const Floats clamped =
            simd::min(simd::max(at[axis], Floats{}), simd::all(static_cast<float>(last)));
        // The lower of two neighbours; the last node has none.
        const Floats below =
            simd::min(clamped, simd::all(static_cast<float>(std::max(last - 1, 0))));
        const Ints low = __builtin_convertvector(below, Ints);
        t[axis] = clamped - __builtin_convertvector(low, Floats);
        index += low * stride[axis];
        next[axis] = last > 0 ? stride[axis] : 0;
    }
    int places[kLanes];
    std::memcpy(places, &index, sizeof places);
    // The corners of the cell between nodes, along u fastest, then v; pairs of them become one, axis by axis.
    Floats corner[8];
    for (int c = 0; c < 8; ++c) {
        const int offset = ((c & 1) != 0 ? next[0] : 0) + ((c & 2) != 0 ? next[1] : 0) +
                           ((c & 4) != 0 ? next[2] : 0);
        float values[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) values[lane] = row.depth[places[lane] + offset];
        std::memcpy(&corner[c], values, sizeof values);
    }
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < 4 >> axis; ++c)
            corner[c] = corner[2 * c] + (corner[2 * c + 1] - corner[2 * c]) * t[axis];
    return corner[0];
}

AWAN_INLINE void leave_in_row_body(const BeamRow& row) {
    const Floats lanes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    for (int from = 0; from < row.count; from += kLanes) {
        const int n = std::min(kLanes, row.count - from);
        float values[kLanes] = {};
        float most = 0;
        for (int i = 0; i < n; ++i) {
            values[i] = row.extinction[from + i];
            most = std::max(most, values[i]);
        }
        if (!(most > 0)) {
            std::fill_n(row.left + from, n, 0.F);
            continue;
        }
        Floats extinction;
        std::memcpy(&extinction, values, sizeof extinction);
        const Floats place = lanes + static_cast<float>(from);
        const Floats at[3] = {row.first.x + place * row.step.x, row.first.y + place * row.step.y,
                              row.first.z + place * row.step.z};
        const Floats depth = row.depth != nullptr ? depth_between(row, at) : Floats{};
        const Floats across = row.scaled * extinction * row.way;
        const Floats entry = simd::max(row.scaled * depth - 0.5F * across, Floats{});
        const Floats left = simd::one_minus(simd::exp(-across), across) * simd::exp(-entry) *
                            (row.per_way / row.scaled);
        std::memcpy(values, &left, sizeof values);
        std::copy_n(values, n, row.left + from);
    }
}
AWAN_KERNEL(void, leave_in_row, (const BeamRow& row), (row))

}  // namespace

// Of a fine cell of depth x along the beam, whose front the beam reaches with the scaled depth e behind it, the beam
// leaves the integral over the cell: exp(-e) (1 - exp(-k x)) / k with k = `scaled`. It is taken along the beam and not
// from the cell's middle, so that a thick cell does not get more light than there is. Through a cubic cell the beam's
// way is taken as its side, through a flat one as the way through its middle.
std::vector<float> beam_source(const PartGrid& grid, const SunDepth& sun, double scaled,
                               int threads, const Deadline& deadline) {
    std::vector<float> source(grid.lattice.size());
    const glm::ivec3 n = grid.fine.cells, cells = grid.lattice.cells;
    const int sub = grid.sub;
    const glm::dvec3 cell = grid.fine.cell, ways = cell / glm::max(glm::abs(sun.w), 1e-12);
    const double side = shortest(cell), way = longest(cell) == side ? side : shortest(ways);
    const bool dimmed = !sun.depth.empty();
    const glm::dmat3 nodes = dimmed ? to_nodes(sun) : glm::dmat3(0);
    const glm::dvec3 origin = nodes * (grid.fine.at(glm::dvec3(0.5)) - sun.origin);
    const glm::dvec3 steps[3] = {nodes * (grid.fine.u * cell.x), nodes * (grid.fine.v * cell.y),
                                 nodes * (grid.fine.w * cell.z)};
    const std::size_t line = static_cast<std::size_t>(n.x),
                      wide = static_cast<std::size_t>(cells.x);
    // A cell's shortest side is `sub` fine ones long: the mean of sub^3 fine cells, sub times as deep.
    const float share = 1 / static_cast<float>(sub * sub);
    parallel_for(threads, static_cast<std::size_t>(cells.z), [&](std::size_t layer) {
        if (deadline.over()) return;
        std::vector<float> left(line);
        for (int z = 0; z < sub; ++z)
            for (int j = 0; j < n.y; ++j) {
                const int k = static_cast<int>(layer) * sub + z;
                const std::size_t row =
                    static_cast<std::size_t>(k) * static_cast<std::size_t>(n.y) +
                    static_cast<std::size_t>(j);
                leave_in_row(
                    {.extinction = grid.fine_extinction.data() + row * line,
                     .left = left.data(),
                     .count = n.x,
                     .depth = dimmed ? sun.depth.data() : nullptr,
                     .nodes = sun.nodes,
                     .first = glm::vec3(origin + double(j) * steps[1] + double(k) * steps[2]),
                     .step = glm::vec3(steps[0]),
                     .scaled = static_cast<float>(scaled),
                     .way = static_cast<float>(way),
                     .per_way = static_cast<float>(side / way)});
                float* to = source.data() + (layer * static_cast<std::size_t>(cells.y) +
                                             static_cast<std::size_t>(j / sub)) *
                                                wide;
                const float* from = left.data();
                for (std::size_t i = 0; i < wide; ++i, ++to)
                    for (int within = 0; within < sub; ++within) *to += share * *from++;
            }
    });
    return source;
}

}  // namespace awan
