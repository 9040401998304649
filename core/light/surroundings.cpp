#include "core/light/surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/light/harmonics.h"
#include "core/light/legendre.h"

namespace awan {
namespace {

struct Chord {
    double near, far, extinction;
};

// The part of a ray from outside that lies in the ellipsoid, distances from its start; far <= near: none.
Chord chord_of(const Neighbour& ball, const glm::dvec3& from, const glm::dvec3& direction) {
    const glm::dvec3 p = (from - ball.center) / ball.half, d = direction / ball.half;
    const double a = glm::dot(d, d), b = glm::dot(p, d), c = glm::dot(p, p) - 1;
    const double root = b * b - a * c;
    if (!(root > 0)) return {0, 0, 0};
    const double half = std::sqrt(root);
    return {std::max((-b - half) / a, 0.0), (-b + half) / a, ball.extinction};
}

// The source function in the cell at a point, towards a direction (unit, away from it).
double source_at(const TransportLight& light, const LightBand& band, const glm::dvec3& point,
                 const std::array<double, kHarmonics>& towards) {
    const glm::ivec3 at(glm::clamp(glm::floor((point - light.origin) / light.cell), glm::dvec3(0),
                                   glm::dvec3(light.cells - 1)));
    const std::size_t cell =
        (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(light.cells.y) +
         static_cast<std::size_t>(at.y)) *
            static_cast<std::size_t>(light.cells.x) +
        static_cast<std::size_t>(at.x);
    double sum = 0;
    for (std::size_t i = 0; i < kHarmonics; ++i)
        sum += static_cast<double>(band.moments[cell][i]) * towards[i];
    return std::clamp(sum, 0.0, static_cast<double>(band.most));
}

// What the first scattering of the sun's beam adds to the source function, for a scattering angle of cosine mu: with f
// the share of the peak, albedo sum_l (2 l + 1) (chi_l - f) P_l(mu) / 4 pi, per irradiance.
double first_scattering(const Medium& medium, double mu, double f) {
    double p[4] = {1, mu, 1.5 * mu * mu - 0.5, 2.5 * mu * mu * mu - 1.5 * mu}, sum = 0;
    for (int l = 0; l < 4; ++l) sum += (2 * l + 1) * (phase_moment(medium, l) - f) * p[l];
    return medium.albedo * std::max(sum, 0.0) / (4 * std::numbers::pi);
}

}  // namespace

Neighbour neighbour_of(const ParticleSet& particles) {
    double mass = 0;
    glm::dvec3 sum(0), square(0);
    const glm::dvec3 base = particles.center[0];
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double m = gaussian_mass(particles, i), s = gaussian_s(particles, i);
        const glm::dvec3 p = particles.center[i] - base;
        mass += m;
        sum += m * p;
        square += m * (p * p + s * s);
    }
    Neighbour ball{base, glm::dvec3(1), 0};
    if (!(mass > 0)) return ball;
    ball.center = base + sum / mass;
    // The variance of a uniform ellipsoid along an axis is a fifth of the half axis squared.
    const glm::dvec3 mean = sum / mass;
    ball.half = glm::sqrt(5.0 * glm::max(square / mass - mean * mean, glm::dvec3(1e-18)));
    ball.extinction = mass / (4 * std::numbers::pi / 3 * ball.half.x * ball.half.y * ball.half.z);
    return ball;
}

Surroundings surroundings_of(const Scene& scene, const std::vector<Neighbour>& neighbours,
                             std::size_t self, const TransportLight& whole) {
    return [&scene, &neighbours, &whole, self](std::size_t band, const glm::dvec3& direction,
                                               double sky) {
        const glm::dvec3 from = neighbours[self].center, away = -direction;
        std::vector<Chord> chords;
        for (std::size_t j = 0; j < neighbours.size(); ++j) {
            if (j == self || !(neighbours[j].extinction > 0)) continue;
            const Chord chord = chord_of(neighbours[j], from, away);
            if (chord.far > chord.near) chords.push_back(chord);
        }
        std::stable_sort(chords.begin(), chords.end(),
                         [](const Chord& a, const Chord& b) { return a.near < b.near; });
        const double f = whole.peak_share, kept = 1 - scene->medium.albedo * f;
        const bool light = band < whole.bands.size();
        // Bands that the sun's beam is in are those without a limit: in grey matter the first, in coloured matter all.
        const bool beam = light && whole.bands[band].most == std::numeric_limits<float>::infinity();
        const std::array<double, kHarmonics> towards = harmonics(direction);
        const double first =
            beam ? first_scattering(scene->medium, glm::dot(direction, whole.sun.w), f) : 0;
        double left = 1, radiance = 0;
        for (const Chord& chord : chords) {
            const double length = chord.far - chord.near, depth = kept * chord.extinction * length;
            const double end = exact::exp(-depth);
            if (light) {
                const glm::dvec3 point =
                    from + (chord.near + length * std::min(0.5, 1 / std::max(depth, 1e-9))) * away;
                const double source =
                    source_at(whole, whole.bands[band], point, towards) +
                    first * exact::exp(-kept * std::max(depth_at(whole.sun, point), 0.0));
                radiance += left * (1 - end) / kept * source;
            }
            left *= end;
            if (left < 1e-3) break;
        }
        return radiance + left * sky;
    };
}

}  // namespace awan
