// Free flights through matter: delta tracking (Woodcock et al. 1965) through blocks with majorants of their own, many
// flights at a time. Places and directions are those of the lattice (q in matter.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "core/truth/matter.h"
#include "core/truth/path_random.h"

namespace awan::truth {

// Flights that meet more than this many points to look at end as if nothing stood there; only a walk along a steep edge
// of optical depth > 1e6 comes near it.
inline constexpr std::int32_t kMaxTentative = 1 << 20;

// Places in matter: the brick, and cells from its first node, 0..kBrick. So no digits are lost in a wide lattice.
struct Places {
    std::int32_t* brick[3];
    float* local[3];

    void set(std::size_t i, const Matter& m, const glm::dvec3& q) const;
    glm::dvec3 at(std::size_t i) const;
    void copy(std::size_t i, const Places& from, std::size_t j) const;
};

// What many flights begin with and end with, each at its own index.
struct Flights {
    Places places;              // in; out where matter was met
    const float* direction[3];  // unit
    const float* to;            // cells ahead, may be infinite; null: all are
    std::uint32_t* random[4];   // in, out: RandomLanes (lanes.h)
    float* depth;               // out: to the sun from where matter was met; with detail about
    std::int32_t* met;          // out: 1 or 0
};

// The flights with these indices. Unbiased. Bytes do not depend on which go together.
void fly_all(const Matter& matter, const Flights& flights, std::span<const std::uint32_t> which);

// One flight from anywhere along o + t d, d unit, t in [0, to] (may be infinite). True: it met matter, at t.
bool fly(const Matter& matter, const glm::dvec3& o, const glm::dvec3& d, double to,
         PathRandom& random, double& t);

// The state of a path's own random numbers at their beginning.
void seed(std::uint64_t key, std::uint32_t* const (&random)[4], std::size_t i);

}  // namespace awan::truth
