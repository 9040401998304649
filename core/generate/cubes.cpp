#include "core/generate/cubes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/generate/shaped_cubes.h"

namespace awan {
namespace {

using std::numbers::pi;

FilledParticle from_unit_point(const Cube& cube, const std::array<double, 4>& u) {
    const glm::dvec3 offset(u[0] - 0.5, u[1] - 0.5, u[2] - 0.5);
    return {cube.center + cube.size * offset, cube.radius * u[3]};
}

// x reflected at +-half until it lies between them.
double reflect(double x, double half) {
    double t = std::fmod(x + half, 4 * half);
    if (t < 0) t += 4 * half;
    return (t > 2 * half ? 4 * half - t : t) - half;
}

FilledParticle gardner_particle(const Cube& cube, const std::array<double, 4>& u) {
    const glm::dvec3 p = cube.size * glm::dvec3(u[0] - 0.5, u[1] - 0.5, u[2] - 0.5);
    const double fx = 2 * pi / cube.size.x, fy = 2 * pi / cube.size.y;
    const double depth_phase = pi * exact::seeded_sin(fx * p.z / 2);
    const double px = pi / 2 * exact::seeded_sin(fy * p.y) + depth_phase;
    const double py = pi / 2 * exact::seeded_sin(fx * p.x) + depth_phase;
    const glm::dvec3 moved(reflect(p.x + px / fx, cube.size.x / 2),
                           reflect(p.y + py / fy, cube.size.y / 2), p.z);
    return {cube.center + moved, cube.radius * u[3]};
}

// By offsets from the centre: far from the origin, `center +- size / 2` may round to `center`.
bool inside(const Cube& cube, glm::dvec3 p) {
    const glm::dvec3 d = p - cube.center;
    return std::abs(d.x) <= cube.size.x / 2 && std::abs(d.y) <= cube.size.y / 2 &&
           std::abs(d.z) <= cube.size.z / 2;
}

FilledParticle printed_particle(const Cube& cube, std::uint64_t key) {
    const auto uniform = [key](int draw, int dimension) {
        const auto number = static_cast<std::uint64_t>(draw) * 4 + static_cast<unsigned>(dimension);
        return unit_open(static_cast<std::uint32_t>(keyed(key, number) >> 32));
    };
    const auto uniform3 = [&](int draw) {
        return glm::dvec3(uniform(draw, 0), uniform(draw, 1), uniform(draw, 2));
    };
    FilledParticle particle{};
    bool placed = false, sized = false;
    for (int draw = 0; draw < kMaxPrintedDraws && !(placed && sized); ++draw) {
        if (!placed) {
            particle.center = printed_position(cube, uniform3(draw));
            placed = inside(cube, particle.center);
        }
        if (!sized) {
            particle.radius = std::min(printed_radius(cube.radius, uniform(draw, 3)), cube.radius);
            sized = particle.radius > 0;
        }
    }
    const int last = kMaxPrintedDraws;
    if (!placed) particle.center = cube.center + cube.size * (uniform3(last) - 0.5);
    if (!sized) particle.radius = cube.radius * uniform(last, 3);
    return particle;
}

}  // namespace

glm::dvec3 printed_position(const Cube& cube, glm::dvec3 random3) {
    // (4.2)-(4.4): for each axis, a large random number modulo the side.
    glm::dvec3 x = random3 * cube.size;
    const glm::dvec3 half(x / 2.0);
    // (4.5): the phases from across.
    double px = pi / 2 * exact::seeded_sin(half.y);
    double py = pi / 2 * exact::seeded_sin(half.x);
    const double pz = pi / 2 * exact::seeded_sin(half.z);
    // (4.6), the second line with the first line's result.
    px += pi * exact::seeded_sin(px * half.z);
    py += pi * exact::seeded_sin(px * half.z);
    // (4.7): the phases move the point.
    x += glm::dvec3(px, py, pz);
    // (4.8): half of it, from the centre.
    return cube.center + x / 2.0;
}

double printed_radius(double max_radius, double random1) {
    // (4.9)-(4.11): a large random number modulo the largest radius.
    const double r = random1 * max_radius;
    // (4.12): its phase.
    return r + pi / 2 * exact::seeded_sin(r);
}

void fill_cube(const Cube& cube, Fill fill, std::uint64_t key, std::uint64_t first,
               std::uint64_t last, FilledParticle* out) {
    if (fill == Fill::kPrinted) {
        for (std::uint64_t i = first; i < last; ++i) *out++ = printed_particle(cube, keyed(key, i));
        return;
    }
    if (fill == Fill::kCumulus) return fill_cumulus(cube, key, first, last, out);
    ScrambledSobol points(key, static_cast<std::uint32_t>(first));
    if (fill == Fill::kGardner) {
        for (std::uint64_t i = first; i < last; ++i) *out++ = gardner_particle(cube, points.next());
    } else if (fill == Fill::kStratus) {
        for (std::uint64_t i = first; i < last; ++i) *out++ = stratus_particle(cube, points.next());
    } else {
        for (std::uint64_t i = first; i < last; ++i) *out++ = from_unit_point(cube, points.next());
    }
}

}  // namespace awan
