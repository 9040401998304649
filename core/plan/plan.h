// The only room that decides. Survey figures in, decisions and their reasons out.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/plan/ladder.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

struct EffectDecision {
    Effect effect = Effect::kSelfShadow;
    bool on = false;
    bool available = true;  // false: not in this version
    std::string reason;     // one sentence, with the figure and the threshold
};

// What a rung would cost this scene and how far it would be from the truth.
struct RungForecast {
    const Rung* rung = nullptr;
    double error =
        0;  // relative (PictureError::nrmse, core/truth/error_measures.h); measured errors are below it in 95% of scenes
    double time_ms = 0;  // of all stages but queue and encode, on this machine
    double bytes = 0;    // memory at its peak, beside the scene's particles and the picture
};

struct Plan {
    std::array<EffectDecision, kEffectCount> effects;
    std::string rung;                     // chosen
    std::string rung_reason;              // one sentence
    RungForecast predicted;               // of the chosen rung
    std::vector<RungForecast> forecasts;  // of every rung, in the ladder's order
    std::uint32_t samples = 0;            // rung truth: paths a pixel

    bool on(Effect effect) const { return effects[static_cast<std::size_t>(effect)].on; }
};

Plan plan(const Scene& scene, const Survey& survey);

}  // namespace awan
