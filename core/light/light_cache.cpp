#include "core/light/light_cache.h"

#include <bit>
#include <cstdint>

#include "core/scene/fingerprint.h"

namespace awan {

// The settings are taken apart by name, so that one that is added to them does not compile until it is in the key.
std::string light_key(const Scene& scene, const TransportSettings& settings, std::uint64_t variant,
                      const DetailField* detail) {
    const auto& [cells, sun_cells, tolerance, max_sweeps, sky, ground, ground_shadow, sky_once,
                 last, islands] = settings;
    std::string key = light_fingerprint(scene);
    const auto add = [&](std::uint64_t value) { key += ':' + std::to_string(value); };
    add(variant);
    add(static_cast<std::uint64_t>(cells));
    add(static_cast<std::uint64_t>(sun_cells));
    add(std::bit_cast<std::uint64_t>(tolerance));
    add(static_cast<std::uint64_t>(max_sweeps));
    add(sky ? 1 : 0);
    add(ground ? 1 : 0);
    add(ground_shadow ? 1 : 0);
    add(sky_once ? 1 : 0);
    add(last ? 1 : 0);
    add(islands.size());
    for (const auto& [own_cells, own_sun_cells] : islands) {
        add(static_cast<std::uint64_t>(own_cells));
        add(static_cast<std::uint64_t>(own_sun_cells));
    }
    if (detail != nullptr) {
        const auto add_number = [&](double value) { add(std::bit_cast<std::uint64_t>(value)); };
        // The seed of its tile is the scene's, even where each cloud has one of its own.
        add(scene->seed);
        for (int axis = 0; axis < 3; ++axis) add_number(detail->origin[axis]);
        add_number(detail->bump);
        add_number(detail->edge);
        add_number(detail->keep);
    }
    return key;
}

}  // namespace awan
