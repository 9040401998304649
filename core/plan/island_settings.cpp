#include "core/plan/island_settings.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// Beside the picture, for what is drawn at its edge.
constexpr double kViewMargin = 1.1;

bool in_picture(const View& view, const glm::dvec3& low, const glm::dvec3& high) {
    const double across = kViewMargin * view.tan_half_fov * view.aspect,
                 up = kViewMargin * view.tan_half_fov;
    bool left = true, right = true, over = true, under = true, behind = true;  // all corners are
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            glm::dvec3((corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y,
                       (corner & 4) ? high.z : low.z) -
            view.eye;
        const double x = glm::dot(p, view.right), y = glm::dot(p, view.up),
                     z = glm::dot(p, view.forward);
        left = left && x < -across * z;
        right = right && x > across * z;
        over = over && y > up * z;
        under = under && y < -up * z;
        behind = behind && z < 0;
    }
    return !(left || right || over || under || behind);
}

// The square root of an island's share of the picture's width, at most 1; 0: it is not in the picture.
double share_of_picture(const View& view, const Island& island) {
    if (island.particles == 0 || !in_picture(view, island.low, island.high)) return 0;
    const glm::dvec3 size = island.high - island.low;
    const double distance = glm::length(glm::clamp(view.eye, island.low, island.high) - view.eye);
    const double width = 2 * distance * view.tan_half_fov * std::max(view.aspect, 1.0);
    return std::sqrt(std::min(1.0, std::max({size.x, size.y, size.z}) / std::max(width, 1e-12)));
}

int steps_down(int full, double share, int least) {
    const double steps = std::floor(-2 * exact::log2(std::clamp(share, 1e-6, 1.0)) + 1e-9);
    return std::clamp(static_cast<int>(std::lround(full * exact::pow(2.0, -steps / 2))),
                      std::min(least, full), full);
}

}  // namespace

std::vector<IslandCells> island_cells(const TransportSettings& settings, const Survey& survey) {
    std::vector<IslandCells> cells;
    for (const Island& island : survey.islands.list) {
        double share = share_of_picture(survey.view, island);
        for (const View& view : survey.seen_from)
            share = std::max(share, share_of_picture(view, island));
        IslandCells& own = cells.emplace_back();
        if (!(share > 0)) continue;
        own.cells = settings.cells == 0 ? 0 : steps_down(settings.cells, share, kLeastIslandCells);
        own.sun_cells = steps_down(settings.sun_cells, share, kLeastIslandSunCells);
    }
    return cells;
}

TransportSettings settings_on_the_way(const TransportSettings& settings, int cells,
                                      const Survey& survey) {
    if (cells == settings.cells) return settings;
    TransportSettings coarser = settings;
    coarser.cells = cells;
    coarser.sun_cells = sun_cells_for(cells);
    coarser.last = false;
    if (!settings.islands.empty()) coarser.islands = island_cells(coarser, survey);
    return coarser;
}

TransportSettings whole_settings(const TransportSettings& settings) {
    TransportSettings whole = settings;
    whole.islands.clear();
    whole.cells = settings.cells == 0 ? 0 : kWholeCells;
    whole.sun_cells = std::min(2 * settings.sun_cells, kWholeSunCells);
    return whole;
}

}  // namespace awan
