// A camera that moves: where it stands at some times, and so between them.
#pragma once

#include <vector>

#include "core/scene/camera.h"

namespace awan {

// One of a list in which times rise.
struct CameraKey {
    double time = 0;
    glm::dvec3 eye{0};
    glm::dvec3 target{0};
    double fov = kAutomaticFov;
};

inline constexpr Field kCameraKeyFields[] = {
    field<&CameraKey::time>({.name = "time",
                             .wanted = "a number (seconds)",
                             .range = within(limits::kMaxTime),
                             .required = true,
                             .unit = "seconds",
                             .says = "Seconds; later than that of the key before."}),
    field<&CameraKey::eye>({.name = "eye",
                            .wanted = "[x, y, z]: three numbers",
                            .range = within(limits::kMaxCoordinate),
                            .required = true,
                            .unit = "units",
                            .says = "Scene units."}),
    field<&CameraKey::target>({.name = "target",
                               .wanted = "[x, y, z]: three numbers",
                               .range = within(limits::kMaxCoordinate),
                               .required = true,
                               .unit = "units",
                               .says = "Scene units; not the eye."}),
    field<&CameraKey::fov>({.name = "fov",
                            .wanted = "a number (degrees, vertical)",
                            .range = from_to(limits::kMinFov, limits::kMaxFov),
                            .unit = "degrees",
                            .says = "Vertical, degrees."}),
};
static_assert(covers<CameraKey>(kCameraKeyFields));

inline constexpr Table kCameraKeyTable{.name = "CameraKey",
                                       .says = "Where a moving camera is at one time.",
                                       .fields = kCameraKeyFields,
                                       .standard = standard_of<CameraKey>};
template <>
inline const Table& table_of<CameraKey>() {
    return kCameraKeyTable;
}

// The camera at a time, any finite number of seconds: that of a key at its time, that of the first before it and of the
// last after it. keys: one or more, within the ranges of their table, with rising times, each with a target that is not
// its eye. `up` is that of the camera, not of length 0; where a view is along it, the axis that is farthest from the
// view stands for it.
//
// Between two keys eye, target and fov go straight and evenly (linear), or along a curve that passes through all keys
// with one tangent on either side: its direction and size are those of the centripetal Catmull-Rom spline (Yuksel et
// al. 2011, as derivatives by time), which keeps near its keys however unevenly they stand. So keys along a line are
// passed along that line, without turning back, at an even speed where it is even from key to key; where two keys
// stand in one place the camera rests between them. What comes out is always within the limits and has a direction.
Camera camera_at(const std::vector<CameraKey>& keys, bool linear, const glm::dvec3& up,
                 double time);

}  // namespace awan
