#include "core/generate/implicit/noise.h"

#include <algorithm>
#include <cmath>

#include "core/generate/keyed_random.h"

namespace awan::implicit {
namespace {

void split(double at, std::uint32_t& shift, float& part) {
    const double whole = std::floor(at);
    shift = static_cast<std::uint32_t>(static_cast<std::int64_t>(whole));
    part = static_cast<float>(at - whole);
}

}  // namespace

Octaves octaves_of(std::uint64_t key, int count, double gain, double cell, double x, double y,
                   double z) {
    Octaves octaves;
    // Of |noise|: mean, root mean square, and variance.
    constexpr double kMean = kMeanAbsNoise, kRms = kRmsNoise;
    constexpr double kVariance = kRms * kRms - kMean * kMean;
    double weight = 1, frequency = 1, left_out = 0;
    for (int o = 0; o < std::min(count, kMostOctaves); ++o, weight *= gain, frequency *= 2) {
        const double shown = smoothstep((1 / (frequency * std::max(cell, 1e-300)) - 1.5) / 1.5);
        octaves.rest += static_cast<float>(kMean * weight * (1 - shown));
        left_out += kVariance * weight * weight * (1 - shown) * (1 - shown);
        octaves.rest_rms = static_cast<float>(std::sqrt(left_out));
        if (shown <= 0) continue;
        const std::uint64_t own = keyed(key, static_cast<std::uint64_t>(o));
        const auto i = static_cast<std::size_t>(octaves.count++);
        octaves.weight[i] = static_cast<float>(weight * shown);
        octaves.frequency[i] = static_cast<float>(frequency);
        NoiseLattice& lattice = octaves.lattice[i];
        lattice.key = static_cast<std::uint32_t>(own >> 32);
        // Each octave begins somewhere else: no place has lattice points of all of them.
        const auto start = [&](std::uint64_t axis) {
            return static_cast<double>(keyed(own, axis) >> 40) * 0x1p-24;
        };
        split(x * frequency + start(0), lattice.shift_x, lattice.part_x);
        split(y * frequency + start(1), lattice.shift_y, lattice.part_y);
        split(z * frequency + start(2), lattice.shift_z, lattice.part_z);
    }
    return octaves;
}

}  // namespace awan::implicit
