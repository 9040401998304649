// Pass 2 of the classic rungs, from the eye: particles as splats.
#pragma once

#include "core/base/image.h"
#include "core/light/light.h"
#include "core/plan/effect_times.h"

namespace awan {

// Blends the particles pixel by pixel, in float32, by the compute pass splat.glsl, over the sky or over nothing. One
// renderer gives the same picture for the same input. Time and memory between two looks at the deadline are bounded.
// times: what it took is added to them; may be null. threads: of what the processor does. in_passing: to look
// at in passing, splats on half as many pixels along each side, but for painted ones. Errors: kOverDeadline,
// kCancelled, kInternal; kTooLarge where the renderer has no memory.
Result<Image> draw(const Scene& scene, const ParticleSet& particles, const View& view,
                   const Plan& plan, const Lighting& lighting, Device& device,
                   const Deadline& deadline, EffectTimes* times = nullptr, int threads = 1,
                   bool in_passing = false);

}  // namespace awan
