#include "core/draw/march_scene.h"

#include <glm/geometric.hpp>

namespace awan {

glm::dvec3 to_scene(const View& view, const glm::dvec3& d) {
    return d.x * view.right + d.y * view.up + d.z * view.forward;
}

glm::dvec3 to_frame(const View& view, const glm::dvec3& d) {
    return {glm::dot(d, view.right), glm::dot(d, view.up), glm::dot(d, view.forward)};
}

glm::dvec3 frame_direction(const MarchScene& scene, double x, double y) {
    const double tan = scene.view.tan_half_fov;
    return glm::normalize(glm::dvec3((x / scene.width * 2 - 1) * tan * scene.view.aspect,
                                     (1 - y / scene.height * 2) * tan, 1));
}

glm::dvec3 pixel_direction(const MarchScene& scene, double x, double y) {
    return to_scene(scene.view, frame_direction(scene, x, y));
}

}  // namespace awan
