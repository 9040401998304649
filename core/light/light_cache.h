// Lights that are kept while a camera moves.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "core/generate/detail.h"
#include "core/light/transport_light.h"
#include "core/plan/transport_settings.h"
#include "core/scene/scene.h"

namespace awan {

// The most recently used lights, as many as fit into `bytes` by TransportLight::bytes. Thread-safe.
class LightCache {
  public:
    explicit LightCache(std::size_t bytes) : bytes_(bytes) {}

    // Null: it is not here. What is found counts as the most recently used.
    std::shared_ptr<const TransportLight> find(const std::string& key);
    // Drops the least recently used lights until this one fits. A light of the same key is replaced. One that alone is
    // more than the cache may hold is not kept, and nothing else changes. light is not null.
    void keep(const std::string& key, std::shared_ptr<const TransportLight> light);
    // Of all lights here.
    std::size_t bytes_in_use() const;

  private:
    struct Entry {
        std::string key;
        std::shared_ptr<const TransportLight> light;
        std::size_t bytes;
    };
    std::list<Entry>::iterator at(const std::string& key);
    std::size_t used() const;

    mutable std::mutex mutex_;
    const std::size_t bytes_;
    std::list<Entry> entries_;  // most recently used first
};

// What a light depends on, and nothing else: of the scene all but camera, image, haze, accuracy and most effects (the
// plan has turned those into settings), then the settings, then which of the sets that the scene's procedural clouds
// make for different eyes it was made from (ParticleSet::variant). Lights of equal keys are equal.
// `detail`: ParticleSet's. Whether there is detail is the plan's choice, and a sequence makes it for figures of its own:
// the scene alone does not say.
std::string light_key(const Scene& scene, const TransportSettings& settings,
                      std::uint64_t variant = 0, const DetailField* detail = nullptr);

}  // namespace awan
