#include "core/generate/automaton/shape.h"

#include <algorithm>
#include <cmath>

namespace awan::automaton {

double fall_off_at(AutomatonShape shape, const std::vector<float>& table, double u) {
    switch (shape) {
        case AutomatonShape::kLinear:
            return 1 - u;
        case AutomatonShape::kQuadratic:
            return 1 - u * u;
        case AutomatonShape::kSmooth:
            return 1 - u * u * (3 - 2 * u);
        case AutomatonShape::kTable:
            break;
    }
    const double at = u * static_cast<double>(table.size() - 1);
    const std::size_t n = std::min(static_cast<std::size_t>(at), table.size() - 2);
    const auto low = static_cast<double>(table[n]), high = static_cast<double>(table[n + 1]);
    return low + (at - static_cast<double>(n)) * (high - low);
}

std::vector<std::uint16_t> fall_off_digits(const AutomatonCloud& cloud) {
    std::vector<std::uint16_t> digits;
    if (cloud.fall_off == AutomatonShape::kLinear) return digits;
    constexpr std::size_t kDistances = 1u << 16;
    digits.resize(kDistances);
    for (std::size_t n = 0; n < kDistances; ++n) {
        const double d = static_cast<double>(n) / kDistances;
        const double left = 1 - fall_off_at(cloud.fall_off, cloud.fall_off_table, d);
        digits[n] = static_cast<std::uint16_t>(
            std::clamp(std::floor(left * kDistances), 0.0, kDistances - 1.0));
    }
    return digits;
}

std::array<std::vector<float>, 3> smooth_weights(const AutomatonCloud& cloud) {
    std::array<std::vector<float>, 3> weights;
    if (cloud.smooth_weight == AutomatonWeight::kEven) return weights;
    // The words go on from kEven as those of a shape do from the first.
    const auto shape = static_cast<AutomatonShape>(static_cast<int>(cloud.smooth_weight) - 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double reach = cloud.smooth[static_cast<int>(axis)];
        for (double n = 0; n <= reach; ++n)
            weights[axis].push_back(
                static_cast<float>(fall_off_at(shape, cloud.smooth_weight_table, n / (reach + 1))));
    }
    return weights;
}

}  // namespace awan::automaton
