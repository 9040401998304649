#include "core/light/islands.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <mutex>
#include <numeric>
#include <optional>

#include "core/base/parallel.h"
#include "core/generate/gaussian.h"
#include "core/light/island_sun.h"
#include "core/light/relief_light.h"
#include "core/light/sun_depth.h"
#include "core/light/surroundings.h"
#include "core/light/transport_part.h"
#include "core/plan/island_settings.h"

namespace awan {
namespace {

// How far a particle's matter reaches, in standard deviations.
constexpr double kReach = 4;

void add_particle(const ParticleSet& from, std::size_t i, ParticleSet& to) {
    to.center.push_back(from.center[i]);
    to.radius.push_back(from.radius[i]);
    to.density.push_back(from.density[i]);
    if (!from.color.empty()) to.color.push_back(from.color[i]);
}

std::vector<ParticleSet> sorted_into(const ParticleSet& particles, const Islands& islands) {
    std::vector<ParticleSet> sets(islands.list.size());
    for (ParticleSet& set : sets) set.detail = particles.detail;
    for (std::size_t i = 0; i < particles.size(); ++i)
        add_particle(particles, i,
                     sets[static_cast<std::size_t>(island_at(islands, particles.center[i]))]);
    return sets;
}

bool touches(const Island& box, const glm::dvec3& low, const glm::dvec3& high) {
    return glm::all(glm::lessThan(low, box.high)) && glm::all(glm::lessThan(box.low, high));
}

// An island's particles and those of others that shade it or reach into its box.
ParticleSet with_others(const std::vector<ParticleSet>& sets, const std::vector<Island>& boxes,
                        std::size_t self, const Lattice& prism) {
    ParticleSet all = sets[self];
    const Island& own = boxes[self];
    for (std::size_t j = 0; j < sets.size(); ++j) {
        if (j == self || sets[j].size() == 0) continue;
        const glm::dvec3 center = 0.5 * (boxes[j].low + boxes[j].high);
        if (!shades(prism, center, glm::length(boxes[j].high - center)) &&
            !touches(own, boxes[j].low, boxes[j].high))
            continue;
        for (std::size_t i = 0; i < sets[j].size(); ++i) {
            const double reach = kReach * gaussian_s(sets[j], i);
            const glm::dvec3 at = sets[j].center[i];
            if (shades(prism, at, reach) || touches(own, at - reach, at + reach))
                add_particle(sets[j], i, all);
        }
    }
    return all;
}

double mass_of(const ParticleSet& particles) {
    double mass = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) mass += gaussian_mass(particles, i);
    return mass;
}

// What the solves of all islands share.
struct IslandScene {
    const Scene& scene;
    const Islands& islands;
    const TransportSettings& settings;  // of an island, but for its cells
    const TransportLight& whole;        // the whole scene on a coarse grid
    std::vector<ParticleSet> sets{};    // each island's particles
    std::vector<Neighbour> neighbours{};
};

IslandScene island_scene(const Scene& scene, const ParticleSet& particles, const Islands& islands,
                         const TransportSettings& settings, const TransportLight& whole) {
    IslandScene all{scene, islands, settings, whole};
    all.sets = sorted_into(particles, islands);
    all.neighbours.resize(all.sets.size());
    for (std::size_t i = 0; i < all.sets.size(); ++i)
        if (all.sets[i].size() > 0) all.neighbours[i] = neighbour_of(all.sets[i]);
    return all;
}

// The same island in the scene's coarser light; null: there is none.
const LightIsland* coarser_island(const SharedLight& coarser, std::size_t island) {
    if (!coarser || island >= coarser->islands.size() || !coarser->islands[island].lit)
        return nullptr;
    return &coarser->islands[island];
}

// Whether light that was solved with `before` is as fine as `now` asks for.
bool as_fine(const IslandCells& before, const IslandCells& now) {
    return before.cells == now.cells && before.sun_cells == now.sun_cells;
}

// Light for which a finer grid of the scene asks for nothing finer: it stays. light: of a part of `coarser`, or of the
// whole of it.
TransportLight as_before(TransportLight light, const SharedLight& coarser, bool last) {
    light.coarser = coarser;
    light.sweeps = 0;
    light.took = {};
    if (last) light.solved = {};
    return light;
}

// One island's light; not lit where it has no matter or is not seen.
Result<LightIsland> light_of_island(const IslandScene& all, std::size_t self,
                                    const IslandCells& cells, const SharedLight& coarser,
                                    int threads, const Deadline& deadline) {
    const Island& box = all.islands.list[self];
    const ParticleSet& own = all.sets[self];
    LightIsland island;
    island.low = box.low;
    island.high = box.high;
    if (cells.sun_cells == 0 || !(mass_of(own) > 0)) return island;
    const LightIsland* const before = coarser_island(coarser, self);
    // It lives as long as the light that it is a part of.
    const SharedLight before_light = before ? SharedLight{coarser, &before->light} : nullptr;
    if (before && as_fine(before->light.asked, cells)) {
        LightIsland same = *before;
        same.light = as_before(std::move(same.light), before_light, all.settings.last);
        return same;
    }
    island.mean_s = box.s_sums[1] / box.s_sums[0];
    const Lattice prism = sun_lattice(own, sun_direction(all.scene->sun), cells.sun_cells, 1);
    const ParticleSet with = with_others(all.sets, all.islands.list, self, prism);
    TransportSettings settings = all.settings;
    settings.cells = cells.cells;
    EffectTimes took;
    SunDepth sun =
        before && before->light.asked.sun_cells == cells.sun_cells
            ? before->light.sun
            : timed_for(took, Effect::kSelfShadow, [&] { return sun_depth_in(prism, with); });
    if (const auto relief = relief_of(*all.scene, 1);
        relief && !(before && before->light.asked.sun_cells == cells.sun_cells))
        shade_by_hills(*relief, 1, sun);
    LightPart part{own, with, std::move(sun), box.depth};
    part.surroundings = surroundings_of(all.scene, all.neighbours, self, all.whole);
    part.whole = &all.whole;
    auto solved =
        light_of_part(all.scene, std::move(part), settings, before_light, threads, deadline);
    if (!solved.ok()) return solved.error();
    island.light = *std::move(solved);
    island.light.took.add(took);
    island.light.asked = cells;
    island.lit = true;
    return island;
}

// Adds to the whole's figures what its islands took, each effect's time times `share`.
void add_figures(TransportLight& light, double share) {
    for (const LightIsland& island : light.islands) {
        light.took.add(island.light.took, share);
        light.sweeps += island.light.sweeps;
        light.residual = std::max(light.residual, island.light.residual);
    }
}

// Indices of the islands, those with the most cells first, so that no thread is left alone with a large one at the end.
std::vector<std::size_t> largest_first(const std::vector<IslandCells>& islands) {
    std::vector<std::size_t> order(islands.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return islands[a].cells > islands[b].cells;
    });
    return order;
}

// The whole scene, on a grid that is the same on the way to all others.
Result<TransportLight> light_about_islands(const Scene& scene, const ParticleSet& particles,
                                           const Survey& survey, const TransportSettings& settings,
                                           const SharedLight& coarser, int threads,
                                           const Deadline& deadline) {
    if (coarser && as_fine(coarser->asked, {settings.cells, settings.sun_cells}))
        return as_before(coarser->of_whole(), coarser, settings.last);
    return light_of_whole(scene, particles, survey, settings, coarser, threads, deadline);
}

}  // namespace

Result<TransportLight> light_in_islands(const Scene& scene, const ParticleSet& particles,
                                        const Survey& survey, const TransportSettings& settings,
                                        const SharedLight& coarser, int threads,
                                        const Deadline& deadline) {
    const TransportSettings coarse = whole_settings(settings);
    auto whole = light_about_islands(scene, particles, survey, coarse, coarser, threads, deadline);
    if (!whole.ok()) return whole;
    TransportLight& light = *whole;
    light.regions = survey.islands;

    const IslandScene all = island_scene(scene, particles, survey.islands, coarse, light);
    const std::vector<std::size_t> order = largest_first(settings.islands);
    std::vector<LightIsland> islands(order.size());
    // Of few islands, one after the other on all threads.
    const bool side_by_side = order.size() >= 2 * static_cast<std::size_t>(threads);
    const auto start = Deadline::Clock::now();
    std::vector<double> own_ms(order.size());
    std::mutex mutex;
    std::optional<Error> failed;
    parallel_for(side_by_side ? threads : 1, order.size(), [&](std::size_t turn) {
        const std::size_t i = order[turn];
        const auto own_start = Deadline::Clock::now();
        auto island = light_of_island(all, i, settings.islands[i], coarser,
                                      side_by_side ? 1 : threads, deadline);
        if (!island.ok()) {
            const std::lock_guard lock(mutex);
            failed = island.error();
            return;
        }
        islands[i] = *std::move(island);
        if (islands[i].lit) own_ms[i] = ms_since(own_start);
    });
    if (failed) return *failed;
    light.islands = std::move(islands);
    // Each island's time was measured on its own thread; side by side they took less of the clock than their sum.
    const double all_ms = std::accumulate(own_ms.begin(), own_ms.end(), 0.0);
    add_figures(light, all_ms > 0 ? std::min(1.0, ms_since(start) / all_ms) : 0);
    return whole;
}

}  // namespace awan
