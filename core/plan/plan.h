// Decides what is simulated and by which rung, from the survey's figures, and says why. No other room decides.
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
    // One sentence, with the figure and the threshold.
    std::string reason;
    // About the relative error of a picture without it (core/plan/criteria.h).
    double left_out = 0;
};

struct Plan {
    std::array<EffectDecision, kEffectCount> effects;
    std::string rung;         // chosen
    std::string rung_reason;  // one sentence
    RungForecast predicted;   // of the chosen rung
    // Of every rung, in the ladder's order.
    std::vector<RungForecast> forecasts;
    TransportSettings transport;  // rungs of Method::kMarch
    std::uint32_t samples = 0;    // rung truth: paths a pixel

    EffectDecision& of(Effect effect) { return effects[static_cast<std::size_t>(effect)]; }
    const EffectDecision& of(Effect effect) const {
        return effects[static_cast<std::size_t>(effect)];
    }
    bool on(Effect effect) const { return of(effect).on; }
    EyeEffects eye_effects() const {
        return {on(Effect::kAerialPerspective), on(Effect::kLightShafts)};
    }
};

// Longer paths than these are not chosen, only taken by name.
inline constexpr double kPatience_ms = 20e3;

// Whether the scene calls for what only splats show: an effect is switched off that the other rungs cannot leave out,
// as they follow all light there is, or its billboards are painted.
bool wants_splats(const Scene& scene);

// Whether its picture has layers (core/scene/layers.h), which only the march can tell apart.
bool wants_layers(const Scene& scene);

// Other paths a pixel for rung truth than the plan has, and what is predicted of it then; otherwise as plan().
void plan_samples(Plan& plan, std::uint32_t samples, const Scene& scene, const Survey& survey,
                  int threads, const MachineSpeed& speed);

// threads: that the march and the paths will have. speed: of this machine.
Plan plan(const Scene& scene, const Survey& survey, int threads, const MachineSpeed& speed);

}  // namespace awan
