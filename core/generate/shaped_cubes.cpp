#include "core/generate/shaped_cubes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"

namespace awan {
namespace {

// Half an ellipsoid that stands on the cube's base. All relative to the cube: the middle from the base's middle, the
// half axes.
struct Dome {
    glm::dvec2 middle{0};
    glm::dvec3 axes{0};
    // How far its lumps are turned about its axis.
    exact::SinCos spin{};
    // Of the particles, those up to this share, from that of the dome before, are in it.
    double up_to = 1;
};

// Lumps on every dome.
constexpr std::size_t kLumps = 18;
// How far a dome reaches where two lumps meet and at the top of one, in half axes.
constexpr double kCrease = 0.68, kTop = 1;
// The square of the distance from a lump's top to where it ends, on the unit sphere.
constexpr double kLumpReach = 0.3;

constexpr std::size_t kMostDomes = 24;
struct Domes {
    std::array<Dome, kMostDomes> all{};
    std::size_t count = 0;
    // Where the lumps' tops are, unit vectors of the upper half: the same on every dome but for its spin.
    std::array<glm::dvec3, kLumps> lumps{};
};

// How high the flat dome is.
constexpr double kFoot = 0.36;
// A dome's half width over its height, smallest and largest.
constexpr double kSlim = 0.3, kBroad = 0.5;

Domes domes_of(const Cube& cube, std::uint64_t key) {
    const auto number = [key](std::size_t dome, std::uint64_t which, double from, double to) {
        const std::uint64_t bits = keyed(keyed(~key, dome), which);
        return from + (to - from) * unit_open(static_cast<std::uint32_t>(bits >> 32));
    };
    Domes domes;
    for (std::size_t k = 0; k < kLumps; ++k) {
        const double up = (static_cast<double>(k) + 0.3) / kLumps, flat = std::sqrt(1 - up * up);
        const exact::SinCos turn =
            exact::sincos_degrees(137.50776 * static_cast<double>(k) + number(k, 4, -20, 20));
        domes.lumps[k] = {flat * turn.cos, up, flat * turn.sin};
    }
    domes.all[0] = {{0, 0}, {0.5, kFoot, 0.5}, exact::sincos_degrees(number(0, 3, 0, 360)), 1};
    // So many that they cover the base about once.
    const double room = cube.size.x / cube.size.y * (cube.size.z / cube.size.y);
    const auto more = static_cast<std::size_t>(std::clamp(5 * room, 7.0, kMostDomes - 1.0));
    domes.count = 1 + more;
    for (std::size_t k = 1; k < domes.count; ++k) {
        // Over the base as the seeds of a sunflower are, a little moved; lower towards the rim.
        const double out = std::sqrt((static_cast<double>(k) - 0.7) / static_cast<double>(more));
        const exact::SinCos turn = exact::sincos_degrees(
            137.50776 * static_cast<double>(k) + number(k, 0, -25, 25) + number(0, 0, 0, 360));
        const double height = (1 - 0.38 * out * out) * number(k, 1, 0.72, 1);
        const double wide = height * number(k, 2, kSlim, kBroad) * cube.size.y;
        Dome& dome = domes.all[k];
        dome.axes = {std::min(0.5, wide / cube.size.x), height, std::min(0.5, wide / cube.size.z)};
        dome.middle = {(0.5 - dome.axes.x) * out * turn.cos, (0.5 - dome.axes.z) * out * turn.sin};
        dome.spin = exact::sincos_degrees(number(k, 3, 0, 360));
    }
    double sum = 0;
    for (std::size_t k = 0; k < domes.count; ++k) {
        const glm::dvec3& axes = domes.all[k].axes;
        sum += axes.x * axes.y * axes.z;
        domes.all[k].up_to = sum;
    }
    for (std::size_t k = 0; k < domes.count; ++k) domes.all[k].up_to /= sum;
    return domes;
}

// The third root of a number 0..1, the same on every machine: Newton's method, from above.
double third_root(double x) {
    double root = 1;
    for (int i = 0; i < 60; ++i) {
        const double next = root - (root - x / (root * root)) / 3;
        if (!(next < root)) break;
        root = next;
    }
    return root;
}

// How far a dome reaches in a direction (a unit vector), in half axes: spheres side by side, with creases between.
double reach(const Domes& domes, const exact::SinCos& spin, const glm::dvec3& direction) {
    const glm::dvec3 d(spin.cos * direction.x - spin.sin * direction.z, direction.y,
                       spin.sin * direction.x + spin.cos * direction.z);
    double nearest = -1;
    for (const glm::dvec3& lump : domes.lumps) nearest = std::max(nearest, glm::dot(lump, d));
    const double away = std::min(1.0, 2 * (1 - nearest) / kLumpReach);
    return kCrease + (kTop - kCrease) * std::sqrt(1 - away);
}

// u[0] chooses the dome, and what is left of it how far out in it the particle is.
FilledParticle cumulus_particle(const Cube& cube, const Domes& domes,
                                const std::array<double, 4>& u) {
    std::size_t k = 0;
    while (k + 1 < domes.count && u[0] > domes.all[k].up_to) ++k;
    const Dome& dome = domes.all[k];
    const double before = k > 0 ? domes.all[k - 1].up_to : 0;
    const double share = std::clamp((u[0] - before) / (dome.up_to - before), 0.0, 1.0);
    // Fuller at the shoulders than an ellipsoid.
    const double up = u[1], flat = std::sqrt(1 - up * up * up),
                 length = std::sqrt(up * up + flat * flat);
    const exact::SinCos turn = exact::sincos_degrees(360 * u[2]);
    const double out =
        third_root(share) *
        reach(domes, dome.spin, glm::dvec3(flat * turn.cos, up, flat * turn.sin) / length);
    const double radius = cube.radius * u[3];
    glm::dvec3 p(dome.middle.x + dome.axes.x * out * flat * turn.cos, dome.axes.y * out * up,
                 dome.middle.y + dome.axes.z * out * flat * turn.sin);
    p *= cube.size;
    p.y = std::min(std::max(p.y, radius / 2), cube.size.y) - cube.size.y / 2;
    return {cube.center + p, radius};
}

}  // namespace

void fill_cumulus(const Cube& cube, std::uint64_t key, std::uint64_t first, std::uint64_t last,
                  FilledParticle* out) {
    const Domes domes = domes_of(cube, key);
    ScrambledSobol points(key, static_cast<std::uint32_t>(first));
    for (std::uint64_t i = first; i < last; ++i)
        *out++ = cumulus_particle(cube, domes, points.next());
}

FilledParticle stratus_particle(const Cube& cube, const std::array<double, 4>& u) {
    const glm::dvec2 square(2 * u[0] - 1, 2 * u[2] - 1);
    // The map of a square to a disc that keeps the axes, a part of the way.
    constexpr double kRound = 0.35;
    const glm::dvec2 p(square.x * std::sqrt(1 - kRound * square.y * square.y),
                       square.y * std::sqrt(1 - kRound * square.x * square.x));
    const double rim = std::max(std::abs(square.x), std::abs(square.y)), rim2 = rim * rim;
    const double thick = std::sqrt(1 - rim2 * rim2);
    const glm::dvec3 offset(p.x / 2, (u[1] - 0.5) * thick, p.y / 2);
    return {cube.center + cube.size * offset, cube.radius * u[3]};
}

}  // namespace awan
