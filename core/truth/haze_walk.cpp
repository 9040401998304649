#include "core/truth/haze_walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/scene/outside.h"
#include "core/truth/flight.h"

namespace awan::truth {
namespace {

using std::numbers::pi;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Scale heights: e^-600 of the extinction is none.
constexpr double kThinnest = 600;

// What comes through the clouds of the sunlight to p; with detail by a flight, 0 or 1, right on average.
double sun_through_from(const Setting& setting, const glm::dvec3& p, PathRandom& random) {
    const Matter& m = *setting.matter;
    if (!m.detail) return exact::exp(-depth_to_sun(m, p));
    double unused;
    return fly(m, m.axes * p + m.shift, m.axes * setting.to_sun, kInfinity, random, unused) ? 0 : 1;
}

}  // namespace

std::optional<HazeSetting> haze_of(const Scene& scene, bool shaded) {
    if (!scene->haze || scene->haze->extinction == 0) return std::nullopt;
    HazeSetting air;
    air.haze = *scene->haze;
    air.phase = {scene->haze->g, false};
    air.shaded = shaded;
    const Outside outside = outside_of(scene);
    const SkyMeans sky = means_of(outside.sky);
    air.sun = outside.sun;
    glm::dvec3 below = sky.below;
    if (scene->ground) {
        const double up = outside.to_sun.y;
        if (up < 0) air.sun = glm::dvec3(0);
        below = (scene->ground->albedo / pi) * (air.sun * std::max(up, 0.0) + sky.irradiance_up);
    }
    air.ambient = (sky.above + below) / 2.0;
    return air;
}

HazePath::HazePath(const Haze& haze, double y, double slope) {
    const double up = (y - haze.height) / haze.scale_height;  // scale heights
    const double rate = slope / haze.scale_height;
    const double b = haze.extinction;
    if (up <= 0) {
        const double leaves = slope > 0 ? -up / rate : kInfinity;
        parts_[0] = {0, b, 0, leaves};
        parts_[1] = {leaves, b, rate, kInfinity};
    } else if (slope < 0) {
        const double enters = up / -rate;
        const double from = up > kThinnest ? (up - kThinnest) / -rate : 0;
        parts_[0] = {from, b * exact::exp(-std::min(up, kThinnest)), rate, enters};
        parts_[1] = {enters, b, 0, kInfinity};
    } else {
        parts_[0] = {0, b * exact::exp(-up), rate, kInfinity};
        parts_[1] = {kInfinity, 0, 0, kInfinity};
    }
}

// b (1 - exp(-rate l)) / rate; b l where the rate is nothing over that length.
double HazePath::depth_in(const Part& part, double length) {
    if (!(length > 0) || part.extinction == 0) return 0;
    if (part.rate == 0 || std::abs(part.rate * length) < 1e-9) return part.extinction * length;
    return part.extinction * -exact::expm1(-part.rate * length) / part.rate;
}

double HazePath::depth(double t) const {
    double sum = 0;
    for (const Part& part : parts_)
        if (t > part.from) sum += depth_in(part, std::min(t, part.end) - part.from);
    return sum;
}

double HazePath::transmittance(double t) const {
    return exact::exp(-depth(t));
}

double HazePath::where(double depth) const {
    for (const Part& part : parts_) {
        if (std::isinf(part.from)) return kInfinity;
        const double whole = depth_in(part, part.end - part.from);
        if (depth >= whole) {
            depth -= whole;
            continue;
        }
        const double even = depth / part.extinction, z = even * part.rate;
        const double length = std::abs(z) < 1e-9 ? even
                              : z < 1            ? -exact::log1p(-z) / part.rate
                                                 : kInfinity;
        return std::min(part.from + length, part.end);
    }
    return kInfinity;
}

glm::dvec3 haze_light(const HazeSetting& air, const Setting& setting, const HazePath& path,
                      const glm::dvec3& o, const glm::dvec3& direction, double end,
                      PathRandom& random) {
    const double scattered = -exact::expm1(-path.depth(end));
    if (!(scattered > 0)) return glm::dvec3(0);
    double lit = 1;
    if (air.shaded && !setting.matter->empty) {
        // A distance with the density of haze that is met before the end.
        const double t = std::min(path.where(-exact::log1p(-random.unit() * scattered)), end);
        if (std::isfinite(t))
            lit = sun_through_from(setting, o + (t / setting.matter->cell) * direction, random);
    }
    const double p = phase_value(air.phase, glm::dot(direction, setting.to_sun)) / (4 * pi);
    return scattered * air.haze.albedo * (lit * p * air.sun + air.ambient);
}

}  // namespace awan::truth
