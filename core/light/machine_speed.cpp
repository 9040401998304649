#include "core/light/machine_speed.h"

#include <algorithm>
#include <chrono>

#include "core/light/sweep.h"

namespace awan {

MachineSpeed measure_speed() {
    using Clock = std::chrono::steady_clock;
    SweepGrid grid;
    grid.cells = {12, 12, 12};
    grid.depth.assign(12 * 12 * 12, 0.5F);
    const Ordinates ordinates = make_ordinates();
    std::vector<float> source(grid.size() * 16, 0.01F), moments(source.size());
    SweepSpace space;
    double best_ms = 1e9;
    for (int i = 0; i < 5; ++i) {
        const auto start = Clock::now();
        sweep(grid, ordinates, {source}, {}, 1, space, {moments});
        best_ms = std::min(best_ms,
                           std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    return {std::clamp(best_ms / kCalibratedSweepMs, 0.1, 20.0)};
}

}  // namespace awan
