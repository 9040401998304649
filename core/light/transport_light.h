// The light in a cloud as the transport solve leaves it and the eye pass takes it. Values only.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "core/light/ground_light.h"
#include "core/light/harmonics.h"
#include "core/light/sun_depth.h"
#include "core/plan/effect_times.h"
#include "core/plan/transport_settings.h"
#include "core/survey/islands.h"

namespace awan {

// One part of the light: its colour, and its shape in space and angle. What a pixel gets is the sum over bands of
// color * radiance.
struct LightBand {
    glm::vec3 color{1};  // r g b
    // Source function of each cell (x fastest, then y, then z), radiance per unit optical depth of ALL extinction:
    // toward direction o (from the cell, unit, the way the light goes) it is sum_i moments[cell][i] * Y_i(o).
    std::vector<std::array<float, kHarmonics>> moments;
    // The largest source function that can be right. Sky light alone nowhere makes a source brighter than what
    // comes in, but the discrete ordinates overshoot that by a few percent: the eye pass cuts the source off here.
    float most = std::numeric_limits<float>::infinity();
};

// Bands on finer cells than those of the grid, where lumps of detail are too small for these.
struct FineLight {
    // As in TransportLight.
    glm::dvec3 origin{0};
    glm::dvec3 cell{0};
    glm::ivec3 cells{0};
    struct Band {
        std::size_t index;  // of the band in TransportLight::bands whose place it takes
        LightBand band;
    };
    std::vector<Band> bands;  // by index; EMPTY: there is no such light
};

struct LightIsland;
struct TransportLight;
using SharedLight = std::shared_ptr<const TransportLight>;

// The light of a scene. It does not depend on the view: it is kept while the camera moves.
struct TransportLight {
    // Corner of cell 0, scene units. Light at a point is interpolated trilinearly between the centres of cells;
    // outside of them it is that of the nearest.
    glm::dvec3 origin{0};
    // Sides of a cell, scene units. 0: there is no grid (rung `single`). Where rung `single` has particles with
    // colours there is a grid, but without bands: it only holds `albedo`.
    glm::dvec3 cell{0};
    glm::ivec3 cells{0};
    bool has_grid() const { return cell.x > 0; }
    std::vector<LightBand> bands;
    FineLight fine;
    // Of each cell, for the sun's beam; EMPTY: medium.albedo everywhere.
    std::vector<glm::vec3> albedo;
    SunDepth sun;
    // L + 1: the forward peak holds the Legendre orders of the phase function from here on.
    int peak_from = 4;
    // f = chi_(L+1), for Henyey-Greenstein g^(L+1): the share of scattering that is taken as the forward peak. Radiance
    // from `bands` is dimmed towards the eye by exp(-(1 - albedo f) tau), not by exp(-tau).
    double peak_share = 0;
    // The light of the next coarser grid: by how much the two differ says how far both may be from the truth. Null:
    // there is none.
    SharedLight coarser;
    // Of each band, its moments as they were solved, before they gained by `coarser`: what a finer grid goes on from.
    // EMPTY: as the bands have them, or no finer grid will be asked for.
    std::vector<std::vector<std::array<float, kHarmonics>>> solved;
    IslandCells asked;    // the cells that its settings asked for
    bool sky = true;      // whether the sky's light is in it, as TransportSettings asked
    GroundLight ground;   // of a scene that has one, as TransportSettings asked
    int sweeps = 0;       // transport sweeps it took, all bands
    double residual = 0;  // of the solve, relative; the largest of the bands
    EffectTimes took;     // of the parts of the solve; says nothing of the light

    // A scene that falls apart has the parts that are seen once more, each on a finer grid of its own. All of the
    // above is then the whole scene on a coarse grid, for use where there is no finer light (core/light/islands.h).
    Islands regions;
    std::vector<LightIsland> islands;  // one for each of regions.list, or EMPTY

    // A copy but for the islands.
    TransportLight of_whole() const;

    std::size_t bytes() const;  // memory it holds, its own size included
};

// The light of one region. Its SunDepth counts all matter between it and the sun, that of other regions too.
struct LightIsland {
    bool lit = false;  // false: it is not seen, and `light` is empty
    TransportLight light;
    glm::dvec3 low{0}, high{0};  // corners of a box that holds its matter, scene units
    double mean_s = 0;           // mean standard deviation of its particles, scene units
};

}  // namespace awan
