// The cloud of an automaton at a time: steps, then smoothing, then Gaussians.
#include "core/scene/automaton.h"

#include <algorithm>
#include <cmath>

#include "core/generate/automaton/cells_to_particles.h"
#include "core/generate/automaton/coarse.h"
#include "core/generate/automaton/kept_states.h"
#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/run.h"
#include "core/generate/automaton/skies.h"
#include "core/generate/models.h"

namespace awan::automaton {

namespace {

// From where to go on; null: from step 0.
std::shared_ptr<const AutomatonState> latest_start(const AutomatonCloud& cloud, std::uint64_t key,
                                                   std::uint64_t step) {
    std::shared_ptr<const AutomatonState> latest;
    const auto offer = [&](const std::shared_ptr<const AutomatonState>& one) {
        if (one && one->step <= step && (!latest || one->step > latest->step)) latest = one;
    };
    for (const auto& start : cloud.starts) offer(start);
    if (cloud.kept) offer(cloud.kept->latest(rules_key(cloud), key, step));
    return latest;
}

Status check_start(const AutomatonCloud& cloud, std::uint64_t key, const AutomatonState& start) {
    const auto wrong = [](const std::string& what) {
        return Error{ErrorCode::kInvalidScene, "", "the state to begin with belongs to " + what};
    };
    if (start.key != key) return wrong("another seed, or another place among the scene's clouds");
    if (start.rules != rules_key(cloud)) return wrong("an automaton with other parameters");
    // Refuses a state from a file that no automaton of these rules could be in.
    const AutomatonGrid grid(cloud.cells);
    if (start.nx != grid.nx || start.ny != grid.ny || start.nz != grid.nz ||
        start.ellipsoids.size() != first_ellipsoids(cloud, key).size() ||
        start.earlier.size() != std::min(start.step, cloud.smooth_steps - 1))
        return wrong("no automaton");
    return std::nullopt;
}

}  // namespace

Status check_starts(const AutomatonCloud& cloud, std::uint64_t key) {
    for (const auto& start : cloud.starts)
        if (Status wrong = check_start(cloud, key, *start)) return wrong;
    return std::nullopt;
}

Result<AutomatonState> run_automaton(const AutomatonCloud& cloud, std::uint64_t key,
                                     std::uint64_t step, int threads, const Deadline& deadline,
                                     AutomatonScratch& scratch) {
    if (Status wrong = check_starts(cloud, key)) return *wrong;
    const auto start = latest_start(cloud, key, step);
    auto state = start ? Result<AutomatonState>(*start)
                       : first_state(cloud, key, threads, deadline, scratch);
    while (state.ok() && state->step < step) {
        if (Status late = step_automaton(cloud, threads, deadline, scratch, *state)) return *late;
        if (cloud.kept && state->step < step) cloud.kept->pass(*state);
    }
    if (state.ok() && cloud.kept) cloud.kept->arrive(*state);
    return state;
}

Result<ModelParticles> make_particles(const AutomatonCloud& cloud, const ModelRequest& request,
                                      const Deadline& deadline) {
    const double steps = automaton_steps_at(cloud, request.time);
    const double whole = std::floor(steps);
    // Cells times steps that take about 50 ms of one core. Above that, a coarse answer is found without growing the
    // cloud.
    constexpr double kQuick = 0x1p26;
    if (request.coarse && cloud.cells.x * cloud.cells.y * cloud.cells.z * (whole + 2) > kQuick)
        return coarse_automaton(cloud, request.key, static_cast<std::uint64_t>(whole), deadline);
    const auto skies = skies_at(cloud, request.key, steps, request.threads, deadline);
    if (!skies.ok()) return skies.error();
    const CellDensity density = skies->density();
    const std::uint64_t most = request.coarse ? 400 : cloud.most_particles;
    auto made = cells_to_particles(cloud, density, most, request.threads, deadline);
    if (!made.ok()) return made.error();
    ModelParticles particles;
    particles.particles = std::move(made->particles);
    particles.error = made->error;
    return particles;
}

}  // namespace awan::automaton
