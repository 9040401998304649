// The clouds of a scene as the look of Ostroushko et al. 2010 sees them (core/generate/spheres/subdivision.h): where
// they stand, how finely they are seen, and how much light comes through their upper levels.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/generate/motion.h"
#include "core/generate/spheres/subdivision.h"
#include "core/looks/ostroushko_relief.h"
#include "core/scene/outside.h"
#include "core/survey/survey.h"

namespace awan::looks {

using spheres::Sphere;
using spheres::SphereTree;

// Where a ray from the origin meets a sphere.
struct SphereHit {
    // Distances along the ray. enter >= 0: for an eye inside, the sphere begins at 0.
    double enter = 0, leave = 0;
    // d: the distance from the sphere's centre to the ray's line.
    double middle = 0;
};
// Ostroushko et al. 2010 (5), (6). c: the centre; radius > 0; direction: unit. False: the ray misses, or the sphere
// is behind.
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

// The share of light that a sphere lets through, 0..1. Ostroushko et al. 2010 (1)-(3): T f + 1 - f, T = exp(-sigma
// l), f = 1 - d/r, where l is the ray's path in the sphere and d the distance of its line from the centre.
double through(const SphereHit& hit, double radius, double sigma);

// A cloud as the look sees it.
struct LookCloud {
    SphereTree tree;
    Motion motion;
    // In the cloud's own coordinates.
    glm::dvec3 eye;
    // Extinction in the cloud, 1/unit of the scene.
    double sigma;
    // How many levels are told apart; at most the tree's.
    int levels;
    // Element n: the share of a sphere's depth that is left where the leaves n levels below stand for it.
    std::vector<double> thinning;
    // The upper levels, down to `upper_levels`; the children of sphere i are n i + 1 .. n i + n, n the tree's parts.
    std::vector<Sphere> upper;
    int upper_levels;
    // The last level at which light is followed to the spheres. Those below have what reaches their ancestor there,
    // since shadows are no finer.
    int lit_level;
    Relief relief;
};

// The clouds of a scene, seen from an eye (scene units).
std::vector<LookCloud> look_clouds(const Scene& scene, const glm::dvec3& eye);

// From the cloud's coordinates to the scene's axes and back; directions, or lengths where `scale` is taken care of.
glm::dvec3 turned(const LookCloud& cloud, const glm::dvec3& v);
glm::dvec3 turned_back(const LookCloud& cloud, const glm::dvec3& v);

// The share of light from a direction (unit) that comes through all clouds to a point, scattered on by them, by the
// upper levels only. Both in the scene's axes, the point relative to the eye. softened: multiplies all depths.
double light_through(const std::vector<LookCloud>& clouds, const glm::dvec3& point,
                     const glm::dvec3& towards, double softened);

}  // namespace awan::looks
