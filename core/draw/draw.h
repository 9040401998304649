// Pass 2, from the eye.
#pragma once

#include "core/base/image.h"
#include "core/light/light.h"
#include "core/plan/effect_times.h"

namespace awan {

// Particles blended per pixel by the compute pass splat.glsl, in float32, over the sky or over
// nothing; the same picture again for the same input on one renderer. Time and memory between two
// looks at the deadline are bounded. times: what it took is added to them; may be null. Errors: kOverDeadline, kCancelled, kInternal; kTooLarge when
// the renderer has no memory.
Result<Image> draw(const Scene& scene, const ParticleSet& particles, const View& view,
                   const Plan& plan, const Lighting& lighting, Device& device,
                   const Deadline& deadline, EffectTimes* times = nullptr);

}  // namespace awan
