// Files compiled into the program (cmake/embed.cmake): shaders, the page, the presets.
#pragma once

#include <span>
#include <string_view>

namespace awan {

struct EmbeddedFile {
    // Relative to the folder that was embedded, e.g. "presets/cumulus.json".
    std::string_view name;
    std::string_view text;
};

// The files of core/shaders; part of the library awan_core.
std::span<const EmbeddedFile> shader_files();
// The presets of web; part of the library awan_document.
std::span<const EmbeddedFile> preset_files();
// The other files of web; part of the library awan_server.
std::span<const EmbeddedFile> web_files();

}  // namespace awan
