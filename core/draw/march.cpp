#include "core/draw/march.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "core/base/parallel.h"
#include "core/draw/march_block.h"
#include "core/generate/detail.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

constexpr double kStepDepth = 0.5;  // scaled optical depth of a step that costs 1% (march_test)

constexpr double kDetailStep = 0.2;  // longest step, in bumps of detail

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

// Lengths of steps and distances of looked up rays; `longer`: of what is usual.
void set_fineness(const TransportLight& light, const std::vector<SeenParticle>& seen, double longer,
                  MarchScene& march) {
    double sum = 0;
    float least = seen.front().s;
    for (const SeenParticle& one : seen) {
        sum += static_cast<double>(one.s);
        least = std::min(least, one.s);
    }
    const double mean = sum / static_cast<double>(seen.size());
    // Samples that see the smaller bumps.
    const double most = march.detail != nullptr ? kDetailStep * march.detail->bump : INFINITY;
    const auto step_in = [&](const TransportLight& own, double mean_s, double least_s) {
        return std::min(longest_step(own, mean_s, least_s), most) * longer;
    };
    march.apart = most_apart(light);
    march.step = step_in(light, mean, static_cast<double>(least));
    // Steps are halves of each other, so that blocks sample at the same distances.
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

// Chords between the sun's direction and those of the picture: least and most, over its blocks' corners, less what lies between.
void chords_of(const MarchScene& scene, double& least, double& most) {
    least = 2;
    most = 0;
    const auto across = static_cast<double>(scene.width), down = static_cast<double>(scene.height);
    constexpr int kGrid = 16;
    double gap = 0;
    for (int j = 0; j <= kGrid; ++j)
        for (int i = 0; i <= kGrid; ++i) {
            const glm::dvec3 d = pixel_direction(scene, across * i / kGrid, down * j / kGrid);
            const double chord = glm::length(d - scene.to_sun);
            least = std::min(least, chord);
            most = std::max(most, chord);
            if (i > 0)
                gap = std::max(gap, glm::length(d - pixel_direction(scene, across * (i - 1) / kGrid,
                                                                    down * j / kGrid)));
            if (j > 0)
                gap = std::max(gap, glm::length(d - pixel_direction(scene, across * i / kGrid,
                                                                    down * (j - 1) / kGrid)));
        }
    least = std::max(0.0, least - gap);
    most = std::min(2.0, most + gap);
}

}  // namespace

Result<Image> march(const Scene& scene, const ParticleSet& particles, const View& view,
                    const TransportLight& light, const MarchSettings& settings, int threads,
                    const Deadline& deadline, EffectTimes* times) {
    EffectTimes took;
    if (auto error = deadline.over()) return *error;
    const bool behind = scene->image.background == Background::kSky;
    Image image{scene->image.width, scene->image.height, behind, {}};
    image.pixels.resize(4 * image.pixel_count());
    const std::vector<SeenParticle> seen =
        see_particles(particles, view, image.width, image.height, threads);

    MarchScene march;
    march.view = view;
    march.width = image.width;
    march.height = image.height;
    march.seen = &seen;
    march.light = source_towards(light, view.eye, threads);
    march.medium = scene->medium;
    if (light.cell > 0) march.peak = {light.peak_from, light.peak_share};
    const Outside outside = outside_of(scene);
    march.to_sun = outside.to_sun;
    march.sun = glm::vec3(outside.sun);
    march.scaled = static_cast<float>(1 - scene->medium.albedo * march.peak.share);
    march.rest = rest_of(march.medium, march.peak);
    // Steps cost about the square of their length.
    const double finer = std::sqrt(std::clamp(settings.step_error, 1e-5, 0.1) / 0.01);
    march.detail = particles.detail.get();
    if (!seen.empty()) set_fineness(light, seen, std::min(finer, 1.5), march);
    march.step_depth = static_cast<float>(kStepDepth * finer);
    double least = 0, most = 2;
    chords_of(march, least, most);
    if (!seen.empty()) march.table = peak_table(march.medium, march.peak, least, most);

    SkyBehind& sky = march.sky;
    if (outside.sky.shines && !outside.sky.physical) {
        for (int c = 0; c < 3; ++c) {
            sky.zenith[c] = static_cast<float>(outside.sky.zenith[c]);
            sky.horizon[c] = static_cast<float>(outside.sky.horizon[c]);
        }
        sky.peak = light.sky && march.peak.share != 0;
    }
    sky.behind = behind;
    march.cut = matter_below_ground(scene, view, particles);
    Backdrop backdrop;
    if ((behind || march.peak.share != 0 || march.cut) && wants_backdrop(scene, view)) {
        backdrop = make_backdrop(scene, view, image.width, image.height, light.ground, threads);
        sky.backdrop = &backdrop;
        sky.peak = march.peak.share != 0;
        sky.sky_peak = light.sky;
        sky.ground_peak = light.ground.into_cloud;
    }

    std::optional<Air> air;
    if (settings.eye_effects.aerial_perspective) {
        auto start = Deadline::Clock::now();
        air = make_air(scene, view);
        took.of(Effect::kAerialPerspective) = ms_since(start);
        start = Deadline::Clock::now();
        if (air && settings.eye_effects.light_shafts) {
            shade_air(light.sun, threads, *air);
            took.of(Effect::kLightShafts) = ms_since(start);
        }
    }
    if (air) march.air = &*air;

    Rooms rooms;
    std::atomic<bool> late = false;
    for_each_block(seen, image.width, image.height, threads,
                   [&](int x, int y, const std::vector<std::uint32_t>& items) {
                       if (late || deadline.over()) {
                           late = true;
                           return;
                       }
                       BlockRoomPtr room = rooms.take();
                       march_block(march, x, y, items, *room, image);
                       rooms.give(std::move(room));
                   });
    if (late)
        if (auto error = deadline.over()) return *error;
    if (times != nullptr) times->add(took);
    return image;
}

}  // namespace awan
