// One tile of the look of Ostroushko et al. (document 003): the spheres that its rays may meet, from the front, and
// what the rays bring home.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "core/looks/ostroushko_shade.h"

namespace awan::looks {

// Pixels.
inline constexpr int kTileSide = 8;

// What all tiles share.
struct LookScene {
    std::vector<LookCloud> clouds;
    LookLight light;
    View view;
    // Pixels.
    int width = 0, height = 0;
    // Radians.
    double pixel_angle = 0;
    // Rays end at a plane.
    bool ground = false;
    double ground_height = 0;
    // A sphere of less in diameter is a leaf.
    double finest_pixels = 1;
};

LookScene look_scene(const Scene& scene, const View& view);

// A leaf, or a sphere that looks no larger than a pixel.
struct LookSphere {
    // Relative to the eye, the scene's axes.
    glm::dvec3 center;
    double radius;
    // Least distance at which any ray can meet it.
    double near;
    // Extinction in it, that of its leaves spread over it.
    double sigma;
    std::uint64_t key;
    // Where light reaches it.
    std::uint32_t place;
};

// Light is followed to spheres of this level and above, those below have their ancestor's: shadows are no finer
// (kUpperLevels).
inline constexpr int kLitLevel = 6;
struct LitPlace {
    // As LookSphere::center.
    glm::dvec3 point;
    bool known = false;
    Reaching share;
};

struct Cone {
    // Unit, from the eye.
    glm::dvec3 axis;
    // Of half its angle, at most a right one.
    double sine, cosine;
};
// Whether a ball may meet it; never false where it does.
bool may_meet(const Cone& cone, const glm::dvec3& center, double radius);

struct ConeSpheres {
    // Nearest first.
    std::vector<LookSphere> spheres;
    // Of the same: center, radius; what most of them are asked for only.
    std::vector<glm::dvec4> balls;
    std::vector<LitPlace> places;
};

// Unit direction of a pixel's middle ray.
glm::dvec3 ray_of(const LookScene& scene, int x, int y);

// All that a cone of rays may meet; of the scene's axes.
ConeSpheres spheres_in_cone(const LookScene& scene, const Cone& cone);

// Of the pixels from (x, y) on that lie in the picture. pixels: 4 a pixel, premultiplied, rows of `width`.
void draw_tile(const LookScene& scene, int x, int y, float* pixels);

}  // namespace awan::looks
