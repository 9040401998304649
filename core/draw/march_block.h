// One block of 16 x 16 pixels, marched front to back as 16 tiles of 4 x 4 pixels, a pixel a lane.
#pragma once

#include <cstdint>
#include <memory>
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

// Draws the block's pixels. `items`: the particles that it sees, indices into scene.seen, nearest first; may be empty.
void march_block(const MarchScene& scene, int block_x, int block_y,
                 const std::vector<std::uint32_t>& items, BlockRoom& room, Image& image);

}  // namespace awan
