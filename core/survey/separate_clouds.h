// The clouds of a scene that stand apart, so that each can be drawn by itself and laid over those behind it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/particle_set.h"
#include "core/survey/islands.h"

namespace awan {

struct SeparateCloud {
    // Indices into the particles, rising.
    std::vector<std::uint32_t> particles;
    // Holds all that shows of it: each particle out to where its optical depth is 1%, at least 2 s and at most 4 s; and
    // all of it, out to 4 s. Scene units.
    Bounds shows, all;
};

// The islands (islands.h), those drawn together that interpenetrate: where what shows of one reaches into the box of
// what shows of another. Planes of the islands' tree lie between the others, so that for every eye there is an order in
// which no cloud stands before one that comes earlier.
struct SeparateClouds {
    std::vector<IslandNode> nodes;  // as in Islands; a region's `below` is an index into `list`
    std::vector<SeparateCloud> list;
};

// One cloud where there are no islands. Clouds without particles are left out. Time: linear in the particles, and
// quadratic in the islands (kMostIslands).
SeparateClouds separate_clouds(const ParticleSet& particles, const Islands& islands);

// Whether two boxes have more in common than a face.
bool overlap(const Bounds& a, const Bounds& b);

// Indices into list, nearest first.
std::vector<std::size_t> front_to_back(const SeparateClouds& clouds, const glm::dvec3& eye);

// The particles with these indices. Without what is of clouds or of other sets (cloud_begin, whole).
ParticleSet some_of(const ParticleSet& particles, const std::vector<std::uint32_t>& indices);

}  // namespace awan
