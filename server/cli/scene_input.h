// The scene of a command: a file and what its flags put in place of what that says.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace awan {

struct SceneInput {
    // A file, or "-".
    std::string path;
    // "/sun/elevation=12", in their order.
    std::vector<std::string> sets;
    std::optional<std::uint64_t> seed;
    // Of ready particles.
    std::optional<double> radius;
    // Files with states of automata to begin with, or folders of such files.
    std::vector<std::string> states{};
    // "puff=my puff.png", in their order.
    std::vector<std::string> textures{};
};

// Reads it; what was taken for what in a file of particles is said on standard error.
Result<SceneDraft> read_scene_input(const SceneInput& input);
Result<Scene> read_valid_scene(const SceneInput& input);

// The files that it is made of, for a depfile.
std::vector<std::string> files_of(const SceneInput& input);

// Writes what make and ninja read to know that `outputs` are made of them; depfile "": nobody asks.
Status write_dependencies(const std::string& depfile, const std::vector<std::string>& outputs,
                          const SceneInput& input);

// Gives states in files, or in all files of a folder, to the automata of the scene that they belong to (state.cpp).
Status begin_with_states(const std::vector<std::string>& paths, SceneDraft& draft);

}  // namespace awan
