#include "core/light/transport_light.h"

namespace awan {

TransportLight TransportLight::of_whole() const {
    return {.origin = origin,
            .cell = cell,
            .cells = cells,
            .bands = bands,
            .fine = fine,
            .albedo = albedo,
            .sun = sun,
            .peak_from = peak_from,
            .peak_share = peak_share,
            .coarser = coarser,
            .solved = solved,
            .asked = asked,
            .sky = sky,
            .ground = ground,
            .sweeps = sweeps,
            .residual = residual,
            .took = took,
            .regions = regions,
            .islands = {}};
}

std::size_t TransportLight::bytes() const {
    std::size_t bytes = sizeof *this + sun.depth.capacity() * sizeof(float) +
                        albedo.capacity() * sizeof(glm::vec3) + ground.bytes();
    bytes += bands.capacity() * sizeof(LightBand);
    for (const LightBand& band : bands) bytes += band.moments.capacity() * sizeof(band.moments[0]);
    bytes += fine.bands.capacity() * sizeof(FineLight::Band);
    for (const FineLight::Band& one : fine.bands)
        bytes += one.band.moments.capacity() * sizeof(one.band.moments[0]);
    bytes +=
        regions.nodes.capacity() * sizeof(IslandNode) + regions.list.capacity() * sizeof(Island);
    // Room for islands that is not in use yet, and those in use, whose `light` counts its own size.
    bytes += (islands.capacity() - islands.size()) * sizeof(LightIsland);
    if (coarser) bytes += coarser->bytes();
    for (const auto& moments : solved)
        bytes += sizeof moments + moments.capacity() * sizeof(moments[0]);
    for (const LightIsland& island : islands)
        bytes += sizeof island - sizeof island.light + island.light.bytes();
    return bytes;
}

}  // namespace awan
