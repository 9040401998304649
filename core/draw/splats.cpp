#include "core/draw/splats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/shaders/shared.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

constexpr double kMinReach = 4;          // of s
constexpr double kFaintDepth = 1e-3;     // optical depth at which a dense particle may be cut
constexpr double kMinWidthPixels = 0.5;  // of s
constexpr double kCloseReaches = 2;      // an eye within so many reaches needs the half line

// Light of unit colour and full strength, per channel.
struct Sources {
    glm::dvec3 sun;    // direct and scattered: sun irradiance / 4 pi
    glm::dvec3 above;  // upper half of the sky: its share of the mean radiance
    glm::dvec3 below;
    double albedo;
};

Sources sources_of(const Scene& scene, const Plan& plan) {
    const Sky& sky = scene->sky;
    Sources sources{scene->sun.color * (scene->sun.intensity / (4 * std::numbers::pi)),
                    glm::dvec3(0), glm::dvec3(0), scene->medium.albedo};
    if (plan.on(Effect::kSkyLight)) {
        sources.above =
            0.5 * sky.intensity * glm::dvec3(shader::sky_mean_above(sky.zenith, sky.horizon));
        sources.below = 0.5 * sky.intensity * sky.horizon;
    }
    return sources;
}

// A particle in the eye's frame.
struct Seen {
    glm::dvec3 q;
    double distance, s, tau, reach;
    bool widened;
    gl::TileBox tiles;
};

// Pixels whose centres see slopes low..high, as tiles. `up`: rows count downward.
void tiles_of(Interval slopes, double tangent, int pixels, bool up, std::int32_t& first,
              std::int32_t& last) {
    if (slopes.low > slopes.high) return;
    const double sign = up ? -1 : 1;
    const auto pixel = [&](double slope) {
        return std::clamp((sign * slope / tangent + 1) / 2 * pixels - 0.5, -1.0,
                          static_cast<double>(pixels));
    };
    const double a = pixel(up ? slopes.high : slopes.low), b = pixel(up ? slopes.low : slopes.high);
    const int low = std::max(0, static_cast<int>(std::ceil(a))),
              high = std::min(pixels - 1, static_cast<int>(std::floor(b)));
    if (low > high) return;
    first = low / kTilePixels;
    last = high / kTilePixels;
}

Seen see(const Scene& scene, const ParticleSet& particles, std::size_t i, const View& view) {
    Seen seen{};
    const glm::dvec3 p = particles.center[i] - view.eye;
    seen.q = {glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward)};
    seen.distance = glm::length(seen.q);
    const double own_s = 0.5 * static_cast<double>(particles.radius[i]);
    const double pixel = 2 * view.tan_half_fov / scene->image.height;
    seen.s = std::max({own_s, kMinWidthPixels * pixel * seen.distance, 1e-12});
    seen.widened = seen.s > own_s;
    const double thinned = (own_s / seen.s) * (own_s / seen.s);
    seen.tau = thinned * static_cast<double>(particles.density[i]) * own_s *
               std::sqrt(2 * std::numbers::pi);
    if (!(seen.tau > 0)) return seen;
    seen.reach = seen.s * std::max(kMinReach,
                                   std::sqrt(2 * std::log(std::max(1.0, seen.tau / kFaintDepth))));
    gl::TileBox tiles;
    tiles_of(disc_slopes(seen.q.x, seen.q.z, seen.reach), view.tan_half_fov * view.aspect,
             scene->image.width, false, tiles.first_x, tiles.last_x);
    tiles_of(disc_slopes(seen.q.y, seen.q.z, seen.reach), view.tan_half_fov, scene->image.height,
             true, tiles.first_y, tiles.last_y);
    seen.tiles = tiles;
    return seen;
}

// A linear function of scene offsets as one of eye offsets, with its value at the eye instead of at
// the centre.
glm::vec4 from_eye(glm::dvec4 f, const View& view, glm::dvec3 q) {
    const glm::dvec3 gradient(f);
    const glm::dvec3 turned(glm::dot(gradient, view.right), glm::dot(gradient, view.up),
                            glm::dot(gradient, view.forward));
    return glm::vec4(glm::dvec4(turned, f.w - glm::dot(turned, q)));
}

Splat make_splat(const Seen& seen, glm::dvec3 color, const ParticleLight* lit, const View& view,
                 const Sources& sources) {
    Splat splat{};
    const double c = seen.q.x * seen.q.x + seen.q.z * seen.q.z;
    splat.place = glm::vec4(glm::dvec4(seen.q, 0.5 / (seen.s * seen.s)));
    splat.matter = glm::vec4(glm::dvec4(seen.tau, 1 / seen.s, c, c > 0 ? seen.q.y / c : 0));
    const glm::dvec3 albedo = sources.albedo * color;
    const glm::dvec3 cap = albedo * (sources.sun + sources.above + sources.below);
    splat.tint = glm::vec4(glm::dvec4(albedo * sources.sun, std::max({cap.x, cap.y, cap.z})));

    glm::dvec4 direct(0, 0, 0, 1), scattered(0), above(0, 0, 0, 1), below(0, 0, 0, 1);
    if (lit != nullptr) {
        const double slope = seen.widened ? 0 : 1;  // a speck has one light
        const glm::dvec4 keep(slope, slope, slope, 1);
        direct = keep * glm::dvec4(lit->direct);
        scattered = keep * glm::dvec4(lit->scattered);
        above = keep * glm::dvec4(lit->from_above);
        below = keep * glm::dvec4(lit->from_below);
    }
    splat.direct = from_eye(direct, view, seen.q);
    const auto channel = [&](int k) {
        return from_eye(albedo[k] * (sources.sun[k] * scattered + sources.above[k] * above +
                                     sources.below[k] * below),
                        view, seen.q);
    };
    splat.red = channel(0);
    splat.green = channel(1);
    splat.blue = channel(2);
    return splat;
}

// Adds a particle of the same centre and radius: optical depths add, light and colour are weighted
// by them.
void merge(Splat& into, const Splat& other) {
    const float whole = into.matter.x + other.matter.x;
    const float share = other.matter.x / whole;
    into.matter.x = whole;
    for (auto member : {&Splat::direct, &Splat::red, &Splat::green, &Splat::blue, &Splat::tint})
        into.*member += share * (other.*member - into.*member);
}

// Sorts by the upper 32 bits, stably; the lower ones ride along. Least significant digit first.
void radix_sort(std::vector<std::uint64_t>& keys) {
    std::vector<std::uint64_t> other(keys.size());
    for (int shift = 32; shift < 64; shift += 8) {
        std::array<std::size_t, 257> begin{};
        for (const std::uint64_t key : keys) ++begin[((key >> shift) & 255u) + 1];
        for (std::size_t digit = 1; digit < begin.size(); ++digit) begin[digit] += begin[digit - 1];
        for (const std::uint64_t key : keys) other[begin[(key >> shift) & 255u]++] = key;
        keys.swap(other);
    }
}

}  // namespace

SplatList make_splats(const Scene& scene, const ParticleSet& particles, const View& view,
                      const Plan& plan, const Lighting& lighting) {
    const Sources sources = sources_of(scene, plan);
    std::vector<Seen> seen(particles.size());
    std::vector<std::uint64_t> order;
    order.reserve(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        seen[i] = see(scene, particles, i, view);
        const gl::TileBox& tiles = seen[i].tiles;
        if (tiles.last_x < tiles.first_x || tiles.last_y < tiles.first_y) continue;
        // Bits of a positive float sort as the float does.
        const std::uint64_t key =
            std::bit_cast<std::uint32_t>(static_cast<float>(seen[i].distance));
        order.push_back(key << 32 | i);
    }
    const bool sorted = plan.on(Effect::kViewExtinction);
    if (sorted) radix_sort(order);

    SplatList list;
    list.splats.reserve(order.size());
    list.tiles.reserve(order.size());
    std::size_t previous = particles.size();  // none
    for (const std::uint64_t key : order) {
        const auto i = static_cast<std::size_t>(key & 0xffffffffu);
        const glm::dvec3 color =
            particles.color.empty() ? glm::dvec3(1) : glm::dvec3(particles.color[i]);
        const ParticleLight* lit = lighting.particles.empty() ? nullptr : &lighting.particles[i];
        const Splat splat = make_splat(seen[i], color, lit, view, sources);
        if (sorted && previous < particles.size() &&
            particles.center[i] == particles.center[previous] &&
            particles.radius[i] == particles.radius[previous]) {
            merge(list.splats.back(), splat);
            continue;
        }
        list.splats.push_back(splat);
        list.tiles.push_back(seen[i].tiles);
        previous = i;
    }
    return list;
}

}  // namespace awan
