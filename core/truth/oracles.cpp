#include "core/truth/oracles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/scene/outside.h"
#include "core/truth/phase_law.h"

namespace awan {
namespace {

// 2 / sqrt(pi) * integral of exp(-x^2) from a to b, a <= b, to 1e-13 of itself.
double erf_between(double a, double b) {
    if (!(a < b)) return 0;
    // A difference would lose digits: Gauss-Legendre, 8 points.
    if (b - a < 0.1) {
        static constexpr double kX[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
        static constexpr double kW[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
        const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
        double sum = 0;
        for (int i = 0; i < 4; ++i) {
            const double x = middle - half * kX[i], y = middle + half * kX[i];
            sum += kW[i] * (exact::exp(-x * x) + exact::exp(-y * y));
        }
        return sum * half * 2 / std::sqrt(std::numbers::pi);
    }
    if (a > 0) return exact::erfc(a) - exact::erfc(b);
    if (b < 0) return exact::erfc(-b) - exact::erfc(-a);
    return exact::erf(b) - exact::erf(a);
}

// Gauss & Kronrod's 7 and 15 points (QUADPACK, Piessens et al. 1983).
constexpr double kNode[8] = {0.0,
                             0.207784955007898467600689403773245,
                             0.405845151377397166906606412076961,
                             0.586087235467691130294144691693013,
                             0.741531185599394439863864773280788,
                             0.864864423359769072789712788640926,
                             0.949107912342758524526189684047851,
                             0.991455371120812639206854697526329};
constexpr double kKronrod[8] = {
    0.209482141084727828012999174891714, 0.204432940075298892414161999234649,
    0.190350578064785409913256402421014, 0.169004726639267902826583426598550,
    0.140653259715525918745189590510238, 0.104790010322250183839876322541518,
    0.063092092629978553290700663189204, 0.022935322010529224963732008058970};
constexpr double kGauss[4] = {
    0.417959183673469387755102040816327, 0.381830050505118944950369775488975,
    0.279705391489276667901467771423780, 0.129484966168869693270611432679082};

struct Estimate {
    glm::dvec3 value{0};
    double error = 0;
};

template <typename F>
Estimate gauss_kronrod(const F& f, double a, double b) {
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    const glm::dvec3 at_middle = f(middle);
    glm::dvec3 fine = kKronrod[0] * at_middle, coarse = kGauss[0] * at_middle;
    for (int i = 1; i < 8; ++i) {
        const glm::dvec3 both = f(middle - half * kNode[i]) + f(middle + half * kNode[i]);
        fine += kKronrod[i] * both;
        if (i % 2 == 0) coarse += kGauss[i / 2] * both;
    }
    const glm::dvec3 apart = glm::abs(fine - coarse) * half;
    return {fine * half, std::max({apart.x, apart.y, apart.z})};
}

template <typename F>
glm::dvec3 integrate(const F& f, double a, double b, double allowed, int depth) {
    const Estimate e = gauss_kronrod(f, a, b);
    if (e.error <= allowed || depth == 0) return e.value;
    const double middle = 0.5 * (a + b);
    return integrate(f, a, middle, allowed / 2, depth - 1) +
           integrate(f, middle, b, allowed / 2, depth - 1);
}

}  // namespace

double line_optical_depth(const ParticleSet& particles, const glm::dvec3& origin,
                          const glm::dvec3& direction, double from, double to) {
    double depth = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i);
        const glm::dvec3 v = particles.center[i] - origin;
        const double along = glm::dot(v, direction);
        const glm::dvec3 aside = v - along * direction;
        const double b2 = glm::dot(aside, aside) / (2 * s * s);
        // exp(-740) is below the smallest double.
        if (b2 > 740) continue;
        const double per = 1 / (std::sqrt(2.0) * s);
        depth += 0.5 * central_depth(particles, i) * exact::exp(-b2) *
                 erf_between((from - along) * per, (to - along) * per);
    }
    return depth;
}

double extinction_at(const ParticleSet& particles, const glm::dvec3& point) {
    double sum = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 v = (point - particles.center[i]) / gaussian_s(particles, i);
        sum += static_cast<double>(particles.density[i]) * exact::exp(-0.5 * glm::dot(v, v));
    }
    return sum;
}

double phase_value(const Medium& medium, double cosine) {
    return truth::phase_value(truth::phase_law(medium), cosine);
}

glm::dvec3 single_scattering(const Scene& scene, const ParticleSet& particles,
                             const glm::dvec3& origin, const glm::dvec3& direction) {
    const glm::dvec3 to_sun = sun_direction(scene->sun);
    const double scale = scene->medium.albedo *
                         phase_value(scene->medium, glm::dot(direction, to_sun)) /
                         (4 * std::numbers::pi);
    // Matter stands within 9 s of the centres; pieces end at every centre, so that no particle is missed.
    double low = INFINITY, high = 0;
    std::vector<double> ends;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double s = gaussian_s(particles, i);
        const glm::dvec3 v = particles.center[i] - origin;
        const double along = glm::dot(v, direction);
        if (glm::length(v - along * direction) > 9 * s || particles.density[i] <= 0) continue;
        for (const double at : {-9.0, -2.0, 0.0, 2.0, 9.0})
            ends.push_back(std::max(along + at * s, 0.0));
        low = std::min(low, std::max(along - 9 * s, 0.0));
        high = std::max(high, along + 9 * s);
    }
    if (!(low < high)) return glm::dvec3(0);
    const auto depth = [&](double t) {
        return line_optical_depth(particles, origin, direction, 0, t);
    };
    // Behind an optical depth of 40 nothing is seen; the pieces follow where the depth rises.
    const auto where = [&](double target) {
        double a = low, b = high;
        for (int i = 0; i < 60; ++i) (depth(0.5 * (a + b)) < target ? a : b) = 0.5 * (a + b);
        return 0.5 * (a + b);
    };
    if (depth(high) > 40) high = where(40);
    const double whole = depth(high);
    for (const double share : {0.001, 0.01, 0.1, 0.3, 1.0, 3.0, 10.0})
        if (share < whole) ends.push_back(where(share));
    ends.push_back(low);
    ends.push_back(high);
    std::sort(ends.begin(), ends.end());

    const auto source = [&](double t) {
        const glm::dvec3 p = origin + t * direction;
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const glm::dvec3 v = (p - particles.center[i]) / gaussian_s(particles, i);
            const double one =
                static_cast<double>(particles.density[i]) * exact::exp(-0.5 * glm::dot(v, v));
            sum += particles.color.empty() ? glm::dvec3(one) : one * glm::dvec3(particles.color[i]);
        }
        return sum * exact::exp(-line_optical_depth(particles, p, to_sun, 0, INFINITY) - depth(t));
    };
    // A first look at the size of the answer, then every piece to its share.
    const double least = (high - low) / 256;
    std::vector<double> pieces{low};
    for (const double end : ends)
        if (end > pieces.back() && end <= high &&
            (end - pieces.back() > least || end == high || particles.size() < 64))
            pieces.push_back(end);
    glm::dvec3 rough(0);
    for (std::size_t i = 1; i < pieces.size(); ++i)
        rough += gauss_kronrod(source, pieces[i - 1], pieces[i]).value;
    const double allowed =
        2e-5 * std::max({rough.x, rough.y, rough.z}) / static_cast<double>(pieces.size());
    glm::dvec3 sum(0);
    for (std::size_t i = 1; i < pieces.size(); ++i)
        sum += integrate(source, pieces[i - 1], pieces[i], allowed, 16);
    return sum * scale * outside_of(scene).sun;
}

PixelRay pixel_ray(const View& view, int width, int height, double x, double y) {
    const double across = ((x + 0.5) / width * 2 - 1) * view.tan_half_fov * view.aspect;
    const double up = (1 - (y + 0.5) / height * 2) * view.tan_half_fov;
    return {view.eye, glm::normalize(view.forward + across * view.right + up * view.up)};
}

}  // namespace awan
