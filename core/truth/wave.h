// Paths side by side, a structure of arrays: what walk.cpp steps from scattering to scattering, and the steps that all
// of them take alike, sixteen at a time (wave.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/truth/flight.h"
#include "core/truth/walk.h"

namespace awan::truth {

// Paths under way at a time: some work for every lane, and little memory. A multiple of the lanes.
inline constexpr std::size_t kWave = 256;

template <typename T>
using OfWave = std::array<T, kWave>;

// What a flight begins and ends with, for each path of a wave.
struct WaveFlights {
    alignas(64) OfWave<float> local[3];
    alignas(64) OfWave<std::int32_t> brick[3];
    alignas(64) OfWave<float> direction[3];
    alignas(64) OfWave<float> depth;
    alignas(64) OfWave<std::int32_t> met;

    Places places() {
        return {{brick[0].data(), brick[1].data(), brick[2].data()},
                {local[0].data(), local[1].data(), local[2].data()}};
    }
    glm::dvec3 along(std::size_t i) const {
        return {static_cast<double>(direction[0][i]), static_cast<double>(direction[1][i]),
                static_cast<double>(direction[2][i])};
    }
    void turn_to(std::size_t i, const glm::dvec3& d) {
        for (int a = 0; a < 3; ++a)
            direction[static_cast<std::size_t>(a)][i] = static_cast<float>(d[a]);
    }
};

struct Wave {
    // Those of 0..count - 1 are under way.
    std::size_t count = 0;
    WaveFlights path{};
    // Cells to the ground along the path.
    alignas(64) OfWave<float> ground{};
    alignas(64) OfWave<std::uint32_t> random[4]{};
    // r g b. absorbed: mean over them. tint: of the matter that it is in.
    alignas(64) OfWave<float> weight[3]{}, absorbed{}, tint[3]{};
    // Sum over the path's scatterings of its weight times what sunlight adds to it: radiance over the sun's irradiance
    // and 1 / (4 pi). lit: that of this scattering, before it is known whether lumps of detail shade it.
    alignas(64) OfWave<float> sunlight[3]{}, lit[3]{};
    alignas(64) OfWave<std::uint32_t> orders{};
    // All bits or none: whether it is in matter (else on the ground), and whether it has been absorbed.
    alignas(64) OfWave<std::int32_t> in_matter{}, gone{};
    // Of the last scatterings, the last first, what technique 1, 2, ... has in the balance heuristic's sum: its chance
    // over the phase value; 0: there were not so many. tried: the chance at this one.
    alignas(64) OfWave<float> shares[kMaxFromSun]{}, tried{};

    // A branch of the path that ends in directions from the sun's side: how many are left, 0: it has none or is over;
    // what the balance heuristic has of it.
    WaveFlights branch{};
    alignas(64) OfWave<float> from_sun[kMaxFromSun + 1][3]{};
    alignas(64) OfWave<std::int32_t> branch_left{};
    alignas(64) OfWave<float> branch_weight[3]{}, branch_sum{};

    // Not by lanes: light but the sun's; where on the ground it is (q).
    OfWave<glm::dvec3> other_light{}, on_ground{};
    OfWave<std::uint32_t> events{};
    OfWave<std::size_t> start{};
};

// What the steps know of a setting, in the lattice's axes.
struct WaveSetting {
    PhaseLaw phase;
    float albedo = 1;
    float to_sun[3]{};
    int from_sun = 0;
    std::uint32_t max_orders = kMaxOrders;
    bool colored = false, sun_shines = false;
    // With detail what stands before the sun is found by flights: `lit` and, of branches, branch_weight are what comes
    // through if nothing does.
    bool detail = false;
    // A sun below the ground shines on nothing above it: on no q with dot(up, q) > ground.
    bool sun_is_below = false;
    float up[3]{}, ground = 0;
};

// Paths in matter scatter: absorption, sunlight, and the start of their branches towards the sun.
void scatter_waves(const WaveSetting& setting, Wave& wave);

// Branches that have `left` directions from the sun's side left have flown along the first of them, or not met matter.
// Those that flew along the last get the sun's light: it is added, or, with detail, left in branch_weight.
void follow_branches(const WaveSetting& setting, int left, Wave& wave);

// Paths in matter that are left go on in a new direction.
void turn_waves(const WaveSetting& setting, Wave& wave);

}  // namespace awan::truth
