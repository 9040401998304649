// What a rung will cost and how wrong it will be, from the survey's figures.
#pragma once

#include <cstdint>

#include "core/scene/rungs.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Threads with which times were calibrated.
inline constexpr int kCalibratedThreads = 2;

// How much slower this machine is than the one on which times were calibrated: 1 is the same.
struct MachineSpeed {
    double slowness = 1;
};

// What a rung would cost this scene and how far it would be from the truth.
struct RungForecast {
    const Rung* rung = nullptr;
    // Relative (PictureError::nrmse, core/accuracy/error_measures.h): what will about be stated of the picture once it
    // is made (core/climb.h); in three scenes of five no more. Of truth, its noise.
    double error = 0;
    // Of all stages but queue and encode, on this machine.
    double time_ms = 0;
    // Memory at its peak, beside the scene's particles and the picture.
    double bytes = 0;
    // Of time_ms, the light and what follows it, of rungs of Method::kMarch; and measuring the error, of all but paths.
    double light_ms = 0, draw_ms = 0, measure_ms = 0;

    // Where nothing is measured.
    double picture_ms() const { return time_ms - measure_ms; }
};

// The most pixels of a picture with which errors are measured (core/climb.h); of a larger one every third, fifth, ...
// of each row is looked at.
inline constexpr double kMostMeasuredPixels = 640 * 480;
// Blocks of 16 x 16 of them that are marched: lights on two grids differ alike over some pixels, so that the mean over
// so many places is known to a tenth. A rung without a grid leaves out what it does all over the picture: fewer do.
inline constexpr int kMeasuredBlocks = 128, kMeasuredBlocksWithoutGrid = 64;
// Pictures that are made for it, at most: of a grid and the two before it.
inline constexpr int kMeasuringPictures = 3;

// Of one rung; `samples`: paths a pixel, for rung truth only. threads: of the march and the paths.
RungForecast forecast(const Rung& rung, const Scene& scene, const Survey& survey,
                      std::uint32_t samples, int threads, const MachineSpeed& speed);

// Paths a pixel with which rung truth is predicted to have the noise `error`; even, 2..kMaxTruthSamples.
std::uint32_t samples_for(double error, const Scene& scene, const Survey& survey);
inline constexpr std::uint32_t kMaxTruthSamples = 1u << 20;

}  // namespace awan
