// What accuracy costs: every rung of a scene with its time and its error against the truth.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/pipeline.h"
#include "core/progress.h"
#include "core/truth/error_measures.h"

namespace awan {

struct RungCost {
    std::string rung;
    double time_ms = 0;                // median of whole renders at the scene's own size
    double light_ms = 0, draw_ms = 0;  // of the median run
    PictureError error;                // against the reference, at its size
    double flip = 0;                   // of the PNGs, sky behind, at the reference's size; 0..1
    double predicted_error = 0, predicted_time_ms = 0;  // what the plan says
    double memory_bytes = 0;  // resident set it added at its peak, estimate of the plan or measured
    bool pareto = false;      // no other rung is both faster and better
    Image picture;            // at the reference's size, with the scene's background
};

struct AccuracyReport {
    int width = 0, height = 0;  // of the timed renders: the scene's own
    struct Reference {
        int width = 0, height = 0;
        std::uint32_t samples = 0;  // paths a pixel
        double noise = 0;           // PictureError::truth_noise
        double time_ms = 0, cpu_ms = 0;
        Image picture;
    } reference;
    std::vector<RungCost> rungs;  // cheapest first
};

struct AccuracyOptions {
    int threads = 1;
    int runs = 3;                    // timed renders of each rung; the first of each is not counted
    int reference_side = 128;        // pixels of the reference's longer side, at most the scene's
    std::uint32_t samples = 1024;    // paths a pixel of the reference
    std::vector<std::string> rungs;  // EMPTY: all but truth, which is the reference
};

// Renders a scene as it says; the caller has the renderer. May be called from this thread only.
using RenderScene = std::function<Result<Rendered>(const Scene&, const Deadline&)>;

Result<AccuracyReport> measure_accuracy(const Scene& scene, const AccuracyOptions& options,
                                        const RenderScene& render, const Progress& progress,
                                        const Deadline& deadline);

}  // namespace awan
