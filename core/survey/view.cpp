#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/survey/survey.h"

namespace awan {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

constexpr double kAutoAzimuth = kAutomaticAzimuth * kRadians;
constexpr double kAutoElevation = kAutomaticElevation * kRadians;
// "auto" leaves this margin around the clouds.
constexpr double kAutoMargin = 1.08;

}  // namespace

double distance_that_holds(const View& view, const Bounds& bounds, const glm::dvec3& target) {
    const double tan_x = view.tan_half_fov * view.aspect / kAutoMargin;
    const double tan_y = view.tan_half_fov / kAutoMargin;
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p = glm::dvec3((corner & 1) ? bounds.max.x : bounds.min.x,
                                        (corner & 2) ? bounds.max.y : bounds.min.y,
                                        (corner & 4) ? bounds.max.z : bounds.min.z) -
                             target;
        const double depth = glm::dot(p, view.forward);
        distance = std::max({distance, std::abs(glm::dot(p, view.right)) / tan_x - depth,
                             std::abs(glm::dot(p, view.up)) / tan_y - depth});
    }
    return distance;
}

View resolve_view(const Camera& camera, const ImageSettings& image, const Bounds& bounds) {
    View view;
    view.aspect = static_cast<double>(image.width) / static_cast<double>(image.height);
    const double fov = camera.automatic ? kAutomaticFov : camera.fov;
    view.tan_half_fov = exact::tan(fov / 2 * kRadians);

    const glm::dvec3 center = (bounds.min + bounds.max) / 2.0;
    glm::dvec3 forward;
    glm::dvec3 up(0, 1, 0);
    if (camera.automatic) {
        forward = -glm::dvec3(exact::sin(kAutoAzimuth) * exact::cos(kAutoElevation),
                              exact::sin(kAutoElevation),
                              exact::cos(kAutoAzimuth) * exact::cos(kAutoElevation));
    } else {
        view.eye = camera.eye;
        forward = camera.target - camera.eye;
        up = camera.up;
    }
    view.forward = glm::normalize(forward);
    view.right = glm::normalize(glm::cross(view.forward, glm::normalize(up)));
    view.up = glm::cross(view.right, view.forward);
    if (camera.automatic) {
        const double distance = distance_that_holds(view, bounds, center);
        view.eye = center - view.forward * std::max(distance, 1e-3);
    }
    return view;
}

}  // namespace awan
