// What is served from memory: the page's files, the contract, the presets. Found by exact name, so
// no path can lead anywhere else.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/document/json.h"

namespace awan {

// A file that is served as it is.
struct Page {
    // E.g. "/", "/main.js", "/openapi.json".
    std::string path;
    std::string_view content_type;
    std::string text;
    std::string etag;
    // As gzip packs it; "" where that is no smaller.
    std::string packed;
};

// Every page, and `/` for index.html; packing them takes some 30 ms, once.
std::vector<Page> make_pages();

// A scene of web/presets.
struct Preset {
    PresetEntry entry;
    std::string etag;
};

// The presets in the order of web/presets/index.json, which gives their titles.
std::vector<Preset> make_presets();

// Scripts, styles and pictures of this server only: a scene's text can never become a script. The form that works
// without scripts is sent to this server.
inline constexpr std::string_view kContentSecurityPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'";

}  // namespace awan
