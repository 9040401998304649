// What a cloud of model "implicit" is: volumetric implicit functions (Ebert, "Volumetric cloud modeling with implicit
// functions", document 004).
//
// Macrostructure: primitives, each a weight and a density that falls off from it (Wyvill, McPheeters & Wyvill 1986),
//   m(p) = max(0, sum_i w_i h(r_i / R_i)),  h(a) = -4/9 a^6 + 17/9 a^4 - 22/9 a^2 + 1 for a <= 1, else 0,
// r_i the distance from p to the closest point q_i of primitive i, R_i its radius of influence.
// Microstructure: turbulence t (octaves of gradient noise) moves the point before m is taken there, and
//   density = (p1 (p3 m + (1 - p3) t m))^p2,
// p1 `amount`, p2 `exponent`, p3 `blend`, p4 `displacement`. All of it is a multiple of the cloud's density (1/unit).
//
// Positions, radii and points are in units. What is a matter of style is in mean radii: of the primitives as they are
// described (without keys), or of the growth's particles where there are none. So a cloud described twice as large looks
// the same.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace awan {

// Sets of defaults; fields that are given override them.
enum class ImplicitPreset { kCumulus, kCirrus, kStratus, kMackerel, kCreature };

enum class ImplicitShape {
    kSphere,     // q is within `core` of the centre
    kEllipsoid,  // a sphere scaled by `radii`
    kCylinder,   // solid, flat ends at two `points`, of radius `core`
    kSegment,    // a skeleton: q is within `core` of the line through `points`
};

// What is given holds at that time; between keys that have it a value is interpolated, before the first and after the last
// it holds.
struct ImplicitKey {
    double time = 0;  // seconds; the keys of a primitive rise
    std::optional<glm::dvec3> center;
    std::optional<double> radius;
    std::optional<double> weight;
};

struct ImplicitPrimitive {
    ImplicitShape shape = ImplicitShape::kSphere;
    glm::dvec3 center{0};  // units
    double radius = 1;     // of influence, from the primitive outward; units
    glm::dvec3 radii{1};   // an ellipsoid's semi-axes are radius * radii
    double core = 0;       // units; as far as that from its skeleton a primitive is solid
    std::vector<glm::dvec3>
        points;            // units, from the centre; of a cylinder two, of a segment two or more
    glm::dvec3 rotate{0};  // degrees about x, then y, then z; turns ellipsoids and points
    double weight = 1;     // negative takes away
    std::vector<ImplicitKey> keys;
};

// The particle system whose particles are primitives (spheres): seeds rise and wander in a turbulent force, bear children
// as often as the turbulence where they are is strong, come to rest after their lifetime, and never die. Lengths are in
// `radius`.
struct ImplicitGrowth {
    std::uint64_t seeds = 12;
    std::uint64_t most = 50;            // particles in all
    double radius = 54;                 // of a full-grown seed, units
    double shrink = 0.85;               // a full-grown child's radius over its parent's
    double weight = 1;                  // of each when full-grown
    glm::dvec3 center{0};               // of the seeds, units
    glm::dvec3 spread{2.2, 0.15, 1.6};  // seeds stand within +-spread of it
    glm::dvec3 velocity{0, 0.03, 0};    // at birth, radii a second
    glm::dvec3 force{0, 0.006, 0};      // radii a second^2
    double turbulence = 0.05;           // of the force, radii a second^2
    double drag = 0.12;                 // 1/second: what slows them
    double lifetime = 25;               // seconds from birth to rest; they are full-grown halfway
    double rate = 0.175;                // children a second, times the turbulence there
    double duration = 60;               // seconds, from time 0; then all rests
};

// Draws matter towards (or, negative, pushes it from) a place: what is seen at p is what was at
// p + strength h(d / reach) (p - at), d the distance from `at`.
struct ImplicitAttractor {
    glm::dvec3 at{0};
    double strength = 0;
    double reach = 1;  // units
};

// Turns matter about an axis through `at` by angle h(d / reach).
struct ImplicitVortex {
    glm::dvec3 at{0};
    glm::dvec3 axis{0, 1, 0};  // any length > 0
    double angle = 0;          // degrees, right-handed
    double reach = 1;          // units
};

// A vector flow table: matter at p was moved there by the vector of p, trilinear between the table's, those of the faces
// outside.
struct ImplicitFlow {
    glm::dvec3 min{-1},
        max{1};          // of the box; the first and the last vectors of a row stand on its faces
    glm::dvec3 size{0};  // vectors along x, y, z: whole numbers
    std::vector<glm::dvec3> vectors;  // units; x fastest, then y, then z
};

// As given; resolved() below fills in the rest.
struct ImplicitCloud {
    ImplicitPreset preset = ImplicitPreset::kCumulus;
    std::optional<std::vector<ImplicitPrimitive>>
        primitives;  // else the preset's, or none beside a growth
    std::optional<ImplicitGrowth> growth;
    bool smooth_keys = true;  // between keys: smoothstep, else straight
    // Below this height nothing: a flat base, soft over a fifth of a mean radius. Units; else the preset's where its
    // primitives are used.
    std::optional<double> base;

    std::optional<double> amount;        // p1
    std::optional<double> exponent;      // p2
    std::optional<double> blend;         // p3; 1: by the primitives alone
    std::optional<double> displacement;  // p4, mean radii
    // The document moves points along (1, -1, 1) by the turbulence, which is positive: the whole cloud shifts. Else each
    // axis has noise of its own around 0.
    bool diagonal = false;
    std::optional<double> noise_size;      // of the largest bumps, mean radii
    std::optional<std::uint64_t> octaves;  // each half the size of the one before
    std::optional<double> gain;            // and as strong times this: 0.5 is 1/f
    std::optional<double> stretch;         // of the noise along the jet stream

    std::optional<glm::dvec3>
        jet;  // what is at the top was blown so far, at the bottom not at all; mean radii
    std::optional<double> jet_turbulence;  // adds (.2, .3, .25) t times this to it
    // Warps (jet, flow, attractors, vortices) come in smoothly between these times, seconds; where to <= from they are
    // always in full.
    double warp_from = 0, warp_to = 0;
    std::vector<ImplicitAttractor> attractors;
    std::vector<ImplicitVortex> vortices;
    std::optional<ImplicitFlow> flow;

    // Mackerel: the density times 1 - depth (1 - s_x s_y s_z), s = (1 + sin(2 pi x / wavelength + turbulence t)) / 2, for
    // axes with a wavelength > 0, mean radii.
    std::optional<glm::dvec3> ripple;
    std::optional<double> ripple_depth;
    std::optional<double> ripple_turbulence;

    // The path of the noise, in the document's frames a second: 30 is video.
    double swirl = 3;
    // The document's path winds out for ever, and its noise coarsens into chaos with the frame number. Else the same path
    // without these two.
    bool printed_swirl = false;

    std::uint64_t resolution = 96;  // cells along the longest side
    double threshold = 0.004;       // of the largest density: cells below are left out
};

// With all that a preset decides. Of any cloud.
struct ImplicitSettings {
    std::vector<ImplicitPrimitive> primitives;
    std::optional<double> base;
    double amount = 0, exponent = 1, blend = 1, displacement = 0;
    double noise_size = 1, gain = 0.5, stretch = 1;
    std::uint64_t octaves = 1;
    glm::dvec3 jet{0};
    double jet_turbulence = 0;
    glm::dvec3 ripple{0};
    double ripple_depth = 0, ripple_turbulence = 0;
    double mean_radius = 1;  // units
};
ImplicitSettings resolved(const ImplicitCloud& cloud);

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const ImplicitCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "implicit".
Status check_implicit(const ImplicitCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const ImplicitCloud& cloud);

}  // namespace awan
