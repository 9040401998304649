// The stages, in order: validate -> generate -> survey -> plan -> light -> draw. pipeline.cpp is
// the only place that lists them. Parsing comes before (server/json, core/formats), encoding after
// (core/formats).
#pragma once

#include "core/deadline.h"
#include "core/draw/image.h"
#include "core/generate/particle_set.h"
#include "core/gl/device.h"
#include "core/plan/plan.h"
#include "core/survey/survey.h"

namespace awan {

struct StageTimes {
    double generate_ms = 0, survey_ms = 0, light_ms = 0, draw_ms = 0;
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
};

// Everything that needs no renderer. threads >= 1.
Result<Planned> plan_scene(const Scene& scene, int threads, const Deadline& deadline);

// The two passes over what was planned, on the thread that owns `device`.
Result<Rendered> render_planned(const Scene& scene, Planned planned, Device& device,
                                const Deadline& deadline);

// Both, in turn.
Result<Rendered> render_scene(const Scene& scene, Device& device, int threads,
                              const Deadline& deadline);

// Engine version, e.g. "0.1.0"; part of every ETag.
const char* engine_version();

}  // namespace awan
