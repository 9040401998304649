#include "core/formats/tone.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>

namespace awan {
namespace {

namespace glsl {
using glm::max;
using glm::min;
#include "core/shaders/tone.glsl"
}  // namespace glsl

double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

int exact_code(float x) {
    return static_cast<int>(std::floor(255.0 * srgb(static_cast<double>(tone_curve(x))) + 0.5));
}

}  // namespace

float tone_curve(float exposed_radiance) {
    return glsl::tone_curve(exposed_radiance);
}
std::uint16_t display_code_16(float exposed_radiance) {
    const float x = exposed_radiance > 0 ? std::min(exposed_radiance, glsl::kToneWhite) : 0.0f;
    return static_cast<std::uint16_t>(
        std::floor(65535.0 * srgb(static_cast<double>(tone_curve(x))) + 0.5));
}
float metered_level() {
    return glsl::kMeteredLevel;
}

DisplayTable::DisplayTable() {
    // first_of[k]: the smallest radiance with code k. Positive floats have the order of their bits, so it is found by
    // bisection on the bits.
    std::array<float, 257> first_of{};
    first_of[256] = std::numeric_limits<float>::infinity();
    const auto white = std::bit_cast<std::uint32_t>(glsl::kToneWhite);
    std::uint32_t below = 0;
    for (std::size_t code = 1; code < 256; ++code) {
        std::uint32_t at_least = white;
        while (at_least - below > 1) {
            const std::uint32_t middle = below + (at_least - below) / 2;
            if (exact_code(std::bit_cast<float>(middle)) >= static_cast<int>(code))
                at_least = middle;
            else
                below = middle;
        }
        first_of[code] = std::bit_cast<float>(at_least);
    }
    first_cell_ = cell_index(first_of[1]);
    brightest_ = first_of[255];
    std::uint32_t code = 0;
    for (std::uint32_t index = first_cell_; index <= cell_index(brightest_); ++index) {
        const auto smallest = std::bit_cast<float>(index << 16);
        while (smallest >= first_of[code + 1]) ++code;
        assert(code == 255 || cell_index(first_of[std::min(code + 2, 256u)]) != index);
        cells_.push_back({first_of[code + 1], code});
    }
    darkest_ = std::bit_cast<float>(first_cell_ << 16);
}

}  // namespace awan
