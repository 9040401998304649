// Exposed radiance -> 8-bit sRGB, through the tone curve of core/shaders/tone.glsl.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace awan {

// The curve of tone.glsl, compiled as C++.
float tone_curve(float exposed_radiance);

// kMeteredLevel of tone.glsl.
float metered_level();

// round(65535 * sRGB(tone_curve(x))); NaN and what is below 0 give 0.
std::uint16_t display_code_16(float exposed_radiance);

// round(255 * sRGB(tone_curve(x))), exactly, without a power function a sample. The 255 radiances
// at which the code changes are found once (0.3 ms); then a float's leading bits name a cell so
// narrow that the code changes at most once in it.
class DisplayTable {
  public:
    DisplayTable();

    // NaN and what is below 0 give 0, infinity 255.
    std::uint8_t code(float exposed_radiance) const {
        // In this order NaN becomes darkest_. No branches: the eye pass gives millions of these.
        const float x =
            std::min(exposed_radiance > darkest_ ? exposed_radiance : darkest_, brightest_);
        const Cell& cell = cells_[cell_index(x) - first_cell_];
        return static_cast<std::uint8_t>(cell.code + (x >= cell.next));
    }

  private:
    // The radiances with the same sign, exponent and first 7 bits of mantissa.
    struct Cell {
        // The radiance from which on the code is one more.
        float next;
        // The code of the smallest radiance in the cell.
        std::uint32_t code;
    };
    static std::uint32_t cell_index(float x) { return std::bit_cast<std::uint32_t>(x) >> 16; }

    // Where the cells begin and end; below and above, the codes are 0 and 255.
    float darkest_ = 0, brightest_ = 0;
    std::uint32_t first_cell_ = 0;
    std::vector<Cell> cells_;
};

}  // namespace awan
