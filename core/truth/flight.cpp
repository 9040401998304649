#include "core/truth/flight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/generate/keyed_random.h"
#include "core/truth/brick_sample.h"
#include "core/truth/brick_walk.h"
#include "core/truth/lane_targets.h"

namespace awan::truth {
namespace {

// t in [a, b] at which the listed particles of a brick have given optical depth `left` from a on.
double where_listed(const Matter& m, std::size_t brick, const glm::dvec3& o, const glm::dvec3& d,
                    double a, double b, double left) {
    double low = a, high = b;
    for (int i = 0; i < 100; ++i) {
        const double t = 0.5 * (low + high);
        if (t <= low || t >= high) break;
        double depth = 0;
        for (std::uint32_t k = m.brick_begin[brick]; k < m.brick_begin[brick + 1]; ++k)
            depth += listed_depth(m.listed[m.brick_items[k]], o, d, a, t);
        (depth < left ? low : high) = t;
    }
    return 0.5 * (low + high);
}

}  // namespace
}  // namespace awan::truth

#define AWAN_LANES_FILE "core/truth/flight_batch.h"
#include "core/truth/for_each_target.h"

namespace awan::truth {

void Places::set(std::size_t i, const Matter& m, const glm::dvec3& q) const {
    const glm::ivec3 b = brick_of(m, q);
    for (int a = 0; a < 3; ++a) {
        brick[a][i] = b[a];
        local[a][i] = static_cast<float>(
            std::clamp(q[a] - double{kBrick} * b[a], 0.0, static_cast<double>(kBrick)));
    }
}

glm::dvec3 Places::at(std::size_t i) const {
    glm::dvec3 q;
    for (int a = 0; a < 3; ++a)
        q[a] = double{kBrick} * brick[a][i] + static_cast<double>(local[a][i]);
    return q;
}

void Places::copy(std::size_t i, const Places& from, std::size_t j) const {
    for (int a = 0; a < 3; ++a) {
        brick[a][i] = from.brick[a][j];
        local[a][i] = from.local[a][j];
    }
}

void fly_all(const Matter& m, const Flights& flights, std::span<const std::uint32_t> which) {
    if (m.empty) {
        for (const std::uint32_t i : which) flights.met[i] = 0;
        return;
    }
    AWAN_ON_TARGET(fly_through(m, flights, which))
}

void seed(std::uint64_t key, std::uint32_t* const (&random)[4], std::size_t i) {
    // All four 0 is the one state that it never leaves; no key gives it, since the mix is a bijection.
    const std::uint64_t a = keyed(key, 0), b = keyed(key, 1);
    random[0][i] = static_cast<std::uint32_t>(a);
    random[1][i] = static_cast<std::uint32_t>(a >> 32);
    random[2][i] = static_cast<std::uint32_t>(b);
    random[3][i] = static_cast<std::uint32_t>(b >> 32);
}

bool fly(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double to, PathRandom& random,
         double& t) {
    if (m.empty) return false;
    const BrickWalk walk(m, o, d, 0, to);
    if (!walk.inside()) return false;
    const glm::dvec3 enters = o + walk.enter() * d;
    std::int32_t brick[3], met = 0;
    float local[3], depth = 0;
    std::uint32_t state[4];
    const float along[3] = {static_cast<float>(d.x), static_cast<float>(d.y),
                            static_cast<float>(d.z)};
    const auto end = static_cast<float>(walk.end() - walk.enter());
    const Flights flights{{{brick, brick + 1, brick + 2}, {local, local + 1, local + 2}},
                          {along, along + 1, along + 2},
                          &end,
                          {state, state + 1, state + 2, state + 3},
                          &depth,
                          &met};
    flights.places.set(0, m, enters);
    seed(random.key(), flights.random, 0);
    const std::uint32_t first = 0;
    fly_all(m, flights, {&first, 1});
    if (met != 0) t = walk.enter() + glm::dot(flights.places.at(0) - enters, d);
    return met != 0;
}

}  // namespace awan::truth
