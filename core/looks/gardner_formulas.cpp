#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/exact_math.h"
#include "core/looks/gardner.h"

namespace awan::gardner {

double intensity(const SineShading& shading, double diffuse, double specular, double texture) {
    const double s = shading.specular, t = shading.texture, a = shading.ambient;
    return (1 - a) * ((1 - t) * ((1 - s) * diffuse + s * specular) + t * texture) + a;
}

double diffuse(const glm::dvec3& normal, const glm::dvec3& to_sun) {
    return std::clamp(glm::dot(normal, to_sun), 0.0, 1.0);
}

double specular(const glm::dvec3& normal, const glm::dvec3& to_sun, const glm::dvec3& to_eye,
                double shininess) {
    const double lit = glm::dot(normal, to_sun);
    if (!(lit > 0)) return 0;
    const double mirrored = glm::dot(2 * lit * normal - to_sun, to_eye);
    return mirrored > 0 ? exact::pow(std::min(mirrored, 1.0), shininess) : 0;
}

std::optional<SphereHit> hit(const UnitSphere& sphere, const glm::dvec3& direction) {
    const glm::dvec3 d = sphere.to_unit * direction;
    const double squared = glm::dot(d, d);
    // b^2 by the cross product. From far away it keeps its digits, while the eye's distance squared has none left.
    const glm::dvec3 across = glm::cross(sphere.eye, d);
    const double limb = 1 - glm::dot(across, across) / squared;
    if (!(limb > 0)) return std::nullopt;
    const double middle = -glm::dot(sphere.eye, d) / squared;
    const double half = std::sqrt(limb / squared);
    double distance = middle - half;
    if (!(distance > 0)) distance = middle + half;
    if (!(distance > 0)) return std::nullopt;
    // The two meetings from the point nearest to the centre, each with digits of its own.
    const glm::dvec3 nearest = glm::cross(d, across) / squared;
    const glm::dvec3 at = nearest + (distance < middle ? -half : half) * d;
    return SphereHit{distance, at / glm::length(at), limb};
}

glm::dvec3 normal_of(const UnitSphere& sphere, const SphereHit& hit) {
    return glm::normalize(glm::transpose(sphere.to_unit) * hit.at);
}

double joined_share(double own, double other, double width) {
    return width > 0 ? std::max(1 - std::abs(own - other) / width, 0.0) : 0.0;
}

std::optional<LimbCurve> limb_on_picture(const UnitSphere& sphere, const View& view) {
    // Inside of the silhouette |eye x d|^2 < |d|^2, where d is linear in x and z.
    const glm::dvec3 base = sphere.to_unit * view.forward, x = sphere.to_unit * view.right,
                     z = sphere.to_unit * view.up;
    const auto form = [&](const glm::dvec3& a, const glm::dvec3& b) {
        return glm::dot(a, b) - glm::dot(glm::cross(sphere.eye, a), glm::cross(sphere.eye, b));
    };
    LimbCurve curve{form(x, x),        form(z, z),        2 * form(x, z),
                    2 * form(base, x), 2 * form(base, z), form(base, base)};
    const double determinant = 4 * curve.a1 * curve.a2 - curve.a3 * curve.a3;
    if (!(determinant > 0 && curve.a1 < 0)) return std::nullopt;
    const double cx = (curve.a3 * curve.a5 - 2 * curve.a2 * curve.a4) / determinant;
    const double cz = (curve.a3 * curve.a4 - 2 * curve.a1 * curve.a5) / determinant;
    const double most = curve(cx, cz);
    if (!(most > 0)) return std::nullopt;
    for (double* a : {&curve.a1, &curve.a2, &curve.a3, &curve.a4, &curve.a5, &curve.a6}) *a /= most;
    return curve;
}

}  // namespace awan::gardner
