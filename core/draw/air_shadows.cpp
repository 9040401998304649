#include "core/draw/air_shadows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"

namespace awan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostSlices = 64;
// Cells of the sun's depth in a slice. With half as many, the light over the cloud of Rekawan's table 4.4 changes by
// 1e-4.
constexpr double kSliceCells = 2;
// Pictures up to this many pixels have rays 2, 4 pixels apart, larger ones 8.
constexpr int kSmall = 160 * 120, kMiddling = 400 * 300;

int spacing_for(int width, int height) {
    const std::int64_t pixels = std::int64_t{width} * height;
    return pixels <= kSmall ? 2 : pixels <= kMiddling ? 4 : 8;
}

// Cuts from..to down to those t for which at + t * by lies in low..high.
void clip(double at, double by, double low, double high, double& from, double& to) {
    if (by == 0) {
        if (at < low || at > high) to = from;
        return;
    }
    const double a = (low - at) / by, b = (high - at) / by;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
}

std::uint32_t slices(double length, double per_unit) {
    if (!(length > 0)) return 0;
    return static_cast<std::uint32_t>(
        std::clamp(std::ceil(length * per_unit / kSliceCells), 1.0, kMostSlices));
}

// Where the ray may meet shadow: in the prism that the lattice of the sun's depth fills when it is moved along the
// light. Within the lattice shadow changes from cell to cell; behind it only as far as the ray crosses the light.
AirShadows::Ray place(const SunDepth& sun, const glm::dvec3& eye, const glm::dvec3& direction,
                      double end) {
    AirShadows::Ray ray;
    const glm::dmat3 nodes = to_nodes(sun);
    const glm::dvec3 off = nodes * (eye - sun.origin), step = nodes * direction;
    double from = 0, to = end;
    clip(off.x, step.x, -0.5, sun.nodes.x - 0.5, from, to);
    clip(off.y, step.y, -0.5, sun.nodes.y - 0.5, from, to);
    const double w = off.z, down = step.z;
    clip(w, down, 0, kInfinity, from, to);
    if (!(from < to)) return ray;
    const double deepest = sun.nodes.z - 1;
    const double passes =
        down == 0 ? (w < deepest ? kInfinity : 0.0) : std::max((deepest - w) / down, 0.0);
    const bool leaves = down > 0 || (down == 0 && w < deepest);  // the lattice, not enters it
    ray.from = from;
    ray.to = to;
    ray.mid = std::clamp(passes, from, to);
    const double inside = glm::length(step), behind = exact::hypot(step.x, step.y);
    ray.first = slices(ray.mid - from, leaves ? inside : behind);
    ray.second = slices(to - ray.mid, leaves ? behind : inside);
    ray.per_first = ray.first > 0 ? ray.first / (ray.mid - from) : 0;
    ray.per_second = ray.second > 0 ? ray.second / (to - ray.mid) : 0;
    return ray;
}

// Depth from the sun along a ray, as depth_at (core/light/sun_depth.h) has it, with what the points share done once.
class DepthAlong {
  public:
    DepthAlong(const SunDepth& sun, const glm::dvec3& eye, const glm::dvec3& direction)
        : sun_(sun), last_(glm::dvec3(sun.nodes - 1)) {
        const glm::dmat3 nodes = to_nodes(sun);
        from_ = nodes * (eye - sun.origin);
        step_ = nodes * direction;
    }
    double operator()(double t) const {
        const glm::dvec3 p = glm::clamp(from_ + t * step_, glm::dvec3(0), last_);
        const glm::ivec3 n = sun_.nodes, low(p);
        const auto row = static_cast<std::size_t>(n.x), layer = row * static_cast<std::size_t>(n.y);
        const std::size_t dx = low.x + 1 < n.x ? 1 : 0, dy = low.y + 1 < n.y ? row : 0,
                          dz = low.z + 1 < n.z ? layer : 0;
        const glm::vec3 f(p - glm::dvec3(low));
        const float* at = sun_.depth.data() + static_cast<std::size_t>(low.z) * layer +
                          static_cast<std::size_t>(low.y) * row + static_cast<std::size_t>(low.x);
        const auto across = [&](const float* a) {
            const float near = a[0] + f.x * (a[dx] - a[0]);
            const float far = a[dy] + f.x * (a[dy + dx] - a[dy]);
            return near + f.y * (far - near);
        };
        const float near = across(at);
        return static_cast<double>(near + f.z * (across(at + dz) - near));
    }

  private:
    const SunDepth& sun_;
    glm::dvec3 last_, from_, step_;
};

// Fills the ray's nodes, and its `whole`.
void integrate(const HazeRay& haze, const SunDepth& sun, const glm::dvec3& eye,
               const glm::dvec3& direction, AirShadows::Ray& ray, float* lost) {
    if (ray.first + ray.second == 0) {
        *lost = 0;
        return;
    }
    double sum = 0, before = haze.opacity(ray.from);
    const DepthAlong depth(sun, eye, direction);
    const auto shade = [&](double t) {
        const double here = depth(t);
        return here > 0 ? 1 - exact::exp(-here) : 0.0;
    };
    *lost = ray.from > 0 ? 0 : static_cast<float>(shade(0));
    const auto part = [&](double from, double to, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            // A part without end runs along the light, or it would leave the prism: its shade is the same everywhere.
            const bool endless = std::isinf(to);
            const double share = (i + 1.0) / count, half = (i + 0.5) / count;
            const double end = i + 1 == count ? to : from + share * (to - from);
            const double after = haze.opacity(end);
            const double here = shade(endless ? from : from + half * (to - from));
            sum += here * (after - before);
            before = after;
            *++lost = static_cast<float>(after > 0 ? std::min(sum / after, 1.0) : here);
        }
    };
    part(ray.from, ray.mid, ray.first);
    part(ray.mid, ray.to, ray.second);
    ray.whole = sum;
}

double lost_on(const AirShadows& shadows, const AirShadows::Ray& ray, double t, double opacity) {
    if (t <= ray.from || !(opacity > 0)) return 0;
    if (t >= ray.to) return std::min(ray.whole / opacity, 1.0);
    const double place =
        t < ray.mid ? (t - ray.from) * ray.per_first : ray.first + (t - ray.mid) * ray.per_second;
    const std::uint32_t last = ray.first + ray.second;
    const std::uint32_t low = std::min(static_cast<std::uint32_t>(place), last - 1);
    const float* node = shadows.lost.data() + ray.at + low;
    const double share = std::min(place - low, 1.0);
    return static_cast<double>(node[0]) +
           share * (static_cast<double>(node[1]) - static_cast<double>(node[0]));
}

template <typename Value>
double bilinear(const AirShadows& shadows, double x, double y, const Value& value) {
    const double u = std::clamp(x / shadows.spacing, 0.0, shadows.across - 1.0);
    const double v = std::clamp(y / shadows.spacing, 0.0, shadows.down - 1.0);
    const int i = std::min(static_cast<int>(u), shadows.across - 2);
    const int j = std::min(static_cast<int>(v), shadows.down - 2);
    const double fx = u - i, fy = v - j;
    const AirShadows::Ray* const row =
        shadows.rays.data() +
        static_cast<std::size_t>(j) * static_cast<std::size_t>(shadows.across) + i;
    const auto along = [&](const AirShadows::Ray* at) {
        const double a = fx < 1 ? (1 - fx) * value(at[0]) : 0;
        return fx > 0 ? a + fx * value(at[1]) : a;
    };
    const double near = fy < 1 ? (1 - fy) * along(row) : 0;
    return fy > 0 ? near + fy * along(row + shadows.across) : near;
}

}  // namespace

AirShadows air_shadows(const PictureRays& picture, const Haze& haze, double ground,
                       const SunDepth& sun, int threads) {
    AirShadows shadows;
    if (sun.depth.empty() || !(haze.extinction > 0)) return shadows;
    shadows.spacing = spacing_for(picture.width, picture.height);
    // Blocks at the picture's edges look up light at their outer corners, beyond the picture.
    constexpr int kWhole = 16;
    const int per_block = kWhole / shadows.spacing;
    shadows.across = (picture.width + kWhole - 1) / kWhole * per_block + 1;
    shadows.down = (picture.height + kWhole - 1) / kWhole * per_block + 1;
    const auto across = static_cast<std::size_t>(shadows.across);
    shadows.rays.resize(across * static_cast<std::size_t>(shadows.down));
    const auto direction = [&](std::size_t i) {
        const double x = static_cast<double>(i % across) * shadows.spacing;
        const double y = static_cast<double>(i / across) * shadows.spacing;
        return glm::normalize(picture.corner + x * picture.per_x + y * picture.per_y);
    };
    std::uint32_t nodes = 0;
    for (std::size_t i = 0; i < shadows.rays.size(); ++i) {
        const glm::dvec3 d = direction(i);
        const double end =
            d.y < 0 && picture.eye.y > ground ? (picture.eye.y - ground) / -d.y : kInfinity;
        AirShadows::Ray& ray = shadows.rays[i];
        ray = place(sun, picture.eye, d, end);
        ray.at = nodes;
        nodes += ray.first + ray.second + 1;
    }
    shadows.lost.resize(nodes);
    parallel_for(threads, static_cast<std::size_t>(shadows.down), [&](std::size_t row) {
        for (std::size_t i = row * across; i < (row + 1) * across; ++i) {
            const glm::dvec3 d = direction(i);
            AirShadows::Ray& ray = shadows.rays[i];
            integrate(HazeRay(haze, picture.eye.y, d.y), sun, picture.eye, d, ray,
                      shadows.lost.data() + ray.at);
        }
    });
    return shadows;
}

double lost_at(const AirShadows& shadows, double x, double y, double t, double opacity) {
    return bilinear(shadows, x, y,
                    [&](const AirShadows::Ray& ray) { return lost_on(shadows, ray, t, opacity); });
}

double whole_lost(const AirShadows& shadows, double x, double y) {
    return bilinear(shadows, x, y, [](const AirShadows::Ray& ray) { return ray.whole; });
}

}  // namespace awan
