// One block of 16 x 16 pixels, marched front to back as 16 tiles of 4 x 4 pixels, a pixel a lane.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/draw/march_scene.h"

namespace awan {

// Room for one block, used again for the next.
struct BlockRoom;
struct BlockRoomDelete {
    void operator()(BlockRoom* room) const;
};
using BlockRoomPtr = std::unique_ptr<BlockRoom, BlockRoomDelete>;
BlockRoomPtr make_block_room();

// The same matter in another light, or measured, along the very rays of a picture, and what comes of it.
struct MarchedAlong {
    MarchScene scene;
    Image image;
};

// Draws the block's pixels, and those of what is marched along with it: where the picture changes sharply, all have
// finer rays. `items`: the particles that it sees, indices into scene.seen, nearest first; may be empty.
void march_block(const MarchScene& scene, int block_x, int block_y,
                 const std::vector<std::uint32_t>& items, BlockRoom& room, Image& image,
                 std::span<MarchedAlong> along = {});

}  // namespace awan
