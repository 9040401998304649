#include "core/plan/transport_settings.h"

#include <algorithm>
#include <array>
#include <functional>

namespace awan {

namespace {

// Cells of the grids that come before those of the rungs. A solve of the first takes a millisecond.
constexpr std::array kFirstSteps = {8, 12};
constexpr double kLeastGrowth = 1.25;

// Cells of all grids that there are, finest first.
std::vector<int> all_steps() {
    std::vector<int> steps(kFirstSteps.begin(), kFirstSteps.end());
    for (const Rung& rung : ladder())
        if (rung.cells > 0) steps.push_back(rung.cells);
    std::sort(steps.begin(), steps.end(), std::greater<>());
    return steps;
}

}  // namespace

std::vector<int> nested_cells(int cells) {
    std::vector<int> grids{cells};
    for (const int step : all_steps())
        if (kLeastGrowth * step <= grids.back()) grids.push_back(step);
    std::reverse(grids.begin(), grids.end());
    return grids;
}

int sun_cells_for(int cells) {
    return std::clamp(3 * cells, 64, 128);
}

TransportSettings transport_settings(const Rung& rung) {
    TransportSettings settings;
    settings.cells = rung.cells;
    settings.sun_cells = sun_cells_for(rung.cells);
    settings.last = rung.cells >= all_steps().front();
    return settings;
}

}  // namespace awan
