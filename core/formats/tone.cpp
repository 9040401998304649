#include "core/formats/tone.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>

#include "core/base/exact_math.h"

namespace awan {
namespace {

namespace glsl {
using glm::max;
using glm::min;
using glm::mix;
using glm::vec3;
#include "core/shaders/tone.glsl"
}  // namespace glsl

// Infinity and what is so bright that squares of it overflow is plain white like this.
constexpr float kBrightest = 1e9f;

double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * exact::pow(linear, 1 / 2.4) - 0.055;
}

float sane(float radiance) {
    return radiance > 0 ? std::min(radiance, kBrightest) : 0.0f;
}

}  // namespace

glm::vec3 tone_mapped(const glm::vec3& exposed_radiance, Tone tone) {
    const glm::vec3 color(sane(exposed_radiance.x), sane(exposed_radiance.y),
                          sane(exposed_radiance.z));
    return tone == Tone::kNeutral ? glsl::tone_neutral(color) : glsl::tone_reinhard(color);
}

float metered_level() {
    return glsl::kMeteredLevel;
}

std::array<float, 3> dither_phases(int x, int y) {
    // 1 / p and 1 / p^2 of 2^32, p^3 = p + 1. In whole numbers, which wrap as the circle does.
    constexpr std::uint32_t kAlong = 3242174889u, kDown = 2447445414u, kThird = 1431655765u;
    constexpr float kStep = 1.0f / 16777216;
    const std::uint32_t at =
        kAlong * static_cast<std::uint32_t>(x) + kDown * static_cast<std::uint32_t>(y);
    const auto phase = [](std::uint32_t turn) { return static_cast<float>(turn >> 8) * kStep; };
    return {phase(at), phase(at + kThird), phase(at + 2 * kThird)};
}

int dithered_code(float value, float phase) {
    // Rounding may lift 255 and a phase just below 1 to 256.
    if (value < 1 || value > 254) return std::min(static_cast<int>(value + phase), 255);
    // The inverse of the distribution function of a triangle over -1..1.
    const float noise = phase < 0.5f ? std::sqrt(2 * phase) - 1 : 1 - std::sqrt(2 - 2 * phase);
    return static_cast<int>(value + 0.5f + noise);
}

Film::Film(const FilmSettings& settings)
    : tone_(settings.tone), gain_(static_cast<float>(exact::exp2(settings.exposure))) {
    const std::uint32_t first = cell_index(kSmallest), last = cell_index(1.0f);
    cells_.reserve(last - first + 1);
    const auto start_of = [](std::uint32_t index) {
        return static_cast<double>(std::bit_cast<float>(index << 14));
    };
    double left = 255 * srgb(start_of(first));
    for (std::uint32_t index = first; index < last; ++index) {
        const double right = 255 * srgb(start_of(index + 1));
        const double slope = (right - left) / (start_of(index + 1) - start_of(index));
        cells_.push_back(
            {static_cast<float>(left - slope * start_of(index)), static_cast<float>(slope)});
        left = right;
    }
    cells_.push_back({255, 0});
}

std::array<std::uint8_t, 3> Film::rounded(const glm::vec3& exposed) const {
    const glm::vec3 linear = tone_mapped(exposed, tone_);
    std::array<std::uint8_t, 3> codes{};
    for (int c = 0; c < 3; ++c)
        codes[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(value_of(linear[c]) + 0.5f);
    return codes;
}

std::array<std::uint8_t, 3> Film::dithered(const glm::vec3& exposed, int x, int y) const {
    const glm::vec3 linear = tone_mapped(exposed, tone_);
    const std::array<float, 3> phases = dither_phases(x, y);
    std::array<std::uint8_t, 3> codes{};
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        codes[i] = static_cast<std::uint8_t>(dithered_code(value_of(linear[c]), phases[i]));
    }
    return codes;
}

std::array<std::uint16_t, 3> Film::rounded_16(const glm::vec3& exposed) const {
    const glm::vec3 linear = tone_mapped(exposed, tone_);
    std::array<std::uint16_t, 3> codes{};
    for (int c = 0; c < 3; ++c)
        codes[static_cast<std::size_t>(c)] = static_cast<std::uint16_t>(
            std::floor(65535.0 * srgb(static_cast<double>(linear[c])) + 0.5));
    return codes;
}

}  // namespace awan
