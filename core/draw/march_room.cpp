#include "core/draw/march_room.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/draw/march_targets.h"
#include "core/survey/projection.h"

namespace awan {
namespace {

// About the most samples of a ray: where its matter is longer than that, all steps are stretched.
constexpr double kMostSamples = 2048;
// The longest step over the shortest. Matter in which steps get as short as this is so dense that rays soon end.
constexpr double kFinest = 4096;

// The closest rays of matter with detail, of a pixel (march_block.cpp): smaller bumps than their gaps are not seen.
constexpr double kRaysAcross = 4;

// Rays that stand apart by so little of a particle's s, or less, tell what lies between them: linear between them, a
// Gaussian is wrong by at most (apart / s)^2 / 4 of its middle, too low there and too high at its rim. Where many
// overlap, as those that wide are do, that is of the sum's curvature, which is less.
constexpr double kWideParts = 6;
// Depositing along the rays of WideRays costs as much as in so many tiles; less is not worth it.
constexpr int kWideTiles = 5;

// A tile of a block's pixels, relative to the block.
TilePlace pixels_of(int tile) {
    return {static_cast<double>(tile % 4 * kTileSide), static_cast<double>(tile / 4 * kTileSide),
            1};
}

// A tile's rays between the four corners around them. The tile's place is relative to its block.
Bilinear bilinear_of(const TilePlace& place, int spacing) {
    Bilinear b;
    const double width = spacing;
    const int side = kBlockSide / spacing + 1;
    const int i = static_cast<int>(place.x / width), j = static_cast<int>(place.y / width);
    for (int c = 0; c < 4; ++c) {
        b.corner[c] = (j + c / 2) * side + i + c % 2;
        for (int lane = 0; lane < simd::kLanes; ++lane) {
            const auto u = static_cast<float>((place.ray_x(lane) - i * width) / width);
            const auto v = static_cast<float>((place.ray_y(lane) - j * width) / width);
            b.weight[c][lane] = (c % 2 == 1 ? u : 1 - u) * (c / 2 == 1 ? v : 1 - v);
        }
    }
    return b;
}

// Pixel coordinates are counted from (x, y), which the middle ray need not go through.
BlockFrame frame_of(const MarchScene& scene, double x, double y, double middle_x, double middle_y) {
    BlockFrame frame;
    frame.forward = frame_direction(scene, middle_x, middle_y);
    const SideAxes side = side_axes(frame.forward);
    frame.right = side.u;
    frame.up = side.v;
    const double tan = scene.view.tan_half_fov, wide = tan * scene.view.aspect;
    frame.du = 2 * wide / scene.width;
    frame.dv = -2 * tan / scene.height;
    frame.u0 = x * frame.du - wide;
    frame.v0 = y * frame.dv + tan;
    return frame;
}

SunInBlock sun_in(const BlockFrame& frame, const MarchScene& scene) {
    const glm::dvec3 sun = to_frame(scene.view, scene.to_sun);
    return {static_cast<float>(glm::dot(sun, frame.right)),
            static_cast<float>(glm::dot(sun, frame.up)),
            static_cast<float>(glm::dot(sun - frame.forward, frame.forward))};
}

// A tile before its first sample. `ray`: its lanes' directions.
void clear(Tile& tile, const simd::Floats ray[3], bool in_picture) {
    tile.x = ray[0];
    tile.y = ray[1];
    tile.z = ray[2];
    tile.alive = in_picture;
    tile.started = false;
    tile.depth = tile.red = tile.green = tile.blue = simd::Floats{};
    tile.seen_air = tile.seen_lost = simd::Floats{};
    tile.left = tile.scaled_left = simd::all(1.0f);
}

// Sets the tiles' rays. (x, y): the picture's point that the frame counts pixels from.
void place_tiles(const MarchScene& scene, const PlacedBlock& block, double x, double y,
                 BlockRoom& room) {
    const MarchKernels& kernels = march_kernels();
    float at_x[simd::kLanes], at_y[simd::kLanes];
    for (int t = 0; t < kTiles; ++t) {
        const TilePlace& place = room.places[t];
        at_x[t] = static_cast<float>(place.x - x + 0.5 * kTileSide * place.gap);
        at_y[t] = static_cast<float>(place.y - y + 0.5 * kTileSide * place.gap);
    }
    kernels.rays(block.frame, at_x, at_y, room.middle);
    for (int t = 0; t < kTiles; ++t) {
        const TilePlace& place = room.places[t];
        for (int lane = 0; lane < simd::kLanes; ++lane) {
            at_x[lane] = static_cast<float>(place.ray_x(lane) - x);
            at_y[lane] = static_cast<float>(place.ray_y(lane) - y);
        }
        simd::Floats ray[3];
        kernels.rays(block.frame, at_x, at_y, ray);
        simd::Floats apart{};
        for (int axis = 0; axis < 3; ++axis) {
            const simd::Floats off = ray[axis] - room.middle[axis][t];
            apart += off * off;
        }
        // A little more, for rounding.
        room.spread[t] = std::sqrt(simd::largest(apart)) * 1.001f;
        clear(room.tiles[t], ray,
              t < block.tiles && place.x < scene.width && place.y < scene.height);
    }
}

// Sets the rays between which wide particles are deposited. (x, y): the picture's point that the frame counts pixels
// from.
void place_wide(const PlacedBlock& block, double x, double y, WideRays& wide) {
    float at_x[simd::kLanes], at_y[simd::kLanes];
    for (int r = 0; r < WideRays::kRows; ++r) {
        for (int lane = 0; lane < simd::kLanes; ++lane) {
            const int ray = std::min(r * simd::kLanes + lane, kWideSide * kWideSide - 1);
            at_x[lane] = static_cast<float>(block.left + ray % kWideSide * kWideApart - x);
            at_y[lane] = static_cast<float>(block.top + ray / kWideSide * kWideApart - y);
        }
        WideRays::Row& row = wide.rows[r];
        simd::Floats ray[3];
        march_kernels().rays(block.frame, at_x, at_y, ray);
        row.x = ray[0];
        row.y = ray[1];
        row.z = ray[2];
    }
}

// The block's rays in the tile of detail (march_detail.h).
DetailRays detail_rays(const MarchScene& scene, const BlockFrame& frame, double reference) {
    const DetailField& field = *scene.detail;
    DetailRays rays;
    rays.field = &field;
    rays.reference = static_cast<float>(reference);
    rays.far = static_cast<float>(
        std::min(kRaysAcross * field.bump * scene.height / (2 * scene.view.tan_half_fov), 1e30));
    const glm::dvec3 middle = to_scene(scene.view, frame.forward);
    const glm::dvec3 start = field.to_tile * (scene.view.eye + reference * middle - field.origin);
    const glm::dvec3 axes[3] = {field.to_tile * to_scene(scene.view, frame.right),
                                field.to_tile * to_scene(scene.view, frame.up),
                                field.to_tile * middle};
    for (int axis = 0; axis < 3; ++axis) {
        rays.start[axis] =
            static_cast<float>(start[axis] - kDetailSide * std::floor(start[axis] / kDetailSide));
        rays.right[axis] = static_cast<float>(axes[0][axis]);
        rays.up[axis] = static_cast<float>(axes[1][axis]);
        rays.middle[axis] = static_cast<float>(axes[2][axis]);
    }
    return rays;
}

// The length along a ray that any of the block's particles may fill, scene units; `items` nearest first.
double filled_length(const std::vector<SeenParticle>& seen,
                     const std::vector<std::uint32_t>& items) {
    double length = 0, end = -1e300;
    for (const std::uint32_t item : items) {
        const SeenParticle& one = seen[item];
        const double last = one.nearest + 2 * static_cast<double>(one.reach);
        length += std::max(0.0, last - std::max(end, one.nearest));
        end = std::max(end, last);
    }
    return length;
}

}  // namespace

void BlockRoomDelete::operator()(BlockRoom* room) const {
    delete room;
}

BlockRoomPtr make_block_room() {
    BlockRoomPtr room(new BlockRoom);
    for (int s = 0; s < kSpacingCount; ++s)
        for (int t = 0; t < kTiles; ++t)
            room->of_pixels[s][t] = bilinear_of(pixels_of(t), kSpacings[s]);
    return room;
}

PlacedBlock place_block(const MarchScene& scene, int block_x, int block_y, BlockRoom& room) {
    PlacedBlock block;
    block.left = block_x * kBlockSide;
    block.top = block_y * kBlockSide;
    block.middle_x = block.left + kBlockSide / 2;
    block.middle_y = block.top + kBlockSide / 2;
    for (int t = 0; t < kTiles; ++t) {
        room.places[t] = pixels_of(t);
        room.places[t].x += block.left;
        room.places[t].y += block.top;
    }
    room.bilinear = room.of_pixels;
    block.frame = frame_of(scene, block.left, block.top, block.middle_x, block.middle_y);
    block.sun = sun_in(block.frame, scene);
    place_tiles(scene, block, block.left, block.top, room);
    place_wide(block, block.left, block.top, room.wide);
    block.between = true;
    return block;
}

PlacedBlock place_block(const MarchScene& scene, int block_x, int block_y,
                        std::span<const TilePlace> places, BlockRoom& room) {
    PlacedBlock block;
    block.left = block_x * kBlockSide;
    block.top = block_y * kBlockSide;
    block.tiles = static_cast<int>(places.size());
    double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
    for (const TilePlace& place : places) {
        low_x = std::min(low_x, place.x);
        low_y = std::min(low_y, place.y);
        high_x = std::max(high_x, place.x + kTileSide * place.gap);
        high_y = std::max(high_y, place.y + kTileSide * place.gap);
    }
    // The frame is that of their own middle, so that floats are fine enough for tiles far below a pixel.
    block.middle_x = 0.5 * (low_x + high_x);
    block.middle_y = 0.5 * (low_y + high_y);
    for (std::size_t t = 0; t < kTiles; ++t) {
        room.places[t] = places[std::min(t, places.size() - 1)];
        TilePlace in_block = room.places[t];
        in_block.x -= block.left;
        in_block.y -= block.top;
        for (int s = 0; s < kSpacingCount; ++s)
            room.of_places[s][t] = bilinear_of(in_block, kSpacings[s]);
    }
    room.bilinear = room.of_places;
    block.frame = frame_of(scene, block.middle_x, block.middle_y, block.middle_x, block.middle_y);
    block.sun = sun_in(block.frame, scene);
    place_tiles(scene, block, block.middle_x, block.middle_y, room);
    block.between = block.tiles > kWideTiles;
    if (block.between) place_wide(block, block.middle_x, block.middle_y, room.wide);
    return block;
}

void place_particles(const MarchScene& scene, const std::vector<std::uint32_t>& items,
                     PlacedBlock& block, BlockRoom& room) {
    const std::vector<SeenParticle>& seen = *scene.seen;
    const BlockFrame& frame = block.frame;
    // A multiple of the step, so that all blocks have samples at the same distances.
    block.reference =
        std::max(0.0, std::floor(seen[items.front()].nearest / scene.step) * scene.step);
    BlockParticles& p = room.particles;
    p.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const SeenParticle& one = seen[items[i]];
        const double along = glm::dot(one.q, frame.forward);
        p.x[i] = static_cast<float>(glm::dot(one.q, frame.right));
        p.y[i] = static_cast<float>(glm::dot(one.q, frame.up));
        p.along[i] = static_cast<float>(along);
        p.place[i] = static_cast<float>(along - block.reference);
        p.near[i] = static_cast<float>(one.nearest - block.reference);
        p.s[i] = one.s;
        p.extinction[i] = one.extinction;
        p.reach[i] = one.reach;
        // Where the rays stand widest apart.
        const double apart =
            kWideApart * frame.du * (glm::length(one.q) + 3 * static_cast<double>(one.s));
        p.wide[i] = static_cast<double>(one.s) > kWideParts * apart ? 1 : 0;
    }
    // A little more than the slope of the block's corners to its middle.
    const double slope = frame.du * kBlockSide * 0.75;
    fineness_in_cone(scene.islands, frame.forward, slope, {scene.apart, scene.step}, room.fineness);
    if (scene.detail != nullptr) block.detail = detail_rays(scene, frame, block.reference);
    const double finest = finest_step(room.fineness), length = filled_length(seen, items);
    for (double samples = finest; samples * kMostSamples < length; samples *= 2) block.stretch *= 2;
    block.longest = scene.step * block.stretch;
    block.shortest = finest / kFinest;
}

}  // namespace awan
