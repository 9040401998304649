// What a cloud of model "implicit" may be.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/scene/checks.h"
#include "core/scene/implicit.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// Goes through the fields in order and keeps the first that is wrong. NaN is in no range.
class Checker {
  public:
    explicit Checker(std::string at) : at_(std::move(at)) {}
    Status wrong;

    void fail(const std::string& field, std::string message) {
        if (!wrong) wrong = invalid(at_ + field, std::move(message));
    }
    void range(const char* field, double value, double lowest, double highest) {
        if (!wrong) wrong = in_range(value, lowest, highest, at_ + field);
    }
    void range(const char* field, std::uint64_t value, std::uint64_t lowest,
               std::uint64_t highest) {
        if (!wrong) wrong = count_in_range(value, lowest, highest, at_ + field);
    }
    void range(const std::string& field, const glm::dvec3& v, double lowest, double highest) {
        for (int i = 0; i < 3; ++i)
            if (!(v[i] >= lowest && v[i] <= highest))
                range((field + "/" + std::to_string(i)).c_str(), v[i], lowest, highest);
    }
    void most(const char* field, std::size_t count, std::uint64_t highest) {
        if (count > highest)
            fail(field, "may have at most " + std::to_string(highest) + " elements, not " +
                            std::to_string(count));
    }
    // The first of what `check` finds wrong with the elements of a list.
    template <typename T, typename Check>
    void each(const char* field, const std::vector<T>& list, Check check) {
        for (std::size_t i = 0; i < list.size() && !wrong; ++i) {
            Checker inner(at_ + field + "/" + std::to_string(i));
            check(list[i], inner);
            wrong = inner.wrong;
        }
    }

  private:
    std::string at_;
};

constexpr double kCoordinate = limits::kMaxImplicitCoordinate;

void check_key(const ImplicitKey& key, Checker& c) {
    c.range("/time", key.time, -limits::kMaxTime, limits::kMaxTime);
    if (key.center) c.range("/center", *key.center, -kCoordinate, kCoordinate);
    if (key.radius)
        c.range("/radius", *key.radius, limits::kMinImplicitRadius, limits::kMaxImplicitRadius);
    if (key.weight)
        c.range("/weight", *key.weight, -limits::kMaxImplicitWeight, limits::kMaxImplicitWeight);
}

void check_shape(const ImplicitPrimitive& p, Checker& c) {
    const bool cylinder = p.shape == ImplicitShape::kCylinder;
    const bool skeleton = cylinder || p.shape == ImplicitShape::kSegment;
    const std::size_t points = p.points.size();
    if (!skeleton && points > 0) c.fail("/points", "belongs to a cylinder or a segment");
    if (cylinder && points != 2)
        c.fail("/points", "must have the two ends of a cylinder, not " + std::to_string(points));
    if (skeleton && points < 2)
        c.fail("/points", "must have two points at least, not " + std::to_string(points));
    if (p.shape != ImplicitShape::kEllipsoid && p.radii != glm::dvec3(1))
        c.fail("/radii", "belongs to an ellipsoid");
    if (p.shape == ImplicitShape::kEllipsoid && p.core != 0)
        c.fail("/core", "belongs to spheres, cylinders and segments");
}

void check_primitive(const ImplicitPrimitive& p, Checker& c) {
    c.range("/center", p.center, -kCoordinate, kCoordinate);
    c.range("/radius", p.radius, limits::kMinImplicitRadius, limits::kMaxImplicitRadius);
    c.range("/radii", p.radii, limits::kMinImplicitRadii, limits::kMaxImplicitRadii);
    c.range("/core", p.core, 0, limits::kMaxImplicitRadius);
    for (std::size_t i = 0; i < p.points.size(); ++i)
        c.range("/points/" + std::to_string(i), p.points[i], -kCoordinate, kCoordinate);
    c.range("/rotate", p.rotate, -limits::kMaxAngle, limits::kMaxAngle);
    c.range("/weight", p.weight, -limits::kMaxImplicitWeight, limits::kMaxImplicitWeight);
    check_shape(p, c);
    c.most("/keys", p.keys.size(), limits::kMaxImplicitKeys);
    c.each("/keys", p.keys, check_key);
    for (std::size_t i = 1; i < p.keys.size(); ++i)
        if (!(p.keys[i].time > p.keys[i - 1].time))
            c.fail("/keys/" + std::to_string(i) + "/time",
                   "must be later than that of the key before, " + to_text(p.keys[i - 1].time));
    // Semi-axes are lengths too, whatever radius a key gives.
    double largest = p.radius;
    for (const ImplicitKey& key : p.keys) largest = std::max(largest, key.radius.value_or(0));
    for (int i = 0; i < 3; ++i)
        if (largest * p.radii[i] > limits::kMaxImplicitRadius)
            c.fail("/radii/" + std::to_string(i), "times the radius must be at most " +
                                                      to_text(limits::kMaxImplicitRadius) +
                                                      ", not " + to_text(largest * p.radii[i]));
}

void check_growth(const ImplicitGrowth& g, Checker& c) {
    constexpr double kSpread = limits::kMaxGrowthSpread, kMotion = limits::kMaxGrowthMotion;
    c.range("/growth/seeds", g.seeds, 1, limits::kMaxGrowth);
    c.range("/growth/most", g.most, g.seeds, limits::kMaxGrowth);
    c.range("/growth/radius", g.radius, limits::kMinImplicitRadius,
            limits::kMaxImplicitRadius / 10);
    c.range("/growth/shrink", g.shrink, 0.1, 1);
    c.range("/growth/weight", g.weight, -limits::kMaxImplicitWeight, limits::kMaxImplicitWeight);
    c.range("/growth/center", g.center, -kCoordinate, kCoordinate);
    c.range("/growth/spread", g.spread, 0, kSpread);
    c.range("/growth/velocity", g.velocity, -kMotion, kMotion);
    c.range("/growth/force", g.force, -kMotion, kMotion);
    c.range("/growth/turbulence", g.turbulence, 0, kMotion);
    c.range("/growth/drag", g.drag, 0, kMotion);
    c.range("/growth/lifetime", g.lifetime, limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
    c.range("/growth/rate", g.rate, 0, 1000);
    c.range("/growth/duration", g.duration, limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
}

void check_flow(const ImplicitFlow& flow, Checker& c) {
    c.range("/flow/min", flow.min, -kCoordinate, kCoordinate);
    c.range("/flow/max", flow.max, -kCoordinate, kCoordinate);
    for (int i = 0; i < 3; ++i)
        if (!(flow.max[i] - flow.min[i] >= limits::kMinImplicitRadius))
            c.fail("/flow/max/" + std::to_string(i), "must be greater than `min` by " +
                                                         to_text(limits::kMinImplicitRadius) +
                                                         " at least");
    c.range("/flow/size", flow.size, 1, static_cast<double>(limits::kMaxFlowVectors));
    for (int i = 0; i < 3; ++i)
        if (flow.size[i] != std::floor(flow.size[i]))
            c.fail("/flow/size/" + std::to_string(i),
                   "must be a whole number, not " + to_text(flow.size[i]));
    c.most("/flow/vectors", flow.vectors.size(), limits::kMaxFlowVectors);
    const double wanted = flow.size.x * flow.size.y * flow.size.z;
    if (wanted != static_cast<double>(flow.vectors.size()))
        c.fail("/flow/vectors", "must have as many vectors as `size` says, " + to_text(wanted) +
                                    ", not " + std::to_string(flow.vectors.size()));
    for (std::size_t i = 0; i < flow.vectors.size(); ++i)
        c.range("/flow/vectors/" + std::to_string(i), flow.vectors[i], -limits::kMaxImplicitRadius,
                limits::kMaxImplicitRadius);
}

void check_warps(const ImplicitCloud& cloud, Checker& c) {
    c.most("/attractors", cloud.attractors.size(), limits::kMaxImplicitWarps);
    c.each("/attractors", cloud.attractors, [](const ImplicitAttractor& a, Checker& one) {
        one.range("/at", a.at, -kCoordinate, kCoordinate);
        one.range("/strength", a.strength, limits::kMinAttraction, limits::kMaxAttraction);
        one.range("/reach", a.reach, limits::kMinImplicitRadius, limits::kMaxImplicitRadius);
    });
    c.most("/vortices", cloud.vortices.size(), limits::kMaxImplicitWarps);
    c.each("/vortices", cloud.vortices, [](const ImplicitVortex& v, Checker& one) {
        one.range("/at", v.at, -kCoordinate, kCoordinate);
        one.range("/axis", v.axis, -kCoordinate, kCoordinate);
        if (!(glm::length(v.axis) >= 1e-6))
            one.fail("/axis", "must have a length of 1e-6 at least");
        one.range("/angle", v.angle, -limits::kMaxVortexAngle, limits::kMaxVortexAngle);
        one.range("/reach", v.reach, limits::kMinImplicitRadius, limits::kMaxImplicitRadius);
    });
    if (cloud.flow) check_flow(*cloud.flow, c);
    c.range("/warp_from", cloud.warp_from, -limits::kMaxTime, limits::kMaxTime);
    c.range("/warp_to", cloud.warp_to, -limits::kMaxTime, limits::kMaxTime);
}

void check_elements(const std::vector<ImplicitPrimitive>& primitives, Checker& c) {
    std::uint64_t elements = 0;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const std::size_t points = primitives[i].points.size();
        elements += points > 1 ? points - 1 : 1;
        if (elements > limits::kMaxImplicitElements)
            c.fail("/primitives/" + std::to_string(i),
                   "a cloud may have at most " + std::to_string(limits::kMaxImplicitElements) +
                       " primitives in all, each piece of a skeleton counted");
    }
}

}  // namespace

Status check_implicit(const ImplicitCloud& cloud, const std::string& at) {
    Checker c(at);
    if (cloud.primitives) {
        check_elements(*cloud.primitives, c);
        c.each("/primitives", *cloud.primitives, check_primitive);
    }
    if (cloud.growth) check_growth(*cloud.growth, c);
    const ImplicitSettings s = resolved(cloud);
    if (s.base) c.range("/base", *s.base, -kCoordinate, kCoordinate);
    c.range("/amount", s.amount, 0, limits::kMaxImplicitAmount);
    c.range("/exponent", s.exponent, limits::kMinImplicitExponent, limits::kMaxImplicitExponent);
    c.range("/blend", s.blend, 0, 1);
    c.range("/displacement", s.displacement, 0, limits::kMaxDisplacement);
    c.range("/noise_size", s.noise_size, limits::kMinNoiseSize, limits::kMaxNoiseSize);
    c.range("/octaves", s.octaves, 1, limits::kMaxOctaves);
    c.range("/gain", s.gain, 0, 1);
    c.range("/stretch", s.stretch, 1, limits::kMaxStretch);
    c.range("/jet", s.jet, -limits::kMaxJet, limits::kMaxJet);
    c.range("/jet_turbulence", s.jet_turbulence, 0, 10);
    check_warps(cloud, c);
    for (int i = 0; i < 3; ++i)
        if (s.ripple[i] != 0 &&
            !(s.ripple[i] >= limits::kMinRipple && s.ripple[i] <= limits::kMaxRipple))
            c.fail("/ripple/" + std::to_string(i),
                   "must be 0 or from " + to_text(limits::kMinRipple) + " to " +
                       to_text(limits::kMaxRipple) + ", not " + to_text(s.ripple[i]));
    c.range("/ripple_depth", s.ripple_depth, 0, 1);
    c.range("/ripple_turbulence", s.ripple_turbulence, 0, 100);
    c.range("/swirl", cloud.swirl, -limits::kMaxSwirl, limits::kMaxSwirl);
    c.range("/resolution", cloud.resolution, limits::kMinImplicitResolution,
            limits::kMaxImplicitResolution);
    c.range("/threshold", cloud.threshold, 0, 0.5);
    return c.wrong;
}

}  // namespace awan
