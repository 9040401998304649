// Exposed radiance -> sRGB of 8 or 16 bits, through a tone curve of core/shaders/tone.glsl.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/scene/image_settings.h"

namespace awan {

// What makes display values of radiance.
struct FilmSettings {
    // Stops: radiance is multiplied by 2^exposure.
    double exposure = 0;
    Tone tone = Tone::kNeutral;
};

// A curve of tone.glsl, compiled as C++: exposed radiance -> display-linear, 0..1. NaN and what is below 0 give 0.
glm::vec3 tone_mapped(const glm::vec3& exposed_radiance, Tone tone);

// kMeteredLevel of tone.glsl.
float metered_level();

// Where dither stands at a pixel, 0 <= u < 1, with the shares of the three channels a third apart. The sequence R2 of
// Roberts 2018: neighbours are far from each other, and of any five in a row, or seven in a column, no arc of a quarter
// of the circle is missed.
std::array<float, 3> dither_phases(int x, int y);

// A value 0..255 -> a code whose mean over the phases is the value. From 1 to 254 the noise is triangular, up to one
// code either way (.41 in the root of the mean square), the least whose strength does not change with the value; no
// code is then given to more than three quarters of the phases, so no band of one code is left. In the first and the
// last step noise is half a code either way, so black and white stay as they are.
int dithered_code(float value, float phase);

// The codes of pixels. Made once a picture (0.2 ms).
class Film {
  public:
    explicit Film(const FilmSettings& settings);

    // What radiance is multiplied by.
    float gain() const { return gain_; }
    // Of exposed radiance: 8 bits by rounding, 8 bits dithered by the pixel's place, 16 bits by rounding.
    std::array<std::uint8_t, 3> rounded(const glm::vec3& exposed) const;
    std::array<std::uint8_t, 3> dithered(const glm::vec3& exposed, int x, int y) const;
    std::array<std::uint16_t, 3> rounded_16(const glm::vec3& exposed) const;

  private:
    // 255 * sRGB of a display-linear value 0..1, within 1e-4: a float's leading bits name a cell, in which it is a
    // straight line. Without a power function a sample: the eye pass gives millions of these.
    float value_of(float linear) const {
        if (linear < kSmallest) return 255 * 12.92f * linear;
        const Cell& cell = cells_[cell_index(linear) - cell_index(kSmallest)];
        return cell.offset + cell.slope * linear;
    }
    // The values with the same sign, exponent and first 9 bits of mantissa.
    struct Cell {
        float offset, slope;
    };
    static std::uint32_t cell_index(float x) { return std::bit_cast<std::uint32_t>(x) >> 14; }
    // Below it sRGB is straight.
    static constexpr float kSmallest = 1.0f / 512;

    Tone tone_;
    float gain_;
    std::vector<Cell> cells_;
};

}  // namespace awan
