// The light that a cloud sends down to the ground, gathered from the transport solution.
#pragma once

#include <array>
#include <vector>

#include "core/light/ground_light.h"
#include "core/light/harmonics.h"

namespace awan {

// A cloud as the ground sees it: cells (x fastest, then y, then z) that dim what is behind them and shine.
struct CloudAbove {
    glm::dvec3 origin{0};  // corner of cell 0, scene units
    glm::dvec3 cell{0};    // sides, scene units
    glm::ivec3 cells{0};
    std::vector<float> depth;  // of each cell: extinction (all of it) x its shortest side
    double scaled = 1;         // share of it that dims light: what is not the forward peak's
    // Source function, radiance per optical depth: toward direction o, sum_i source[cell][c * kHarmonics + i] * Y_i(o).
    std::vector<std::array<float, 3 * kHarmonics>> source;
};

// The same cloud with blocks of cells made one, so that no side of the grid has more than `most` cells.
CloudAbove coarser(CloudAbove cloud, int most);

// The nodes on the ground at which the cloud's light is gathered, with 0 at all of them.
GroundChange nodes_under(const CloudAbove& cloud, double height);

// Adds to each node of `change` the irradiance of the cloud's own light, less what the cloud hides of `sky` (null: it
// hides nothing), by so many rays a node, spread over the cone that holds the cloud.
void gather(const CloudAbove& cloud, const SkyDome* sky, double height, int rays, int threads,
            GroundChange& change);

// Rays a node of what is seen, and of what is weak beside it (a bounce) or only on the way to it. So few are within
// some percent of what many gather: pictures change by .04% to .08% of their range (root mean square).
inline constexpr int kGatherRays = 160, kFewGatherRays = 40;

}  // namespace awan
