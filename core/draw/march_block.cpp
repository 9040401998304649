#include "core/draw/march_block.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "core/draw/march_targets.h"
#include "core/survey/projection.h"

namespace awan {

namespace {

constexpr int kSpacings[] = {16, 8, 4, 2};  // pixels between rays along which light is looked up
constexpr int kMostCorners = 81;
constexpr double kMostSamples = 2048;  // about, of a ray
constexpr double kFinest = 4096;  // the longest step over the shortest: these end soon, in opacity
// After each so many chunks of samples the shortest step doubles: whatever lies along a ray, its march ends. Scenes that
// are looked at take some hundred.
constexpr int kManyChunks = 8192;

// Largest change of depth towards the sun in a step, over the largest depth of a step. 1 halves what is left of the step error in
// a flat sheet under a low sun, and doubles the time of a cumulus.
constexpr float kRise = 2.5f;
constexpr float kDark = 7.0f;  // scaled depth towards the sun behind which the beam is not seen

// Of the ray through a point of the picture, in the eye's frame (right, up, forward).
glm::dvec3 frame_direction(const MarchScene& scene, double x, double y) {
    const double tan = scene.view.tan_half_fov;
    return glm::normalize(glm::dvec3((x / scene.width * 2 - 1) * tan * scene.view.aspect,
                                     (1 - y / scene.height * 2) * tan, 1));
}

glm::dvec3 to_scene(const View& view, const glm::dvec3& d) {
    return d.x * view.right + d.y * view.up + d.z * view.forward;
}
glm::dvec3 to_frame(const View& view, const glm::dvec3& d) {
    return {glm::dot(d, view.right), glm::dot(d, view.up), glm::dot(d, view.forward)};
}

}  // namespace

struct BlockRoom {
    Tile tiles[kTiles];
    TileLight light;
    LightAt corners[kMostCorners][kChunk + 2];
    Bilinear bilinear[std::size(kSpacings)][kTiles];
    Floats middle[3], spread;  // of the tiles' rays, a tile a lane
    BlockParticles particles;
    std::vector<ActiveParticle> active;
    std::vector<FineInterval> fineness;
    struct alignas(64) Column {
        Floats value;
    };
    std::vector<Column> rows;  // of the peak table, tile by tile
};

void BlockRoomDelete::operator()(BlockRoom* room) const {
    delete room;
}

BlockRoomPtr make_block_room() {
    BlockRoomPtr room(new BlockRoom);
    for (std::size_t s = 0; s < std::size(kSpacings); ++s)
        for (int t = 0; t < kTiles; ++t) {
            const int spacing = kSpacings[s], side = kBlockSide / spacing + 1;
            Bilinear& b = room->bilinear[s][t];
            const int x = t % 4 * kTileSide, y = t / 4 * kTileSide;
            const int i = x / spacing, j = y / spacing;
            for (int c = 0; c < 4; ++c) {
                b.corner[c] = (j + c / 2) * side + i + c % 2;
                for (int lane = 0; lane < kLanes; ++lane) {
                    const float u = (static_cast<float>(x - i * spacing + lane % 4) + 0.5f) /
                                    static_cast<float>(spacing);
                    const float v = (static_cast<float>(y - j * spacing + lane / 4) + 0.5f) /
                                    static_cast<float>(spacing);
                    b.weight[c][lane] = (c % 2 == 1 ? u : 1 - u) * (c / 2 == 1 ? v : 1 - v);
                }
            }
        }
    return room;
}

glm::dvec3 pixel_direction(const MarchScene& scene, double x, double y) {
    return to_scene(scene.view, frame_direction(scene, x, y));
}

namespace {

// One block on its way through the cloud.
class BlockMarch {
  public:
    BlockMarch(const MarchScene& scene, int block_x, int block_y, BlockRoom& room)
        : scene_(scene),
          room_(room),
          kernels_(march_kernels()),
          left_(block_x * kBlockSide),
          top_(block_y * kBlockSide) {}

    void run(const std::vector<std::uint32_t>& items) {
        place_rays();
        if (items.empty()) return;
        place_particles(items);
        march();
    }

    void draw(Image& image) const {
        const float up[3] = {static_cast<float>(to_scene(scene_.view, frame_.right).y),
                             static_cast<float>(to_scene(scene_.view, frame_.up).y),
                             static_cast<float>(to_scene(scene_.view, frame_.forward).y)};
        const auto width = static_cast<std::size_t>(image.width);
        for (int t = 0; t < kTiles; ++t) {
            const int x = left_ + t % 4 * kTileSide, y = top_ + t / 4 * kTileSide;
            const int across = std::min(kTileSide, image.width - x);
            if (across <= 0) continue;
            float pixels[kLanes][4];
            Floats backdrop[4];
            const Floats* const behind = scene_.sky.backdrop != nullptr ? backdrop : nullptr;
            if (behind != nullptr) take_backdrop(t, backdrop);
            if (scene_.air != nullptr)
                kernels_.finish_air(scene_, air_tile(*scene_.air, x, y), sun_, up, behind,
                                    room_.tiles[t], pixels);
            else
                kernels_.finish(scene_, up, behind, room_.tiles[t], pixels);
            for (int j = 0; j < std::min(kTileSide, image.height - y); ++j)
                std::memcpy(
                    image.pixels.data() +
                        4 * (static_cast<std::size_t>(y + j) * width + static_cast<std::size_t>(x)),
                    pixels[j * kTileSide], static_cast<std::size_t>(across) * sizeof pixels[0]);
        }
    }

  private:
    // Pixel of a lane, in the picture: the last one's for those beyond it.
    std::size_t pixel_of(int t, int lane) const {
        const int x = std::min(left_ + t % 4 * kTileSide + lane % 4, scene_.width - 1);
        const int y = std::min(top_ + t / 4 * kTileSide + lane / 4, scene_.height - 1);
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene_.width) +
               static_cast<std::size_t>(x);
    }

    // r g b, and whether it is seen through the peak.
    void take_backdrop(int t, Floats* to) const {
        const SkyBehind& sky = scene_.sky;
        const Backdrop& backdrop = *sky.backdrop;
        for (int lane = 0; lane < kLanes; ++lane) {
            const std::size_t pixel = pixel_of(t, lane);
            for (std::size_t c = 0; c < 3; ++c) to[c][lane] = backdrop.rgb[3 * pixel + c];
            const bool ground =
                !backdrop.distance.empty() && std::isfinite(backdrop.distance[pixel]);
            to[3][lane] = (ground ? sky.ground_peak : sky.sky_peak) ? 1.0f : 0.0f;
        }
    }

    // Takes away what lies beyond the ground.
    void cut_at_ground(const Chunk& chunk) {
        for (int t = 0; t < kTiles; ++t) {
            Tile& tile = room_.tiles[t];
            if (tile.first > tile.last) continue;
            Floats ground;
            for (int lane = 0; lane < kLanes; ++lane)
                ground[lane] = static_cast<float>(
                    static_cast<double>(scene_.sky.backdrop->distance[pixel_of(t, lane)]) -
                    reference_);
            for (int k = tile.first; k <= tile.last; ++k) {
                const float from = chunk.from + static_cast<float>(k) * chunk.step;
                tile.profile[k] *= simd::min(
                    simd::max((ground - from) * (1.0f / chunk.step), Floats{}), simd::all(1.0f));
            }
        }
    }

    void place_rays() {
        frame_.forward = frame_direction(scene_, left_ + kBlockSide / 2, top_ + kBlockSide / 2);
        const SideAxes side = side_axes(frame_.forward);
        frame_.right = side.u;
        frame_.up = side.v;
        const double tan = scene_.view.tan_half_fov, wide = tan * scene_.view.aspect;
        frame_.du = 2 * wide / scene_.width;
        frame_.dv = -2 * tan / scene_.height;
        frame_.u0 = left_ * frame_.du - wide;
        frame_.v0 = top_ * frame_.dv + tan;
        float x[kLanes], y[kLanes];
        for (int t = 0; t < kTiles; ++t) {
            x[t] = static_cast<float>(t % 4 * kTileSide + kTileSide / 2);
            y[t] = static_cast<float>(t / 4 * kTileSide + kTileSide / 2);
        }
        kernels_.rays(frame_, x, y, room_.middle);
        for (int t = 0; t < kTiles; ++t) {
            Tile& tile = room_.tiles[t];
            const int across = t % 4 * kTileSide, down = t / 4 * kTileSide;
            for (int lane = 0; lane < kLanes; ++lane) {
                x[lane] = static_cast<float>(across + lane % 4) + 0.5f;
                y[lane] = static_cast<float>(down + lane / 4) + 0.5f;
            }
            Floats ray[3];
            kernels_.rays(frame_, x, y, ray);
            tile.x = ray[0];
            tile.y = ray[1];
            tile.z = ray[2];
            Floats apart{};
            for (int axis = 0; axis < 3; ++axis) {
                const Floats off = ray[axis] - room_.middle[axis][t];
                apart += off * off;
            }
            room_.spread[t] = std::sqrt(simd::largest(apart)) * 1.001f;
            tile.alive = left_ + across < scene_.width && top_ + down < scene_.height;
            tile.started = false;
            tile.depth = tile.red = tile.green = tile.blue = Floats{};
            tile.seen_air = tile.seen_lost = Floats{};
            tile.left = tile.scaled_left = simd::all(1.0f);
        }
        const glm::dvec3 sun = to_frame(scene_.view, scene_.to_sun);
        sun_ = {static_cast<float>(glm::dot(sun, frame_.right)),
                static_cast<float>(glm::dot(sun, frame_.up)),
                static_cast<float>(glm::dot(sun - frame_.forward, frame_.forward))};
    }

    void place_particles(const std::vector<std::uint32_t>& items) {
        const std::vector<SeenParticle>& seen = *scene_.seen;
        const glm::dvec3 &forward = frame_.forward, &right = frame_.right, &up = frame_.up;
        reference_ =
            std::max(0.0, std::floor(seen[items.front()].nearest / scene_.step) * scene_.step);
        BlockParticles& p = room_.particles;
        p.resize(items.size());
        double length = 0, end = -1e300;
        for (std::size_t i = 0; i < items.size(); ++i) {
            const SeenParticle& one = seen[items[i]];
            const double along = glm::dot(one.q, forward);
            p.x[i] = static_cast<float>(glm::dot(one.q, right));
            p.y[i] = static_cast<float>(glm::dot(one.q, up));
            p.along[i] = static_cast<float>(along);
            p.place[i] = static_cast<float>(along - reference_);
            p.near[i] = static_cast<float>(one.nearest - reference_);
            p.s[i] = one.s;
            p.extinction[i] = one.extinction;
            p.reach[i] = one.reach;
            const double last = one.nearest + 2 * static_cast<double>(one.reach);
            length += std::max(0.0, last - std::max(end, one.nearest));
            end = std::max(end, last);
        }
        const double slope = frame_.du * kBlockSide * 0.75;  // of the block's corners to its middle
        fineness_in_cone(scene_.islands, frame_.forward, slope, {scene_.apart, scene_.step},
                         room_.fineness);
        if (scene_.detail != nullptr) place_detail();
        longest_ = scene_.step;
        const double finest = finest_step(room_.fineness);
        for (double samples = finest; samples * kMostSamples < length; samples *= 2) stretch_ *= 2;
        longest_ *= stretch_;
        shortest_ = finest / kFinest;
    }

    void place_detail() {
        const DetailField& field = *scene_.detail;
        detail_.field = &field;
        detail_.reference = static_cast<float>(reference_);
        detail_.far = static_cast<float>(
            std::min(field.bump * scene_.height / (2 * scene_.view.tan_half_fov), 1e30));
        const glm::dvec3 middle = to_scene(scene_.view, frame_.forward);
        const glm::dvec3 start =
            field.to_tile * (scene_.view.eye + reference_ * middle - field.origin);
        const glm::dvec3 axes[3] = {field.to_tile * to_scene(scene_.view, frame_.right),
                                    field.to_tile * to_scene(scene_.view, frame_.up),
                                    field.to_tile * middle};
        for (int axis = 0; axis < 3; ++axis) {
            detail_.start[axis] = static_cast<float>(
                start[axis] - kDetailSide * std::floor(start[axis] / kDetailSide));
            detail_.right[axis] = static_cast<float>(axes[0][axis]);
            detail_.up[axis] = static_cast<float>(axes[1][axis]);
            detail_.middle[axis] = static_cast<float>(axes[2][axis]);
        }
    }

    void march() {
        const BlockParticles& p = room_.particles;
        std::vector<ActiveParticle>& active = room_.active;
        active.clear();
        std::size_t next = 0;
        double step = longest_, marched = 0;
        int chunks = 0;
        auto at = 0.0;  // whole steps from the reference
        while (std::any_of(room_.tiles, room_.tiles + kTiles,
                           [](const Tile& tile) { return tile.alive; })) {
            double from = at * step;
            std::erase_if(
                active, [&](const ActiveParticle& a) { return static_cast<double>(a.end) < from; });
            if (active.empty()) {
                if (next == p.s.size()) break;
                at = std::max(at, std::floor(static_cast<double>(p.near[next]) / step));
                from = at * step;
            }
            Fineness fineness = fineness_at(room_.fineness, reference_ + from + 0.5 * step);
            for (; step > fineness.step * stretch_; at *= 2) {
                step /= 2;
                fineness = fineness_at(room_.fineness, reference_ + from + 0.5 * step);
            }
            const double longest = fineness.step * stretch_;
            for (; next < p.s.size() && static_cast<double>(p.near[next]) < from + kChunk * step;
                 ++next) {
                ActiveParticle a;
                a.index = static_cast<std::uint32_t>(next);
                kernels_.measure(p, room_.middle, room_.spread, a);
                if (static_cast<double>(a.end) > from) active.push_back(a);
            }
            kernels_.ratio(p, static_cast<float>(step), active);
            // All blocks change the spacing at one distance, or the change would be seen between them.
            const double near = reference_ + from;
            const int spacing = choose_spacing(near + 0.5 * step, fineness.apart);
            const double until = std::min(farthest(spacing, fineness.apart), fineness.until);
            // Steps double at even places only: from an odd one, an odd number of them, or they stay short for ever.
            const double most = std::fmod(at, 2) == 0 ? kChunk : kChunk - 1;
            const int ahead =
                static_cast<int>(std::clamp(std::ceil((until - near) / step - 0.5), 1.0, most));
            if (++chunks % kManyChunks == 0) shortest_ = std::min(2 * shortest_, longest_);
            const Chunk chunk{static_cast<float>(from), static_cast<float>(step),
                              static_cast<float>(marched), ahead, step != marched};
            int count = ahead;
            bool fine = true;  // far finer than it need be
            const float allowed = scene_.step_depth;
            kernels_.deposit(p, active, chunk, room_.tiles);
            if (detail_.field != nullptr) kernels_.detail(detail_, chunk, room_.tiles);
            if (scene_.cut) cut_at_ground(chunk);
            for (const Tile& tile : room_.tiles) {
                if (!tile.alive) continue;
                if (step > shortest_)
                    count = std::min(count, kernels_.too_deep(tile, scene_.scaled, allowed));
                if (step < longest && fine)
                    fine = kernels_.too_deep(tile, scene_.scaled, allowed * 0.3f) == kChunk;
            }
            if (step > shortest_) count = std::min(count, first_too_shaded(from, step, count));
            if (count > 0) {
                const double ratio = marched / step;
                march_tiles(from, step, count, spacing, std::min((ratio * ratio - 1) / 24, 0.25));
                marched = step;
                at += count;
            }
            if (count < ahead) {
                step /= 2;
                at *= 2;
            } else if (step < longest && fine && std::fmod(at, 2) == 0) {
                step *= 2;
                at /= 2;
            }
        }
    }

    // First and last of the samples 0..count-1 in which any tile has matter; first > last: none.
    std::pair<int, int> samples_with_matter(int count) const {
        int first = kChunk, last = -1;
        for (const Tile& tile : room_.tiles) {
            if (!has_matter(tile, count)) continue;
            first = std::min(first, tile.first);
            last = std::max(last, std::min(tile.last, count - 1));
        }
        return {first, last};
    }

    // The first sample with matter over which the depth towards the sun changes by more than a step may cost: there the
    // beam is not what it is in the step's middle, however thin the step is towards the eye. kChunk: none. By the block's
    // middle ray.
    int first_too_shaded(double from, double step, int count) {
        const auto [first, last] = samples_with_matter(count);
        if (first > last) return kChunk;
        const auto h = static_cast<float>(step);
        LightAt at[kChunk + 2];
        const LightRay ray =
            ray_of(left_ + kBlockSide / 2.0, top_ + kBlockSide / 2.0, reference_ + from);
        light_along(scene_.light, ray, (static_cast<float>(first) - 0.5f) * h, h, last - first + 3,
                    at);
        const float allowed = kRise * scene_.step_depth / scene_.scaled;
        for (int k = first; k <= last; ++k) {
            const LightAt* const sample = at + (k - first);
            if (sample[1].depth * scene_.scaled > kDark) continue;  // no beam is left
            if (0.5f * std::abs(sample[2].depth - sample[0].depth) > allowed) return k;
        }
        return kChunk;
    }

    void march_tiles(double from, double step, int count, int spacing, double seam) {
        const auto [first, last] = samples_with_matter(count);
        if (first > last) return;
        const double base = reference_ + from;
        if (spacing >= 0) look_up_corners(base, step, count, first, last, spacing);
        for (int t = 0; t < kTiles; ++t) {
            Tile& tile = room_.tiles[t];
            if (!has_matter(tile, count)) continue;
            if (!tile.started) start(t);
            const int end = std::min(tile.last, count - 1);
            const bool albedo = !scene_.light.light->albedo.empty();
            if (spacing >= 0)
                kernels_.spread(room_.bilinear[spacing][t], room_.corners, tile.first, end, albedo,
                                scene_.air != nullptr, room_.light);
            else
                look_up_pixels(t, base, step, tile.first, end);
            (scene_.air != nullptr ? kernels_.march_haze : kernels_.march)(
                shade(t, seam), room_.light, count, tile);
        }
    }

    static bool has_matter(const Tile& tile, int count) {
        return tile.alive && tile.first <= std::min(tile.last, count - 1);
    }

    // Widest spacing of looked up rays that are at most `apart` from each other at this distance; -1: every pixel.
    int choose_spacing(double distance, double apart) const {
        for (int s = 0; s < static_cast<int>(std::size(kSpacings)); ++s)
            if (distance <= farthest(s, apart)) return s;
        return -1;
    }
    // Up to where a spacing will do.
    double farthest(int spacing, double most) const {
        if (spacing < 0) return 1e300;
        // At the middle of the picture: the widest.
        const double apart = kSpacings[spacing] * 2 * scene_.view.tan_half_fov / scene_.height;
        if (!(apart <= 0.2)) return 0;
        if (scene_.air != nullptr)
            return std::min(most / apart, farthest_for_air(*scene_.air, apart));
        return most / apart;
    }

    LightRay ray_of(double x, double y, double base) const {
        const glm::dvec3 d = pixel_direction(scene_, x, y);
        return light_ray(scene_.light, scene_.view.eye + base * d, d);
    }

    void look_up_corners(double base, double step, int count, int first, int last, int spacing) {
        bool needed[kMostCorners] = {};
        for (int t = 0; t < kTiles; ++t)
            if (has_matter(room_.tiles[t], count))
                for (const int c : room_.bilinear[spacing][t].corner) needed[c] = true;
        const int apart = kSpacings[spacing], side = kBlockSide / apart + 1;
        const auto h = static_cast<float>(step);
        for (int c = 0; c < side * side; ++c) {
            if (!needed[c]) continue;
            const LightRay ray = ray_of(left_ + c % side * apart, top_ + c / side * apart, base);
            light_along(scene_.light, ray, (static_cast<float>(first) - 0.5f) * h, h,
                        last - first + 3, room_.corners[c] + first);
            if (scene_.air != nullptr)
                air_along(*scene_.air, left_ + c % side * apart, top_ + c / side * apart,
                          base + (first + 0.5) * step, step, last - first + 1,
                          room_.corners[c] + first + 1);
        }
    }

    void look_up_pixels(int t, double base, double step, int first, int last) {
        const auto h = static_cast<float>(step);
        LightAt at[kChunk + 2];
        for (int lane = 0; lane < kLanes; ++lane) {
            const LightRay ray = ray_of(left_ + t % 4 * kTileSide + lane % 4 + 0.5,
                                        top_ + t / 4 * kTileSide + lane / 4 + 0.5, base);
            light_along(scene_.light, ray, (static_cast<float>(first) - 0.5f) * h, h,
                        last - first + 3, at);
            if (scene_.air != nullptr)
                air_along(*scene_.air, left_ + t % 4 * kTileSide + lane % 4 + 0.5,
                          top_ + t / 4 * kTileSide + lane / 4 + 0.5, base + (first + 0.5) * step,
                          step, last - first + 1, at + 1);
            TileLight& light = room_.light;
            for (int k = first; k <= last + 2; ++k) {
                light.depth[k][lane] = at[k - first].depth;
                light.air[k][lane] = at[k - first].air;
                light.lost[k][lane] = at[k - first].lost;
                for (int c = 0; c < 3; ++c) {
                    light.source[c][k][lane] = at[k - first].source[c];
                    light.albedo[c][k][lane] = at[k - first].albedo[c];
                }
            }
        }
    }

    void start(int t) {
        Tile& tile = room_.tiles[t];
        tile.started = true;
        const auto columns = static_cast<std::size_t>(scene_.table.columns);
        room_.rows.resize(kTiles * columns);
        kernels_.phases(scene_, sun_, tile, rows_at(t));
    }

    Floats* rows_at(int t) const {
        if (room_.rows.empty()) return nullptr;
        return &room_.rows[static_cast<std::size_t>(t * scene_.table.columns)].value;
    }

    Shade shade(int t, double seam) const {
        const TransportLight& light = *scene_.light.light;
        const float albedo = light.albedo.empty() ? static_cast<float>(scene_.medium.albedo) : 1.0f;
        Shade shade{};
        shade.scaled = scene_.scaled;
        shade.seam = static_cast<float>(seam);
        shade.grid = light.cell > 0 && !light.bands.empty();
        shade.peak = scene_.table.columns > 0;
        shade.albedo = !light.albedo.empty();
        for (int c = 0; c < 3; ++c) shade.beam[c] = albedo * scene_.sun[c];
        shade.last = scene_.table.last;
        shade.rows = rows_at(t);
        return shade;
    }

    const MarchScene& scene_;
    BlockRoom& room_;
    const MarchKernels& kernels_;
    int left_, top_;  // pixels
    BlockFrame frame_{};
    SunInBlock sun_{};
    DetailRays detail_;
    double reference_ = 0, longest_ = 1, shortest_ = 1;
    double stretch_ = 1;  // of all steps, where a ray is long
};

}  // namespace

void march_block(const MarchScene& scene, int block_x, int block_y,
                 const std::vector<std::uint32_t>& items, BlockRoom& room, Image& image) {
    BlockMarch block(scene, block_x, block_y, room);
    block.run(items);
    block.draw(image);
}

}  // namespace awan
