// Clouds of spheres that tests share.
#pragma once

#include <gtest/gtest.h>

#include "core/generate/models.h"
#include "core/scene/spheres.h"

namespace awan::test {

inline SpheresCloud cloud_of(std::uint64_t levels) {
    SpheresCloud cloud;
    cloud.levels = levels;
    return cloud;
}

inline ModelRequest request_of(std::uint64_t key, int threads = 1) {
    ModelRequest request;
    request.key = key;
    request.threads = threads;
    return request;
}

inline ReadyParticles particles_of(const SpheresCloud& cloud, const ModelRequest& request) {
    auto made = spheres::make_particles(cloud, request, {});
    EXPECT_TRUE(made.ok());
    return made->particles;
}

}  // namespace awan::test
