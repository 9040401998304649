// Pass 1 of the transport rungs: all orders of scattering by discrete ordinates on a grid. No GL.
//
// The sun's beam and the light scattered from it only within the phase function's forward peak are not on the
// grid: the eye pass (core/draw/march.h) has them exactly, from SunDepth. The grid holds the rest: light
// scattered out of the peak at least once before it meets its last particle, and all of the sky's.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/light/ground_light.h"
#include "core/plan/effect_times.h"
#include "core/plan/transport_settings.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Optical depth from the sun (all extinction, the peak's too) at the nodes of a lattice that faces it.
// Node (i, j, k) stands at origin + cell * (i u + j v + k w). Between nodes: trilinear. Outside: the
// nearest node's (the lattice holds the cloud, so depth is 0 before it and constant after it along w).
struct SunDepth {
    glm::dvec3 origin{0};                           // scene units
    glm::dvec3 u{1, 0, 0}, v{0, 1, 0}, w{0, 0, 1};  // orthonormal; w is the way the light goes
    double cell = 0;                                // scene units
    glm::ivec3 nodes{0};
    std::vector<float> depth;  // i fastest, then j, then k
};

// Real spherical harmonics up to l = 3, in the order l^2 + l + m, normalised so that the integral of
// each one's square over the sphere is 1 (core/light/harmonics.h).
inline constexpr int kHarmonics = 16;

// One part of the light: its colour, and its shape in space and angle.
struct LightBand {
    glm::vec3 color{
        1};  // r g b of this part; what a pixel gets is the sum over bands of color * radiance
    // Source function of each cell (x fastest, then y, then z), radiance per unit optical depth of ALL extinction:
    // toward direction o (from the cell, unit, the way the light goes) it is sum_i moments[cell][i] * Y_i(o).
    std::vector<std::array<float, kHarmonics>> moments;
    // Of sky light alone no source is brighter than what comes in; the ordinates' may be, by a few percent. The eye pass
    // takes no more than this.
    float most = std::numeric_limits<float>::infinity();
};

struct LightIsland;

// View-independent: kept while the camera moves.
struct TransportLight {
    glm::dvec3 origin{
        0};  // corner of cell 0, scene units; light at a point: trilinear between cell centres, clamped outside
    double cell =
        0;  // side of a cubic cell, scene units; 0: there is no grid (rung `single`, unless particles have colours:
            // then there are no bands, only `albedo`)
    glm::ivec3 cells{0};
    std::vector<LightBand> bands;
    std::vector<glm::vec3> albedo;  // of each cell, for the beam; EMPTY: medium.albedo everywhere
    SunDepth sun;
    int peak_from = 4;  // L + 1: the peak holds the orders from here on
    double peak_share =
        0;  // f = g^(L+1): the share of scattering that is taken as the forward peak. Radiance from
            // `bands` is dimmed towards the eye by exp(-(1 - albedo f) tau), not exp(-tau)
    bool sky = true;      // whether the sky's light is in it, as TransportSettings asked
    GroundLight ground;   // of a scene that has one; as TransportSettings asked
    int sweeps = 0;       // transport sweeps it took, all bands
    double residual = 0;  // of the solve, relative; largest of the bands
    EffectTimes took;     // of the solve's parts; says nothing of the light

    // Of a scene that falls apart, the parts that are seen, more finely; all above is then of the whole, coarsely, and good
    // where no finer light is (core/light/islands.h).
    Islands regions;
    std::vector<LightIsland> islands;  // one for each of regions.list, or EMPTY

    std::size_t bytes() const;  // memory it holds
};

// The light of one region. Its SunDepth counts all matter before it, whose ever it is.
struct LightIsland {
    bool lit = false;  // false: it is not seen, and `light` is empty
    TransportLight light;
    glm::dvec3 low{0}, high{0};  // holds its matter, scene units
    double mean_s = 0;           // of its particles
};

// Errors: kOverDeadline, kCancelled. The same bytes for every number of threads. Time: cells^3 and particles; memory: see
// transport_bytes.
Result<TransportLight> transport_light(const Scene& scene, const ParticleSet& particles,
                                       const Survey& survey, const TransportSettings& settings,
                                       int threads, const Deadline& deadline);

}  // namespace awan
