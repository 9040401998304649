// Lights that are kept while a camera moves.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "core/generate/detail.h"
#include "core/light/transport.h"

namespace awan {

// The most recently used lights, as many as fit into so many bytes. Thread-safe.
class LightCache {
  public:
    explicit LightCache(std::size_t bytes) : bytes_(bytes) {}

    std::shared_ptr<const TransportLight> find(const std::string& key);  // null: not here
    void keep(const std::string& key, std::shared_ptr<const TransportLight> light);
    std::size_t bytes_in_use() const;

  private:
    struct Entry {
        std::string key;
        std::shared_ptr<const TransportLight> light;
    };
    mutable std::mutex mutex_;
    const std::size_t bytes_;
    std::size_t used_ = 0;
    std::list<Entry> entries_;  // most recently used first
};

// What a light depends on: everything of the scene but camera, image, effects and accuracy, and the settings.
// variant, detail: ParticleSet's. Whether there is detail is the plan's choice, and a sequence makes it for figures of
// its own: the scene alone does not say.
std::string light_key(const Scene& scene, const TransportSettings& settings,
                      std::uint64_t variant = 0, const DetailField* detail = nullptr);

}  // namespace awan
