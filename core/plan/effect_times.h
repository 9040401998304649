// How long each effect took, where its time can be told apart from that of others.
#pragma once

#include <array>

#include "core/base/deadline.h"
#include "core/scene/scene.h"

namespace awan {

// Wall time, ms. Of the effects whose work is inside the kernels of other effects (view_extinction, interior,
// sun_color) there is none; detail and aerial_perspective have what is done apart from the rays.
struct EffectTimes {
    std::array<double, kEffectCount> ms{};

    double& of(Effect effect) { return ms[static_cast<std::size_t>(effect)]; }
    double of(Effect effect) const { return ms[static_cast<std::size_t>(effect)]; }
    void add(const EffectTimes& other, double share = 1) {
        for (std::size_t i = 0; i < ms.size(); ++i) ms[i] += share * other.ms[i];
    }
};

// What work() gives; how long it took is added to `effect`.
template <typename Work>
auto timed_for(EffectTimes& times, Effect effect, const Work& work) {
    const auto start = Deadline::Clock::now();
    auto result = work();
    times.of(effect) += ms_since(start);
    return result;
}

}  // namespace awan
