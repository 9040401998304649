// The curve of Morton 1966: places that are close together along it are close together in the plane.
#pragma once

#include <cstdint>

namespace awan {

// The bits of x with a 0 after each.
constexpr std::uint64_t spread_bits(std::uint32_t x) {
    std::uint64_t b = x;
    b = (b | b << 16) & 0x0000ffff0000ffffu;
    b = (b | b << 8) & 0x00ff00ff00ff00ffu;
    b = (b | b << 4) & 0x0f0f0f0f0f0f0f0fu;
    b = (b | b << 2) & 0x3333333333333333u;
    return (b | b << 1) & 0x5555555555555555u;
}

// Where (x, y) lies along the curve.
constexpr std::uint64_t morton_place(std::uint32_t x, std::uint32_t y) {
    return spread_bits(x) | spread_bits(y) << 1;
}

}  // namespace awan
