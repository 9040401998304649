#include "core/draw/march.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "core/draw/march_block.h"
#include "core/generate/detail.h"
#include "core/parallel.h"
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

// Least of the longest steps, in cells of the light. Matter that is smaller than a step is uneven within it: whole cells
// took three times the error and were seen as edges between blocks that step differently, at no gain in time.
constexpr double kLeastStepCells = 0.7;

// Longest step where nothing is deep: about a cell of the light, or a few to the smallest lattice of the sun's depth.
double longest_step(const TransportLight& light, const std::vector<SeenParticle>& seen) {
    if (light.cell > 0) {
        double sum = 0;
        for (const SeenParticle& one : seen) sum += static_cast<double>(one.s);
        const double mean = sum / static_cast<double>(seen.size());
        return std::clamp(mean, kLeastStepCells * light.cell, light.cell);
    }
    const glm::ivec3 n = light.sun.nodes;
    if (light.sun.cell > 0 && !light.sun.depth.empty())
        return light.sun.cell * std::max({n.x, n.y, n.z, 1}) / 32;
    float least = seen.front().s;
    for (const SeenParticle& one : seen) least = std::min(least, one.s);
    return static_cast<double>(least);
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
                    const Deadline& deadline) {
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
    march.step = seen.empty() ? 1 : longest_step(light, seen) * std::min(finer, 1.5);
    // Samples that see the smaller bumps.
    march.detail = particles.detail.get();
    if (march.detail != nullptr)
        march.step = std::min(march.step, kDetailStep * march.detail->bump * std::min(finer, 1.5));
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

    std::optional<Air> air;
    if (settings.aerial_perspective)
        air = make_air(scene, view, settings.light_shafts ? &light.sun : nullptr, threads);
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
    return image;
}

}  // namespace awan
