// What goes between a cloud and the ground below it, there and back until it is spent.
#pragma once

#include <functional>

#include "core/light/ground_gather.h"
#include "core/light/sweep.h"
#include "core/light/transport.h"

namespace awan {

// Solves for light that enters the grid from below, in the matter as `channel` (0 1 2; any for grey matter) has it.
using SolveFromBelow = std::function<Result<LightBand>(const InflowFromBelow& inflow, int channel)>;

// A cloud that shines as light.bands say, colours in, plus `beam`: what the sun's beam leaves in each cell
// (extinction x side x irradiance 1; EMPTY: none), scattered by moments chi_l (0..3) without the peak and albedo.
struct BeamSource {
    const std::vector<float>* left = nullptr;  // null: none
    glm::dvec3 sun{0};                         // irradiance
    glm::dvec3 direction{0, -1, 0};            // the way the light goes
    std::array<double, 4> moment{};            // times 1 - f
    double albedo = 1;                         // where light.albedo is EMPTY
};
CloudAbove cloud_above(const TransportLight& light, const std::vector<float>& depth, double scaled,
                       std::size_t first_band, const BeamSource& beam);

// Fills light.ground.change with what the cloud sends down and hides of the sky (settings.ground_shadow) and appends the
// ground's light in the cloud to light.bands (settings.ground): one band in grey matter, of one colour, whose luminance
// is right everywhere; else one a channel. Bounces between the two are followed once and summed as the geometric series that the
// second and the third make. Preconditions: light.ground has its sun and sky, light has its bands.
Status ground_and_cloud(const SkyDome& sky, const std::vector<float>& depth, double scaled,
                        const BeamSource& beam, bool colored, const TransportSettings& settings,
                        const SolveFromBelow& solve, int threads, TransportLight& light);

}  // namespace awan
