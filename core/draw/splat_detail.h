// What splats need of detail (core/generate/detail.h): two volumes on the renderer.
#pragma once

#include <glm/mat4x3.hpp>

#include "core/generate/particle_set.h"
#include "core/gl/objects.h"
#include "core/survey/survey.h"

namespace awan {

// As splat.glsl takes it.
struct SplatDetail {
    gl::VolumeTexture extinction, bumps;
    glm::mat4x3 to_extinction, to_bumps;
    float keep, bump, edge;
};

// Cells of the extinction are as wide as most of the matter's particles have for standard deviation, as far as
// kMostDetailCells along the longest side allow. Precondition: particles have detail and mass.
SplatDetail splat_detail(const ParticleSet& particles, const View& view, int threads);

inline constexpr int kMostDetailCells = 160;

}  // namespace awan
