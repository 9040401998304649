// What splats need of detail (core/generate/detail.h): two volumes on the renderer.
#pragma once

#include <glm/mat4x3.hpp>
#include <glm/vec3.hpp>

#include "core/generate/particle_set.h"
#include "core/gl/objects.h"
#include "core/survey/survey.h"

namespace awan {

// As splat.glsl takes it.
struct SplatDetail {
    gl::VolumeTexture extinction, bumps;
    glm::mat4x3 to_extinction, to_bumps;
    float keep, bump, edge;
    // How far each particle looks the extinction up aside, at most, in its coordinates: a voxel where what is between
    // voxels is what the nearest is, so that their sides do not show where particles overlap; else 0.
    glm::vec3 aside;
};

// Cells of the extinction are as wide as most of the matter's particles have for standard deviation, as far as
// kMostDetailCells along the longest side allow. Where particles are many and voxels of bumps no wider than a pixel or
// two, volumes are not interpolated. height: of the picture, pixels. Precondition: particles have detail and mass.
SplatDetail splat_detail(const ParticleSet& particles, const View& view, int height, int threads);

inline constexpr int kMostDetailCells = 160;

}  // namespace awan
