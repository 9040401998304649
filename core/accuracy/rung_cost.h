// One rung's time and its error against the reference.
#pragma once

#include <vector>

#include "core/accuracy/accuracy.h"
#include "core/accuracy/reference.h"
#include "core/accuracy/steps.h"
#include "core/scene/rungs.h"

namespace awan {

// What the rungs of one scene are measured with. All of it outlives the measuring.
struct RungMeasurement {
    // Times are measured at this scene's size; errors and pictures at the reference's.
    const Scene& scene;
    const Reference& reference;
    const AccuracyOptions& options;
    const RenderScene& render;
    // Told of the step that was begun last.
    const Steps& steps;
    // What brings the pictures to the screen.
    FilmSettings film;
};

// All of RungCost but `pareto`. forecast: what was predicted of this rung; null: nothing, its figures are NaN then.
// Errors: of the render.
Result<RungCost> measure_rung(const RungMeasurement& with, const Rung& rung,
                              const RungForecast* forecast, const Deadline& deadline);

// About what measure_rung takes, with a reference of size `small`. forecast: as there.
double measuring_ms(const RungForecast* forecast, const Scene& scene, PictureSize small, int runs);

// Marks the rungs that no other one beats in both time and error.
void mark_pareto(std::vector<RungCost>& rungs);

}  // namespace awan
