// The only room that decides. Survey figures in, decisions and their reasons out.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/plan/eye_effects.h"
#include "core/plan/forecast.h"
#include "core/plan/transport_settings.h"
#include "core/scene/rungs.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

struct EffectDecision {
    Effect effect = Effect::kSelfShadow;
    bool on = false;
    bool available = true;  // false: not in this version
    std::string reason;     // one sentence, with the figure and the threshold
    double left_out = 0;  // about the relative error of a picture without it (core/plan/criteria.h)
};

struct Plan {
    std::array<EffectDecision, kEffectCount> effects;
    std::string rung;                     // chosen
    std::string rung_reason;              // one sentence
    RungForecast predicted;               // of the chosen rung
    std::vector<RungForecast> forecasts;  // of every rung, in the ladder's order
    TransportSettings transport;          // rungs of Method::kMarch
    std::uint32_t samples = 0;            // rung truth: paths a pixel

    EffectDecision& of(Effect effect) { return effects[static_cast<std::size_t>(effect)]; }
    const EffectDecision& of(Effect effect) const {
        return effects[static_cast<std::size_t>(effect)];
    }
    bool on(Effect effect) const { return of(effect).on; }
    EyeEffects eye_effects() const {
        return {on(Effect::kAerialPerspective), on(Effect::kLightShafts)};
    }
};

// threads: that the rungs of march and paths will have.
Plan plan(const Scene& scene, const Survey& survey, int threads, const MachineSpeed& speed);

}  // namespace awan
