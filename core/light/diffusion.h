// The diffusion limit of transport, as a preconditioner: sweeps settle what happens over a few mean free
// paths, diffusion what happens over many ("diffusion synthetic acceleration", Alcouffe 1977; inside a Krylov
// solver it need not be consistent with the sweep: Warsa, Wareing & Morel 2004).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace awan {

// Seven-point operator on cubic cells, in units of the cell's side: sum over faces of conductance x difference, plus
// absorption; light leaves through the sides of the grid.
struct Diffusion {
    glm::ivec3 cells{0};
    std::vector<float> across[3];  // conductance to the next cell along x, y, z (0 after the last)
    std::vector<float> diagonal;   // sum of conductances, absorption and what leaves the grid
};

// depth: of each cell, extinction x side; scattered: the part of it that is scattered; forward: mean
// cosine of that scattering.
Diffusion make_diffusion(const glm::ivec3& cells, std::span<const float> depth,
                         std::span<const float> scattered, double forward);

// Solves for `value` by conjugate gradients until the residual is `tolerance` of the source, at most
// kMaxDiffusionSteps.
void solve_diffusion(const Diffusion& diffusion, std::span<const float> source, double tolerance,
                     std::span<float> value);

inline constexpr int kMaxDiffusionSteps = 200;

}  // namespace awan
