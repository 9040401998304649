// States of automata on the command line: `awan state` writes one, --state goes on from it.
#include <algorithm>
#include <cmath>
#include <filesystem>

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
using automaton::check_starts;
using automaton::read_state;
using automaton::run_automaton;
using automaton::write_state;

// Of all files of --state together.
constexpr std::size_t kMostStateBytes = std::size_t{1} << 30;

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

// Regular files of a folder, by name; of anything else, it alone.
Result<std::vector<std::string>> files_at(const std::string& path) {
    std::error_code failed;
    if (!std::filesystem::is_directory(path, failed)) return std::vector{path};
    std::vector<std::string> files;
    for (std::filesystem::directory_iterator at(path, failed), end; !failed && at != end;
         at.increment(failed))
        if (at->is_regular_file()) files.push_back(at->path().string());
    if (failed)
        return Error{ErrorCode::kInvalidScene, "", "--state " + path + ": " + failed.message()};
    if (files.empty())
        return Error{ErrorCode::kInvalidScene, "", "--state " + path + ": no files are in it"};
    std::sort(files.begin(), files.end());
    return files;
}

// Gives a state to the automaton that it belongs to.
Status begin_with(const std::string& path, std::shared_ptr<const AutomatonState> state,
                  SceneDraft& draft) {
    for (std::size_t k = 0; k < draft.clouds.size(); ++k) {
        Cloud& cloud = draft.clouds[k];
        if (!cloud.automaton || key_of(draft, k) != state->key) continue;
        AutomatonCloud resumed = *cloud.automaton;
        resumed.starts.push_back(std::move(state));
        // Whether the state fits is asked here, where the pointer can name the cloud. A draft that cannot be a scene
        // says so later.
        const std::string at = "/clouds/" + std::to_string(k) + "/automaton";
        if (!check_model(resumed, at))
            if (Status wrong = check_starts(resumed, resumed.starts.back()->key)) {
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

std::uint64_t steps_at(const AutomatonCloud& cloud, double time) {
    return static_cast<std::uint64_t>(std::floor(automaton_steps_at(cloud, time)));
}

// The steps whose states are written.
std::vector<std::uint64_t> steps_of(const Scene& scene, const AutomatonCloud& cloud,
                                    const StateCommand& command) {
    if (!command.every) return {steps_at(cloud, scene->time)};
    const double until =
        scene->sequence ? std::max(scene->sequence->from, scene->sequence->to) : scene->time;
    std::vector<std::uint64_t> steps;
    for (std::uint64_t step = 0; step <= steps_at(cloud, until); step += *command.every)
        steps.push_back(step);
    return steps;
}

}  // namespace

Status begin_with_states(const std::vector<std::string>& paths, SceneDraft& draft) {
    std::size_t bytes_read = 0;
    for (const std::string& given : paths) {
        const auto files = files_at(given);
        if (!files) return files.error();
        for (const std::string& path : *files) {
            auto bytes = read_input(path);
            if (!bytes) return bytes.error();
            bytes_read += bytes->size();
            if (bytes_read > kMostStateBytes)
                return Error{ErrorCode::kInvalidScene, "",
                             "--state " + path + ": makes it over 1 GiB of states; name fewer"};
            auto state = read_state(*bytes);
            if (!state) {
                Error error = state.error();
                error.message = "--state " + path + ": " + error.message;
                return error;
            }
            if (Status wrong = begin_with(
                    path, std::make_shared<const AutomatonState>(*std::move(state)), draft))
                return wrong;
        }
    }
    return std::nullopt;
}

int run_state(const StateCommand& command) {
    auto scene = read_valid_scene(command.scene);
    if (!scene) return report_error(command.scene.path, scene.error());
    const Status misplaced =
        command.every ? check_numbered(command.output, 2) : check_not_numbered(command.output);
    if (misplaced) return bad_usage(misplaced->message);
    if (binary_to_terminal(command.output))
        return bad_usage("-o -: a state is not written to a terminal");
    const auto k = choose_cloud(**scene, command);
    if (!k) return report_error(command.scene.path, k.error());
    const AutomatonCloud& cloud = *(*scene)->clouds[*k].automaton;
    std::vector<std::string> outputs;
    for (const std::uint64_t step : steps_of(*scene, cloud, command)) {
        outputs.push_back(command.every ? numbered_name(command.output, step) : command.output);
        if (command.skip_existing && is_finished(outputs.back())) continue;
        // Each goes on from the one before, which cloud.kept has.
        AutomatonScratch scratch;
        const auto state =
            run_automaton(cloud, key_of(**scene, *k), step, command.threads, Deadline{}, scratch);
        if (!state) return report_error(command.scene.path, state.error());
        if (const Status failed = write_output(outputs.back(), write_state(*state)))
            return report_error("", *failed);
    }
    return end_with(write_dependencies(command.depfile, outputs, command.scene));
}

}  // namespace awan
