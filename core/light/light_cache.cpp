#include "core/light/light_cache.h"

#include <algorithm>
#include <cstdio>

#include "core/scene/validate.h"

namespace awan {

std::shared_ptr<const TransportLight> LightCache::find(const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto at = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const Entry& entry) { return entry.key == key; });
    if (at == entries_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, at);
    return at->light;
}

void LightCache::keep(const std::string& key, std::shared_ptr<const TransportLight> light) {
    const std::size_t size = light->bytes();
    const std::lock_guard lock(mutex_);
    if (size > bytes_) return;
    const auto at = std::find_if(entries_.begin(), entries_.end(),
                                 [&](const Entry& entry) { return entry.key == key; });
    if (at != entries_.end()) {  // two requests made it at once
        used_ -= at->light->bytes();
        entries_.erase(at);
    }
    while (used_ + size > bytes_) {
        used_ -= entries_.back().light->bytes();
        entries_.pop_back();
    }
    used_ += size;
    entries_.push_front({key, std::move(light)});
}

std::size_t LightCache::bytes_in_use() const {
    const std::lock_guard lock(mutex_);
    return used_;
}

std::string light_key(const Scene& scene, const TransportSettings& settings, std::uint64_t variant,
                      const DetailField* detail) {
    char text[192];
    std::snprintf(text, sizeof text, ":%llx:%d:%d:%a:%d:%d:%d:%d",
                  static_cast<unsigned long long>(variant), settings.cells, settings.sun_cells,
                  settings.tolerance, settings.max_sweeps, settings.sky ? 1 : 0,
                  settings.ground ? 1 : 0, settings.ground_shadow ? 1 : 0);
    std::string key = light_fingerprint(scene) + text;
    for (const IslandCells& island : settings.islands) {
        std::snprintf(text, sizeof text, ":%d.%d", island.cells, island.sun_cells);
        key += text;
    }
    if (detail != nullptr) {
        // The seed of its tile is the scene's, even where each cloud has one of its own.
        std::snprintf(text, sizeof text, ":detail:%llx:%a:%a:%a:%a:%a:%a",
                      static_cast<unsigned long long>(scene->seed), detail->bump, detail->origin.x,
                      detail->origin.y, detail->origin.z, static_cast<double>(detail->edge),
                      static_cast<double>(detail->keep));
        key += text;
    }
    return key;
}

}  // namespace awan
