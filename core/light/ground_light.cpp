#include "core/light/ground_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/parallel.h"
#include "core/light/sun_depth.h"

namespace awan {
namespace {

using std::numbers::pi;

constexpr int kSlabs =
    4;  // a slab of a quarter of the cloud blurs its own width by 1e-3 of it at most
constexpr int kMostDirections = 96;  // in the disc
constexpr int kMostNodes = 192;      // along the longer side of a raster
constexpr double kNodesInBlur = 4;   // of a raster, in the radius of its widest blur

// Bilinear, in nodes; `value(i, j)` of nodes within 0..n-1.
template <typename Value>
auto bilinear(const glm::dvec2& at, const glm::ivec2& nodes, const Value& value) {
    const glm::ivec2 low =
        glm::clamp(glm::ivec2(glm::floor(at)), glm::ivec2(0), glm::max(nodes - 2, 0));
    const glm::ivec2 high = glm::min(low + 1, nodes - 1);
    const glm::dvec2 t = glm::clamp(at - glm::dvec2(low), 0.0, 1.0);
    return (1 - t.y) * ((1 - t.x) * value(low.x, low.y) + t.x * value(high.x, low.y)) +
           t.y * ((1 - t.x) * value(low.x, high.y) + t.x * value(high.x, high.y));
}

std::size_t index(int i, int j, int across) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(across) +
           static_cast<std::size_t>(i);
}

// Even over the unit disc: Vogel 1979, "A better way to construct the sunflower head".
glm::dvec2 in_disc(int i, int count) {
    const double r = std::sqrt((i + 0.5) / count), turn = i * pi * (3 - std::sqrt(5.0));
    return {r * std::cos(turn), r * std::sin(turn)};
}

// The raster's share at each node: the mean of of_depth over lines towards directions within `radius` (radians) of the sun.
template <typename OfDepth>
SunRaster raster_of(const SunDepth& sun, double height, double radius, int threads,
                    const OfDepth& of_depth) {
    SunRaster raster;
    raster.u = sun.u;
    raster.v = sun.v;
    const glm::dvec3 low = glm::dvec3(glm::dot(sun.origin, sun.u), glm::dot(sun.origin, sun.v),
                                      glm::dot(sun.origin, sun.w));
    const glm::dvec3 size = sun.cell * glm::dvec3(sun.nodes - 1);
    // The point of the ground at (u, v) of the sun's frame: w from p.y = height.
    const auto along = [&](double u, double v) {
        return (height - u * sun.u.y - v * sun.v.y) / sun.w.y;
    };
    // The longest way from the matter's middle to the ground sets the widest blur.
    double farthest = 0;
    for (int corner = 0; corner < 4; ++corner)
        farthest = std::max(
            farthest,
            along(low.x + (corner & 1 ? size.x : 0), low.y + (corner & 2 ? size.y : 0)) - low.z);
    if (!(farthest > 0)) return raster;  // all of it is below the ground
    const double slope = std::tan(radius), margin = farthest * slope + 1.5 * sun.cell;
    const double longer = std::max(size.x, size.y) + 2 * margin;
    raster.cell = std::max({sun.cell, margin / kNodesInBlur, longer / (kMostNodes - 1)});
    raster.nodes =
        glm::ivec2(glm::ceil((glm::dvec2(size.x, size.y) + 2 * margin) / raster.cell)) + 1;
    raster.origin = glm::dvec2(low.x, low.y) + 0.5 * glm::dvec2(size.x, size.y) -
                    0.5 * raster.cell * glm::dvec2(raster.nodes - 1);
    raster.share.resize(static_cast<std::size_t>(raster.nodes.x) *
                        static_cast<std::size_t>(raster.nodes.y));
    const double deep = size.z / kSlabs;
    // Beside the lattice there is no matter, though its outermost nodes may hold a little.
    const auto depth = [&](double u, double v, double w) {
        const glm::dvec2 off =
            glm::max(glm::max(glm::dvec2(low.x - u, low.y - v),
                              glm::dvec2(u - low.x - size.x, v - low.y - size.y)),
                     glm::dvec2(0));
        const double kept =
            std::max(0.0, 1 - off.x / sun.cell) * std::max(0.0, 1 - off.y / sun.cell);
        return kept > 0 ? kept * depth_at(sun, u * sun.u + v * sun.v + w * sun.w) : 0.0;
    };
    parallel_for(threads, static_cast<std::size_t>(raster.nodes.y), [&](std::size_t row) {
        for (int i = 0; i < raster.nodes.x; ++i) {
            const glm::dvec2 at =
                raster.origin + raster.cell * glm::dvec2(i, static_cast<double>(row));
            const double w = along(at.x, at.y);
            const double widest = std::max(0.0, w - low.z) * slope / sun.cell;
            const int count =
                std::clamp(static_cast<int>(std::ceil(pi * widest * widest)), 1, kMostDirections);
            double sum = 0;
            for (int n = 0; n < count; ++n) {
                const glm::dvec2 tilt = count == 1 ? glm::dvec2(0) : slope * in_disc(n, count);
                double whole = 0;
                for (int slab = 0; slab < kSlabs; ++slab) {
                    const double from = low.z + slab * deep, to = std::min(from + deep, w);
                    if (!(to > from)) break;
                    const glm::dvec2 place = at - (w - 0.5 * (from + to)) * tilt;
                    whole += depth(place.x, place.y, to) - depth(place.x, place.y, from);
                }
                sum += of_depth(whole);
            }
            raster.share[index(i, static_cast<int>(row), raster.nodes.x)] =
                static_cast<float>(sum / count);
        }
    });
    return raster;
}

// Radians, root mean square: of the peak, whose Legendre moments are 1 up to L and g^(l - L - 1) from there on,
// by the second of those: 1 - P_l(cos a) is about l (l + 1) a^2 / 4.
double peak_width(double g, int order) {
    return std::sqrt(4 * (1 - g) / ((order + 1.0) * (order + 2.0)));
}

}  // namespace

double share_at(const SunRaster& raster, const glm::dvec3& point) {
    if (raster.share.empty()) return 0;
    const glm::dvec2 at =
        (glm::dvec2(glm::dot(point, raster.u), glm::dot(point, raster.v)) - raster.origin) /
        raster.cell;
    if (!(at.x >= 0 && at.y >= 0 && at.x <= raster.nodes.x - 1 && at.y <= raster.nodes.y - 1))
        return 0;
    return bilinear(at, raster.nodes, [&](int i, int j) {
        return static_cast<double>(raster.share[index(i, j, raster.nodes.x)]);
    });
}

glm::dvec3 change_at(const GroundChange& change, double x, double z) {
    if (change.irradiance.empty()) return glm::dvec3(0);
    const glm::dvec2 off = (glm::dvec2(x, z) - change.center) / change.reach;
    const glm::dvec2 t = off / (1.0 + glm::abs(off));
    return bilinear(0.5 * (t + 1.0) * static_cast<double>(change.side - 1), glm::ivec2(change.side),
                    [&](int i, int j) {
                        const std::array<float, 3>& c = change.irradiance[index(i, j, change.side)];
                        return glm::dvec3(static_cast<double>(c[0]), static_cast<double>(c[1]),
                                          static_cast<double>(c[2]));
                    });
}

std::size_t GroundLight::bytes() const {
    return (shadow.share.capacity() + ahead.share.capacity()) * sizeof(float) +
           change.irradiance.capacity() * sizeof(change.irradiance[0]);
}

glm::dvec3 irradiance_at(const GroundLight& ground, double x, double z) {
    const glm::dvec3 p(x, ground.height, z);
    const double direct = std::max(0.0, 1 + share_at(ground.shadow, p) + share_at(ground.ahead, p));
    return glm::max(direct * ground.sun + ground.sky + change_at(ground.change, x, z),
                    glm::dvec3(0));
}

glm::dvec3 mean_radiance_below(const GroundLight& ground, const glm::dvec3& point) {
    const double above = point.y - ground.height;
    if (!(above > 0)) return glm::dvec3(0);
    constexpr int kUp = 8, kAround = 16;
    glm::dvec3 sum(0);
    for (int i = 0; i < kUp; ++i)
        for (int j = 0; j < kAround; ++j) {
            const double down = (i + 0.5) / kUp, side = std::sqrt(1 - down * down);
            const double turn = 2 * pi * (j + 0.5 * (i % 2)) / kAround, t = above / down;
            sum += radiance_at(ground, point.x + t * side * std::sin(turn),
                               point.z + t * side * std::cos(turn));
        }
    return sum / (1.0 * kUp * kAround);
}

bool has_ground(const SceneDraft& scene, const Bounds& cloud) {
    return scene.ground && cloud.max.y > scene.ground->height;
}

GroundLight bare_ground(const SceneDraft& scene) {
    GroundLight ground;
    if (!scene.ground) return ground;
    ground.present = true;
    ground.height = scene.ground->height;
    ground.albedo = scene.ground->albedo;
    const Outside outside = outside_of(scene);
    ground.sun = std::max(outside.to_sun.y, 0.0) * outside.sun;
    ground.sky = means_of(outside.sky).irradiance_up;
    return ground;
}

void cast_shadow(const SunDepth& sun, double albedo, double peak_share, double g, int threads,
                 GroundLight& ground) {
    if (sun.depth.empty() || !(-sun.w.y > kLowestShadow) || ground.sun == glm::dvec3(0)) return;
    ground.shadow = raster_of(sun, ground.height, kSunRadius, threads,
                              [](double depth) { return std::expm1(-depth); });
    if (!(peak_share > 0) || !(albedo > 0)) return;
    // exp(-k tau) - exp(-tau) without cancellation, k < 1. The disc of radius r has the rms radius r / sqrt(2).
    const double scaled = 1 - albedo * peak_share;
    ground.ahead = raster_of(
        sun, ground.height, std::numbers::sqrt2 * peak_width(g, 4), threads, [=](double depth) {
            return -std::exp(-scaled * depth) * std::expm1(-(1 - scaled) * depth);
        });
}

}  // namespace awan
