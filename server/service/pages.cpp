#include "server/service/pages.h"

#include <algorithm>

#include "core/base/embedded.h"
#include "server/document/schema.h"
#include "server/service/compression.h"
#include "server/service/negotiation.h"

namespace awan {
namespace {

std::string_view content_type_of(std::string_view name) {
    if (name.ends_with(".html")) return "text/html; charset=utf-8";
    if (name.ends_with(".css")) return "text/css; charset=utf-8";
    if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
    if (name.ends_with(".svg")) return "image/svg+xml";
    if (name.ends_with(".json")) return "application/json";
    return "application/octet-stream";
}

// The contract: routes and answers as web/openapi.json has them, scenes as the tables of core/scene do.
std::string whole_contract(std::string_view routes) {
    constexpr std::string_view kSchemas = "\"schemas\": {";
    const std::size_t at = routes.find(kSchemas) + kSchemas.size();
    std::string text(routes.substr(0, at));
    text += '\n' + scene_schemas() + ',';
    return text.append(routes.substr(at));
}

}  // namespace

std::vector<Page> make_pages() {
    std::vector<Page> pages;
    for (const EmbeddedFile& file : web_files()) {
        std::string text(file.text);
        if (file.name == "openapi.json") text = whole_contract(file.text);
        const std::string etag = make_etag({text});
        const std::string packed = packed_whole(text);
        if (file.name == "index.html")
            pages.push_back({"/", content_type_of(file.name), text, etag, packed});
        pages.push_back({"/" + std::string(file.name), content_type_of(file.name), std::move(text),
                         etag, packed});
    }
    return pages;
}

std::vector<Preset> make_presets() {
    std::vector<Preset> presets;
    for (const PresetEntry& entry : preset_entries())
        presets.push_back({entry, make_etag({entry.text})});
    return presets;
}

}  // namespace awan
