// What the commands' flags have in common, and the commands: each is added to `app`, and what is given back runs it,
// with what its flags were read to.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "server/cli/cli.h"

namespace awan {

inline constexpr const char* kSceneHelp =
    "the scene: a .json, .awn, .awa, .ply or .csv file, or - for standard input";

// Of this machine, >= 1.
int processors();

// Every flag has an environment variable: --allow-host is AWAN_ALLOW_HOST.
std::string environment_name(std::string flag);

template <typename T>
CLI::Option* add(CLI::App& command, const std::string& names, T& value, const std::string& help) {
    CLI::Option* option = command.add_option(names, value, help)->capture_default_str();
    return option->envname(environment_name(option->get_lnames().front()));
}

void add_device(CLI::App& command, DeviceChoice& choice);
void add_threads(CLI::App& command, int& threads);
void add_textures(CLI::App& command, SceneInput& scene);
// What takes the place of values in the scene, or in each of several.
void add_values(CLI::App& command, SceneInput& scene);
void add_scene(CLI::App& command, SceneInput& scene, const std::string& name = "scene");
void add_state(CLI::App& command, SceneInput& scene);
// A file that there is one of, whatever there are frames of.
void only_one(CLI::Option* option);
void add_farm_flags(CLI::App& command, bool& skip_existing, std::string& depfile);

using Run = std::function<int()>;

Run add_serve(CLI::App& app);

// Pictures (flags_of_pictures.cpp).
Run add_render(CLI::App& app);
Run add_fly(CLI::App& app);
Run add_accuracy(CLI::App& app);
Run add_bench(CLI::App& app);
Run add_sky(CLI::App& app);
Run add_impostor(CLI::App& app);

// Scenes and particles (flags_of_scenes.cpp).
Run add_particles(CLI::App& app);
Run add_plan(CLI::App& app);
Run add_state_command(CLI::App& app);
Run add_convert(CLI::App& app);
Run add_validate(CLI::App& app);
Run add_presets(CLI::App& app);
Run add_digest(CLI::App& app);

}  // namespace awan
