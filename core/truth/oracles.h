// Exact answers for what can be answered exactly, in double, from the particles themselves.
#pragma once

#include "core/base/image.h"
#include "core/generate/particle_set.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Optical depth of origin + t direction over t in [from, to]; direction is unit, to may be
// infinite. Sum of erfc differences with arguments of one sign: relative error < 1e-12 for any ray.
double line_optical_depth(const ParticleSet& particles, const glm::dvec3& origin,
                          const glm::dvec3& direction, double from, double to);

// Extinction at a point, 1/unit.
double extinction_at(const ParticleSet& particles, const glm::dvec3& point);

// Mean 1 over the sphere; cosine of the angle between the ways light goes before and after.
double phase_value(const Medium& medium, double cosine);

// Sunlight scattered exactly once into the ray (origin, direction from the eye outward), r g b, by
// adaptive quadrature over exact optical depths: relative error < 1e-4.
glm::dvec3 single_scattering(const Scene& scene, const ParticleSet& particles,
                             const glm::dvec3& origin, const glm::dvec3& direction);

// Ray of a pixel's centre; of a place beside it, where x and y are not whole.
struct PixelRay {
    glm::dvec3 origin, direction;
};
PixelRay pixel_ray(const View& view, int width, int height, double x, double y);

}  // namespace awan
