#include "core/generate/automaton/skies.h"

#include <cmath>

#include "core/generate/automaton/run.h"

namespace awan::automaton {

CellDensity Skies::density() const {
    CellDensity density;
    density.share_of_next = share_of_next;
    for (const auto& field : now) density.now.push_back(&field);
    for (const auto& field : next) density.next.push_back(&field);
    return density;
}

Result<Skies> skies_at(const AutomatonCloud& cloud, std::uint64_t key, double steps, int threads,
                       const Deadline& deadline) {
    const double whole = std::floor(steps);
    AutomatonScratch scratch;
    auto state =
        run_automaton(cloud, key, static_cast<std::uint64_t>(whole), threads, deadline, scratch);
    if (!state.ok()) return state.error();
    // Before step 0 the sky was clear: empty fields are put in for the steps that were not made, as many as are
    // smoothed over.
    const AutomatonGrid grid(cloud.cells);
    const auto take = [&](std::vector<std::vector<std::uint64_t>>& to) {
        to.push_back(state->cld);
        to.insert(to.end(), state->earlier.begin(), state->earlier.end());
        while (to.size() < cloud.smooth_steps) to.emplace_back(grid.all_words(), 0);
    };
    Skies skies;
    skies.share_of_next = steps - whole;
    take(skies.now);
    if (skies.share_of_next > 0) {
        if (Status late = step_automaton(cloud, threads, deadline, scratch, *state)) return *late;
        take(skies.next);
    }
    return skies;
}

}  // namespace awan::automaton
