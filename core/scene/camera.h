// From where a scene is seen.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// The automatic camera looks at the clouds from this side, up a little, as one sees clouds. Degrees. web/camera.js says
// the same of the page's.
inline constexpr double kAutomaticFov = 40, kAutomaticAzimuth = 30, kAutomaticElevation = -10;

struct Camera {
    // "auto": the whole cloud, three-quarter view; then the rest is unused.
    bool automatic = true;
    glm::dvec3 eye{0};
    glm::dvec3 target{0};
    glm::dvec3 up{0, 1, 0};
    double fov = 40;
};

inline constexpr Field kCameraFields[] = {
    absence<&Camera::automatic>("auto"),
    field<&Camera::eye>({.name = "eye",
                         .wanted = "[x, y, z]: three numbers",
                         .range = within(limits::kMaxCoordinate),
                         .required = true,
                         .unit = "units",
                         .says = "Scene units."}),
    field<&Camera::target>({.name = "target",
                            .wanted = "[x, y, z]: three numbers",
                            .range = within(limits::kMaxCoordinate),
                            .required = true,
                            .unit = "units",
                            .says = "Scene units; not the eye."}),
    field<&Camera::up>({.name = "up",
                        .wanted = "[x, y, z]: three numbers",
                        .range = within(limits::kMaxCoordinate),
                        .says = "Not parallel to the view."}),
    field<&Camera::fov>({.name = "fov",
                         .wanted = "a number (degrees, vertical)",
                         .range = from_to(limits::kMinFov, limits::kMaxFov),
                         .unit = "degrees",
                         .says = "Vertical, degrees."}),
};
static_assert(covers<Camera>(kCameraFields));

inline constexpr Table kCameraTable{.name = "Camera",
                                    .says = "From where the scene is seen.",
                                    .fields = kCameraFields,
                                    .standard = standard_of<Camera>};
template <>
inline const Table& table_of<Camera>() {
    return kCameraTable;
}

}  // namespace awan
