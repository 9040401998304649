// The clouds of a scene as the look of Ostroushko et al. sees them (document 003; core/generate/spheres/subdivision.h):
// where they stand, how finely they are seen, and how much light comes through their upper levels.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/generate/motion.h"
#include "core/generate/spheres/subdivision.h"
#include "core/scene/outside.h"
#include "core/survey/survey.h"

namespace awan::looks {

// A ray from the origin; direction unit. From `begin` on.
struct SphereHit {
    // Distances along the ray; enter >= 0: an eye inside begins at 0.
    double enter = 0, leave = 0;
    // d: from the sphere's centre to the line.
    double middle = 0;
};
// The source's equations 5, 6. c: centre, radius > 0. False: missed, or behind.
inline bool meets(const glm::dvec3& c, double radius, const glm::dvec3& direction, SphereHit& hit) {
    const double along = c.x * direction.x + c.y * direction.y + c.z * direction.z;
    const glm::dvec3 beside = c - along * direction;
    const double square = beside.x * beside.x + beside.y * beside.y + beside.z * beside.z;
    const double half = radius * radius - square;
    if (!(half > 0)) return false;
    const double root = std::sqrt(half);
    hit.leave = along + root;
    if (!(hit.leave > 0)) return false;
    hit.enter = std::max(along - root, 0.0);
    hit.middle = std::sqrt(square);
    return true;
}

// Equations 1-3: T f + 1 - f, T = exp(-sigma l), f = 1 - d/r; l is the path in the sphere, d its middle's distance.
// 0..1.
double through(const SphereHit& hit, double radius, double sigma);

struct LookCloud {
    SphereTree tree;
    Motion motion;
    // In the cloud's own coordinates.
    glm::dvec3 eye;
    // Extinction in it, 1/unit of the scene.
    double sigma;
    // That are told apart; at most the tree's.
    int levels;
    // Element n: share of the depth of a sphere that is left where the leaves n levels below stand for it.
    std::vector<double> thinning;
    // The upper levels down to `upper_levels`, children of sphere i at 5 i + 1 .. 5 i + 5.
    std::vector<Sphere> upper;
    int upper_levels;
};

std::vector<LookCloud> look_clouds(const Scene& scene, const glm::dvec3& eye);

// From the cloud's coordinates (a direction or a length beside `scale`) to the scene's axes and back.
glm::dvec3 turned(const LookCloud& cloud, const glm::dvec3& v);
glm::dvec3 turned_back(const LookCloud& cloud, const glm::dvec3& v);

// What comes through all clouds to a point from a direction (unit), both in the scene's axes, the point relative to the
// eye; `softened` multiplies all depths. By the upper levels only.
double light_through(const std::vector<LookCloud>& clouds, const glm::dvec3& point,
                     const glm::dvec3& towards, double softened);

}  // namespace awan::looks
