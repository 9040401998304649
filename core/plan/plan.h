// The only room that decides. Survey figures in, decisions and their reasons out.
#pragma once

#include <array>
#include <string>

#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

struct EffectDecision {
    Effect effect = Effect::kSelfShadow;
    bool on = false;
    bool available = true;  // false: not in this version
    std::string reason;     // one sentence, with the figure and the threshold
};

struct Plan {
    std::array<EffectDecision, kEffectCount> effects;
    std::string rung;  // "harris"

    bool on(Effect effect) const { return effects[static_cast<std::size_t>(effect)].on; }
};

Plan plan(const Scene& scene, const Survey& survey);

}  // namespace awan
