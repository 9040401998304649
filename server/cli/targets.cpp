#include "server/cli/targets.h"

#include <algorithm>

#include "server/cli/frames.h"
#include "server/cli/support.h"

namespace awan {

Result<std::vector<Target>> targets_of(const RenderCommand& command, const std::string& otherwise) {
    std::vector<Target> targets;
    for (const std::string& path : command.outputs) {
        const bool twice = std::any_of(targets.begin(), targets.end(),
                                       [&](const Target& other) { return other.path == path; });
        if (twice) return Error{ErrorCode::kIo, "", "-o " + path + " stands twice"};
        // With several outputs the format is that of the one that has no name of its own.
        const bool named = path != "-" && path.rfind('.') != std::string::npos;
        const std::string word = command.format == "png16" ? "png" : command.format;
        const std::string format = named && command.outputs.size() > 1 ? "" : word;
        auto known = output_format(path, format, {"png", "exr", "webp", "apng"}, otherwise);
        if (!known) return known.error();
        if (binary_to_terminal(path))
            return Error{ErrorCode::kIo, "", "-o -: an image is not written to a terminal"};
        const bool sheet = command.flipbook && (*known == "png" || *known == "exr");
        targets.push_back({path, *std::move(known), sheet});
    }
    return targets;
}

std::vector<std::string> files_of_frame(const std::vector<Target>& targets,
                                        const std::uint64_t* frame) {
    std::vector<std::string> files;
    for (const Target& target : targets)
        if (!target.animated())
            files.push_back(frame == nullptr ? target.path : numbered_name(target.path, *frame));
    return files;
}

}  // namespace awan
