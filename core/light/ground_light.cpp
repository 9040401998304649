#include "core/light/ground_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/light/harmonics.h"
#include "core/light/sun_depth.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

using std::numbers::pi;

// Slabs of the lattice in which tilted lines are taken as straight: over a quarter of the cloud the sun's disc blurs by
// 1e-3 of the cloud's width at most.
constexpr int kSlabs = 4;
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
    return {r * exact::cos(turn), r * exact::sin(turn)};
}

// The lattice of the sun's depth over a level ground, in the sun's frame: places are u a + v b + w c with the lattice's
// axes, which need not be orthogonal; a, b, c in scene units.
struct SunBox {
    const SunDepth& sun;
    double height;         // of the ground
    glm::dvec3 low, size;  // of the lattice's nodes
    glm::dmat3 frame;      // makes (a, b, c) of scene units
    glm::dmat3 nodes;      // to_nodes of the lattice
};

SunBox sun_box(const SunDepth& sun, double height) {
    const glm::dmat3 nodes = to_nodes(sun);
    const glm::dmat3 frame(sun.cell * nodes[0], sun.cell * nodes[1], sun.cell * nodes[2]);
    return {sun, height, frame * sun.origin, sun.cell * glm::dvec3(sun.nodes - 1), frame, nodes};
}

// The lattice's sides across the light, the wider.
double column_width(const SunBox& box) {
    return std::max(box.sun.cell.x, box.sun.cell.y);
}

// The rows of the frame that make a and b of a place.
void set_frame(const SunBox& box, SunRaster& raster) {
    const glm::dmat3 rows = glm::transpose(box.frame);
    raster.u = rows[0];
    raster.v = rows[1];
}

// Makes (a, b) of a place in the plane through the origin that faces the sun, given along its own two axes. Where the
// lattice leans, a disc that faces the sun is an ellipse to it.
glm::dmat2 disc_in_frame(const SunBox& box) {
    const SideAxes side = side_axes(box.sun.w);
    const bool faces =
        std::abs(glm::dot(box.sun.u, box.sun.w)) + std::abs(glm::dot(box.sun.v, box.sun.w)) < 1e-9;
    if (faces) return glm::dmat2(1);
    return {glm::dvec2(box.frame * side.u), glm::dvec2(box.frame * side.v)};
}

// w of the ground's point at (u, v): where u sun.u.y + v sun.v.y + w sun.w.y = height.
double ground_at(const SunBox& box, double u, double v) {
    return (box.height - u * box.sun.u.y - v * box.sun.v.y) / box.sun.w.y;
}

// The longest way of light from the lattice's front to the ground; not > 0 where all of it is below the ground.
double longest_way(const SunBox& box) {
    double longest = 0;
    for (int corner = 0; corner < 4; ++corner)
        longest = std::max(longest, ground_at(box, box.low.x + (corner & 1 ? box.size.x : 0),
                                              box.low.y + (corner & 2 ? box.size.y : 0)) -
                                        box.low.z);
    return longest;
}

// Optical depth from the sun. Beside the lattice there is no matter, though its outermost nodes may hold a little:
// there the depth falls off over a cell.
double depth_in(const SunBox& box, double u, double v, double w) {
    const SunDepth& sun = box.sun;
    const glm::dvec2 off =
        glm::max(glm::max(glm::dvec2(box.low.x - u, box.low.y - v),
                          glm::dvec2(u - box.low.x - box.size.x, v - box.low.y - box.size.y)),
                 glm::dvec2(0));
    const double kept =
        std::max(0.0, 1 - off.x / sun.cell.x) * std::max(0.0, 1 - off.y / sun.cell.y);
    return kept > 0 ? kept * depth_at(sun, box.nodes, u * sun.u + v * sun.v + w * sun.w) : 0.0;
}

// Depth of the whole line that ends at `at` on the ground, w away, and leans by `tilt` against the sun's direction. In
// each slab it is that of a straight line through the point where the leaning one crosses the slab's middle.
double depth_along(const SunBox& box, const glm::dvec2& at, double w, const glm::dvec2& tilt) {
    const double deep = box.size.z / kSlabs;
    double whole = 0;
    for (int slab = 0; slab < kSlabs; ++slab) {
        const double from = box.low.z + slab * deep, to = std::min(from + deep, w);
        if (!(to > from)) break;
        const glm::dvec2 place = at - (w - 0.5 * (from + to)) * tilt;
        whole += depth_in(box, place.x, place.y, to) - depth_in(box, place.x, place.y, from);
    }
    return whole;
}

// A raster, all 0, that holds the lattice's shadow and the blur around it. slope: tangent of the blur's radius.
SunRaster raster_around(const SunBox& box, double slope) {
    SunRaster raster;
    set_frame(box, raster);
    const glm::dvec2 size(box.size.x, box.size.y);
    const double margin = longest_way(box) * slope + 1.5 * column_width(box);
    const double longer = std::max(size.x, size.y) + 2 * margin;
    raster.cell = std::max({column_width(box), margin / kNodesInBlur, longer / (kMostNodes - 1)});
    raster.nodes = glm::ivec2(glm::ceil((size + 2 * margin) / raster.cell)) + 1;
    raster.origin = glm::dvec2(box.low.x, box.low.y) + 0.5 * size -
                    0.5 * raster.cell * glm::dvec2(raster.nodes - 1);
    raster.share.resize(static_cast<std::size_t>(raster.nodes.x) *
                        static_cast<std::size_t>(raster.nodes.y));
    return raster;
}

// At each node the mean of of_depth over lines towards directions within `radius` (radians) of the sun; EMPTY where all
// matter is below the ground.
template <typename OfDepth>
SunRaster raster_of(const SunBox& box, double radius, int threads, const OfDepth& of_depth) {
    const double slope = exact::tan(radius);
    if (!(longest_way(box) > 0)) {
        SunRaster none;
        set_frame(box, none);
        return none;
    }
    SunRaster raster = raster_around(box, slope);
    const glm::dmat2 across = slope * disc_in_frame(box);
    const auto mean_at = [&](const glm::dvec2& at) {
        const double w = ground_at(box, at.x, at.y);
        // As many lines as the blur's disc has cells.
        const double widest = std::max(0.0, w - box.low.z) * slope / column_width(box);
        const int count =
            std::clamp(static_cast<int>(std::ceil(pi * widest * widest)), 1, kMostDirections);
        double sum = 0;
        for (int n = 0; n < count; ++n) {
            const glm::dvec2 tilt = count == 1 ? glm::dvec2(0) : across * in_disc(n, count);
            sum += of_depth(depth_along(box, at, w, tilt));
        }
        return static_cast<float>(sum / count);
    };
    parallel_for(threads, static_cast<std::size_t>(raster.nodes.y), [&](std::size_t row) {
        for (int i = 0; i < raster.nodes.x; ++i)
            raster.share[index(i, static_cast<int>(row), raster.nodes.x)] =
                mean_at(raster.origin + raster.cell * glm::dvec2(i, static_cast<double>(row)));
    });
    return raster;
}

// How far the forward peak turns light, root mean square, radians. The peak's Legendre moments are 1 up to l = L and
// about turning^(l - L - 1) from there on; a narrow peak of mean square angle a^2 has
//     1 - chi_l = l (l + 1) a^2 / 4,
// which at the first moment that is not 1, l = L + 2 = order + 1, gives
//     a^2 = 4 (1 - turning) / ((order + 1) (order + 2)).
double peak_width(double turning, int order) {
    return std::sqrt(4 * (1 - turning) / ((order + 1.0) * (order + 2.0)));
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
    std::size_t all = (shadow.share.capacity() + ahead.share.capacity()) * sizeof(float) +
                      change.irradiance.capacity() * sizeof(change.irradiance[0]);
    for (const ChangeAbove& one : above)
        all += one.change.irradiance.capacity() * sizeof(one.change.irradiance[0]);
    if (clouds) all += clouds->depth.capacity() * sizeof(float);
    if (relief) all += relief->bytes();
    return all;
}

glm::dvec3 change_above(const GroundLight& ground, const glm::dvec3& place) {
    double low = ground.height;
    const GroundChange* below = &ground.change;
    for (const GroundLight::ChangeAbove& one : ground.above) {
        if (place.y < one.y) {
            const double t = std::clamp((place.y - low) / (one.y - low), 0.0, 1.0);
            return (1 - t) * change_at(*below, place.x, place.z) +
                   t * change_at(one.change, place.x, place.z);
        }
        low = one.y;
        below = &one.change;
    }
    return change_at(*below, place.x, place.z);
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
            sum += radiance_at(ground, point.x + t * side * exact::sin(turn),
                               point.z + t * side * exact::cos(turn));
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
    ground.relief = relief_of(scene, 1);
    if (ground.relief) ground.albedo = ground.relief->mean_albedo;
    const Outside outside = outside_of(scene);
    ground.sun = std::max(outside.to_sun.y, 0.0) * outside.sun;
    ground.sky = means_of(outside.sky).irradiance_up;
    return ground;
}

void cast_shadow(const SunDepth& sun, double albedo, double peak_share, double turning, int threads,
                 GroundLight& ground) {
    if (sun.depth.empty() || !(-sun.w.y > kLowestShadow) || ground.sun == glm::dvec3(0)) return;
    if (ground.relief) {
        if (!ground.clouds) ground.clouds = std::make_shared<const SunDepth>(sun);
        ground.clouds_shade = true;
    }
    const SunBox box = sun_box(sun, ground.height);
    ground.shadow =
        raster_of(box, kSunRadius, threads, [](double depth) { return exact::expm1(-depth); });
    if (!(peak_share > 0) || !(albedo > 0)) return;
    // A disc of radius r has the root mean square radius r / sqrt(2).
    const double radius = std::numbers::sqrt2 * peak_width(turning, kOrders);
    // exp(-k depth) - exp(-depth) with k = `scaled` < 1, written so that nothing cancels.
    const double scaled = 1 - albedo * peak_share;
    ground.ahead = raster_of(box, radius, threads, [=](double depth) {
        return -exact::exp(-scaled * depth) * exact::expm1(-(1 - scaled) * depth);
    });
}

}  // namespace awan
