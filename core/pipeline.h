// The stages, in order: validate -> generate -> survey -> plan -> light -> draw. pipeline.cpp is
// the only place that lists them. Parsing comes before (server/json, core/formats), encoding after
// (core/formats).
#pragma once

#include <optional>

#include "core/base/deadline.h"
#include "core/base/progress.h"
#include "core/draw/image.h"
#include "core/generate/detail.h"
#include "core/generate/particle_set.h"
#include "core/gl/device.h"
#include "core/light/light_cache.h"
#include "core/plan/effect_times.h"
#include "core/plan/plan.h"
#include "core/survey/survey.h"

namespace awan {

struct StageTimes {
    double generate_ms = 0, survey_ms = 0, light_ms = 0, draw_ms = 0;
    EffectTimes effects;  // parts of the above; of effects that are on
};

struct Planned {
    ParticleSet particles;
    Survey survey;
    Plan plan;
    StageTimes times;
};

struct Rendered {
    Survey survey;  // without its volume
    Plan plan;
    Image image;
    StageTimes times;
    bool light_was_kept = false;  // it came from the cache
};

// What rendering works with. The splat rungs need the device, on the thread that owns it; the others run on
// `threads` threads and do without.
struct Tools {
    Device* device = nullptr;      // null: splat rungs fail with kNoRenderer
    int threads = 1;               // >= 1
    LightCache* lights = nullptr;  // null: nothing is kept
    Progress progress;             // of rung truth, the only one that takes long
    MachineSpeed speed;
};

// Generates, surveys and plans this one picture, whatever sequence it is of. detail: the figures to make detail for, else the
// survey's. threads >= 1.
Result<Planned> plan_still(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed, const std::optional<DetailFigures>& detail);

// The same; of a scene with a sequence, with what is settled for all of its frames (core/sequence.h).
Result<Planned> plan_only(const Scene& scene, int threads, const Deadline& deadline,
                          const MachineSpeed& speed = {});

// Ready for render_planned: with the particles' detail where it is on.
// tiles: kept from render to render; may be null.
Result<Planned> ready_to_render(const Scene& scene, Result<Planned> planned, int threads,
                                DetailTiles* tiles = nullptr);

// plan_only, ready to render.
Result<Planned> plan_scene(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed = {}, DetailTiles* tiles = nullptr);

// Light and picture of what was planned.
Result<Rendered> render_planned(const Scene& scene, Planned planned, const Tools& tools,
                                const Deadline& deadline);

// Both, in turn.
Result<Rendered> render_scene(const Scene& scene, const Tools& tools, const Deadline& deadline);

// Engine version, e.g. "0.1.0"; part of every ETag.
const char* engine_version();

}  // namespace awan
