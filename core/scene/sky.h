// The sky of a scene: a gradient, radiance `intensity * mix(horizon, zenith, f(sine of elevation))`
// (core/shaders/sky.glsl), or the clear sky that belongs to the sun (core/scene/atmosphere.h), times `intensity`.
#pragma once

#include <memory>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// What a physical sky is computed by: light scattered in layers of air (core/scene/atmosphere.h), or the fits of
// Preetham et al. 1999 (core/scene/daylight.h), whose horizon is mauve with a sun that is not low.
enum class Daylight { kScattered, kPreetham };
inline constexpr const char* kDaylightWords[] = {"scattered", "preetham"};

// Of the radiance of Preetham et al. 1999 that a sky by them has: their clear skies are 1.8 times as bright as measured
// ones (IES: 14 klx on the ground at 45 degrees, the model 25).
inline constexpr double kPreethamShare = 0.55;

// The defaults.
inline constexpr double kPhysicalSkyIntensity = 1;
inline constexpr double kGradientSkyIntensity = 1.7;
inline constexpr const char* kSkyModelWords[] = {"gradient", "physical"};

struct AirSky;  // atmosphere.h

struct Sky {
    // "none": black, no light.
    bool none = false;
    // Then `zenith` and `horizon` are unused.
    bool physical = true;
    // Of a physical sky.
    Daylight daylight = Daylight::kScattered;
    glm::dvec3 zenith{0.09, 0.25, 0.72};
    glm::dvec3 horizon{0.44, 0.67, 0.95};
    double intensity = kPhysicalSkyIntensity;
    double turbidity = 2;
    // What follows from it and the sun; validate() fills it in. Null: it is not scattered light.
    std::shared_ptr<const AirSky> air;
};

inline constexpr auto kSkyIsPhysical = [](const void* sky) {
    return static_cast<const Sky*>(sky)->physical;
};

inline constexpr auto kSkyIsGradient = [](const void* sky) {
    return !static_cast<const Sky*>(sky)->physical;
};

// By what the rest of a sky says.
inline double usual_sky_intensity(const Sky& sky) {
    return sky.physical ? kPhysicalSkyIntensity : kGradientSkyIntensity;
}

inline constexpr Field kSkyFields[] = {
    absence<&Sky::none>("none"),
    field<&Sky::physical>(
        {.name = "model",
         .words = kSkyModelWords,
         .says = "physical: the clear sky that belongs to the sun; zenith and horizon are errors "
                 "then. Left out, it is physical unless one of those is given."}),
    field<&Sky::daylight>(
        {.name = "daylight",
         .words = kDaylightWords,
         .says = "Of a physical sky. scattered: computed from layers of air, ozone and aerosol "
                 "(Hillaire 2020). preetham: the fits of Preetham et al. 1999.",
         .idle = kSkyIsGradient}),
    field<&Sky::turbidity>(
        {.name = "turbidity",
         .wanted = "a number from 2 (very clear) to 10 (hazy)",
         .range = from_to(limits::kMinTurbidity, limits::kMaxTurbidity),
         .says = "Of the air: 2 very clear, 3 clear, 6 hazy. For a physical sky and a sun of "
                 "colour \"auto\"."}),
    field<&Sky::zenith>({.name = "zenith",
                         .wanted = "[r, g, b]: three numbers",
                         .range = from_to(0, limits::kMaxColor),
                         .says = "Linear radiance.",
                         .idle = kSkyIsPhysical}),
    field<&Sky::horizon>({.name = "horizon",
                          .wanted = "[r, g, b]: three numbers",
                          .range = from_to(0, limits::kMaxColor),
                          .says = "Linear radiance.",
                          .idle = kSkyIsPhysical}),
    field<&Sky::intensity>(
        {.name = "intensity",
         .wanted = "a number >= 0",
         .range = from_to(0, limits::kMaxIntensity),
         .says = "Multiplies the colours; of a physical sky (default 1) the "
                 "sun's intensity.",
         .usual =
             [](const void* sky) { return usual_sky_intensity(*static_cast<const Sky*>(sky)); }}),
    outside_document<&Sky::air>("follows from the sun and the air"),
};
static_assert(covers<Sky>(kSkyFields));

// Colours of a gradient are those of a gradient without saying so.
inline void complete_sky(void* sky, const Given& given) {
    if (!given.has("model") && !given.has("daylight") &&
        (given.has("zenith") || given.has("horizon")))
        static_cast<Sky*>(sky)->physical = false;
}

inline constexpr Table kSkyTable{.name = "Sky",
                                 .says =
                                     "Of a gradient: radiance intensity * mix(horizon, zenith, "
                                     "1.09 u^2 / (u^2 + 0.09)), u = max(0, sine of "
                                     "the elevation).",
                                 .fields = kSkyFields,
                                 .standard = standard_of<Sky>,
                                 .shorthand = "model",
                                 .complete = complete_sky};
template <>
inline const Table& table_of<Sky>() {
    return kSkyTable;
}

}  // namespace awan
