// From a scene to the plan of one picture of it: generate, survey, plan, in this order, with what each took.
#pragma once

#include <optional>

#include "core/base/deadline.h"
#include "core/generate/detail.h"
#include "core/generate/particle_set.h"
#include "core/plan/effect_times.h"
#include "core/plan/plan.h"
#include "core/survey/survey.h"

namespace awan {

// Wall time, ms.
struct StageTimes {
    double generate_ms = 0, survey_ms = 0, light_ms = 0, draw_ms = 0;
    // Of measuring the picture's error.
    double measure_ms = 0;
    // Parts of the above; of effects that are on.
    EffectTimes effects;
};

class FlightImpostors;  // core/flight_impostors.h

struct Planned {
    ParticleSet particles;
    Survey survey;
    Plan plan;
    StageTimes times;
    // The picture is of the planned rung, whatever its error: the scene names it, or it is settled for all frames of a
    // sequence.
    bool rung_is_settled = false;
    // Nobody wants to know the error of a picture whose rung is settled: none is stated. Measuring it takes longer than
    // drawing a small picture by light that was kept.
    bool is_unmeasured = false;
    // The picture is looked at in passing: one ray a pixel, even where it is uneven, and no error is stated.
    bool is_preview = false;
    // Of the flight that the picture is a frame of, and which. Null: it is drawn whole.
    FlightImpostors* impostors = nullptr;
    std::uint64_t flight_frame = 0;
};

// Plans a picture of the scene at its own time; a sequence that it may have is not looked at. detail: the figures from
// which the cloud's detail is made, where they are not the survey's own (all frames of a sequence share theirs).
// threads >= 1. Errors: of generate() and survey().
Result<Planned> plan_still(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, const std::optional<DetailFigures>& detail);

// The same of particles that have been generated: `made`, by generate() from the scene's clouds. The plan's times and
// forecasts are without that.
Result<Planned> plan_generated(const Scene& scene, ParticleSet made, int threads,
                               const Deadline& deadline, const MachineSpeed& speed,
                               const std::optional<DetailFigures>& detail);

// The same of particles that light and eye work on, as an earlier plan of the same clouds has them: many that overlap
// are merged in it, and detail is not made yet.
Result<Planned> plan_particles(const Scene& scene, ParticleSet particles, int threads,
                               const Deadline& deadline, const MachineSpeed& speed,
                               const std::optional<DetailFigures>& detail);

// Adds to a plan what rendering needs beside it: the tiles of the particles' detail, where the plan has detail on.
// An error in `planned` is passed on. tiles: keeps what one picture made for the next; may be null.
Result<Planned> with_detail_made(const Scene& scene, Result<Planned> planned, int threads,
                                 DetailTiles* tiles = nullptr);

// What is looked at in passing: automata of many cells are merged into fewer particles, for splats into the fewest.
Scene for_preview(const Scene& scene);

// A plan made one of a preview (Planned::is_preview): of the rung that was planned, whatever error the scene asks for.
Planned as_preview(const Scene& scene, Planned planned);

// Adds `ms` to what the plan predicts, for the chosen rung and for every other: work that all of them share.
void add_to_predictions(Plan& plan, double ms);

// Runs a stage and notes its wall time.
template <typename Stage>
auto timed(double& milliseconds, const Stage& stage) {
    const auto start = Deadline::Clock::now();
    auto result = stage();
    milliseconds = ms_since(start);
    return result;
}

}  // namespace awan
