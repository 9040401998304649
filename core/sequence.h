// Clouds that change in time: the frames of a scene's sequence. A frame depends on its time alone and on what is
// settled for all of them from the first, the middle and the last, so any frame by itself is the same bytes as among
// the others, and a farm can share them out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/deadline.h"
#include "core/climb.h"
#include "core/generate/detail.h"
#include "core/plan/forecast.h"
#include "core/planning.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Seconds at frame i < sequence.frames: the first at `from`, the last at `to`; a single one at `from`.
double frame_time(const Sequence& sequence, std::uint64_t i);

// What the draft of a valid scene is at one time of that sequence, any, without one: with the clouds and the camera of
// that time.
SceneDraft still_of(const SceneDraft& draft, const Sequence& sequence, double time);

// Whether the clouds of all its frames are the same, so that light that one frame made is the next one's too. scene:
// one with a sequence.
bool clouds_stand(const SceneDraft& scene);

// What the clouds fill at its first, middle and last time. threads >= 1. Errors: of generate().
Result<Bounds> bounds_of_sequence(const SceneDraft& draft, const Sequence& sequence, int threads,
                                  const Deadline& deadline);

// What is chosen automatically and yet must not change from frame to frame. It is chosen from three frames, the first,
// the middle and the last: a camera without keys holds the clouds of all three; an effect is on if one of them calls
// for it; the detail's scale is the largest. Light is not settled: it is made anew for every frame whose matter moved.
//
// The rung, where an error is asked for, is one whose error is measured: of the three frames the one that is forecast
// to be the hardest climbs (core/climb.h) until the error holds, and all frames are of the rung where it ends, paths
// where no grid will do. Every frame still states its own error. Where a time is asked for, the rung is the cheapest
// that one of the three is forecast to call for. Machines that share out the frames of one sequence must come to the
// same: so these forecasts are for the machine and the threads of the calibration, not for the own ones.
struct Settled {
    // The scene without its sequence, with what was settled in place of what was automatic.
    SceneDraft draft;
    // How the rung came about; EMPTY: the scene names it, or has none.
    std::string reason;
    // Paths a pixel, where rung truth is settled.
    std::optional<std::uint32_t> samples;
    // None: nothing was planned (a look). Stands where the clouds are at the time `sequence.from`.
    std::optional<DetailFigures> detail;
    // The scene's: where the camera is at each time.
    Sequence sequence;
    // What a camera with keys sees of matter that stands, as far as some dozen frames tell: one light serves all of
    // them (Survey::seen_from). EMPTY: each frame has its own.
    std::vector<View> views;
    // The frames' errors are not wanted (Planned::is_unmeasured); the rung's is measured all the same where one is
    // asked for.
    bool is_unmeasured = false;
};

// kForecast: nothing is measured, the rung is the one that is expected.
enum class Settling { kForecast, kMeasured };

// A scene with a sequence. Takes three times what it takes to plan one frame and, measured, about the time of its light
// once more. Errors: of plan_still() and climb().
Result<Settled> settle(const Scene& scene, Settling how, const ClimbTools& tools,
                       const Deadline& deadline);

// Of every frame. Precondition: its camera has keys.
std::vector<View> views_of_frames(const Settled& settled);

// One picture of a sequence.
struct Frame {
    Scene scene;
    std::optional<DetailFigures> detail;
    std::optional<std::uint32_t> samples;
    std::vector<View> views;
    bool is_unmeasured = false;
};
// time: seconds, any of the sequence.
Frame frame_at(const Settled& settled, double time);

// The particles of clouds that stand, for the frames after the first: one thread's. EMPTY: not made yet, or there are
// other ones for every eye.
struct StandingMatter {
    std::optional<ParticleSet> particles;
};

// As plan_still (core/planning.h). matter: of a sequence whose clouds stand (clouds_stand); else null.
Result<Planned> plan_frame(const Frame& frame, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, StandingMatter* matter = nullptr);

}  // namespace awan
