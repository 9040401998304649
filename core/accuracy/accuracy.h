// What accuracy costs: every rung of a scene with its time and its error against the truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/accuracy/error_measures.h"
#include "core/base/progress.h"
#include "core/pipeline.h"

namespace awan {

struct RungCost {
    std::string rung;
    // Median of whole renders at the scene's own size.
    double time_ms = 0;
    double light_ms = 0, draw_ms = 0;  // of the median run
    int runs = 0;                      // renders that the median is of
    // Against the reference, at its size.
    PictureError error;
    // Of the PNGs, sky behind, at the reference's size; 0..1.
    double flip = 0;
    // What is stated of the picture at the reference's size without looking at the reference; NaN: nothing.
    double stated_error = 0;
    double predicted_error = 0, predicted_time_ms = 0;  // what the plan says
    // At its peak, beside the scene's particles: what the plan says.
    double memory_bytes = 0;
    // No other rung is both faster and better.
    bool pareto = false;
    // At the reference's size, with the scene's background.
    Image picture;
    // Of its pixels to the truth: luminance, relative to the truth's mean over cloud pixels.
    std::vector<float> difference;
};

struct AccuracyReport {
    // Of the timed renders: the scene's own.
    int width = 0, height = 0;
    struct Reference {
        int width = 0, height = 0;
        std::uint32_t samples = 0;  // paths a pixel
        double noise = 0;           // PictureError::truth_noise
        double time_ms = 0, cpu_ms = 0;
        Image picture;
    } reference;
    std::vector<RungCost> rungs;  // cheapest first
    struct LeftOut {
        std::string rung, reason;
    };
    // Rungs that AccuracyOptions::time_ms had no room for.
    std::vector<LeftOut> left_out;
    // What brings the pictures to the screen.
    FilmSettings film;
};

struct AccuracyOptions {
    int threads = 1;
    MachineSpeed speed;  // for what is predicted
    // Timed renders of each rung, fewer where they take seconds. The first of each is not counted,
    // unless it is the only one or takes over half a second.
    int runs = 4;
    // Pixels of the reference's longer side, at most the scene's.
    int reference_side = 128;
    // Paths a pixel of the reference.
    std::uint32_t samples = 384;
    // EMPTY: all but truth, which is the reference.
    std::vector<std::string> rungs;
    // About how long all of it may take; 0: as long as it takes. Half of it goes to the reference,
    // which gets as many of the samples, and then of the pixels, as fit; rungs that are then too slow are left out.
    double time_ms = 0;
    // Told what is done now; may be empty.
    std::function<void(const std::string&)> on_step;
};

// Renders a scene as it says, nothing kept from an earlier render; the caller has the renderer. Is
// called from the thread that measures.
using RenderScene = std::function<Result<Rendered>(const Scene&, const Deadline&)>;

// The errors are measured with the reference's own rays, the times at the scene's own size.
// A ground lies under the pictures as the sky does; it is no part of the errors but by its light in the cloud.
// Errors: of `render` and of trace_truth; kInvalidScene at /accuracy/rung for a name that is no rung's.
Result<AccuracyReport> measure_accuracy(const Scene& scene, const AccuracyOptions& options,
                                        const RenderScene& render, const Progress& progress,
                                        const Deadline& deadline);

}  // namespace awan
