#include "core/survey/haze_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// Slopes below it change no height within any finite picture.
constexpr double kLevel = 1e-200;

}  // namespace

HazeRay::HazeRay(const Haze& haze, double y, double slope)
    : extinction_(haze.extinction),
      start_((y - haze.height) / haze.scale_height),
      slope_(std::abs(slope) < kLevel ? 0 : slope),
      rate_(slope_ / haze.scale_height),
      crossing_(std::numeric_limits<double>::infinity()) {
    if ((start_ < 0 && slope_ > 0) || (start_ > 0 && slope_ < 0)) crossing_ = -start_ / rate_;
}

// Over extinction; `start` >= 0 in scale heights, `length` may be infinite where it leads upwards or is level.
double HazeRay::above(double start, double length) const {
    const double rise = rate_ == 0 ? 0 : rate_ * length;
    const double density = exact::exp(-std::max(std::min(start, start + rise), 0.0));
    if (density == 0 || length <= 0) return 0;
    const double x = std::abs(rise);
    const double mean =
        x < 1e-5 ? length * (1 - x * (0.5 - x / 6)) : -exact::expm1(-x) / std::abs(rate_);
    return density * mean;
}

double HazeRay::depth(double t) const {
    if (extinction_ == 0 || t <= 0) return 0;
    if (start_ > 0 || (start_ == 0 && slope_ >= 0)) {
        if (t <= crossing_) return extinction_ * above(start_, t);
        return extinction_ * (above(start_, crossing_) + (t - crossing_));
    }
    if (t <= crossing_) return extinction_ * t;
    return extinction_ * (crossing_ + above(0, t - crossing_));
}

double HazeRay::opacity(double t) const {
    return -exact::expm1(-depth(t));
}

// In either part the depth of a step is the one before's times a constant.
void HazeRay::opacities(double first, double step, int count, double* out) const {
    const double last = first + (count - 1) * step, rise = rate_ * step;
    const bool crosses = crossing_ > first && crossing_ < last;
    if (crosses || !(std::abs(rise) < 1) || first < 0) {
        for (int k = 0; k < count; ++k) out[k] = opacity(first + k * step);
        return;
    }
    const double start = start_ + rate_ * first;
    const bool in_layer = start_ + rate_ * (0.5 * (first + last)) <= 0;
    double depth = extinction_ * (in_layer ? step : above(start, step));
    const double ratio = in_layer ? 1 : exact::exp(-rise);
    out[0] = opacity(first);
    for (int k = 1; k < count; ++k, depth *= ratio) {
        const double taken =
            depth < 0.01
                ? depth * (1 - depth / 2 * (1 - depth / 3 * (1 - depth / 4 * (1 - depth / 5))))
                : -exact::expm1(-depth);
        out[k] = out[k - 1] + (1 - out[k - 1]) * taken;
    }
}

double vertical_haze_depth(const Haze& haze, double low, double high) {
    return HazeRay(haze, low, 1).depth(high - low);
}

}  // namespace awan
