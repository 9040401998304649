// awan validate, presets, digest: what scenes are, without making anything of them.
#include <cstdio>

#include "core/scene/fingerprint.h"
#include "core/scene/validate.h"
#include "server/cli/cli.h"
#include "server/cli/scene_input.h"
#include "server/cli/support.h"
#include "server/document/presets.h"

namespace awan {

int run_validate(const ValidateCommand& command) {
    int code = kExitFine;
    for (const std::string& path : command.scenes) {
        SceneInput input = command.input;
        input.path = path;
        const auto scene = read_valid_scene(input);
        if (!scene)
            code = report_error(path, scene.error());
        else
            std::printf("%s: can be\n", path.c_str());
    }
    return code;
}

int run_presets(const PresetsCommand& command) {
    const std::vector<PresetEntry> presets = preset_entries();
    if (command.name.empty()) {
        for (const PresetEntry& entry : presets)
            std::printf("%-24s %s%s\n", std::string(entry.name).c_str(),
                        std::string(entry.title).c_str(),
                        entry.genus.empty() ? "" : (" (" + std::string(entry.genus) + ")").c_str());
        return kExitFine;
    }
    const PresetEntry* const found = find_preset(presets, command.name);
    if (found == nullptr)
        return bad_usage("there is no preset " + command.name + "; there are " + names_of(presets));
    std::fwrite(found->text.data(), 1, found->text.size(), stdout);
    return kExitFine;
}

int run_digest(const DigestCommand& command) {
    const auto scene = read_valid_scene(command.scene);
    if (!scene) return report_error(command.scene.path, scene.error());
    std::printf("%s  %s\n", fingerprint(*scene).c_str(), command.scene.path.c_str());
    return kExitFine;
}

}  // namespace awan
