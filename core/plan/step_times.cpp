#include "core/plan/step_times.h"

#include <algorithm>
#include <cmath>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// With which power of its cells along a side the time of a grid grows below the coarsest rung: the third.
constexpr double kTimePower = 3;
// What is left of a step's weight when the next one is told of.
constexpr double kFading = 0.5;
// Forecasts may be so many times off.
constexpr double kMostScale = 10;
// Steps of less are the clock's noise and what every solve takes to begin.
constexpr double kLeastStep_ms = 1;

}  // namespace

StepTimes::StepTimes(const std::vector<RungForecast>& forecasts) {
    for (const RungForecast& forecast : forecasts)
        if (forecast.rung->cells > 0)
            forecasts_.push_back({forecast.rung->cells, forecast.light_ms});
    std::sort(forecasts_.begin(), forecasts_.end(),
              [](const Known& a, const Known& b) { return a.cells < b.cells; });
}

double StepTimes::light_ms(double cells) const {
    if (forecasts_.empty()) return 0;
    const auto after = std::find_if(forecasts_.begin(), forecasts_.end(),
                                    [&](const Known& known) { return known.cells >= cells; });
    if (after == forecasts_.begin() || after == forecasts_.end()) {
        const Known& end = after == forecasts_.end() ? forecasts_.back() : forecasts_.front();
        return end.ms * exact::pow(cells / end.cells, kTimePower);
    }
    const Known &low = after[-1], &high = *after;
    const double share = exact::log(cells / low.cells) / exact::log(1.0 * high.cells / low.cells);
    return std::max(low.ms, 1e-3) *
           exact::pow(std::max(high.ms, 1e-3) / std::max(low.ms, 1e-3), share);
}

void StepTimes::solved(int cells, double ms) {
    const double expected = std::max(light_ms(cells) - light_ms(reached_), 0.0);
    reached_ = cells;
    if (std::max(ms, expected) < kLeastStep_ms) return;
    took_ms_ = kFading * took_ms_ + ms;
    expected_ms_ = kFading * expected_ms_ + expected;
}

void StepTimes::kept(int cells) {
    reached_ = cells;
}

double StepTimes::next_ms(int cells) const {
    double scale = 1;
    if (expected_ms_ > 0) scale = std::clamp(took_ms_ / expected_ms_, 1 / kMostScale, kMostScale);
    return scale * std::max(light_ms(cells) - light_ms(reached_), 0.0);
}

}  // namespace awan
