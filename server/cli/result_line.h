// What came of a render, in a line: for people, or as JSON for programs.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pipeline.h"
#include "server/cli/scene_input.h"
#include "server/cli/support.h"

namespace awan {

struct PictureResult {
    std::string scene;
    // The files that hold it.
    std::vector<std::string> outputs;
    std::optional<std::uint64_t> frame;
    // They were there already, and nothing was rendered.
    bool skipped = false;
    double encode_ms = 0;
};

// {"scene","outputs","frame","skipped","digest","width","height","particles","rung","error","error_forecast",
// "times_ms":{...}} and a line feed; null for an error that is not known. rendered: null when it was skipped.
std::string result_json(const PictureResult& result, const Scene& scene, const Rendered* rendered);

// The same of what is no picture of the scene's own size, a sky or an atlas: without what says how it was lit. Times in
// ms, by their names; EMPTY when it was skipped.
struct FileResult {
    std::string scene;
    std::vector<std::string> outputs;
    bool skipped = false;
    int width = 0, height = 0;
    std::vector<std::pair<const char*, double>> times;
};
std::string result_json(const FileResult& result, const Scene& scene);
// The end of a command that made such files: prints the line where it is asked for, and writes what they depend on. The
// code to exit with.
template <typename Command>
int end_with_line(const FileResult& result, const Scene& scene, const Command& command) {
    if (command.json) std::fputs(result_json(result, scene).c_str(), stdout);
    return end_with(write_dependencies(command.depfile, result.outputs, command.scene));
}

// "a.png: transport-32, error 4.2% (expected 5%)"; EMPTY for a look, which has no error.
std::string result_text(const std::string& output, const Rendered& rendered);

}  // namespace awan
