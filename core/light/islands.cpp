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
#include "core/light/sun_depth.h"
#include "core/light/surroundings.h"
#include "core/light/transport_part.h"
#include "core/plan/island_settings.h"

namespace awan {
namespace {

constexpr double kReach = 4;  // in s

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

}  // namespace

Result<TransportLight> light_in_islands(const Scene& scene, const ParticleSet& particles,
                                        const Survey& survey, const TransportSettings& settings,
                                        int threads, const Deadline& deadline) {
    const glm::dvec3 towards_sun = sun_direction(scene->sun);
    const TransportSettings coarse = whole_settings(settings);
    const double deepest = std::max(survey.optical_depth_sun, survey.optical_depth_zenith);
    EffectTimes took;
    SunDepth sun = timed_for(took, Effect::kSelfShadow, [&] {
        return sun_depth(particles, towards_sun, coarse.sun_cells, threads);
    });
    auto whole = light_of_part(scene, {particles, particles, std::move(sun), deepest, {}, nullptr},
                               coarse, threads, deadline);
    if (!whole.ok()) return whole.error();
    TransportLight& light = *whole;
    light.took.add(took);
    light.regions = survey.islands;
    light.islands.resize(settings.islands.size());

    const std::vector<ParticleSet> sets = sorted_into(particles, survey.islands);
    std::vector<Neighbour> neighbours(sets.size());
    for (std::size_t i = 0; i < sets.size(); ++i)
        if (sets[i].size() > 0) neighbours[i] = neighbour_of(sets[i]);

    // The largest first, so that no thread is left alone with it.
    std::vector<std::size_t> order(sets.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return settings.islands[a].cells > settings.islands[b].cells;
    });
    const auto start = Deadline::Clock::now();
    std::vector<double> own_ms(sets.size());  // of the thread that had it
    std::mutex mutex;
    std::optional<Error> failed;
    const int inner = sets.size() < 2 * static_cast<std::size_t>(threads) ? threads : 1;
    parallel_for(inner > 1 ? 1 : threads, order.size(), [&](std::size_t turn) {
        const std::size_t i = order[turn];
        const IslandCells& cells = settings.islands[i];
        LightIsland& island = light.islands[i];
        const auto own_start = Deadline::Clock::now();
        const Island& box = survey.islands.list[i];
        island.low = box.low;
        island.high = box.high;
        if (cells.sun_cells == 0 || !(mass_of(sets[i]) > 0)) return;
        island.mean_s = box.s_sums[1] / box.s_sums[0];
        const Lattice prism = sun_lattice(sets[i], towards_sun, cells.sun_cells, 1);
        const ParticleSet all = with_others(sets, survey.islands.list, i, prism);
        TransportSettings own = coarse;
        own.cells = cells.cells;
        EffectTimes own_took;
        SunDepth own_sun =
            timed_for(own_took, Effect::kSelfShadow, [&] { return sun_depth_in(prism, all); });
        auto solved = light_of_part(scene,
                                    {sets[i], all, std::move(own_sun), box.depth,
                                     surroundings_of(scene, neighbours, i, light), &light},
                                    own, inner, deadline);
        if (!solved.ok()) {
            const std::lock_guard lock(mutex);
            failed = solved.error();
            return;
        }
        island.light = *std::move(solved);
        island.light.took.add(own_took);
        island.lit = true;
        own_ms[i] = ms_since(own_start);
    });
    if (failed) return *failed;
    // Side by side they took less than one after the other.
    const double all_ms = std::accumulate(own_ms.begin(), own_ms.end(), 0.0);
    const double share = all_ms > 0 ? std::min(1.0, ms_since(start) / all_ms) : 0;
    for (const LightIsland& island : light.islands) light.took.add(island.light.took, share);
    for (const LightIsland& island : light.islands) {
        light.sweeps += island.light.sweeps;
        light.residual = std::max(light.residual, island.light.residual);
    }
    return whole;
}

}  // namespace awan
