#include "core/truth/droplet_law.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace awan::truth {

DropletLaw::DropletLaw(const DropletPhase& phase)
    : half(phase.nodes.size() - 1),
      stretch(std::ldexp(1.0f, phase.octaves) - 1),
      shift(23 - DropletPhase::kPerOctaveBits) {
    std::vector<double> light;
    for (const auto* const p : {&phase.ahead, &phase.behind})
        for (std::size_t i = 0; i < half; ++i) {
            const double low = phase.nodes[i], step = phase.nodes[i + 1] - low;
            from.push_back(static_cast<float>(low));
            width.push_back(static_cast<float>(step));
            p_from.push_back(static_cast<float>((*p)[i]));
            p_rise.push_back(static_cast<float>((*p)[i + 1] - (*p)[i]));
            light.push_back(((*p)[i] + (*p)[i + 1]) * step);
        }
    const double mean =
        std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
    keep.assign(light.size(), 1.0f);
    other.resize(light.size());
    std::vector<std::uint32_t> less, more;
    for (std::uint32_t i = 0; i < light.size(); ++i) {
        other[i] = i;
        light[i] /= mean;
        (light[i] < 1 ? less : more).push_back(i);
    }
    while (!less.empty() && !more.empty()) {
        const std::uint32_t poor = less.back(), rich = more.back();
        less.pop_back();
        keep[poor] = static_cast<float>(light[poor]);
        other[poor] = rich;
        light[rich] -= 1 - light[poor];
        if (light[rich] < 1) {
            more.pop_back();
            less.push_back(rich);
        }
    }
}

double value(const DropletLaw& law, double w, bool behind) {
    const auto stretched = static_cast<float>(1 + w * static_cast<double>(law.stretch));
    const std::uint32_t bits =
        std::bit_cast<std::uint32_t>(stretched) - std::bit_cast<std::uint32_t>(1.0f);
    const std::size_t i =
        std::min<std::size_t>(bits >> law.shift, law.half - 1) + (behind ? law.half : 0);
    const double part = std::clamp(
        (w - static_cast<double>(law.from[i])) / static_cast<double>(law.width[i]), 0.0, 1.0);
    return static_cast<double>(law.p_from[i]) + part * static_cast<double>(law.p_rise[i]);
}

}  // namespace awan::truth
