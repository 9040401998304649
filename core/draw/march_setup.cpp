#include "core/draw/march_setup.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "core/base/parallel.h"
#include "core/draw/hills_backdrop.h"
#include "core/generate/detail.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// Scaled optical depth of a step that costs 1% (march_test).
constexpr double kStepDepth = 0.5;
// The longest step in matter with detail, in bumps of it: samples see the smaller ones.
constexpr double kDetailStep = 0.2;

// Rooms for blocks: as many as threads ask for at a time.
class Rooms {
  public:
    BlockRoomPtr take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return make_block_room();
        BlockRoomPtr room = std::move(free_.back());
        free_.pop_back();
        return room;
    }
    void give(BlockRoomPtr room) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(room));
    }

  private:
    std::mutex mutex_;
    std::vector<BlockRoomPtr> free_;
};

// Sets the lengths of steps and the gaps between looked up rays. `longer`: factor of the usual lengths.
void find_fineness(const TransportLight& light, const std::vector<SeenParticle>& seen,
                   double longer, MarchScene& march) {
    double sum = 0;
    float least = seen.front().s;
    for (const SeenParticle& one : seen) {
        sum += static_cast<double>(one.s);
        least = std::min(least, one.s);
    }
    const double mean = sum / static_cast<double>(seen.size());
    const double most = march.detail != nullptr ? kDetailStep * march.detail->bump : INFINITY;
    const auto step_in = [&](const TransportLight& own, double mean_s, double least_s) {
        return std::min(longest_step(own, mean_s, least_s), most) * longer;
    };
    march.apart = most_apart(light);
    march.step = step_in(light, mean, static_cast<double>(least));
    // All steps are the longest one, halved some number of times, so that blocks sample at the same distances.
    for (const LightIsland& island : light.islands)
        if (island.lit)
            march.step = std::max(march.step, step_in(island.light, island.mean_s, island.mean_s));
    for (const LightIsland& island : light.islands) {
        if (!island.lit) continue;
        const double own = step_in(island.light, island.mean_s, island.mean_s);
        double step = march.step;
        while (step > own * 1.0001) step /= 2;
        const glm::dvec3 middle = 0.5 * (island.low + island.high);
        const glm::dvec3 apart = middle - march.view.eye;
        march.islands.push_back({{glm::dot(apart, march.view.right), glm::dot(apart, march.view.up),
                                  glm::dot(apart, march.view.forward)},
                                 glm::length(island.high - middle),
                                 most_apart(island.light),
                                 step});
    }
}

// The least and the most of the chords between the sun's direction and those of the picture's rays.
struct ChordRange {
    double least = 2, most = 0;
};

// From the rays of a grid over the picture. Between two neighbours a chord differs from theirs by less than the rays
// do.
ChordRange chords_of(const MarchScene& scene) {
    ChordRange range;
    const auto across = static_cast<double>(scene.width), down = static_cast<double>(scene.height);
    constexpr int kGrid = 16;
    const auto direction = [&](int i, int j) {
        return pixel_direction(scene, across * i / kGrid, down * j / kGrid);
    };
    double gap = 0;
    for (int j = 0; j <= kGrid; ++j)
        for (int i = 0; i <= kGrid; ++i) {
            const glm::dvec3 d = direction(i, j);
            const double chord = glm::length(d - scene.to_sun);
            range.least = std::min(range.least, chord);
            range.most = std::max(range.most, chord);
            if (i > 0) gap = std::max(gap, glm::length(d - direction(i - 1, j)));
            if (j > 0) gap = std::max(gap, glm::length(d - direction(i, j - 1)));
        }
    range.least = std::max(0.0, range.least - gap);
    range.most = std::min(2.0, range.most + gap);
    return range;
}

// The sky behind the cloud, as its gradient.
SkyBehind gradient_behind(const Scene& scene) {
    SkyBehind sky;
    const SkyDome dome = outside_of(scene).sky;
    if (dome.shines && !dome.physical) {
        for (int c = 0; c < 3; ++c) {
            sky.zenith[c] = static_cast<float>(dome.zenith[c]);
            sky.horizon[c] = static_cast<float>(dome.horizon[c]);
        }
    }
    sky.behind = scene->image.background == Background::kSky;
    return sky;
}

// The haze with the clouds' shadows in it, as the settings ask.
std::optional<Air> air_of(const Scene& scene, const View& view, const TransportLight& light,
                          const MarchSettings& settings, int threads, EffectTimes& took) {
    if (!settings.eye_effects.aerial_perspective) return std::nullopt;
    auto start = Deadline::Clock::now();
    std::optional<Air> air = make_air(scene, view);
    took.of(Effect::kAerialPerspective) = ms_since(start);
    if (!air || !settings.eye_effects.light_shafts) return air;
    start = Deadline::Clock::now();
    // Hills shade the clouds, not the haze.
    shade_air(light.ground.clouds ? *light.ground.clouds : light.sun, threads, *air);
    took.of(Effect::kLightShafts) = ms_since(start);
    return air;
}

}  // namespace

MarchScene march_scene(const Scene& scene, const View& view, const TransportLight& light,
                       const ParticleSet& particles, const std::vector<SeenParticle>& seen,
                       double step_error, int threads, std::span<const std::uint8_t> islands,
                       int width, int height) {
    MarchScene march;
    march.view = view;
    march.width = width > 0 ? width : scene->image.width;
    march.height = height > 0 ? height : scene->image.height;
    march.seen = &seen;
    march.light.light = &light;
    if (!seen.empty()) march.light = source_towards(light, view.eye, threads, islands);
    march.medium = scene->medium;
    if (light.has_grid()) march.peak = {light.peak_from, light.peak_share};
    const Outside outside = outside_of(scene);
    march.to_sun = outside.to_sun;
    march.sun = glm::vec3(outside.sun);
    march.scaled = static_cast<float>(1 - scene->medium.albedo * march.peak.share);
    if (march.peak.share > 0)
        march.most_peak =
            static_cast<float>(std::max(depth_of_most(march.medium, march.peak), 1e-3));
    march.rest = rest_of(march.medium, march.peak);
    march.detail = particles.detail.get();
    march.cut = matter_below_ground(scene, view, particles);
    // The error of steps goes with the square of their length.
    const double finer = std::sqrt(std::clamp(step_error, 1e-5, 0.1) / 0.01);
    march.step_depth = static_cast<float>(kStepDepth * finer);
    if (seen.empty()) return march;
    find_fineness(light, seen, std::min(finer, 1.5), march);
    const ChordRange chords = chords_of(march);
    march.table = peak_table(march.medium, march.peak, chords.least, chords.most);
    return march;
}

MarchFinenesses fineness_of(const View& view, const TransportLight& light,
                            const ParticleSet& particles, const std::vector<SeenParticle>& seen) {
    if (seen.empty()) return {};
    MarchScene march;
    march.view = view;
    march.detail = particles.detail.get();
    find_fineness(light, seen, 1, march);
    MarchFinenesses found{{march.step, march.apart}};
    for (const SeenIsland& island : march.islands) found.push_back({island.step, island.apart});
    return found;
}

void set_fineness(const MarchFinenesses& given, MarchScene& march) {
    march.step = given.front().step;
    march.apart = given.front().apart;
    for (std::size_t i = 0; i < march.islands.size() && i + 1 < given.size(); ++i) {
        march.islands[i].step = given[i + 1].step;
        march.islands[i].apart = given[i + 1].apart;
    }
}

void set_behind(const Scene& scene, const TransportLight& light, const MarchSettings& settings,
                int width, int height, int threads, EffectTimes& took, MarchBehind& around,
                MarchScene& march) {
    const View& view = march.view;
    const bool behind = scene->image.background == Background::kSky;
    const bool has_peak = march.peak.share != 0;
    march.sky = gradient_behind(scene);
    around.air = air_of(scene, view, light, settings, threads, took);
    if (around.air) march.air = &*around.air;
    const GroundLight& ground = light.ground;
    // How hills are lit matters where they are seen.
    if (ground.relief && (behind || has_peak) && wants_backdrop(scene, view)) {
        const auto start = Deadline::Clock::now();
        around.hills = relief_light(scene, ground, threads);
        took.of(Effect::kTerrain) += ms_since(start);
    }
    // Where haze ends at hills, their distance matters, too.
    const bool ends_haze = ground.relief && march.air != nullptr;
    if ((behind || march.cut || ends_haze) && wants_backdrop(scene, view)) {
        const auto start = Deadline::Clock::now();
        const ReliefLight* const lit = around.hills ? &*around.hills : nullptr;
        around.backdrop =
            ground.relief ? hills_backdrop(scene, view, width, height, ground,
                                           behind ? lit : nullptr, march.air, threads, march.wanted)
                          : make_backdrop(scene, view, width, height, ground, threads, nullptr,
                                          nullptr, march.wanted);
        march.sky.backdrop = &around.backdrop;
        if (ground.relief) took.of(Effect::kTerrain) += ms_since(start);
    }
    march.sky.peak = has_peak && ((light.sky && outside_of(scene).sky.shines) ||
                                  (light.ground.into_cloud && wants_backdrop(scene, view)));
    if (!march.sky.peak) return;
    march.sky.through_peak = settings.through_peak;
    if (march.sky.through_peak != nullptr) return;
    around.through_peak =
        behind_through_peak(scene, view, width, height, ground, march.peak, light.sky,
                            ground.into_cloud, threads, around.hills ? &*around.hills : nullptr);
    march.sky.through_peak = &around.through_peak;
}

bool march_blocks(const MarchScene& scene, int threads, const Deadline& deadline, Image& image,
                  std::span<MarchedAlong> along, const BlockChoice& only) {
    Rooms rooms;
    std::atomic<bool> late = false;
    for_each_block(
        *scene.seen, image.width, image.height, threads,
        [&](int x, int y, const std::vector<std::uint32_t>& items) {
            if (late || deadline.over()) {
                late = true;
                return;
            }
            if (only && !only(x, y, !items.empty())) return;
            BlockRoomPtr room = rooms.take();
            march_block(scene, x, y, items, *room, image, along);
            rooms.give(std::move(room));
        },
        scene.wanted);
    return !late;
}

}  // namespace awan
