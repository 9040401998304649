#include "core/draw/march_block.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/draw/march_fine.h"
#include "core/draw/march_lookup.h"
#include "core/draw/march_room.h"
#include "core/draw/march_targets.h"

namespace awan {
namespace {

// After each so many chunks of samples the shortest step doubles, so that every march ends, whatever lies along its
// rays. Scenes that are looked at take some hundred.
constexpr int kManyChunks = 8192;
// A chunk whose steps all are below this share of what they may be is followed by longer ones.
constexpr float kFarTooFine = 0.3f;
// Wide particles of a chunk that are not worth interpolating.
constexpr int kFewWide = 3;
constexpr int kWideSpacing = 2;
static_assert(kSpacings[kWideSpacing] == kWideApart);

// Tiles of finer rays that a block may have in matter with detail, where lumps may lie in all of it: as many as its
// squares of 2 x 2 pixels; and again, of pixels that are still uneven.
constexpr std::size_t kMostSharpOfLumps = 64;

// How far a block's march has come. Distances are counted from the block's reference.
struct Progress {
    double step;         // of the next chunk
    double at = 0;       // where it begins, in steps
    double marched = 0;  // step of the chunk that ended there; 0: none did
    int chunks = 0;
    std::size_t next = 0;  // the first particle that is still ahead

    double from() const { return at * step; }
    void halve() {
        step /= 2;
        at *= 2;
    }
    void double_step() {
        step *= 2;
        at /= 2;
    }
    // At odd places steps cannot double: blocks sample at whole multiples of their steps.
    bool even() const { return std::fmod(at, 2) == 0; }
};

// The next chunk as it is tried.
struct Attempt {
    Chunk chunk{};
    int spacing = -1;    // of the rays along which its light is looked up
    double longest = 1;  // the longest step here
};

// What came of it.
struct Verdict {
    int count = 0;     // samples from the start that are fine enough to be taken
    bool fine = true;  // all of them are far finer than they need be
};

// One block on its way through the cloud.
class BlockMarch {
  public:
    BlockMarch(const MarchScene& scene, const PlacedBlock& block, BlockRoom& room)
        : scene_(scene), room_(room), kernels_(march_kernels()), block_(block) {}

    // Chunk by chunk, front to back. A chunk in which a step turns out too deep is only taken up to there, and goes on
    // with half the step.
    void run(const std::vector<std::uint32_t>& items) {
        place_particles(scene_, items, block_, room_);
        room_.active.clear();
        Progress progress{block_.longest};
        while (any_alive() && skip_to_matter(progress)) {
            const Attempt attempt = next_chunk(progress);
            fill_profiles(attempt.chunk);
            const Verdict verdict = judge(attempt, progress);
            if (verdict.count > 0) {
                march_tiles(attempt, progress, verdict.count);
                progress.marched = progress.step;
                progress.at += verdict.count;
            }
            if (verdict.count < attempt.chunk.count)
                progress.halve();
            else if (progress.step < attempt.longest && verdict.fine && progress.even())
                progress.double_step();
        }
    }

    // The block's pixels.
    void draw(Image& image) const {
        const auto width = static_cast<std::size_t>(image.width);
        for (int t = 0; t < kTiles; ++t) {
            const auto x = static_cast<int>(room_.places[t].x),
                       y = static_cast<int>(room_.places[t].y);
            const int across = std::min(kTileSide, image.width - x);
            if (across <= 0) continue;
            float pixels[simd::kLanes][4];
            finish(t, pixels);
            for (int j = 0; j < std::min(kTileSide, image.height - y); ++j)
                std::memcpy(
                    image.pixels.data() +
                        4 * (static_cast<std::size_t>(y + j) * width + static_cast<std::size_t>(x)),
                    pixels[j * kTileSide], static_cast<std::size_t>(across) * sizeof pixels[0]);
        }
    }

    // The rays of tiles that are finer than pixels, to the sums of the pixels that they are in.
    void add_to(FinePixels& fine) const {
        for (int t = 0; t < block_.tiles; ++t) {
            float rays[simd::kLanes][4];
            finish(t, rays);
            const TilePlace& place = room_.places[t];
            for (int lane = 0; lane < simd::kLanes; ++lane)
                fine.add(static_cast<int>(place.ray_x(lane)) - block_.left,
                         static_cast<int>(place.ray_y(lane)) - block_.top, place.gap * place.gap,
                         rays[lane]);
        }
    }

  private:
    // What a tile's rays have met, and what stands behind it: r g b alpha of each.
    void finish(int t, float (*to)[4]) const {
        const BlockFrame& frame = block_.frame;
        const View& view = scene_.view;
        const float up[3] = {static_cast<float>(to_scene(view, frame.right).y),
                             static_cast<float>(to_scene(view, frame.up).y),
                             static_cast<float>(to_scene(view, frame.forward).y)};
        const SkyBehind& sky = scene_.sky;
        simd::Floats backdrop[3], once[3], often[3], opacity, lost;
        BehindPixels behind;
        if (sky.backdrop != nullptr) {
            take_pixels(t, sky.backdrop->rgb, backdrop);
            behind.backdrop = backdrop;
            if (!sky.backdrop->opacity.empty()) {
                behind.opacity = &opacity;
                behind.lost = &lost;
            }
            if (!sky.backdrop->quarters_of.empty()) take_hills(t, backdrop, opacity, lost);
        }
        if (sky.peak) {
            take_pixels(t, sky.through_peak->once, once);
            take_pixels(t, sky.through_peak->often, often);
            behind.once = once;
            behind.often = often;
        }
        if (scene_.air != nullptr && !scene_.measures)
            kernels_.finish_air(scene_, air_tile(*scene_.air, room_.places[t]), block_.sun, up,
                                behind, room_.tiles[t], to);
        else
            kernels_.finish(scene_, up, behind, room_.tiles[t], to);
        if (scene_.measures)
            for (int lane = 0; lane < simd::kLanes; ++lane)
                to[lane][0] = room_.tiles[t].seen_air[lane];
    }

    bool any_alive() const {
        return std::any_of(room_.tiles, room_.tiles + kTiles,
                           [](const Tile& tile) { return tile.alive; });
    }

    // Lets go of particles that lie behind, and jumps over empty space. False: no matter is left.
    bool skip_to_matter(Progress& progress) const {
        const double from = progress.from();
        std::erase_if(room_.active,
                      [&](const ActiveParticle& a) { return static_cast<double>(a.end) < from; });
        if (!room_.active.empty()) return true;
        const std::vector<float>& near = room_.particles.near;
        if (progress.next == near.size()) return false;
        progress.at = std::max(
            progress.at, std::floor(static_cast<double>(near[progress.next]) / progress.step));
        return true;
    }

    // The chunk that begins here, as long as the fineness and the spacing of rays stay what they are. Takes up the
    // particles that reach into it.
    Attempt next_chunk(Progress& progress) {
        const double from = progress.from(), near = block_.reference + from;
        Fineness fineness = fineness_at(room_.fineness, near + 0.5 * progress.step);
        while (progress.step > fineness.step * block_.stretch) {
            progress.halve();
            fineness = fineness_at(room_.fineness, near + 0.5 * progress.step);
        }
        const double step = progress.step;
        take_up_particles(from, from + kChunk * step, progress.next);
        kernels_.ratio(room_.particles, static_cast<float>(step), room_.active);

        Attempt attempt;
        attempt.longest = fineness.step * block_.stretch;
        // All blocks change the spacing at one distance: else the change would be seen between them.
        attempt.spacing = choose_spacing(scene_, near + 0.5 * step, fineness.apart);
        const double until =
            std::min(farthest(scene_, attempt.spacing, fineness.apart), fineness.until);
        // From an odd place an odd number of samples: steps double at even places only, and would stay short for ever.
        const double most = progress.even() ? kChunk : kChunk - 1;
        const int count =
            static_cast<int>(std::clamp(std::ceil((until - near) / step - 0.5), 1.0, most));
        attempt.chunk = {static_cast<float>(from), static_cast<float>(step),
                         static_cast<float>(progress.marched), count, step != progress.marched};
        if (++progress.chunks % kManyChunks == 0)
            block_.shortest = std::min(2 * block_.shortest, block_.longest);
        return attempt;
    }

    // Those that have matter from `from` on and may have it before `to`.
    void take_up_particles(double from, double to, std::size_t& next) {
        const BlockParticles& p = room_.particles;
        for (; next < p.s.size() && static_cast<double>(p.near[next]) < to; ++next) {
            ActiveParticle a;
            a.index = static_cast<std::uint32_t>(next);
            kernels_.measure(p, room_.middle, room_.spread, a);
            if (static_cast<double>(a.end) > from) room_.active.push_back(a);
        }
    }

    void fill_profiles(const Chunk& chunk) {
        kernels_.deposit(room_.particles, room_.active, chunk, between(), room_.wide, room_.tiles);
        if (block_.detail.field != nullptr) kernels_.detail(block_.detail, chunk, room_.tiles);
        if (scene_.cut) cut_at_ground(chunk);
    }

    // The weights of tiles between the rays of room_.wide, where enough particles are wide for it to be worth while.
    const Bilinear* between() const {
        if (!block_.between) return nullptr;
        const auto wide = std::count_if(
            room_.active.begin(), room_.active.end(),
            [&](const ActiveParticle& a) { return room_.particles.wide[a.index] != 0; });
        return wide < kFewWide ? nullptr : room_.bilinear[kWideSpacing];
    }

    // Takes away what lies beyond the ground.
    void cut_at_ground(const Chunk& chunk) {
        for (int t = 0; t < kTiles; ++t) {
            Tile& tile = room_.tiles[t];
            if (tile.first > tile.last) continue;
            simd::Floats ground;
            for (int lane = 0; lane < simd::kLanes; ++lane)
                ground[lane] = static_cast<float>(static_cast<double>(ground_before(t, lane)) -
                                                  block_.reference);
            for (int k = tile.first; k <= tile.last; ++k) {
                const float from = chunk.from + static_cast<float>(k) * chunk.step;
                tile.profile[k] *=
                    simd::min(simd::max((ground - from) * (1.0f / chunk.step), simd::Floats{}),
                              simd::all(1.0f));
            }
        }
    }

    // How much of the chunk is fine enough, and whether it is finer than need be.
    Verdict judge(const Attempt& attempt, const Progress& progress) const {
        const double step = progress.step;
        const bool may_halve = step > block_.shortest, may_double = step < attempt.longest;
        Verdict verdict{attempt.chunk.count, true};
        for (const Tile& tile : room_.tiles) {
            if (!tile.alive) continue;
            if (may_halve)
                verdict.count = std::min(verdict.count,
                                         kernels_.too_deep(tile, scene_.scaled, scene_.step_depth));
            if (may_double && verdict.fine)
                verdict.fine = kernels_.too_deep(tile, scene_.scaled,
                                                 scene_.step_depth * kFarTooFine) == kChunk;
        }
        if (may_halve)
            verdict.count = std::min(
                verdict.count,
                first_too_shaded(scene_, block_, samples_with_matter(progress, verdict.count)));
        return verdict;
    }

    // Of samples 0..count-1 from here, those in which any tile has matter; first > last: none.
    SampleRange samples_with_matter(const Progress& progress, int count) const {
        SampleRange samples{block_.reference + progress.from(), progress.step, count, kChunk, -1};
        for (const Tile& tile : room_.tiles) {
            if (!has_matter(tile, count)) continue;
            samples.first = std::min(samples.first, tile.first);
            samples.last = std::max(samples.last, std::min(tile.last, count - 1));
        }
        return samples;
    }

    // Takes the first `count` samples of the chunk.
    void march_tiles(const Attempt& attempt, const Progress& progress, int count) {
        const SampleRange samples = samples_with_matter(progress, count);
        if (samples.first > samples.last) return;
        const int spacing = attempt.spacing;
        if (spacing >= 0) look_up_corners(scene_, block_, samples, spacing, room_);
        const double ratio = progress.marched / progress.step;
        const double seam = std::min((ratio * ratio - 1) / 24, 0.25);
        const bool haze = scene_.air != nullptr || scene_.measures,
                   albedo = !scene_.light.light->albedo.empty();
        for (int t = 0; t < kTiles; ++t) {
            Tile& tile = room_.tiles[t];
            if (!has_matter(tile, count)) continue;
            if (!tile.started) start(t);
            SampleRange own = samples;
            own.first = tile.first;
            own.last = std::min(tile.last, count - 1);
            if (spacing >= 0)
                kernels_.spread(room_.bilinear[spacing][t], room_.corners, own.first, own.last,
                                albedo, haze, room_.light);
            else
                look_up_pixels(scene_, t, own, room_);
            (haze ? kernels_.march_haze : kernels_.march)(shade(t, seam), room_.light, count, tile);
        }
    }

    // A tile's phase functions are found when it first meets matter.
    void start(int t) {
        Tile& tile = room_.tiles[t];
        tile.started = true;
        const auto columns = static_cast<std::size_t>(scene_.table.columns);
        room_.rows.resize(kTiles * columns);
        kernels_.phases(scene_, block_.sun, tile, rows_at(t));
    }

    simd::Floats* rows_at(int t) const {
        if (room_.rows.empty()) return nullptr;
        return &room_.rows[static_cast<std::size_t>(t * scene_.table.columns)].value;
    }

    Shade shade(int t, double seam) const {
        const TransportLight& light = *scene_.light.light;
        const float albedo = light.albedo.empty() ? static_cast<float>(scene_.medium.albedo) : 1.0f;
        Shade shade{};
        shade.scaled = scene_.scaled;
        shade.seam = static_cast<float>(seam);
        shade.grid = light.has_grid() && !light.bands.empty();
        shade.peak = scene_.table.columns > 0;
        shade.albedo = !light.albedo.empty();
        for (int c = 0; c < 3; ++c) shade.beam[c] = albedo * scene_.sun[c];
        shade.last = scene_.table.last;
        shade.rows = rows_at(t);
        return shade;
    }

    // Pixel that a ray is in: the picture's last one's for those beyond it.
    std::size_t pixel_of(int t, int lane) const {
        const TilePlace& place = room_.places[t];
        const int x = std::min(static_cast<int>(place.ray_x(lane)), scene_.width - 1);
        const int y = std::min(static_cast<int>(place.ray_y(lane)), scene_.height - 1);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene_.width) +
               static_cast<std::size_t>(x);
    }

    // The quarter of a pixel that a ray finer than pixels is in; null: the pixel is not divided, or the ray stands for
    // all of it.
    const BackdropSample* quarter_of(int t, int lane) const {
        const Backdrop& behind = *scene_.sky.backdrop;
        const TilePlace& place = room_.places[t];
        if (behind.quarters_of.empty() || !(place.gap < 1)) return nullptr;
        const std::uint32_t divided = behind.quarters_of[pixel_of(t, lane)];
        if (divided == 0) return nullptr;
        const auto half = [](double at) { return at - std::floor(at) < 0.5 ? 0U : 1U; };
        return &behind.quarters[divided - 1][2 * half(place.ray_y(lane)) + half(place.ray_x(lane))];
    }

    float ground_before(int t, int lane) const {
        const BackdropSample* const quarter = quarter_of(t, lane);
        return quarter != nullptr ? quarter->distance
                                  : scene_.sky.backdrop->distance[pixel_of(t, lane)];
    }

    // What stands behind finer rays, and the haze before all.
    void take_hills(int t, simd::Floats* backdrop, simd::Floats& opacity,
                    simd::Floats& lost) const {
        const Backdrop& behind = *scene_.sky.backdrop;
        for (int lane = 0; lane < simd::kLanes; ++lane) {
            const BackdropSample* const quarter = quarter_of(t, lane);
            if (quarter != nullptr) {
                for (int c = 0; c < 3; ++c) backdrop[c][lane] = quarter->rgb[c];
                opacity[lane] = quarter->opacity;
                lost[lane] = quarter->lost;
            } else if (!behind.opacity.empty()) {
                opacity[lane] = behind.opacity[pixel_of(t, lane)];
                lost[lane] = behind.lost[pixel_of(t, lane)];
            }
        }
    }

    // Of each of the tile's pixels: r g b.
    void take_pixels(int t, const std::vector<float>& rgb, simd::Floats* to) const {
        for (int lane = 0; lane < simd::kLanes; ++lane) {
            const std::size_t pixel = pixel_of(t, lane);
            for (std::size_t c = 0; c < 3; ++c) to[c][lane] = rgb[3 * pixel + c];
        }
    }

    const MarchScene& scene_;
    BlockRoom& room_;
    const MarchKernels& kernels_;
    PlacedBlock block_;
};

}  // namespace

void march_block(const MarchScene& scene, int block_x, int block_y,
                 const std::vector<std::uint32_t>& items, BlockRoom& room, Image& image,
                 std::span<MarchedAlong> along) {
    const std::vector<FineTile> fine = fine_tiles(scene, block_x, block_y, items);
    const auto draw_pixels = [&](const MarchScene& of, Image& to) {
        BlockMarch block(of, place_block(of, block_x, block_y, room), room);
        for (const FineTile& one : fine) {
            const int across = static_cast<int>(one.place.x) / kTileSide % 4,
                      down = static_cast<int>(one.place.y) / kTileSide % 4;
            room.tiles[down * 4 + across].alive = false;
        }
        if (!items.empty()) block.run(items);
        // Of tiles that are divided, what stands behind the cloud.
        block.draw(to);
    };
    draw_pixels(scene, image);
    for (MarchedAlong& one : along) draw_pixels(one.scene, one.image);
    // Haze has an edge of its own, the horizon.
    const bool hazy = scene.air != nullptr;
    if (items.empty() && !hazy) return;

    // Finer rays, of the picture and of what is marched along with it.
    struct Finer {
        FinePixels of_picture;
        std::vector<FinePixels> of_along;
    };
    const auto march_part = [&](std::span<const TilePlace> places,
                                const std::vector<std::uint32_t>& part_items, Finer& to) {
        const auto march_one = [&](const MarchScene& of, FinePixels& pixels) {
            BlockMarch part(of, place_block(of, block_x, block_y, places, room), room);
            if (!part_items.empty()) part.run(part_items);
            part.add_to(pixels);
        };
        march_one(scene, to.of_picture);
        for (std::size_t i = 0; i < along.size(); ++i) march_one(along[i].scene, to.of_along[i]);
    };
    const auto march_all = [&](const std::vector<TilePlace>& places, Finer& to) {
        const std::span<const TilePlace> all(places);
        for (std::size_t first = 0; first < all.size(); first += kTiles)
            march_part(all.subspan(first, std::min<std::size_t>(kTiles, all.size() - first)), items,
                       to);
    };
    const int left = block_x * kBlockSide, top = block_y * kBlockSide;
    const auto draw_finer = [&](const Finer& finer) {
        finer.of_picture.draw(left, top, image);
        for (std::size_t i = 0; i < along.size(); ++i)
            finer.of_along[i].draw(left, top, along[i].image);
    };
    const bool lumps = scene.detail != nullptr;
    Finer pixels{{}, std::vector<FinePixels>(along.size())};
    if (!scene.one_ray)
        march_all(sharp_places(image, left, top, fine, lumps ? kMostSharpOfLumps : kTiles), pixels);
    for (std::size_t first = 0; first < fine.size();) {
        const FineBatch batch = batch_from(fine, first, items);
        march_part(batch.places, batch.items, pixels);
        first += batch.places.size();
    }
    draw_finer(pixels);
    if (scene.one_ray || (!lumps && !hazy)) return;
    Finer finest{{}, std::vector<FinePixels>(along.size())};
    march_all(pixels.of_picture.sharp_places(left, top, brightest_pixel(image, left, top),
                                             kMostSharpOfLumps),
              finest);
    draw_finer(finest);
}

}  // namespace awan
