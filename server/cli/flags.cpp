#include "server/cli/flags.h"

#include <algorithm>
#include <thread>

#include "server/cli/frames.h"

namespace awan {

int processors() {
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string environment_name(std::string flag) {
    for (char& c : flag) c = c == '-' ? '_' : static_cast<char>(std::toupper(c));
    return "AWAN_" + flag;
}

void add_device(CLI::App& command, DeviceChoice& choice) {
    command
        .add_flag_callback(
            "--software", [&choice] { choice = DeviceChoice::kSoftware; },
            "render on the processor even where there is a GPU")
        ->envname("AWAN_SOFTWARE");
}

void add_threads(CLI::App& command, int& threads) {
    add(command, "--threads", threads, "threads that work on one scene")->check(CLI::Range(1, 256));
}

void add_textures(CLI::App& command, SceneInput& scene) {
    add(command, "--texture", scene.textures,
        "a picture that the scene may be painted with, as puff=my-puff.png; may be repeated")
        ->allow_extra_args(false);
}

void add_values(CLI::App& command, SceneInput& scene) {
    add(command, "--set", scene.sets,
        "a value of the document, as /sun/elevation=12 or /clouds/0/density=auto, or @ and a file "
        "that "
        "holds it; may be repeated")
        ->allow_extra_args(false);
    add_textures(command, scene);
    add(command, "--seed", scene.seed, "instead of the document's");
    add(command, "--radius", scene.radius,
        "of ready particles (.ply, .csv), in place of what the file says of it")
        ->check(CLI::PositiveNumber);
}

void add_scene(CLI::App& command, SceneInput& scene, const std::string& name) {
    command.add_option(name, scene.path, kSceneHelp)->required();
    add_values(command, scene);
}

void add_state(CLI::App& command, SceneInput& scene) {
    add(command, "--state", scene.states,
        "a file of `awan state`, or a folder of such files: the automaton goes on from the latest "
        "that is not too late instead of from the beginning; may be repeated")
        ->allow_extra_args(false);
}

void only_one(CLI::Option* option) {
    option->check([](const std::string& path) {
        // Whose flag it is, is said before it.
        const Status wrong = check_not_numbered(path, "");
        return wrong ? wrong->message : std::string();
    });
}

void add_farm_flags(CLI::App& command, bool& skip_existing, std::string& depfile) {
    command
        .add_flag("--skip-existing", skip_existing,
                  "what is there already is not made again (files appear whole)")
        ->envname("AWAN_SKIP_EXISTING");
    only_one(add(command, "--depfile", depfile,
                 "a file that says to make and ninja what the outputs are made of"));
}

}  // namespace awan
