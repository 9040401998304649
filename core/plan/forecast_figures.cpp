#include "core/plan/forecast_figures.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/plan/criteria.h"
#include "core/plan/forecast.h"
#include "core/plan/island_settings.h"
#include "core/plan/transport_settings.h"
#include "core/scene/outside.h"
#include "core/survey/lattice.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// What is deeper or coarser than this looks alike: figures beyond what was measured would only run away.
constexpr double kMostDepth = 300, kMostCellDepth = 60;

constexpr double kIslandsShare = 0.4;

double longest_side(const Survey& survey) {
    const glm::dvec3 size = survey.bounds.max - survey.bounds.min;
    return std::max({size.x, size.y, size.z, 1e-12});
}

double mean_s(const Survey& survey) {
    return survey.s_sums[2] > 0 ? survey.s_sums[3] / survey.s_sums[2] : 1;
}

// Of the light that reaches a cloud from all sides.
double sun_share(const Scene& scene) {
    const auto grey = [](const glm::dvec3& c) { return (c.x + c.y + c.z) / 3; };
    const Outside outside = outside_of(scene);
    const SkyDome& dome = outside.sky;
    const double sun = grey(outside.sun) / (4 * std::numbers::pi);
    double sky = grey(0.67 * dome.zenith + 1.33 * dome.horizon) / 2;
    if (dome.physical) {
        const SkyMeans means = means_of(dome, 8);
        sky = grey(means.above + means.below) / 2;
    }
    return sun + sky > 0 ? sun / (sun + sky) : 0;
}

// Cell updates of a lattice with `cells` along its longest side (survey/lattice.h), by the sums over its particles.
double updates(double longest, const std::array<double, 4>& sum, int cells) {
    if (cells == 0) return 0;
    const double h = longest / cells, side = 8 / h;
    const double expanded =
        side * side * side * sum[3] + 3 * side * side * sum[2] + 3 * side * sum[1] + sum[0];
    return std::min(expanded, sum[0] * exact::pow(cells, 3));
}

double updates(const Survey& survey, int cells) {
    return updates(longest_side(survey), survey.s_sums, cells);
}

// Cells of a cubic grid with `count` of them along the longest side.
double cubes_in(const glm::dvec3& size, int count) {
    if (count == 0) return 0;
    const glm::dvec3 share = size / std::max({size.x, size.y, size.z, 1e-12});
    return exact::pow(count, 3) * std::max(share.x, 1.0 / count) * std::max(share.y, 1.0 / count) *
           std::max(share.z, 1.0 / count);
}

// Cells of the solve's grid.
double cells_in(const glm::dvec3& size, int count) {
    return cubes_in(size, spread_count(size, count, kMostGridSpread));
}

// Of an island without its fringe, as Survey::bounds are.
glm::dvec3 island_size(const Island& island) {
    const double fringe = 4 * island.s_sums[1] / std::max(island.s_sums[0], 1.0);
    return glm::max(island.high - island.low - fringe, glm::dvec3(1e-12));
}

// Half the extent along `axis` (unit) of the ellipsoid that fits a box: clouds leave a box's corners empty.
double half_extent(const glm::dvec3& size, const glm::dvec3& axis) {
    return 0.5 * glm::length(size * axis);
}

// Of the box that holds an island, turned to the sun (SunDepth's axes).
struct SunAxes {
    glm::dvec3 u, v, w;
};
SunAxes sun_axes(const Scene& scene) {
    const glm::dvec3 w = -sun_direction(scene->sun);
    const SideAxes side = side_axes(w);
    return {side.u, side.v, w};
}
glm::dvec3 turned_size(const glm::dvec3& size, const SunAxes& axes) {
    return 2.0 * glm::dvec3(half_extent(size, axes.u), half_extent(size, axes.v),
                            half_extent(size, axes.w));
}

// Of the box that holds all islands with matter, turned to the sun.
glm::dvec3 turned_size_of_all(const Islands& islands, const SunAxes& axes) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Island& island : islands.list) {
        if (island.particles == 0) continue;
        const glm::dvec3 middle = 0.5 * (island.low + island.high);
        const glm::dvec3 at(glm::dot(middle, axes.u), glm::dot(middle, axes.v),
                            glm::dot(middle, axes.w));
        const glm::dvec3 half = 0.5 * turned_size(island_size(island), axes);
        low = glm::min(low, at - half);
        high = glm::max(high, at + half);
    }
    return glm::max(high - low, glm::dvec3(1e-12));
}

// Of a SunDepth of a box of this (turned) size: a layer of nodes more than cells.
double nodes_in(const glm::dvec3& size, int asked) {
    if (asked == 0) return 0;
    const int count = spread_count(size, asked, kMostSunSpread);
    const double longest = std::max({size.x, size.y, size.z, 1e-12});
    return cubes_in(size, count) * (1 + longest / (count * std::max(size.z, longest / count)));
}

}  // namespace

int grid_count(const Survey& survey, int cells) {
    return spread_count(survey.bounds.max - survey.bounds.min, cells, kMostGridSpread);
}

IslandWork island_work(const TransportSettings& settings, const Scene& scene,
                       const Survey& survey) {
    if (survey.islands.list.empty()) return {};
    const TransportSettings whole = whole_settings(settings);
    IslandWork work;
    work.cells = cells_in(survey.bounds.max - survey.bounds.min, whole.cells);
    work.largest = work.cells;
    work.updates = updates(survey, whole.sun_cells) + updates(survey, 3 * whole.cells);
    const SunAxes axes = sun_axes(scene);
    work.nodes = nodes_in(turned_size_of_all(survey.islands, axes), whole.sun_cells);
    double area = 0, sum = 0;
    const std::vector<IslandCells> cells = island_cells(settings, survey);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Island& island = survey.islands.list[i];
        if (cells[i].sun_cells == 0) continue;
        const glm::dvec3 size = island_size(island);
        const double longest = std::max({size.x, size.y, size.z});
        const double own = cells_in(size, cells[i].cells);
        work.cells += own;
        work.largest = std::max(work.largest, own);
        work.updates += updates(longest, island.s_sums, cells[i].sun_cells) +
                        updates(longest, island.s_sums, 3 * cells[i].cells);
        work.nodes += nodes_in(turned_size(size, axes), cells[i].sun_cells);
        const double distance =
            glm::length(0.5 * (island.low + island.high) - survey.view.eye) + longest;
        const double seen = longest / distance * (longest / distance);
        if (cells[i].cells > 0) {
            area += seen;
            sum += seen * longest / spread_count(size, cells[i].cells, kMostGridSpread);
        }
    }
    work.cell = area > 0 ? sum / area : 0;
    return work;
}

ErrorFigures error_figures(const Rung& rung, const Scene& scene, const Survey& survey) {
    const double g = asymmetry(scene->medium), f = g > 0 ? g * g * g * g : 0;
    const double depth = std::clamp(survey.optical_depth_eye, 1e-6, 1e6);
    double cell_depth = 0, coarseness = 0;
    if (rung.cells > 0) {
        const double cell = survey.islands.list.empty()
                                ? longest_side(survey) / grid_count(survey, rung.cells)
                                : island_work(transport_settings(rung), scene, survey).cell;
        cell_depth =
            std::clamp(survey.max_extinction * (1 - scene->medium.albedo * f) * cell, 0.0, 1e6);
        coarseness = std::clamp(exact::log2(std::max(cell, 1e-12) / mean_s(survey)), -4.0, 4.0);
    }
    const double into_sun = std::max(survey.sun_cosine, 0.0), backlit = into_sun * into_sun;
    const double thin = exact::log(depth / (1 + depth)),
                 thick = exact::log1p(std::min(depth, kMostDepth));
    const double cells = exact::log1p(std::min(cell_depth, kMostCellDepth)), forward = std::abs(g);
    const std::array figures{
        1.0,
        thin,
        thick,
        cells,
        forward,
        g * g,
        backlit,
        g * g * backlit,
        coarseness,
        survey.eye_inside ? 1.0 : 0.0,
        sun_share(scene),
        exact::log10(std::clamp(1 - scene->medium.albedo, 1e-4, 1.0)) + 4,
        thin * forward,
        thick * forward,
        thick * backlit,
        thick * thick,
        cells * cells,
        thin * thin,
        detail_counts(scene, survey) ? scene->detail.value_or(Detail{}).amount : 0,
        survey.ground.light / (1 + survey.ground.light),
        -exact::expm1(-survey.haze.depth_to_clouds),
        survey.islands.list.empty() ? 0.0 : 1.0};
    static_assert(figures.size() == kErrorFigureCount);
    return figures;
}

TimeFigures time_figures(const Rung& rung, const Scene& scene, const Survey& survey,
                         std::uint32_t samples) {
    const double pixels = static_cast<double>(scene->image.width) * scene->image.height;
    const double covered = pixels * survey.covered;
    const auto particles = static_cast<double>(survey.drawn);
    TimeFigures figures{
        1, covered, particles, pixels * survey.particles_per_pixel, pixels, 0, 0, 0, 0, 0, 0,
        0, 0,       0};
    if (detail_counts(scene, survey)) {
        // As long a way as the cloud's mean side, in steps of a fifth of a bump (core/draw/march.cpp).
        const glm::dvec3 size = survey.bounds.max - survey.bounds.min;
        const double way = exact::cbrt(std::max(size.x * size.y * size.z, 0.0));
        const double step = 0.2 * scene->detail.value_or(Detail{}).size * survey.detail.radius;
        figures[8] = covered * std::min(way / std::max(step, 1e-12), 2048.0);
        figures[10] = 1;
    }
    if (scene->haze && scene->haze->extinction > 0) figures[9] = pixels;
    if (rung.method == Method::kMarch) {
        const TransportSettings settings = transport_settings(rung);
        const bool one = survey.islands.list.empty();
        const IslandWork islands = island_work(settings, scene, survey);
        const double cells =
            one ? cells_in(survey.bounds.max - survey.bounds.min, rung.cells) : islands.cells;
        double bands = (scene->sun.intensity > 0 ? 1 : 0) + (scene->sky.none ? 0
                                                             : scene->sky.physical
                                                                 ? 3  // a colour channel each
                                                                 : 2);
        // From the ground, and back once more.
        if (survey.ground.light > 0) bands += 2;
        const double harmonics = asymmetry(scene->medium) == 0 ? 0.5 : 1;  // of the cost of 16
        // Sweeps that the solve takes, from the coarser grid's light: few in thin matter, twice as many at depth 30.
        const double sweeps = 1 + 0.35 * exact::log1p(std::min(survey.optical_depth_sun, 1e3));
        // Islands' grids are small and less deep than all of them in a row: measured on the sky of 100 clouds.
        figures[5] = cells * bands * harmonics * sweeps * (one ? 1 : kIslandsShare);
        figures[11] = std::min(covered, kMostLookedUp) * figures[3] / std::max(covered, 1.0) *
                      exact::log1p(std::clamp(survey.optical_depth_eye, 0.0, kMostDepth));
        if (figures[10] > 0)
            figures[12] =
                figures[5] / std::max(bands, 1.0) * exact::pow(fine_cells_a_side(rung.cells), 3);
        figures[13] = exact::pow(figures[5] / sweeps, 2.0 / 3);
        figures[6] = one ? updates(survey, settings.sun_cells) + updates(survey, 3 * rung.cells)
                         : islands.updates;
    }
    if (rung.method == Method::kPaths) {
        // A path that meets thick matter scatters about as often as it is deep, and as the forward peak asks for.
        const double depth = std::clamp(survey.mean_depth_eye, 0.0, 1e4);
        const double absorbed = 1 - scene->medium.albedo;
        const double orders = depth / (1 + absorbed * depth * depth);
        // Its beginning, from the eye to the first of them, costs as much as some more.
        constexpr double kBeginning = 4;
        figures[7] = covered * samples * (kBeginning + orders);
    }
    return figures;
}

// Of one of the sampled blocks (kBlockSide of draw/march_bins.h).
constexpr double kBlockPixels = 16 * 16;

TimeFigures measuring_figures(const Rung& rung, const Scene& scene, const Survey& survey) {
    const Rung& grid = rung.cells > 0 ? rung : rung_of(RungId::kTransport16);
    TimeFigures figures = time_figures(grid, scene, survey, 0);
    const double blocks = rung.cells > 0 ? kMeasuredBlocks : kMeasuredBlocksWithoutGrid;
    const double covered = figures[1], pixels = figures[4];
    const double sampled = std::min(1.0, kBlockPixels * blocks / std::max(covered, 1.0));
    const double looked_up = std::min(covered, kMostLookedUp);
    for (const std::size_t of_rays : {1, 3, 8, 9}) figures[of_rays] *= sampled;
    figures[4] *= std::min(1.0, kMostMeasuredPixels / std::max(pixels, 1.0));
    if (looked_up > 0) figures[11] *= std::min(figures[1], looked_up) / looked_up;
    return figures;
}

}  // namespace awan
