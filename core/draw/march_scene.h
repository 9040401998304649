// What all blocks of a picture share while they are marched. Values, and the directions of a picture's rays.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/draw/air.h"
#include "core/draw/backdrop.h"
#include "core/draw/behind_peak.h"
#include "core/draw/march_bins.h"
#include "core/draw/march_fineness.h"
#include "core/draw/march_light.h"
#include "core/draw/march_phase.h"
#include "core/draw/march_simd.h"
#include "core/generate/detail.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// The sky as pixels see it.
struct SkyBehind {
    float zenith[3] = {}, horizon[3] = {};  // radiance of a sky that is a gradient
    bool behind = false;                    // it is drawn behind the cloud
    bool peak = false;                      // it is seen through the forward peak, too
    // What stands behind instead of the gradient; null: nothing.
    const Backdrop* backdrop = nullptr;
    const BehindPeak* through_peak = nullptr;  // null without `peak`
};

// What stands behind the pixels of a tile.
struct BehindPixels {
    const simd::Floats* backdrop = nullptr;  // radiance r g b; null: the sky's gradient
    // That which the forward peak brings (BehindPeak), r g b; null: none.
    const simd::Floats* once = nullptr;
    const simd::Floats* often = nullptr;
    // The haze's O and L before `backdrop`, which then is as it comes through that; null: neither.
    const simd::Floats* opacity = nullptr;
    const simd::Floats* lost = nullptr;
};

struct MarchScene {
    View view;
    int width = 0, height = 0;  // pixels
    const std::vector<SeenParticle>* seen = nullptr;
    EyeLight light;
    Medium medium;
    Peak peak;
    RestOfPhase rest;
    PeakTable table;
    glm::dvec3 to_sun{0, 1, 0};  // unit
    glm::vec3 sun{0};            // irradiance
    float scaled = 1;            // share of extinction that is not the peak's: 1 - albedo * f
    float most_peak = 1;         // depth_of_most (behind_peak.h), above 0
    double step = 1;             // the longest step, scene units
    // The widest gap between rays along which light is looked up, scene units.
    double apart = 1e300;
    std::vector<SeenIsland> islands;  // where step and apart are less
    float step_depth = 1;             // scaled optical depth of the longest step, where it is seen
    SkyBehind sky;
    const DetailField* detail = nullptr;  // null: there is none
    const Air* air = nullptr;             // null: there is no haze
    // Instead of light, finds how far away rays end: red is the mean distance to where their light stops, times alpha.
    bool measures = false;
    // In haze: what the haze sends from behind the matter is left out, so that pixels are of the matter alone.
    bool alone = false;
    bool one_ray = false;              // a pixel, even where it is uneven
    std::vector<std::uint8_t> wanted;  // whether a block is marched, row by row; EMPTY: all are
    bool cut = false;  // whether rays end at backdrop->distance: there is matter below the ground
};

// From the eye's frame (right, up, forward) to the scene's, and back.
glm::dvec3 to_scene(const View& view, const glm::dvec3& d);
glm::dvec3 to_frame(const View& view, const glm::dvec3& d);

// Unit direction of the ray through a point of the picture (pixels from its top left corner), in the eye's frame and in
// the scene's.
glm::dvec3 frame_direction(const MarchScene& scene, double x, double y);
glm::dvec3 pixel_direction(const MarchScene& scene, double x, double y);

}  // namespace awan
