// What holds of every clear sky, whatever it is computed by.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <numbers>
#include <string>

#include "core/scene/outside.h"

namespace awan::test {

inline constexpr double kDegree = std::numbers::pi / 180;

// Unit. Radians; azimuth 0 is +z.
inline glm::dvec3 towards(double elevation, double azimuth = 0) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            std::cos(elevation) * std::cos(azimuth)};
}

// That its radiance is finite, not negative and below 3 in every direction. named: of what sun and air it is.
template <typename Sky>
void expect_sane_everywhere(const Sky& sky, const std::string& named) {
    for (double up = -90; up <= 90; up += 7.5)
        for (double azimuth = 0; azimuth <= 180; azimuth += 30) {
            const glm::dvec3 seen = radiance(sky, towards(up * kDegree, azimuth * kDegree));
            for (int c = 0; c < 3; ++c) {
                ASSERT_TRUE(std::isfinite(seen[c])) << named << " " << up;
                ASSERT_GE(seen[c], 0) << named << " " << up;
                ASSERT_LT(seen[c], 3) << named << " " << up;
            }
        }
}

// That its radiance is finite with the sun straight below and on both axes exactly. sky_of: the sky of a sun.
template <typename SkyOf>
void expect_finite_on_axes(SkyOf sky_of) {
    for (const glm::dvec3& sun : {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0)})
        for (const glm::dvec3& to :
             {glm::dvec3(0, -1, 0), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0)})
            EXPECT_TRUE(std::isfinite(luminance(radiance(sky_of(sun), to))));
}

}  // namespace awan::test
