// The files that a render writes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "server/cli/cli.h"

namespace awan {

// One output and its format: "png", "exr", "webp" or "apng".
struct Target {
    std::string path;
    std::string format;
    // All frames side by side.
    bool sheet = false;

    // It holds every frame.
    bool animated() const { return sheet || format == "webp" || format == "apng"; }
};

// Those of the command. otherwise: the format of standard output, where none is named. The error is of bad usage: two
// the same, two to standard output, a format that nobody knows.
Result<std::vector<Target>> targets_of(const RenderCommand& command, const std::string& otherwise);

// The files of one frame; animations, which hold all of them, stay out. frame: none for a scene that stands still.
std::vector<std::string> files_of_frame(const std::vector<Target>& targets,
                                        const std::uint64_t* frame);

}  // namespace awan
