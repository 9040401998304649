// Clouds that change in time: the frames of a scene's sequence. A frame depends on its time alone and on what is
// settled for all of them from the first, the middle and the last, so any frame by itself is the same bytes as among
// the others, and a farm can share them out.
#pragma once

#include <cstdint>
#include <optional>

#include "core/base/deadline.h"
#include "core/generate/detail.h"
#include "core/plan/forecast.h"
#include "core/scene/scene.h"

namespace awan {

// Seconds at frame i < sequence.frames: the first at `from`, the last at `to`; a single one at `from`.
double frame_time(const Sequence& sequence, std::uint64_t i);

// What is chosen automatically and yet must not change from frame to frame. It is chosen from three frames, the
// first, the middle and the last: the camera holds the clouds of all three; the rung is the finest that one of them
// calls for, or the cheapest where a time is given; an effect is on if one of them calls for it; the detail's scale
// is the largest. Light is not settled: it is made anew for every frame whose matter moved.
struct Settled {
    // The scene without its sequence, with what was settled in place of what was automatic.
    SceneDraft draft;
    // None: nothing was planned (a look). Stands where the clouds are at the time `from`.
    std::optional<DetailFigures> detail;
    double from = 0;
};

// A scene with a sequence. Takes three times what it takes to plan one frame.
Result<Settled> settle(const Scene& scene, int threads, const Deadline& deadline,
                       const MachineSpeed& speed);

// One picture of a sequence, as plan_still (core/planning.h) takes it.
struct Frame {
    Scene scene;
    std::optional<DetailFigures> detail;
};
// time: seconds, any of the sequence.
Frame frame_at(const Settled& settled, double time);

}  // namespace awan
