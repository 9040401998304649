#include "core/draw/splats.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/draw/air_image.h"
#include "core/draw/billboards.h"
#include "core/generate/gaussian.h"
#include "core/scene/outside.h"
#include "core/shaders/shared.h"
#include "core/survey/narrow.h"
#include "core/survey/projection.h"
#include "core/survey/relief_ray.h"

namespace awan {
namespace {

// Where particles are cut: their least reach, in standard deviations, beyond which 0.2% of the mass lies (of many with
// detail, that cover each other's edges, 3.4%); and the optical depth that the lines there have.
struct Cut {
    double min_reach, faint_depth;
};
constexpr Cut kCut{3.5, 5e-4}, kCutOfMany{2.6, 1e-2};

LightSources light_sources(const Scene& scene, const Plan& plan) {
    const Outside outside = outside_of(scene);
    const SkyDome& sky = outside.sky;
    const double g = asymmetry(scene->medium);
    LightSources sources{outside.sun / (4 * std::numbers::pi),
                         glm::dvec3(0),
                         glm::dvec3(0),
                         scene->medium.albedo,
                         outside.to_sun,
                         g * g * g * std::abs(g)};
    if (!plan.on(Effect::kSkyLight) || !sky.shines) return sources;
    if (sky.physical) {
        const SkyMeans means = means_of(sky);
        sources.above = 0.5 * means.above;
        sources.below = 0.5 * means.below;
    } else {
        sources.above = 0.5 * glm::dvec3(shader::sky_mean_above(sky.zenith, sky.horizon));
        sources.below = 0.5 * sky.horizon;
    }
    return sources;
}

// Over a ground it is the ground that shines from below, not the sky.
void light_from_ground(const Scene& scene, const ParticleSet& particles, const GroundLight& ground,
                       LightSources& sources) {
    if (particles.size() == 0) return;
    const Bounds bounds = bounds_of(particles);
    if (!has_ground(*scene, bounds)) return;
    const glm::dvec3 middle = 0.5 * (bounds.min + bounds.max);
    const double low = ground.height + 0.25 * (bounds.max.y - ground.height);
    sources.below = glm::dvec3(0);
    if (ground.into_cloud)
        sources.below =
            0.5 * mean_radiance_below(ground, {middle.x, std::max(middle.y, low), middle.z});
}

// A particle in the eye's frame.
struct Seen {
    glm::dvec3 q;
    double distance, s, tau, reach;
    bool widened;
    gl::TileBox tiles;
};

// Along one side of the picture, the tiles whose pixels see a ball, and the centre and half the width of what they see,
// in tiles. first > last: none.
struct Along {
    std::int32_t first = 0, last = -1;
    double center = 0, half = 0;
};

// `up`: rows count downward.
Along tiles_along(Interval slopes, double tangent, int pixels, int tile, bool up) {
    Along along;
    const PixelSpan seen = pixels_between(slopes, tangent, pixels, up);
    if (seen.first > seen.last) return along;
    along.first = seen.first / tile;
    along.last = seen.last / tile;
    along.center = ((seen.low + seen.high) / 2 + 0.5) / tile;
    along.half = (seen.high - seen.low) / 2 / tile + 1e-3;
    return along;
}

// The tiles that see a ball: those of its bounding rectangle, and without the corners where that is safe. A ball is
// seen as an ellipse whose longer axis points away from the picture's middle and is e = 1 / cos(angle to the ball's far
// side) times as long as the other, at most. It need not be the upright ellipse of the rectangle; but no ellipse in the
// rectangle with such axes reaches beyond that one enlarged by sqrt(2 / (1 + 1 / e^2)).
gl::TileBox tiles_of(const Seen& seen, const SplatWindow& window) {
    const Interval right = disc_slopes(seen.q.x, seen.q.z, seen.reach);
    const Interval up = disc_slopes(seen.q.y, seen.q.z, seen.reach);
    const Along x = tiles_along({right.low - window.middle.x, right.high - window.middle.x},
                                window.tangent.x, window.width, kTileWidth, false);
    const Along y = tiles_along({up.low - window.middle.y, up.high - window.middle.y},
                                window.tangent.y, window.height, kTileHeight, true);
    gl::TileBox box{x.first, y.first, x.last, y.last};
    if (seen.distance <= seen.reach) return box;
    // cos(a + b): a is the angle to the centre, b from there to the far side.
    const double cos_a = seen.q.z / seen.distance, sin_b = seen.reach / seen.distance;
    const double sin_a = std::sqrt(std::max(0.0, 1 - cos_a * cos_a)),
                 cos_b = std::sqrt(1 - sin_b * sin_b);
    const double cos_far = cos_a * cos_b - sin_a * sin_b;
    // Beyond e = 1.9 the corners are kept.
    if (cos_far < 0.54 || cos_a < 0) return box;
    const double grow = std::sqrt(2 / (1 + cos_far * cos_far));
    box.center_x = static_cast<float>(x.center);
    box.center_y = static_cast<float>(y.center);
    box.per_x = static_cast<float>(1 / (grow * x.half));
    box.per_y = static_cast<float>(1 / (grow * y.half));
    return box;
}

double reach_of(double tau, const ParticleSet& particles) {
    const bool is_many = particles.detail != nullptr && particles.size() >= kManySplats;
    const Cut& cut = is_many ? kCutOfMany : kCut;
    return std::max(cut.min_reach, std::sqrt(2 * exact::log(std::max(1.0, tau / cut.faint_depth))));
}

Seen see(const ParticleSet& particles, std::size_t i, const View& view, const SplatWindow& window) {
    const Footprint own = footprint_of(particles, i, view);
    Seen seen{};
    seen.q = own.q;
    seen.distance = own.distance;
    const double along = std::max(0.0, seen.q.z);
    seen.s = std::max({own.s, kLeastWidth * window.gap() * along, 1e-12});
    seen.widened = std::max({own.s, kLeastWidth * window.picture_gap * along, 1e-12}) > own.s;
    if (!own.seen) return seen;
    seen.tau = widened_depth(own.tau, seen.s / own.s);
    if (!(seen.tau > 0)) return seen;
    const double cut = reach_of(seen.tau, particles);
    seen.reach = seen.s * cut;
    // In the picture's plane exp(-cut^2 / 2) of a Gaussian lies beyond the cut.
    seen.tau /= -exact::expm1(-cut * cut / 2);
    seen.tiles = tiles_of(seen, window);
    return seen;
}

bool is_painted(const SplatSetting& setting, std::size_t i) {
    return setting.levels && setting.particles.paint[i].texture != 0;
}

// Of a painted particle; tau: what its texture's opacity is multiplied by.
Seen see_billboard(const SplatSetting& setting, std::size_t i, const SplatWindow& window,
                   PaintedSplat& painted) {
    const Footprint own = footprint_of(setting.particles, i, setting.view);
    Seen seen{};
    seen.q = own.q;
    seen.distance = own.distance;
    seen.s = std::max(own.s, 1e-12);
    if (!own.seen) return seen;
    const Paint& paint = setting.particles.paint[i];
    const double pixel = window.gap() * std::max(0.0, own.q.z);
    const double side = kBillboardReach * seen.s, half = std::max(side, pixel);
    const double thinnest = setting.levels->depth_of(0);
    seen.tau = side / half * (side / half) * std::min(1.0, own.distance / half) *
               std::min(1.0, own.tau / thinnest);
    const int layer = kDepthLevels * (paint.texture - 1) + setting.levels->level_of(own.tau);
    const auto [across, up] = billboard_axes(own.q, half, paint, vertical_in(setting.view));
    const double texel = 2 * half / kTextureSide;
    const double level = pixel > texel ? exact::log2(pixel / texel) : 0;
    painted.across = glm::vec4(glm::dvec4(across / (half * half), layer));
    painted.up = glm::vec4(glm::dvec4(up / (half * half), level));
    painted.tint.x = static_cast<float>(paint.texture - 1);
    seen.reach = std::numbers::sqrt2 * half;
    seen.tiles = tiles_of(seen, window);
    return seen;
}

// A linear function f of a place relative to a particle's centre (gradient x y z per scene unit, value w) as one of the
// place relative to the eye, in the eye's frame. q: the centre in that frame.
glm::vec4 from_eye(glm::dvec4 f, const View& view, glm::dvec3 q) {
    const glm::dvec3 gradient(f);
    const glm::dvec3 turned(glm::dot(gradient, view.right), glm::dot(gradient, view.up),
                            glm::dot(gradient, view.forward));
    return glm::vec4(glm::dvec4(turned, f.w - glm::dot(turned, q)));
}

// A particle's light as its splat has it. One that is narrower than the picture's pixels has the same light all over:
// where it is drawn wider than it is, its gradient would reach too far, and in a finer window it is lit as it is there.
glm::dvec4 over(glm::vec4 light, const Seen& seen) {
    return seen.widened ? glm::dvec4(0, 0, 0, light.w) : glm::dvec4(light);
}

// Bounds of what lines laid through particles may lead to: fluence about the sun, over its own.
constexpr double kMostForward = 30;

// The phase function for light that was scattered forward before, from the particle to the eye: 1 in the mean. Each
// time it is scattered, the mean cosine is g times as much (Henyey & Greenstein); it is taken to have been thrice.
double scattered_phase(const Seen& seen, const View& view, const LightSources& sources) {
    if (!(seen.distance > 0)) return 1;
    const glm::dvec3 way =
        (seen.q.x * view.right + seen.q.y * view.up + seen.q.z * view.forward) / seen.distance;
    const double g = sources.g_of_scattered, cosine = glm::dot(way, sources.to_sun);
    const double apart = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (apart * std::sqrt(apart));
}

Splat make_splat(const Seen& seen, glm::dvec3 color, const ParticleLight* lit, const View& view,
                 const SplatWindow& window, const LightSources& sources) {
    Splat splat{};
    // splat.glsl looks for the row of a column of pixels that is nearest to the particle. Straight above or below the
    // eye there is none: the particle is moved a hair to the side.
    const bool vertical = seen.q.x * seen.q.x + seen.q.z * seen.q.z < 1e-10 * seen.q.y * seen.q.y;
    const glm::dvec3 place =
        vertical ? seen.q + glm::dvec3(1e-5 * std::abs(seen.q.y), 0, 0) : seen.q;
    // Beside the line from the eye through the window's middle, which floats would not resolve in a window far below a
    // pixel that lies away from the picture's middle.
    splat.place = glm::vec4(glm::dvec4(place.x - place.z * window.middle.x,
                                       place.y - place.z * window.middle.y, place.z,
                                       0.5 / (seen.s * seen.s)));
    const glm::dvec3 albedo = sources.albedo * color;
    splat.matter = glm::vec4(glm::dvec4(albedo * sources.sun, seen.tau));

    glm::dvec4 direct(0, 0, 0, 1), scattered(0), above(0, 0, 0, 1), below(0, 0, 0, 1);
    if (lit != nullptr) {
        direct = over(lit->direct, seen);
        // Seen from the eye; the light arrives from about the sun, not from its disc.
        const double phase = scattered_phase(seen, view, sources);
        scattered = over(static_cast<float>(phase) * lit->scattered + lit->diffuse, seen);
        above = over(lit->from_above, seen);
        below = over(lit->from_below, seen);
    }
    splat.direct = from_eye(direct, view, seen.q);

    // All other light has one gradient between its parts, that of their sum, relative to the sum's value at the centre.
    const auto sum = [](glm::dvec3 c) { return c.x + c.y + c.z; };
    const glm::dvec4 other =
        sum(sources.sun) * scattered + sum(sources.above) * above + sum(sources.below) * below;
    const glm::dvec3 value =
        sources.sun * scattered.w + sources.above * above.w + sources.below * below.w;
    const double most = sum(kMostForward * sources.sun + 2.0 * (sources.above + sources.below));
    splat.other =
        glm::vec4(glm::dvec4(albedo * value, other.w > 0 ? std::min(most / other.w, 1e6) : 0));
    splat.change = from_eye(other.w > 0 ? other / other.w : glm::dvec4(0), view, seen.q);
    return splat;
}

// Adds a particle of the same centre and radius: optical depths add, light and colour are weighted
// by them.
void merge(Splat& into, const Splat& other) {
    const float whole = into.matter.w + other.matter.w;
    const float share = other.matter.w / whole;
    for (auto member : {&Splat::matter, &Splat::direct, &Splat::other, &Splat::change})
        into.*member += share * (other.*member - into.*member);
    into.matter.w = whole;
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

SplatWindow whole_picture(const View& view, const ImageSettings& image) {
    const glm::dvec2 tangent(view.tan_half_fov * view.aspect, view.tan_half_fov);
    return {glm::dvec2(0), tangent, image.width, image.height, 2 * tangent.y / image.height};
}

Footprint footprint_of(const ParticleSet& particles, std::size_t i, const View& view) {
    Footprint own{};
    const glm::dvec3 p = particles.center[i] - view.eye;
    own.q = {glm::dot(p, view.right), glm::dot(p, view.up), glm::dot(p, view.forward)};
    own.distance = glm::length(own.q);
    own.s = gaussian_s(particles, i);
    own.tau = central_depth(particles, i);
    own.seen = own.s > 0 && own.tau > 0;
    own.reach = own.s * reach_of(own.tau, particles);
    return own;
}

namespace {

bool is_hidden(const Relief& relief, const glm::dvec3& eye, const glm::dvec3& place) {
    const double distance = glm::length(place - eye);
    return distance > 0 && hills_ahead(relief, eye, (place - eye) / distance) < distance;
}

}  // namespace

std::vector<std::uint32_t> drawing_order(const Scene& scene, const ParticleSet& particles,
                                         const View& view, const Plan& plan) {
    // A splat cannot end at the ground: of what the ground hides, whole particles are left out.
    const bool cut = scene->ground && view.eye.y > scene->ground->height;
    const auto relief = cut ? relief_of(*scene, 1) : nullptr;
    std::vector<std::uint64_t> keys;
    keys.reserve(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (cut && particles.center[i].y < scene->ground->height) continue;
        if (relief && is_hidden(*relief, view.eye, particles.center[i])) continue;
        const glm::dvec3 p = particles.center[i] - view.eye;
        const glm::dvec3 q(glm::dot(p, view.right), glm::dot(p, view.up),
                           glm::dot(p, view.forward));
        // Bits of a positive float sort as the float does.
        const std::uint64_t key = std::bit_cast<std::uint32_t>(static_cast<float>(glm::length(q)));
        keys.push_back(key << 32 | i);
    }
    if (plan.on(Effect::kViewExtinction)) radix_sort(keys);
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t n = 0; n < keys.size(); ++n)
        order[n] = static_cast<std::uint32_t>(keys[n] & 0xffffffffu);
    return order;
}

SplatSetting splat_setting(const Scene& scene, const ParticleSet& particles, const View& view,
                           const Plan& plan, const Lighting& lighting, const Air* air) {
    LightSources sources = light_sources(scene, plan);
    light_from_ground(scene, particles, lighting.ground, sources);
    std::optional<DepthLevels> levels;
    if (plan.on(Effect::kTexture)) levels = depth_levels(particles);
    return {particles, view, lighting, air, plan.on(Effect::kViewExtinction), sources, levels};
}

SplatList make_splats(const SplatSetting& setting, const SplatWindow& window,
                      std::span<const std::uint32_t> order) {
    const auto& [particles, view, lighting, air, sorted, sources, levels] = setting;
    SplatList list;
    if (levels) list.paint.reserve(order.size());
    list.splats.reserve(order.size());
    list.tiles.reserve(order.size());
    std::size_t previous = particles.size();  // none
    for (const std::uint32_t i : order) {
        const bool is_billboard = is_painted(setting, i);
        PaintedSplat painted;
        const Seen seen = is_billboard ? see_billboard(setting, i, window, painted)
                                       : see(particles, i, view, window);
        const gl::TileBox& tiles = seen.tiles;
        if (tiles.last_x < tiles.first_x || tiles.last_y < tiles.first_y) continue;
        if (seen.distance <= seen.reach) list.reaches_eye = true;
        const glm::dvec3 color =
            particles.color.empty() ? glm::dvec3(1) : glm::dvec3(particles.color[i]);
        const ParticleLight* lit = lighting.particles.empty() ? nullptr : &lighting.particles[i];
        Splat splat = make_splat(seen, color, lit, view, window, sources);
        if (air != nullptr) painted.tint.y = see_through_air(*air, view, seen.q, splat);
        if (sorted && !is_billboard && previous < particles.size() &&
            particles.center[i] == particles.center[previous] &&
            particles.radius[i] == particles.radius[previous]) {
            merge(list.splats.back(), splat);
            continue;
        }
        list.splats.push_back(splat);
        list.tiles.push_back(tiles);
        if (levels) list.paint.push_back(painted);
        previous = is_billboard ? particles.size() : i;
    }
    return list;
}

}  // namespace awan
