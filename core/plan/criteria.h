// Whether a scene calls for an effect, by figures of its survey: the only place with the thresholds.
#pragma once

#include <array>
#include <string>

#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

struct Criterion {
    bool wanted = false;
    // About how wrong the picture would be without: rms over the cloud's pixels (or the whole picture's, of what is
    // seen beside the cloud), relative to their mean. 0: the scene has nothing of the kind. Within a factor of 3 or
    // so (effects_test), often too large: the figures are the largest in view.
    double left_out = 0;
    // One phrase, with figure and threshold where there is one.
    std::string reason;
};

// In the order of Effect.
std::array<Criterion, kEffectCount> criteria(const Scene& scene, const Survey& survey);
// One of them.
Criterion criterion(Effect effect, const Scene& scene, const Survey& survey);

// Pixels; smaller bumps are faded out (core/draw/march_detail.h).
inline constexpr double kLeastBump = 1;
// Pixels; where the scene leaves it to us, smaller bumps are not worth what detail costs.
inline constexpr double kLeastAutoBump = 16;
// Whether the scene has detail as far as its cost and error go: one that asks for it has it however small it is.
bool detail_counts(const Scene& scene, const Survey& survey);
// Size of detail's largest bumps in the picture, pixels, where the cloud is nearest; infinite from within.
double detail_pixels(const Scene& scene, const Survey& survey);

}  // namespace awan
