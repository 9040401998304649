// What forecasts are made from: a few bounded numbers of a scene, the same for fitting and for use.
#pragma once

#include <array>
#include <cstdint>

#include "core/plan/transport_settings.h"
#include "core/scene/rungs.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// What the islands of a scene cost together, the coarse solve of the whole included. All 0 without islands' cells.
struct IslandWork {
    double cells = 0;    // of all grids
    double largest = 0;  // of the largest
    double nodes = 0;    // of all SunDepths
    double updates = 0;  // cell updates of all lattices
    double cell = 0;     // mean side of a cell, weighted by the area in the picture, scene units
};
IslandWork island_work(const TransportSettings& settings, const Scene& scene, const Survey& survey);

inline constexpr std::array kErrorFigureNames = {
    "one",     "thin",       "thick",         "cell_depth", "g",           "g2",
    "backlit", "g2_backlit", "coarseness",    "inside",     "sun_share",   "absorbed",
    "thin_g",  "thick_g",    "thick_backlit", "thick2",     "cell_depth2", "thin2",
    "detail",  "ground",     "haze",          "islands"};
inline constexpr std::size_t kErrorFigureCount = kErrorFigureNames.size();
using ErrorFigures = std::array<double, kErrorFigureCount>;
// 1; log of depth / (1 + depth) and log(1 + depth) towards the eye; log(1 + scaled depth of the densest cell); |g|; g^2;
// how far one looks into the sun (cosine^2, 0 when it is behind); that times g^2; log2 of cell over mean s; eye inside;
// the sun's share of the light; log10 of what is absorbed; products of these; the amount of detail; the ground's share of the
// light; what haze takes of the cloud; whether there are islands.
ErrorFigures error_figures(const Rung& rung, const Scene& scene, const Survey& survey);

inline constexpr std::array kTimeFigureNames = {"one",    "covered",  "particles", "pairs",
                                                "pixels", "unknowns", "updates",   "scatterings",
                                                "lumps",  "air",      "detail"};
inline constexpr std::size_t kTimeFigureCount = kTimeFigureNames.size();
using TimeFigures = std::array<double, kTimeFigureCount>;
// 1; pixels that meet cloud; particles; pixel-particle pairs; pixels; cells x bands x harmonics of the transport grid x its sweeps;
// cell updates of its lattices; paths x (1 + scatterings); samples of detail along the rays that meet cloud; pixels seen through
// haze; whether there is detail.
TimeFigures time_figures(const Rung& rung, const Scene& scene, const Survey& survey,
                         std::uint32_t samples);

}  // namespace awan
