// From a scene to its picture. The stages, in order: generate, survey and plan (core/planning.h, core/sequence.h),
// light, draw. A document is parsed and validated before (server/document, core/scene), the picture is encoded after
// (core/formats).
#pragma once

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/base/progress.h"
#include "core/draw/layers.h"
#include "core/flight_impostors.h"
#include "core/formats/image_file.h"
#include "core/generate/detail.h"
#include "core/gl/device.h"
#include "core/light/light_cache.h"
#include "core/planning.h"

namespace awan {

// A finished picture and how it came about.
struct Rendered {
    Survey survey;  // without its volume
    Plan plan;
    Image image;
    StageTimes times;
    bool light_was_kept = false;  // it came from the cache
    // The rung that the picture is of: the plan's, or where that did not keep to the scene's wish, another.
    const Rung* rung = nullptr;
    // Its error, measured while it was made (core/climb.h), as PictureError::nrmse. NaN: it was not measured, as the
    // time that the scene asks for is too short or nobody wants it, and plan.predicted.error is all that is known; or
    // there is none (a look).
    double stated_error = 0;
    // Those that the scene asks for (core/scene/layers.h).
    PictureLayers layers{};
    // Of a flight's frame.
    ImpostorFrame impostors{};
};

// What its file keeps of it.
PictureNotes notes_of(const Rendered& rendered);

// What rendering works with. The splat rungs need the device, on the thread that owns it; the others run on
// `threads` threads and do without.
struct Tools {
    // Null: splat rungs fail with kNoRenderer.
    Device* device = nullptr;
    int threads = 1;               // >= 1
    LightCache* lights = nullptr;  // null: nothing is kept
    // Of rung truth, the only one that takes long.
    Progress progress;
    MachineSpeed speed;
};

// Generates, surveys and plans. Of a scene with a sequence: with what is settled for all of its frames
// (core/sequence.h), its rung as far as forecasts tell. threads >= 1. Errors: kInvalidScene (what only making the
// clouds shows), kOverDeadline, kCancelled.
Result<Planned> plan_only(const Scene& scene, int threads, const Deadline& deadline,
                          const MachineSpeed& speed = {});

// The same, then with_detail_made: all that render_planned needs. The rung of a sequence is settled by measure; lights
// keeps what that is measured with, and may be null.
Result<Planned> plan_scene(const Scene& scene, int threads, const Deadline& deadline,
                           const MachineSpeed& speed = {}, DetailTiles* tiles = nullptr,
                           LightCache* lights = nullptr);

// Lights and draws what plan_scene planned. Errors: kNoRenderer where the rung needs a device and `tools` has none,
// kOverDeadline, kCancelled.
Result<Rendered> render_planned(const Scene& scene, Planned planned, const Tools& tools,
                                const Deadline& deadline);

// plan_scene, then render_planned.
Result<Rendered> render_scene(const Scene& scene, const Tools& tools, const Deadline& deadline);

// Engine version, e.g. "0.1.0"; part of every ETag.
const char* engine_version();

}  // namespace awan
