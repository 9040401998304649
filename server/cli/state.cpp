// States of automata on the command line: `awan state` writes one, --state goes on from it.
#include <cmath>

#include "core/generate/automaton/run.h"
#include "core/generate/automaton/state_file.h"
#include "core/generate/keyed_random.h"
#include "core/scene/automaton.h"
#include "core/scene/rules.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/support.h"

namespace awan {
namespace {

using automaton::AutomatonScratch;
using automaton::check_start;
using automaton::read_state;
using automaton::run_automaton;
using automaton::write_state;

// The key that generate() gives to the model.
std::uint64_t key_of(const SceneDraft& draft, std::size_t k) {
    return keyed(draft.clouds[k].seed.value_or(draft.seed), k);
}

Result<std::size_t> choose_cloud(const SceneDraft& draft, const StateCommand& command) {
    const std::size_t count = draft.clouds.size();
    const auto invalid = [](const std::string& what) {
        return Error{ErrorCode::kInvalidScene, "/clouds", what};
    };
    if (command.cloud) {
        if (*command.cloud >= count)
            return invalid("--cloud " + std::to_string(*command.cloud) + ": there are " +
                           std::to_string(count) + " clouds, from 0");
        const auto k = static_cast<std::size_t>(*command.cloud);
        if (draft.clouds[k].automaton) return k;
        return invalid("cloud " + std::to_string(k) + " is no automaton and has no state");
    }
    std::optional<std::size_t> only;
    for (std::size_t k = 0; k < count; ++k) {
        if (!draft.clouds[k].automaton) continue;
        if (only) return invalid("several are automata: say which with --cloud");
        only = k;
    }
    if (!only) return invalid("none is an automaton, and only those have a state");
    return *only;
}

}  // namespace

Status begin_with_state(const std::string& path, SceneDraft& draft) {
    if (path.empty()) return std::nullopt;
    auto bytes = read_input(path);
    if (!bytes) return bytes.error();
    auto state = read_state(*bytes);
    if (!state) {
        Error error = state.error();
        error.message = "--state " + path + ": " + error.message;
        return error;
    }
    for (std::size_t k = 0; k < draft.clouds.size(); ++k) {
        Cloud& cloud = draft.clouds[k];
        if (!cloud.automaton || key_of(draft, k) != state->key) continue;
        AutomatonCloud resumed = *cloud.automaton;
        resumed.start = std::make_shared<const AutomatonState>(*std::move(state));
        // Whether the state fits is asked here, where the pointer can name the cloud. A draft that cannot be a scene
        // says so later.
        const std::string at = "/clouds/" + std::to_string(k) + "/automaton";
        if (!check_model(resumed, at))
            if (Status wrong = check_start(resumed, resumed.start->key)) {
                wrong->pointer = at;
                return wrong;
            }
        cloud.automaton = std::make_shared<const AutomatonCloud>(std::move(resumed));
        return std::nullopt;
    }
    return Error{ErrorCode::kInvalidScene, "/clouds",
                 "--state " + path +
                     ": belongs to none of the scene's automata; it has another "
                     "seed, or had another place among the clouds"};
}

int run_state(const StateCommand& command) {
    auto scene = read_valid_scene(command.scene);
    if (!scene) return report_error(command.scene.path, scene.error());
    if (const Status wrong = check_not_numbered(command.output)) return bad_usage(wrong->message);
    if (command.skip_existing && is_finished(command.output))
        return end_with(write_dependencies(command.depfile, {command.output}, command.scene));
    if (binary_to_terminal(command.output))
        return bad_usage("-o -: a state is not written to a terminal");
    const auto k = choose_cloud(**scene, command);
    if (!k) return report_error(command.scene.path, k.error());
    const AutomatonCloud& cloud = *(*scene)->clouds[*k].automaton;
    const double steps = std::floor(automaton_steps_at(cloud, (*scene)->time));
    AutomatonScratch scratch;
    const auto state = run_automaton(cloud, key_of(**scene, *k), static_cast<std::uint64_t>(steps),
                                     command.threads, Deadline{}, scratch);
    if (!state) return report_error(command.scene.path, state.error());
    if (const Status failed = write_output(command.output, write_state(*state)))
        return report_error("", *failed);
    return end_with(write_dependencies(command.depfile, {command.output}, command.scene));
}

}  // namespace awan
