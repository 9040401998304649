// The diffusion limit of transport, as a preconditioner. Sweeps settle what happens over a few mean free paths,
// diffusion what happens over many: "diffusion synthetic acceleration" (Alcouffe 1977). Within a Krylov solver such as
// GMRES its discretisation need not be consistent with the sweep's (Warsa, Wareing & Morel 2004).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace awan {

// The seven-point operator on cells, in units of the cell's shortest side: to each cell
//     sum over faces of conductance * (own value - neighbour's) + absorption * own value,
// where light leaves through the outer faces of the grid.
struct Diffusion {
    glm::ivec3 cells{0};
    std::vector<float> across[3];  // conductance to the next cell along x, y, z (0 after the last)
    std::vector<float> diagonal;   // sum of conductances, absorption and what leaves the grid
    // The same on ever coarser cells, each of up to 2 x 2 x 2 of the one before, whose `coarser` is EMPTY.
    std::vector<Diffusion> coarser;
};

// sides: of a cell, in units of the shortest; depth: of each cell, extinction x shortest side; scattered: the part of
// it that is scattered; forward: the mean cosine of that scattering. With the transport depth t = depth - forward *
// scattered, a face between cells of side h conducts
//     1 / (3/2 h (t + t') + kStreaming) / h.
Diffusion make_diffusion(const glm::ivec3& cells, const glm::vec3& sides,
                         std::span<const float> depth, std::span<const float> scattered,
                         double forward);

// Solves for `value` by conjugate gradients until the residual is `tolerance` of the source, at most
// kMaxDiffusionSteps. Their preconditioner is a V-cycle through the coarser cells (Briggs, Henson & McCormick 2000):
// light that spreads over many cells is settled on few. The same bytes for every number of threads.
void solve_diffusion(const Diffusion& diffusion, std::span<const float> source, double tolerance,
                     std::span<float> value, int threads = 1);

inline constexpr int kMaxDiffusionSteps = 60;

}  // namespace awan
