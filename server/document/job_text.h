// A job as a client asks for it, and as it is told.
#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace awan {

// {"kind": "render" | "accuracy" | "sequence" | "fly", "scene": {...}, "format": "..."}, and of a flight "path",
// "mode", "frames", "rung", "impostors" and "impostor_pixels". Views of the text they were read from.
struct JobText {
    std::string_view kind;
    // The scene's document, as it stands; "/scene" is before every pointer in it.
    std::string_view scene;
    // A word; "" where there is none.
    std::string_view format;
    // Of a flight, as they stand: words without their quotes, a number; "" where there is none.
    std::string_view path, mode, frames, rung, impostors, impostor_pixels;
    // Of an impostor, likewise.
    std::string_view views, size, mapping;
};

// Only the outer object is read; what stands in `scene` is parse_scene()'s business. Costs no memory, whatever the
// text. Errors: kMalformed, kInvalidScene.
Result<JobText> parse_job(std::string_view text);

// What GET /v1/jobs/{id} says.
struct JobStatus {
    std::string_view id, kind, state;
    double progress = 0;
    // Seconds since it came.
    double age = 0;
    // Status of its answer; 0: it has none yet.
    int status = 0;
};
std::string job_to_json(const JobStatus& job);

}  // namespace awan
