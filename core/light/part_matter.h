// The matter of one part of a scene, on the grid of its transport solve.
#pragma once

#include <vector>

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/light/delta_m.h"
#include "core/light/sun_depth.h"
#include "core/light/sweep.h"
#include "core/light/transport_part.h"
#include "core/survey/lattice.h"

namespace awan {

// Mean extinction on the solve's grid, and on a finer one, whose cells are those of the grid cut in `sub` along each
// side.
struct PartGrid {
    Lattice lattice;
    std::vector<float> extinction;  // of each cell, 1/unit
    int sub = 1;
    Lattice fine;
    std::vector<float> fine_extinction;  // of each fine cell, 1/unit
    double detail_ms = 0;                // time that detail took
};

// The grid lies around part.own and has as many cells as cubes would be, `cells` of them along its longest side, but as
// flat as the matter is (fitted_cells), and fewer where filling it would be too much work. From above, nothing under
// the ground is there: `floor` is its height, -infinity without one.
PartGrid grid_of_part(const LightPart& part, int cells, double floor, int threads);

// The light that the sun's beam, of irradiance 1, leaves in each cell: (all extinction) x shortest side x the mean over
// the cell of exp(-scaled depth from the sun). `scaled`: the share of the depth that dims light (delta_m.h). All 0
// where the deadline passed.
std::vector<float> beam_source(const PartGrid& grid, const SunDepth& sun, double scaled,
                               int threads, const Deadline& deadline);

// Albedo of each cell, r g b: that of the particles in it, each by its share of the extinction. `white`: of particles
// without a colour of their own.
std::vector<glm::vec3> colored_albedo(const ParticleSet& particles, const Lattice& lattice,
                                      const std::vector<float>& extinction, double white,
                                      int threads);

// Matter as one channel of the light meets it: a medium with the forward peak taken out.
struct Matter {
    SweepGrid grid;
    std::vector<float> albedo;  // of each cell
    // Of each cell: the scaled depth of its shortest side times the albedo of p'.
    std::vector<float> scattered;
};

// albedo: of each cell (colored_albedo), of which channel 0, 1 or 2 is taken; EMPTY: split.albedo everywhere.
Matter matter_of(const PartGrid& grid, const ScatteringSplit& split,
                 const std::vector<glm::vec3>& albedo, int channel);

}  // namespace awan
