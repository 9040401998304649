#include "core/light/sun_columns.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/plan/transport_settings.h"
#include "core/survey/lattice.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// Optical depth of matter that the lattice may leave outside.
constexpr double kLeftOut = 0.01;
// Matter is flat where it changes along one axis over less than this share of the length of the other two.
constexpr double kFlat = 0.5;
// The least height of a layer to a column's width.
constexpr double kThinnest = 1.0 / 32;
// The least cosine between the light and the short axis: below it columns would lean over more than three times the
// cloud's thickness.
constexpr double kLeastCosine = 0.15;
// Layers at most, to the count of cells that was asked for.
constexpr int kMostLayers = 3;

// The axis along which the matter is the shortest, and the other two.
struct Axes {
    int thin, b, c;
};
Axes axes_of(const glm::dvec3& length) {
    const int thin =
        length.x <= length.y ? (length.x <= length.z ? 0 : 2) : (length.y <= length.z ? 1 : 2);
    return {thin, (thin + 1) % 3, (thin + 2) % 3};
}

glm::dvec3 unit(int axis) {
    glm::dvec3 made(0);
    made[axis] = 1;
    return made;
}

// Nodes that the lattice of sun_lattice would have.
double nodes_facing(const MatterBox& box, const glm::dvec3& w, int cells) {
    const SideAxes side = side_axes(w);
    const auto along = [&](const glm::dvec3& axis) { return glm::dot(glm::abs(axis), box.size); };
    const glm::dvec3 size(along(side.u), along(side.v), along(w));
    const double cell = longest(size) / spread_count(size, cells, kMostSunSpread);
    return std::ceil(size.x / cell) * std::ceil(size.y / cell) * (std::ceil(size.z / cell) + 1);
}

// Flat matter's layers and columns, counted along (b, c, the light).
struct Columns {
    Lattice upright;     // its w is the short axis, the way the light goes
    glm::dvec2 lean{0};  // columns that the light moves along u and v from layer to layer
    glm::ivec2 before{
        0};  // columns beside the upright lattice, on the side that the light comes from
    glm::ivec2 count{0};  // columns in all
};

Columns columns_of(const MatterBox& box, const Axes& axes, const glm::dvec3& w, double nodes,
                   int most_layers) {
    const double down = std::abs(w[axes.thin]), thick = box.size[axes.thin];
    const glm::dvec2 slope = glm::dvec2(w[axes.b], w[axes.c]) / down;
    const glm::dvec2 size(box.size[axes.b], box.size[axes.c]), lean = slope * thick;
    const glm::dvec2 whole = size + glm::abs(lean);
    const double thin = std::max(
        kThinnest, box.length[axes.thin] / std::max(box.length[axes.b], box.length[axes.c]));
    const double width = exact::cbrt(whole.x * whole.y * thick / (thin * nodes));
    const int layers =
        std::clamp(static_cast<int>(std::ceil(thick / (thin * width))), 2, most_layers);
    const double side =
        std::max(std::sqrt(whole.x * whole.y * layers / nodes), 1e-6 * longest(box.size));
    Columns made;
    Lattice& upright = made.upright;
    upright.u = unit(axes.b);
    upright.v = unit(axes.c);
    upright.w = (w[axes.thin] > 0 ? 1.0 : -1.0) * unit(axes.thin);
    upright.cells = {std::max(1, static_cast<int>(std::ceil(size.x / side))),
                     std::max(1, static_cast<int>(std::ceil(size.y / side))), layers};
    upright.cell = glm::dvec3(size / glm::dvec2(upright.cells), thick / layers);
    upright.origin = box.corner;
    if (w[axes.thin] < 0) upright.origin += thick * unit(axes.thin);
    const glm::dvec2 moved = lean / glm::dvec2(upright.cell);
    made.lean = moved / static_cast<double>(layers);
    made.before = glm::ivec2(glm::ceil(glm::max(moved, glm::dvec2(0))));
    made.count = glm::ivec2(upright.cells) + glm::ivec2(glm::ceil(glm::abs(moved)));
    return made;
}

// Weights of the four points around a place between the middle two, 0..1: the cubic through them (Lagrange).
struct Cubic {
    float weight[4];
    explicit Cubic(double t)
        : weight{static_cast<float>(-t * (t - 1) * (t - 2) / 6),
                 static_cast<float>((t + 1) * (t - 1) * (t - 2) / 2),
                 static_cast<float>(-(t + 1) * t * (t - 2) / 2),
                 static_cast<float>((t + 1) * t * (t - 1) / 6)} {}
};

// A row or column of cells as the leaning columns have it: column i is at `from + i` cells, beyond the ends there is
// nothing. stride: between the cells.
void moved_line(const float* line, int count, std::size_t stride, double from, int columns,
                float* to) {
    const int whole = static_cast<int>(std::floor(from));
    const Cubic cubic(from - whole);
    for (int i = 0; i < columns; ++i) {
        float sum = 0;
        for (int n = 0; n < 4; ++n) {
            const int at = i + whole + n - 1;
            if (at >= 0 && at < count)
                sum += cubic.weight[n] * line[static_cast<std::size_t>(at) * stride];
        }
        to[static_cast<std::size_t>(i) * stride] = sum;
    }
}

// Moves layer k of the upright cells into the leaning columns; `to` has count.x * count.y cells.
void moved_layer(const Columns& columns, int k, const float* cells, float* to) {
    const glm::ivec3 n = columns.upright.cells;
    const glm::ivec2 count = columns.count;
    const glm::dvec2 from = (k + 0.5) * columns.lean - glm::dvec2(columns.before);
    const auto nx = static_cast<std::size_t>(n.x), across = static_cast<std::size_t>(count.x);
    std::vector<float> rows(across * static_cast<std::size_t>(n.y));
    for (int j = 0; j < n.y; ++j)
        moved_line(cells + static_cast<std::size_t>(j) * nx, n.x, 1, from.x, count.x,
                   rows.data() + static_cast<std::size_t>(j) * across);
    for (std::size_t i = 0; i < across; ++i)
        moved_line(rows.data() + i, n.y, across, from.y, count.y, to + i);
}

// Whether the particles' extent alone says that they do not lie flat.
bool surely_bulky(const ParticleSet& particles) {
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto reach = static_cast<double>(particles.radius[i]);
        low = glm::min(low, particles.center[i] - reach);
        high = glm::max(high, particles.center[i] + reach);
    }
    return shortest(high - low) > 0.6 * longest(high - low);
}

}  // namespace

std::optional<SunDepth> leaning_sun_depth(const ParticleSet& particles,
                                          const glm::dvec3& towards_sun, int cells, int threads) {
    if (particles.detail || surely_bulky(particles)) return std::nullopt;
    const MatterBox box =
        box_around_matter(particles, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kLeftOut, threads);
    const Axes axes = axes_of(box.length);
    const glm::dvec3 w = -towards_sun;
    if (box.length[axes.thin] > kFlat * std::min(box.length[axes.b], box.length[axes.c]) ||
        std::abs(w[axes.thin]) < kLeastCosine)
        return std::nullopt;
    double nodes = nodes_facing(box, w, cells);
    Columns columns = columns_of(box, axes, w, nodes, kMostLayers * cells);
    for (int i = 0; i < 8 && lattice_work(particles, columns.upright.cell, columns.upright.cells) >
                                 kMaxSunWork;
         ++i) {
        nodes *= 0.5;
        columns = columns_of(box, axes, w, nodes, kMostLayers * cells);
    }
    const Lattice& upright = columns.upright;
    const int layers = upright.cells.z;
    const std::vector<float> extinction = extinction_in(particles, upright, threads);
    const std::size_t from =
        static_cast<std::size_t>(upright.cells.x) * static_cast<std::size_t>(upright.cells.y);
    const std::size_t layer =
        static_cast<std::size_t>(columns.count.x) * static_cast<std::size_t>(columns.count.y);
    SunDepth sun;
    sun.u = upright.u;
    sun.v = upright.v;
    sun.w = w;
    const double down = std::abs(w[axes.thin]);
    sun.cell = {upright.cell.x, upright.cell.y, upright.cell.z / down};
    sun.nodes = {columns.count.x, columns.count.y, layers + 1};
    sun.origin = upright.at(glm::dvec3(0.5 - glm::dvec2(columns.before), 0));
    sun.depth.resize(layer * static_cast<std::size_t>(sun.nodes.z));
    parallel_for(threads, static_cast<std::size_t>(layers), [&](std::size_t k) {
        moved_layer(columns, static_cast<int>(k), extinction.data() + k * from,
                    sun.depth.data() + (k + 1) * layer);
    });
    const auto side = static_cast<float>(sun.cell.z);
    for (std::size_t i = 0; i < layer * static_cast<std::size_t>(layers); ++i)
        sun.depth[layer + i] = sun.depth[i] + std::max(sun.depth[layer + i], 0.F) * side;
    settle_nodes(sun, threads);
    return sun;
}

}  // namespace awan
