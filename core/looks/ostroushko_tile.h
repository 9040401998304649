// One tile of the look of Ostroushko et al. 2010: the spheres that its rays may meet, from the front, and the light
// that the rays bring.
#pragma once

#include <glm/vec4.hpp>
#include <vector>

#include "core/looks/ostroushko_shade.h"

namespace awan::looks {

// The side of a tile, pixels.
inline constexpr int kTileSide = 8;

// What all tiles share.
struct LookScene {
    std::vector<LookCloud> clouds;
    LookLight light;
    View view;
    // Width and height of the picture, pixels.
    int width = 0, height = 0;
    // The angle of a pixel, radians.
    double pixel_angle = 0;
    // Whether rays end at a ground.
    bool ground = false;
    double ground_height = 0;
    // A sphere that looks smaller than this, in pixels of its diameter, is a leaf.
    double finest_pixels = 1;
};

LookScene look_scene(const Scene& scene, const View& view);

// A leaf, or a sphere that looks no larger than a pixel.
struct LookSphere {
    // Relative to the eye, in the scene's axes.
    glm::dvec3 center;
    double radius;
    // The least distance at which any ray can meet it.
    double near;
    // Extinction in it, 1/unit: that of its leaves spread over it.
    double sigma;
    std::uint64_t key;
    // The index of its cloud.
    std::uint32_t cloud;
    // The index of its LitPlace.
    std::uint32_t place;
};

// Where light is followed to (LookCloud::lit_level).
struct LitPlace {
    // In the coordinates of LookSphere::center.
    glm::dvec3 point;
    bool known = false;
    Reaching share;
};

// A cone of rays from the eye.
struct Cone {
    // Unit, from the eye.
    glm::dvec3 axis;
    // Sine and cosine of half the cone's angle, which is at most a right one.
    double sine, cosine;
};
// Whether a ball may meet it; never false where it does.
bool may_meet(const Cone& cone, const glm::dvec3& center, double radius);

// What a cone of rays may meet.
struct ConeSpheres {
    // The spheres, nearest first.
    std::vector<LookSphere> spheres;
    // Centre and radius of each of them, which is all that most of them are asked for.
    std::vector<glm::dvec4> balls;
    std::vector<LitPlace> places;
};

// The unit direction of the ray through a pixel's middle.
glm::dvec3 ray_of(const LookScene& scene, int x, int y);

// All that a cone of rays may meet. The cone is in the scene's axes.
ConeSpheres spheres_in_cone(const LookScene& scene, const Cone& cone);

// Draws the pixels from (x, y) on that lie in the picture. pixels: 4 floats a pixel, premultiplied, rows of `width`.
void draw_tile(const LookScene& scene, int x, int y, float* pixels);

}  // namespace awan::looks
