// Files compiled into the program (cmake/embed.cmake): shaders, the page, the presets.
#pragma once

#include <span>
#include <string_view>

namespace awan {

struct EmbeddedFile {
    std::string_view name;  // relative to the folder, e.g. "presets/cumulus.json"
    std::string_view text;
};

std::span<const EmbeddedFile> shader_files();  // core/shaders, in awan_core
std::span<const EmbeddedFile> web_files();     // web, in awan_server

}  // namespace awan
