// Implicit clouds that tests share.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "core/generate/implicit/field.h"
#include "core/scene/implicit.h"

namespace awan::test {

// One whose density is its primitives' alone.
inline ImplicitCloud bare(std::vector<ImplicitPrimitive> primitives) {
    ImplicitCloud cloud;
    cloud.primitives = std::move(primitives);
    cloud.amount = cloud.exponent = cloud.blend = 1.0;
    cloud.displacement = 0.0;
    cloud.threshold = 0;
    return cloud;
}

inline ImplicitPrimitive ball(glm::dvec3 center, double radius, double weight = 1) {
    ImplicitPrimitive primitive;
    primitive.center = center;
    primitive.radius = radius;
    primitive.weight = weight;
    return primitive;
}

inline ImplicitPrimitive skeleton(ImplicitShape shape, std::vector<glm::dvec3> points,
                                  double radius, double core = 0) {
    ImplicitPrimitive primitive;
    primitive.shape = shape;
    primitive.points = std::move(points);
    primitive.radius = radius;
    primitive.core = core;
    return primitive;
}

inline constexpr std::uint64_t kKey = 77;

inline double density(const ImplicitCloud& cloud, glm::dvec3 p, double time = 0) {
    return implicit::density_at(implicit::prepare_field(cloud, kKey, time), p);
}

// Points all over a box of half extents `half` around the middle.
template <typename Use>
void all_over(glm::dvec3 middle, double half, int count, const Use& use) {
    for (int i = 0; i < count; ++i) {  // of the golden ratios of three dimensions (Roberts' R3)
        const auto at = [&](double step) {
            const double x = 0.5 + step * i;
            return 2 * (x - std::floor(x)) - 1;
        };
        use(middle + half * glm::dvec3(at(0.8191725133961645), at(0.6710436067037893),
                                       at(0.5497004779019703)));
    }
}

// The cubic of Wyvill, McPheeters & Wyvill 1986 as Ebert 2002 prints it.
inline double printed_cubic(double a) {
    if (a >= 1) return 0;
    return -4.0 / 9 * std::pow(a, 6) + 17.0 / 9 * std::pow(a, 4) - 22.0 / 9 * a * a + 1;
}

}  // namespace awan::test
