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
    // Mean side of a cell, weighted by the area in the picture, scene units.
    double cell = 0;
};
IslandWork island_work(const TransportSettings& settings, const Scene& scene, const Survey& survey);

// Cells along the longest side of the grid of a rung that has so many by its name (spread_count).
int grid_count(const Survey& survey, int cells);

inline constexpr std::array kErrorFigureNames = {
    "one",     "thin",       "thick",         "cell_depth", "g",           "g2",
    "backlit", "g2_backlit", "coarseness",    "inside",     "sun_share",   "absorbed",
    "thin_g",  "thick_g",    "thick_backlit", "thick2",     "cell_depth2", "thin2",
    "detail",  "ground",     "haze",          "islands"};
inline constexpr std::size_t kErrorFigureCount = kErrorFigureNames.size();
using ErrorFigures = std::array<double, kErrorFigureCount>;
// Of these names:
//   one, g2            1; the square of g, the mean cosine of the phase function
//   g                  its size |g|
//   thin, thick        log(depth / (1 + depth)) and log(1 + depth), depth: the largest optical depth towards the eye
//   cell_depth         log(1 + depth of the densest cell of the transport grid), scaled for forward scattering
//   backlit            how far one looks into the sun: cosine^2, 0 where it is behind
//   coarseness         log2 of the grid's cell over the particles' mean s
//   inside, islands    1 where the eye is within a particle; where the scene falls apart into islands
//   sun_share, ground  the sun's share of the light; the ground's
//   absorbed           log10 of 1 - albedo, from 0 up
//   detail             the amount of detail that is asked for
//   haze               what haze takes of the light of the cloud
// and products and squares of them, as the other names say.
ErrorFigures error_figures(const Rung& rung, const Scene& scene, const Survey& survey);

// Pixels between which the march takes the light from its neighbours, about.
inline constexpr double kMostLookedUp = 3000;

inline constexpr std::array kTimeFigureNames = {
    "one",         "covered", "particles", "pairs",  "pixels",  "unknowns", "updates",
    "scatterings", "lumps",   "air",       "detail", "lookups", "fine",     "faces"};
inline constexpr std::size_t kTimeFigureCount = kTimeFigureNames.size();
using TimeFigures = std::array<double, kTimeFigureCount>;
// Of these names:
//   one                  1
//   pixels, covered      of the picture; of these, those that meet cloud
//   particles, pairs     all; pairs of a pixel and a particle that it sees
//   unknowns             cells x bands x harmonics of the transport grid, times the sweeps through it
//   updates              of cells, where particles are summed on lattices
//   scatterings          paths x (4 + scatterings of a path); rung truth
//   lumps                samples of detail along the rays that meet cloud
//   air                  pixels that are seen through haze
//   detail               1 where there is detail
//   lookups              pairs that are looked at for the light, of at most kMostLookedUp pixels: the more the deeper
//   fine                 as unknowns, of the sun's solve on fine cells; 0 without detail
//   faces                unknowns of one sweep, to the power of 2/3
// samples: paths a pixel of rung truth.
TimeFigures time_figures(const Rung& rung, const Scene& scene, const Survey& survey,
                         std::uint32_t samples);

// Of measuring the error of a picture (core/climb.h) of any rung but truth: of one of the pictures of a sample of
// blocks that are made for it, and of its light; of a rung without a grid that of the coarsest, which is solved for it.
TimeFigures measuring_figures(const Rung& rung, const Scene& scene, const Survey& survey);

}  // namespace awan
