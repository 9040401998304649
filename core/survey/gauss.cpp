#include "core/survey/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {
namespace {

constexpr int kIntervals = 8192;
constexpr double kTableReach = 5.5;

std::array<double, kIntervals + 1> make_table() {
    std::array<double, kIntervals + 1> table{};
    for (int i = 0; i <= kIntervals; ++i) {
        const double x = -kTableReach + 2 * kTableReach * i / kIntervals;
        table[static_cast<std::size_t>(i)] = 0.5 * exact::erfc(-x / std::numbers::sqrt2);
    }
    table.front() = 0;
    table.back() = 1;
    return table;
}

}  // namespace

double normal_cdf(double x) {
    static const auto kTable = make_table();
    if (!(x > -kTableReach)) return 0;
    if (!(x < kTableReach)) return 1;
    const double t = (x + kTableReach) * (kIntervals / (2 * kTableReach));
    // Just below the reach t rounds up to the end of the table.
    const auto i = std::min(static_cast<std::size_t>(t), std::size_t{kIntervals - 1});
    return kTable[i] + (t - static_cast<double>(i)) * (kTable[i + 1] - kTable[i]);
}

}  // namespace awan
