// The sun of a scene.
#pragma once

#include <optional>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Whether pictures show the sun itself.
enum class SunDisc { kAutomatic, kShown, kHidden };
inline constexpr const char* kSunDiscWords[] = {"auto", "on", "off"};

struct Sun {
    double elevation = 40;
    double azimuth = 110;
    std::optional<glm::dvec3> direction;
    glm::dvec3 color{1.0, 0.97, 0.92};
    // "auto": from the elevation (core/scene/daylight.h); `color` is unused then.
    bool auto_color = true;
    double intensity = 40;
    SunDisc disc = SunDisc::kAutomatic;
};

inline constexpr auto kSunHasDirection = [](const void* sun) {
    return static_cast<const Sun*>(sun)->direction.has_value();
};

inline constexpr Field kSunFields[] = {
    field<&Sun::elevation>({.name = "elevation",
                            .wanted = "a number (degrees above the horizon)",
                            .range = within(90),
                            .unit = "degrees",
                            .says = "Degrees above the horizon.",
                            .idle = kSunHasDirection}),
    field<&Sun::azimuth>({.name = "azimuth",
                          .wanted = "a number (degrees; 0 is +z, 90 is +x)",
                          .range = within(limits::kMaxAngle),
                          .unit = "degrees",
                          .says = "Degrees; 0 is +z, 90 is +x.",
                          .idle = kSunHasDirection}),
    field<&Sun::direction>(
        {.name = "direction",
         .wanted = "[x, y, z] towards the sun",
         .range = within(limits::kMaxCoordinate),
         .says = "Towards the sun, any length above 0; instead of the two angles.",
         .otherwise = "by elevation and azimuth"}),
    field_unless<&Sun::color, &Sun::auto_color>(
        {.name = "color",
         .wanted = R"([r, g, b] or "auto")",
         .range = from_to(0, limits::kMaxColor),
         .absent = "auto",
         .says = "Linear; \"auto\": that of sunlight through clear air, by the sun's elevation and "
                 "the sky's "
                 "turbidity. Its luminance is 1 at the zenith and turbidity 2, less elsewhere, and "
                 "none below "
                 "the horizon."}),
    field<&Sun::intensity>({.name = "intensity",
                            .wanted = "a number >= 0",
                            .range = from_to(0, limits::kMaxIntensity),
                            .says = "Irradiance at normal incidence."}),
    field<&Sun::disc>({.name = "disc",
                       .words = kSunDiscWords,
                       .says = "Whether pictures show the sun itself where no cloud hides it, and "
                               "PNG and WebP its glare. auto: under a sky, in all but EXR."}),
};
static_assert(covers<Sun>(kSunFields));

inline constexpr Table kSunTable{.name = "Sun",
                                 .says = "The sun, by two angles or by a direction.",
                                 .fields = kSunFields,
                                 .standard = standard_of<Sun>};
template <>
inline const Table& table_of<Sun>() {
    return kSunTable;
}

}  // namespace awan
