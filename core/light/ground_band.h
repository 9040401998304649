// What goes between a cloud and the ground below it, there and back until it is spent.
#pragma once

#include <functional>
#include <span>

#include "core/base/result.h"
#include "core/light/ground_gather.h"
#include "core/light/sweep.h"
#include "core/light/transport_light.h"

namespace awan {

// Solves for light that enters the grid from below, in the matter as `channel` (0 1 2; any for grey matter) has it.
using SolveFromBelow = std::function<Result<LightBand>(const InflowFromBelow& inflow, int channel)>;

// The grid of a cloud and its matter.
struct CloudGrid {
    glm::dvec3 origin{0};  // corner of cell 0, scene units
    glm::dvec3 cell{0};    // sides, scene units
    glm::ivec3 cells{0};
    std::span<const float> depth;  // of each cell: extinction (all of it) x its shortest side
    double scaled = 1;             // share of it that dims light: what is not the forward peak's
};

// What the sun's beam leaves in a cloud, to be scattered once.
struct BeamSource {
    // Of each cell: extinction x side x irradiance 1 (beam_source of part_matter.h); EMPTY: there is no beam.
    std::span<const float> left{};
    glm::dvec3 sun{0};               // irradiance
    glm::dvec3 direction{0, -1, 0};  // the way the light goes, unit
    std::array<double, kOrders>
        moment{};       // Legendre moments of scattering outside the peak, times 1 - f
    double albedo = 1;  // where cell_albedo is EMPTY
    std::span<const glm::vec3> cell_albedo{};
};

// A cloud that shines as `bands` say, their colours in, plus what it scatters of the beam.
CloudAbove cloud_above(const CloudGrid& grid, std::span<const LightBand> bands,
                       const BeamSource& beam);

// A cloud over its ground, both lit from outside, with nothing between them yet.
struct GroundExchange {
    const CloudGrid& cloud;
    std::span<const LightBand> bands;  // the cloud's light from outside
    const BeamSource& beam;
    const GroundLight& ground;  // with its sun, shadow and sky
    const SkyDome& sky;
    bool colored;     // whether the matter differs from channel to channel
    bool into_cloud;  // whether the ground lights the cloud
    bool shadow;      // whether the cloud shades and lights the ground
    int rays;         // with which what it sends down is gathered (ground_gather.h)
    int threads;
};

struct GroundAndCloud {
    GroundChange change;  // what the cloud sends down, less what it hides of the sky
    std::vector<GroundLight::ChangeAbove> above;  // the same at the heights of hills
    std::vector<LightBand> into_cloud;            // the ground's light in the cloud
};

// In grey matter the ground's light is one band, of the colour that the cloud's middle sees; its luminance is right
// everywhere. In coloured matter it is a band a channel.
// Light that goes from the ground to the cloud and back does so again and again, each time weaker. The first and the
// second such bounce are computed; the rest is taken as the geometric series that the two begin.
Result<GroundAndCloud> ground_and_cloud(const GroundExchange& exchange,
                                        const SolveFromBelow& solve);

}  // namespace awan
