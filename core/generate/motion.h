// Where a cloud stands: from its own coordinates to the scene's and back.
#pragma once

#include <glm/vec3.hpp>

#include "core/base/exact_math.h"
#include "core/scene/scene.h"

namespace awan {

// A point p of the cloud stands at translate + rotate_y(scale * p) in the scene.
struct Motion {
    glm::dvec3 translate;
    double scale;
    exact::SinCos turn;

    glm::dvec3 operator()(glm::dvec3 p) const {
        p *= scale;
        return translate +
               glm::dvec3(p.x * turn.cos + p.z * turn.sin, p.y, p.z * turn.cos - p.x * turn.sin);
    }
    glm::dvec3 back(glm::dvec3 p) const {
        p -= translate;
        return glm::dvec3(p.x * turn.cos - p.z * turn.sin, p.y, p.z * turn.cos + p.x * turn.sin) /
               scale;
    }
};

inline Motion motion_of(const Cloud& cloud, double time) {
    return {cloud.translate + time * cloud.velocity, cloud.scale,
            exact::sincos_degrees(cloud.rotate_y)};
}

}  // namespace awan
