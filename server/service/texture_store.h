// The textures that clients have given to the service, in memory for as long as it runs.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "core/scene/texture.h"

namespace awan {

// Thread-safe.
class TextureStore {
  public:
    // Keeps it under its name, in the place of one that had it. `was_there`: there was one. Fails with kTooLarge where
    // limits::kMaxKeptTextures are kept under other names.
    Status keep(std::shared_ptr<const Texture> texture, bool& was_there);
    // False: there is none of that name.
    bool remove(std::string_view name);
    // By name or hash; null: there is none.
    std::shared_ptr<const Texture> find(std::string_view name) const;
    // By name.
    GivenTextures all() const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const Texture>, std::less<>> kept_;
};

}  // namespace awan
