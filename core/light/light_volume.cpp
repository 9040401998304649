#include "core/light/light_volume.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/light/nested_grids.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// Cells whose moments are held at a time: 64 bytes each.
constexpr std::size_t kAtOnce = 1u << 18;

constexpr double kWhole = 4 * std::numbers::pi;

// Albedo of the matter at a place, for the sun's light.
glm::dvec3 albedo_at(const TransportLight& light, double usual, const glm::dvec3& place) {
    if (light.albedo.empty()) return glm::dvec3(usual);
    const glm::ivec3 cell = glm::clamp(glm::ivec3(glm::floor((place - light.origin) / light.cell)),
                                       glm::ivec3(0), light.cells - 1);
    return glm::dvec3(light.albedo[static_cast<std::size_t>(
        (cell.z * light.cells.y + cell.y) * light.cells.x + cell.x)]);
}

}  // namespace

// With S_0 the moment of the source function that is even in all directions, Y_0 = (4 pi)^(-1/2), f the forward peak's
// share and k = 1 - a f (delta_m.h), the source function's mean is S_0 Y_0 outside the peak. The peak's light is taken
// to go straight on; it is a share f of what is scattered, so that all of it is S_0 Y_0 / (1 - f). To that comes the
// sun's, a E exp(-k tau) / 4 pi, with E its irradiance and tau the optical depth towards it.
std::vector<float> light_volume(const Scene& scene, const TransportLight& light,
                                const DensityVolume& volume, int threads) {
    std::vector<float> to(volume.extinction.size());
    const auto row = static_cast<std::size_t>(volume.cells.x),
               layer = row * static_cast<std::size_t>(volume.cells.y);
    if (layer == 0) return to;
    const glm::dvec3 sun = outside_of(scene).sun;
    const double albedo = scene->medium.albedo, scaled = 1 - albedo * light.peak_share;
    const double even = 1 / std::sqrt(kWhole) / (1 - light.peak_share);
    const glm::dmat3 nodes = light.sun.depth.empty() ? glm::dmat3(1) : to_nodes(light.sun);
    const std::size_t layers = std::max<std::size_t>(kAtOnce / layer, 1);
    for (std::size_t first = 0; first < static_cast<std::size_t>(volume.cells.z); first += layers) {
        TransportLight part;  // the place of these layers
        part.origin = volume.origin + glm::dvec3(0, 0, static_cast<double>(first) * volume.cell);
        part.cell = glm::dvec3(volume.cell);
        part.cells = volume.cells;
        part.cells.z =
            static_cast<int>(std::min(layers, static_cast<std::size_t>(volume.cells.z) - first));
        float* const out = to.data() + first * layer;
        const float* const extinction = volume.extinction.data() + first * layer;
        for (std::size_t b = 0; b < light.bands.size(); ++b) {
            const auto moments = moments_between(light, b, part, threads);
            const double color = luminance(glm::dvec3(light.bands[b].color)) * even;
            for (std::size_t i = 0; i < moments.size(); ++i)
                out[i] += static_cast<float>(color * static_cast<double>(moments[i][0]));
        }
        parallel_for(
            threads, layer / row * static_cast<std::size_t>(part.cells.z), [&](std::size_t line) {
                const auto ny = static_cast<std::size_t>(part.cells.y);
                for (std::size_t x = 0; x < row; ++x) {
                    const std::size_t i = line * row + x;
                    if (!(extinction[i] > 0)) {
                        out[i] = 0;
                        continue;
                    }
                    const glm::dvec3 place =
                        part.origin + part.cell * (glm::dvec3(static_cast<double>(x),
                                                              static_cast<double>(line % ny),
                                                              static_cast<double>(line / ny)) +
                                                   0.5);
                    const double lit = exact::exp(-scaled * depth_at(light.sun, nodes, place));
                    const double direct =
                        luminance(sun * albedo_at(light, albedo, place)) * lit / kWhole;
                    out[i] = std::max(out[i] + static_cast<float>(direct), 0.0F);
                }
            });
    }
    return to;
}

}  // namespace awan
