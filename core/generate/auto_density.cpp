#include "core/generate/auto_density.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/base/exact_math.h"
#include "core/generate/cubes.h"
#include "core/generate/keyed_random.h"
#include "core/generate/models.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

constexpr std::uint64_t kSampled = 256;
// Of models that are made of cells or of many small spheres, of which few stand in one line.
constexpr std::uint64_t kSampledOfModel = 1024;
// Cells along the longest side, for this alone.
constexpr std::uint64_t kCoarseCells = 48;

// A Gaussian of extinction in the cloud's own units, for a density of 1.
struct Blob {
    glm::dvec3 center;
    double s, mass;
};

Blob blob_of(const glm::dvec3& center, double radius, double density) {
    const double s = 0.5 * radius;
    constexpr double kTwoPi = 2 * std::numbers::pi;
    return {center, s, density * kTwoPi * std::sqrt(kTwoPi) * s * s * s};
}

std::uint64_t size_of(const Cloud& cloud) {
    std::uint64_t total = cloud.ready.positions.size();
    for (const Cube& cube : cloud.cubes) total += cube.particles;
    return total;
}

double densest_of(const Cloud& cloud) {
    double most = cloud.ready.densities.empty() ? 1 : 0;
    for (const float density : cloud.ready.densities)
        most = std::max(most, static_cast<double>(density));
    if (!cloud.cubes.empty()) most = 0;
    for (const Cube& cube : cloud.cubes) most = std::max(most, cube.density);
    return most;
}

// Particles of the cloud, `count` of all, evenly over their numbers.
std::vector<Blob> sampled(const Cloud& cloud, Fill fill, std::uint64_t key, std::uint64_t count) {
    const std::uint64_t all = size_of(cloud);
    std::vector<Blob> blobs;
    std::size_t c = 0;
    std::uint64_t before = 0;
    for (std::uint64_t k = 0; k < count; ++k) {
        // Anywhere in its share of the numbers: even steps would pick out some of a cube's low-discrepancy points that
        // lie in one part of it.
        const std::uint64_t from = k * all / count, to = (k + 1) * all / count;
        const std::uint64_t number = from + keyed(~key, k) % (to - from);
        if (cloud.model != CloudModel::kCubes) {
            const ReadyParticles& ready = cloud.ready;
            const auto i = static_cast<std::size_t>(number);
            blobs.push_back(
                blob_of(ready.positions[i], static_cast<double>(ready.radii[i]),
                        ready.densities.empty() ? 1 : static_cast<double>(ready.densities[i])));
            continue;
        }
        while (number - before >= cloud.cubes[c].particles) before += cloud.cubes[c++].particles;
        const Cube& cube = cloud.cubes[c];
        FilledParticle particle{};
        fill_cube(cube, fill, keyed(key, c), number - before, number - before + 1, &particle);
        blobs.push_back(blob_of(particle.center, particle.radius, cube.density));
    }
    return blobs;
}

// Of two blobs, the integral over lines along an axis of the product of their depths, over the product of their masses.
// apart: the square of their distance across the axis.
double met_depth(const Blob& a, const Blob& b, double apart) {
    const double width = a.s * a.s + b.s * b.s;
    return exact::seeded_exp(-apart / (2 * width)) / (2 * std::numbers::pi * width);
}

// The mean depth for a density of 1, weighted by mass, along each axis. `all`: particles of the cloud.
glm::dvec3 mean_depths(const std::vector<Blob>& blobs, std::uint64_t all) {
    glm::dvec3 pairs(0);
    double own = 0, mass = 0;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        const Blob& a = blobs[i];
        mass += a.mass;
        own += a.mass * a.mass * met_depth(a, a, 0);
        for (std::size_t j = 0; j < i; ++j) {
            const Blob& b = blobs[j];
            const glm::dvec3 d = a.center - b.center, d2 = d * d;
            const double both = 2 * a.mass * b.mass;
            pairs += both * glm::dvec3(met_depth(a, b, d2.y + d2.z), met_depth(a, b, d2.z + d2.x),
                                       met_depth(a, b, d2.x + d2.y));
        }
    }
    if (!(mass > 0)) return glm::dvec3(0);
    // Of all pairs only some were looked at; every particle meets itself once.
    const auto n = static_cast<double>(blobs.size()), total = static_cast<double>(all);
    const double more = blobs.size() > 1 ? (total - 1) / (n - 1) : 0;
    return (own + more * pairs) / mass;
}

// To three digits, the same on every machine.
double rounded(double x) {
    std::array<char, 32> text{};
    const auto written =
        std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::scientific, 2);
    std::from_chars(text.data(), written.ptr, x);
    return x;
}

double deep_enough(const Cloud& cloud, const std::vector<Blob>& blobs, std::uint64_t all) {
    const glm::dvec3 depths = cloud.scale * mean_depths(blobs, all);
    const double least = std::min({depths.x, depths.y, depths.z}), most = densest_of(cloud);
    if (!(least > 0) || !(most > 0)) return kDefaultDensity;
    const double wanted = std::min(kAutoDepth / least, limits::kMaxDensity);
    return std::min(rounded(wanted), limits::kMaxDensity / std::max(most, 1.0));
}

template <typename Keys>
void take_last(const Keys& keys, double& time) {
    if (!keys.empty()) time = std::max(time, keys.back().time);
}

// When all of it is there.
double last_change(const ImplicitCloud& cloud) {
    double time = cloud.warp_to > cloud.warp_from ? std::max(cloud.warp_to, 0.0) : 0;
    take_last(cloud.keys, time);
    if (cloud.primitives)
        for (const ImplicitPrimitive& one : *cloud.primitives) take_last(one.keys, time);
    for (const ImplicitAttractor& one : cloud.attractors) take_last(one.keys, time);
    for (const ImplicitVortex& one : cloud.vortices) take_last(one.keys, time);
    for (const ImplicitParticle& one : cloud.particles) time = std::max(time, one.time);
    if (cloud.growth) {
        time = std::max(time, cloud.growth->duration);
        take_last(cloud.growth->keys, time);
    }
    if (cloud.bubbles)
        time = std::max(time, cloud.bubbles->began +
                                  static_cast<double>(cloud.bubbles->most) / cloud.bubbles->rate);
    // Two wavelengths of sliding roll them up.
    if (cloud.billows && cloud.billows->shear != 0)
        time = std::max(time, cloud.billows->began +
                                  2 * cloud.billows->wavelength / std::abs(cloud.billows->shear));
    return std::min(time, limits::kMaxTime);
}

// The cloud, made of few cells, and when.
Cloud coarser(const Cloud& cloud, double& time) {
    Cloud coarse = cloud;
    time = 0;
    if (cloud.implicit) {
        auto own = std::make_shared<ImplicitCloud>(*cloud.implicit);
        own->resolution = std::min(own->resolution, kCoarseCells);
        time = last_change(*own);
        coarse.implicit = std::move(own);
    }
    if (cloud.ellipsoids) {
        auto own = std::make_shared<EllipsoidsCloud>(*cloud.ellipsoids);
        own->resolution = std::min(own->resolution, kCoarseCells);
        if (own->plane) own->plane->resolution = std::min(own->plane->resolution, kCoarseCells);
        coarse.ellipsoids = std::move(own);
    }
    return coarse;
}

}  // namespace

double auto_density(const Cloud& cloud, Fill fill, std::uint64_t key) {
    if (cloud.model == CloudModel::kAutomaton) {
        const double own =
            automaton::density_for_depth(*cloud.automaton, key, kAutoDepth / cloud.scale);
        return own > 0 ? rounded(std::min(own, limits::kMaxDensity)) : kDefaultDensity;
    }
    if (is_procedural(cloud)) return kDefaultDensity;
    const std::uint64_t all = size_of(cloud);
    const std::vector<Blob> blobs = sampled(cloud, fill, key, std::min(all, kSampled));
    return deep_enough(cloud, blobs, all);
}

Result<double> own_auto_density(const Cloud& cloud, Fill fill, std::uint64_t key,
                                const Deadline& deadline) {
    if (!is_procedural(cloud) || cloud.model == CloudModel::kAutomaton)
        return auto_density(cloud, fill, key);
    ModelRequest request;
    request.key = key;
    // The whole cloud, so many pixels high.
    request.pixel_angle = 2 * exact::tan(kAutomaticFov * std::numbers::pi / 360) / kCoarseCells;
    const Cloud coarse = coarser(cloud, request.time);
    auto made = model_particles(coarse, request, deadline);
    if (!made.ok()) return made.error();
    Cloud particles;
    particles.model = CloudModel::kParticles;
    particles.scale = cloud.scale;
    particles.ready = std::move(made->particles);
    const std::uint64_t all = size_of(particles);
    return deep_enough(particles, sampled(particles, fill, key, std::min(all, kSampledOfModel)),
                       all);
}

}  // namespace awan
