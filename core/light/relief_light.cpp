#include "core/light/relief_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/survey/projection.h"
#include "core/survey/relief_ray.h"

namespace awan {
namespace {

using std::numbers::pi;

constexpr int kMostNodes = 161;  // of S and O, along the relief's longer side
// Directions of the sky: so many around, and in bands even in the sine of the elevation.
constexpr int kAround = 16, kBands = 8;
// From place to place on the way to a horizon, the first in cells.
constexpr double kFirst = 1.5, kGrowth = 1.28;

struct SkyTable {
    glm::dvec3 direction[kAround][kBands];
    glm::dvec3 radiance[kAround][kBands];
};

SkyTable sky_table(const SkyDome& sky) {
    SkyTable table;
    for (int a = 0; a < kAround; ++a)
        for (int b = 0; b < kBands; ++b) {
            const double up = (b + 0.5) / kBands, flat = std::sqrt(1 - up * up);
            const double turn = 2 * pi * (a + 0.5) / kAround;
            table.direction[a][b] = {flat * exact::cos(turn), up, flat * exact::sin(turn)};
            table.radiance[a][b] = sky_radiance(sky, table.direction[a][b]);
        }
    return table;
}

// Sine of the elevation of the hills' edge against the sky, seen from x, z on them; 0: the level ground's.
double horizon_sine(const Relief& relief, double x, double z, const glm::dvec3& towards) {
    const double flat = exact::hypot(towards.x, towards.z), here = height_at(relief, x, z);
    const double dx = towards.x / flat, dz = towards.z / flat;
    const glm::dvec2 high = relief.high();
    double tangent = 0, to = kFirst * std::min(relief.cell.x, relief.cell.y);
    for (;; to *= kGrowth) {
        const double px = x + to * dx, pz = z + to * dz;
        if (!(px > relief.low.x && pz > relief.low.y && px < high.x && pz < high.y)) break;
        if (relief.highest - here <= tangent * to) break;
        tangent = std::max(tangent, (height_at(relief, px, pz) - here) / to);
    }
    return tangent / std::sqrt(1 + tangent * tangent);
}

// S and O of a place, where horizon(direction) is the sine of the hills' edge.
template <typename Horizon>
std::array<float, 12> open_below(const SkyTable& table, const Horizon& horizon) {
    std::array<glm::dvec3, 4> sums{};
    constexpr double kSolid = 2 * pi / (kAround * kBands);
    for (int a = 0; a < kAround; ++a) {
        const double edge = kBands * horizon(table.direction[a][0]);
        for (int b = 0; b < kBands; ++b) {
            const double seen = std::clamp(b + 1 - edge, 0.0, 1.0);
            if (!(seen > 0)) continue;
            const glm::dvec3 part = seen * kSolid * table.direction[a][b];
            for (int c = 0; c < 3; ++c)
                sums[static_cast<std::size_t>(c)] += part * table.radiance[a][b][c];
            sums[3] += part / pi;
        }
    }
    std::array<float, 12> open{};
    for (std::size_t i = 0; i < 12; ++i)
        open[i] = static_cast<float>(sums[i / 3][static_cast<int>(i % 3)]);
    return open;
}

// Irradiance from the sky, and n . O.
struct OpenSky {
    glm::dvec3 irradiance{0};
    double share = 1;
};
OpenSky open_sky(const ReliefLight& light, const GroundLight& ground, const glm::dvec3& place,
                 const glm::dvec3& normal) {
    const Relief& relief = *ground.relief;
    const glm::dvec2 span = relief.high() - relief.low;
    const glm::dvec2 at = glm::clamp((glm::dvec2(place.x, place.z) - relief.low) / span, 0.0, 1.0) *
                          glm::dvec2(light.nodes - 1);
    const glm::ivec2 cell = glm::min(glm::ivec2(at), light.nodes - 2);
    const glm::dvec2 t = at - glm::dvec2(cell);
    std::array<double, 4> sums{};
    const auto add = [&](const std::array<float, 12>& open, double weight) {
        for (std::size_t k = 0; k < 4; ++k)
            sums[k] += weight * (normal.x * static_cast<double>(open[3 * k]) +
                                 normal.y * static_cast<double>(open[3 * k + 1]) +
                                 normal.z * static_cast<double>(open[3 * k + 2]));
    };
    // Beside the hills they hide the less the farther they are.
    const glm::dvec2 here(place.x, place.z);
    const double away =
        glm::length(here - glm::clamp(here, relief.low, relief.high())) / relief.highest;
    const double near = 1 / (1 + away * away);
    if (near < 1) add(light.plain, 1 - near);
    for (int corner = 0; corner < 4; ++corner) {
        const int i = corner & 1, j = corner >> 1;
        const double weight = (i ? t.x : 1 - t.x) * (j ? t.y : 1 - t.y);
        add(light.open[static_cast<std::size_t>(cell.y + j) *
                           static_cast<std::size_t>(light.nodes.x) +
                       static_cast<std::size_t>(cell.x + i)],
            near * weight);
    }
    return {glm::max(glm::dvec3(sums[0], sums[1], sums[2]), glm::dvec3(0)),
            std::clamp(sums[3], 0.0, 1.0)};
}

// What comes through the clouds to a place from a point of the sun's disc. The line is taken as one that runs along the
// sun's light through the point where the leaning one is half way through the clouds.
double through_clouds(const ReliefLight& light, const GroundLight& ground, const glm::dvec3& place,
                      const glm::dvec3& to_sun) {
    const SunDepth& sun = *ground.clouds;
    if (sun.depth.empty()) return 1;
    const glm::dvec3 half = 0.5 * glm::dvec3(sun.nodes - 1) * sun.cell;
    const glm::dvec3 middle = sun.origin + half.x * sun.u + half.y * sun.v + half.z * sun.w;
    const double behind = std::max(glm::dot(place - middle, sun.w), 0.0);
    const glm::dvec3 tilt = to_sun / glm::dot(to_sun, light.to_sun) - light.to_sun;
    const glm::dvec3 p = place + behind * tilt;
    const glm::dvec3 at = light.to_nodes * (p - sun.origin), last(sun.nodes - 1);
    // Beside the lattice there is no matter.
    if (at.x <= -1 || at.y <= -1 || at.x >= last.x + 1 || at.y >= last.y + 1 || at.z <= 0)
        return std::clamp(1 + share_at(ground.ahead, p), 0.0, 1.0);
    // What comes through along the four columns around it, not their depths: between a deep cloud and none, these would
    // make the shadow a cell wider, and its edge blocks.
    const double x = std::floor(at.x), y = std::floor(at.y);
    const double z = std::min(at.z, last.z), k = std::min(std::floor(z), std::max(last.z - 1, 0.0));
    const auto depth_of = [&](int i, int j, int layer) {
        return static_cast<double>(
            sun.depth[(static_cast<std::size_t>(layer) * static_cast<std::size_t>(sun.nodes.y) +
                       static_cast<std::size_t>(j)) *
                          static_cast<std::size_t>(sun.nodes.x) +
                      static_cast<std::size_t>(i)]);
    };
    double through = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const int i = static_cast<int>(x) + (corner & 1), j = static_cast<int>(y) + (corner >> 1);
        const double weight =
            (corner & 1 ? at.x - x : 1 - at.x + x) * (corner >> 1 ? at.y - y : 1 - at.y + y);
        if (i < 0 || j < 0 || i >= sun.nodes.x || j >= sun.nodes.y) {
            through += weight;
            continue;
        }
        const int low = static_cast<int>(k), high = std::min(low + 1, sun.nodes.z - 1);
        const double depth =
            depth_of(i, j, low) + (z - k) * (depth_of(i, j, high) - depth_of(i, j, low));
        through += weight * exact::exp(-std::max(depth, 0.0));
    }
    return std::clamp(through + share_at(ground.ahead, p), 0.0, 1.0);
}

// Share of the sun's irradiance.
double sunlit(const ReliefLight& light, const GroundLight& ground, const glm::dvec3& place,
              const glm::dvec3& normal, const glm::dvec2& aside) {
    if (light.sun == glm::dvec3(0)) return 0;
    const glm::dvec3 to_sun =
        glm::normalize(light.to_sun + aside.x * light.aside_u + aside.y * light.aside_v);
    const double cosine = glm::dot(normal, to_sun);
    if (!(cosine > 0) || !(to_sun.y > 0)) return 0;
    if (std::isfinite(hills_ahead(*ground.relief, lifted(*ground.relief, place), to_sun))) return 0;
    return cosine * (ground.clouds_shade && ground.clouds
                         ? through_clouds(light, ground, place, to_sun)
                         : 1.0);
}

glm::dvec3 place_on(const Relief& relief, double x, double z) {
    return {x, relief.base + height_at(relief, x, z), z};
}

// Of all hills, over the level area that they stand on: each place counts as much as its light does from above.
glm::dvec3 mean_radiance(const ReliefLight& light, const GroundLight& ground, int threads) {
    const Relief& relief = *ground.relief;
    constexpr int kSide = 64;
    std::vector<glm::dvec3> rows(kSide, glm::dvec3(0));
    parallel_for(threads, kSide, [&](std::size_t j) {
        for (int i = 0; i < kSide; ++i) {
            const glm::dvec2 at = relief.low + (relief.high() - relief.low) *
                                                   (glm::dvec2(i, j) + 0.5) /
                                                   static_cast<double>(kSide);
            rows[j] += radiance_at(light, ground, place_on(relief, at.x, at.y), glm::dvec2(0));
        }
    });
    glm::dvec3 sum(0);
    for (const glm::dvec3& row : rows) sum += row;
    return sum / (1.0 * kSide * kSide);
}

}  // namespace

ReliefLight relief_light(const Scene& scene, const GroundLight& ground, int threads) {
    const Relief& relief = *ground.relief;
    const Outside outside = outside_of(scene);
    ReliefLight light;
    light.to_sun = outside.to_sun;
    light.sun = outside.to_sun.y > 0 ? outside.sun : glm::dvec3(0);
    const SideAxes side = side_axes(outside.to_sun);
    light.aside_u = exact::tan(kSunRadius) * side.u;
    light.aside_v = exact::tan(kSunRadius) * side.v;
    if (ground.clouds && !ground.clouds->depth.empty()) light.to_nodes = to_nodes(*ground.clouds);

    const int longer = std::max(relief.cells.x, relief.cells.y);
    light.nodes = glm::max((kMostNodes - 1) * relief.cells / longer, 1) + 1;
    const SkyTable table = sky_table(outside.sky);
    const glm::dvec2 gap = (relief.high() - relief.low) / glm::dvec2(light.nodes - 1);
    light.plain = open_below(table, [](const glm::dvec3&) { return 0.0; });
    light.open.resize(static_cast<std::size_t>(light.nodes.x) *
                      static_cast<std::size_t>(light.nodes.y));
    parallel_for(threads, static_cast<std::size_t>(light.nodes.y), [&](std::size_t row) {
        for (int i = 0; i < light.nodes.x; ++i)
            light
                .open[row * static_cast<std::size_t>(light.nodes.x) + static_cast<std::size_t>(i)] =
                open_below(table, [&](const glm::dvec3& towards) {
                    return horizon_sine(relief, relief.low.x + i * gap.x,
                                        relief.low.y + static_cast<double>(row) * gap.y, towards);
                });
    });
    light.bounced = mean_radiance(light, ground, threads);
    return light;
}

glm::dvec3 radiance_at(const ReliefLight& light, const GroundLight& ground, const glm::dvec3& place,
                       const glm::dvec2& aside) {
    const glm::dvec3 normal = normal_at(*ground.relief, place.x, place.z);
    const OpenSky open = open_sky(light, ground, place, normal);
    const glm::dvec3 direct = sunlit(light, ground, place, normal, aside) * light.sun;
    const glm::dvec3 all = direct + open.irradiance + open.share * change_above(ground, place) +
                           pi * light.bounced * (1 - open.share);
    return albedo_at(*ground.relief, place.x, place.z, normal) * glm::max(all, glm::dvec3(0)) / pi;
}

glm::dvec3 level_albedo(const ReliefLight& light, const GroundLight& ground) {
    const glm::dvec3 all = ground.sun + ground.sky;
    glm::dvec3 albedo = ground.albedo;
    for (int c = 0; c < 3; ++c)
        if (all[c] > 0) albedo[c] = std::clamp(pi * light.bounced[c] / all[c], 0.0, 1.0);
    return albedo;
}

void shade_by_hills(const Relief& relief, int threads, SunDepth& sun) {
    if (sun.depth.empty()) return;
    const auto across = static_cast<std::size_t>(sun.nodes.x);
    const std::size_t layer = across * static_cast<std::size_t>(sun.nodes.y);
    parallel_for(threads, static_cast<std::size_t>(sun.nodes.y), [&](std::size_t j) {
        for (std::size_t i = 0; i < across; ++i) {
            const glm::dvec3 front = sun.origin + static_cast<double>(i) * sun.cell.x * sun.u +
                                     static_cast<double>(j) * sun.cell.y * sun.v;
            const auto shaded = [&](int k) {
                return std::isfinite(hills_ahead(relief, front + k * sun.cell.z * sun.w, -sun.w));
            };
            // What is behind a place in shadow is in shadow: the first of each column is found by halving.
            int lit = -1, dark = sun.nodes.z;
            while (dark - lit > 1) {
                const int middle = (lit + dark) / 2;
                (shaded(middle) ? dark : lit) = middle;
            }
            for (int k = dark; k < sun.nodes.z; ++k)
                sun.depth[static_cast<std::size_t>(k) * layer + j * across + i] += kHillDepth;
        }
    });
}

}  // namespace awan
