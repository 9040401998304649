// What the columns of a file of particles mean, from their names: those of our own answers, and those that other tools
// write. The list for people is in server/document/README.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace awan {

// What one column says of a particle.
enum class Says : std::uint8_t {
    kX,
    kY,
    kZ,
    kRadius,
    // Twice the radius.
    kWidth,
    // Radii along the axes: of a sphere as large they make one radius, their geometric mean.
    kRadiusX,
    kRadiusY,
    kRadiusZ,
    // Of 3D Gaussian splats: logarithms of the standard deviations along the axes.
    kLogScale0,
    kLogScale1,
    kLogScale2,
    // Extinction, 1/unit.
    kDensity,
    // The share of a ray's light that is lost on the way through the middle, 0..1.
    kOpacity,
    kRed,
    kGreen,
    kBlue,
    // Of splats: the constant terms of colours in spherical harmonics.
    kHarmonicRed,
    kHarmonicGreen,
    kHarmonicBlue,
    kCount,
};
inline constexpr std::size_t kSaysCount = static_cast<std::size_t>(Says::kCount);

// A name that is known.
struct KnownName {
    Says says;
    // Of two names for the same thing in one file the one of lower rank counts.
    int rank;
    // The unit that stands behind it, as tables have it: "m" of "x [m]", "Radius (mm)" or "z_cm". EMPTY: none.
    std::string unit{};
};

// Nothing for a name that says nothing to us. Upper and lower case are the same; so is whatever is no letter and no
// digit: "P[x]", "P.x" and "p_x".
std::optional<KnownName> known_name(std::string_view name);

// Whether it names a place or a colour as a whole, "Location" or "Cd": a column of vectors, or none.
bool is_vector_name(std::string_view name);

// How a column is called in messages: "radius".
const char* name_of(Says says);

}  // namespace awan
