// One transport solve: discrete ordinates with delta-M scaling (delta_m.h), weighted diamond differences (sweep.h) and
// GMRES (gmres.h) that is helped along by diffusion (diffusion.h).
#pragma once

#include <functional>
#include <span>

#include "core/base/deadline.h"
#include "core/light/delta_m.h"
#include "core/light/part_matter.h"
#include "core/light/sweep.h"
#include "core/light/transport_light.h"

namespace awan {

struct BandProblem {
    const Matter& matter;
    const ScatteringSplit& split;
    // As beam_source gives it; null: the sun does not shine.
    const std::vector<float>* beam = nullptr;
    glm::dvec3 beam_direction{0, -1, 0};  // the way the light goes, unit
    Inflow inflow{};                      // what comes in through the grid's faces; empty: nothing
    InflowFromBelow from_below{};         // and beside that; empty: nothing
    // The source function that the solve begins from, as SolvedBand::band has it; EMPTY: dark.
    std::vector<std::array<float, kHarmonics>> guess{};
    // Adds to `addition`, a number a cell, about what evenly scattered light of the strength `unsettled` becomes over
    // many mean free paths; EMPTY: by diffusion on the grid itself.
    std::function<void(std::span<const float> unsettled, std::span<float> addition)> spread{};
    double tolerance = 1e-3;  // of the residual, relative to the source
    int max_sweeps = 40;
    // Only light that has not been scattered before: the source function of what it scatters once.
    bool once = false;
};

struct SolvedBand {
    LightBand band;  // its moments; colour and `most` are the caller's to set
    int sweeps = 0;
    double residual = 0;  // relative
};

// With psi the radiance, Y_i the harmonics of order l(i), the scaled depth s of a cell's side, a the albedo and chi'_l
// the moments of scattering outside the peak, solves for the moments phi_i = integral of psi Y_i in
//     o . grad psi + s psi = sum_i Y_i(o) [ s a (1 - f) / (1 - a f) chi'_l(i) phi_i
//                                           + a (1 - f) chi'_l(i) Y_i(sun) beam ]
// and gives the source function: moments a (1 - f) chi'_l(i) phi_i. The sun's beam itself is not in it: the eye pass
// has what the beam scatters once (core/draw/march.h). Errors: kOverDeadline, kCancelled.
Result<SolvedBand> solve_band(const BandProblem& problem, const Ordinates& ordinates, int threads,
                              const Deadline& deadline);

}  // namespace awan
