// Clouds that change in time: the frames of a scene's sequence. A frame depends on its time alone and on what is settled for all
// of them from the first, the middle and the last, so any frame by itself is the same bytes as among the others, and a farm
// can share them out.
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

// What does not change from frame to frame though it is chosen automatically: the camera (it holds all three), the rung
// (the finest that one of the three calls for; the cheapest where a time is given), effects (those that one of them calls for) and the
// detail's scale. Light is made anew for every frame whose matter moved.
struct Settled {
    SceneDraft draft;                     // without its sequence
    std::optional<DetailFigures> detail;  // at the sequence's `from`
    double from = 0;
};

// A scene with a sequence. Takes three times what it takes to plan one frame.
Result<Settled> settle(const Scene& scene, int threads, const Deadline& deadline,
                       const MachineSpeed& speed);

struct Frame {
    Scene scene;
    std::optional<DetailFigures> detail;
};
Frame frame_at(const Settled& settled, double time);

}  // namespace awan
