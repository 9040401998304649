// One block of 16 x 16 pixels, marched front to back as 16 tiles of 4 x 4 pixels, a pixel a lane.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "core/base/image.h"
#include "core/draw/air.h"
#include "core/draw/backdrop.h"
#include "core/draw/march_bins.h"
#include "core/draw/march_fineness.h"
#include "core/draw/march_light.h"
#include "core/draw/march_phase.h"
#include "core/draw/march_simd.h"
#include "core/scene/scene.h"

namespace awan {

// The sky as pixels see it.
struct SkyBehind {
    float zenith[3] = {}, horizon[3] = {};
    bool behind = false;                         // drawn behind the cloud
    bool peak = false;                           // seen through the forward peak
    const Backdrop* backdrop = nullptr;          // instead of the two colours
    bool sky_peak = false, ground_peak = false;  // then: which of the two goes through the peak
};

// What all blocks of a picture share.
struct MarchScene {
    View view;
    int width = 0, height = 0;
    const std::vector<SeenParticle>* seen = nullptr;
    EyeLight light;
    Medium medium;
    Peak peak;
    RestOfPhase rest;
    PeakTable table;
    glm::dvec3 to_sun{0, 1, 0};
    glm::vec3 sun{0};      // irradiance
    float scaled = 1;      // share of extinction that is not the peak's: 1 - albedo * f
    double step = 1;       // longest step, scene units
    double apart = 1e300;  // most distance between rays along which light is looked up, scene units
    std::vector<SeenIsland> islands;  // where both are less
    float step_depth = 1;             // longest step in scaled optical depth, where it is seen
    SkyBehind sky;
    const DetailField* detail = nullptr;  // null: none
    const Air* air = nullptr;             // null: there is no haze
    bool cut = false;  // whether rays end at backdrop->distance: there is matter below the ground
};

inline constexpr int kTileSide = 4;
inline constexpr int kTiles = 16;  // of a block
inline constexpr int kChunk = 32;  // samples that are built at a time

// Room for one block, used again for the next.
struct BlockRoom;
struct BlockRoomDelete {
    void operator()(BlockRoom* room) const;
};
using BlockRoomPtr = std::unique_ptr<BlockRoom, BlockRoomDelete>;
BlockRoomPtr make_block_room();

// Unit direction of the ray through a point of the picture, pixels from its top left corner.
glm::dvec3 pixel_direction(const MarchScene& scene, double x, double y);

// Draws the block's pixels. `items` may be empty.
void march_block(const MarchScene& scene, int block_x, int block_y,
                 const std::vector<std::uint32_t>& items, BlockRoom& room, Image& image);

}  // namespace awan
