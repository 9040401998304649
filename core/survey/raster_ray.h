#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "core/survey/survey.h"

namespace awan {

// The way (unit) that one looks through the middle of field (i, j) of a picture that is divided into across x down
// fields, counted from the top left.
inline glm::dvec3 raster_ray(const View& view, int across, int down, int i, int j) {
    const double u = ((i + 0.5) / across * 2 - 1) * view.tan_half_fov * view.aspect;
    const double v = (1 - (j + 0.5) / down * 2) * view.tan_half_fov;
    return glm::normalize(view.forward + u * view.right + v * view.up);
}

}  // namespace awan
