#include "server/service/texture_store.h"

#include "server/limits.h"

namespace awan {

Status TextureStore::keep(std::shared_ptr<const Texture> texture, bool& was_there) {
    const std::lock_guard lock(mutex_);
    was_there = kept_.contains(texture->name);
    if (!was_there && kept_.size() >= limits::kMaxKeptTextures)
        return Error{ErrorCode::kTooLarge, "",
                     "there are " + std::to_string(kept_.size()) +
                         " textures already, as many as are kept; DELETE one first"};
    kept_[texture->name] = std::move(texture);
    return std::nullopt;
}

bool TextureStore::remove(std::string_view name) {
    const std::lock_guard lock(mutex_);
    const auto found = kept_.find(name);
    if (found == kept_.end()) return false;
    kept_.erase(found);
    return true;
}

std::shared_ptr<const Texture> TextureStore::find(std::string_view name) const {
    const std::lock_guard lock(mutex_);
    if (const auto found = kept_.find(name); found != kept_.end()) return found->second;
    for (const auto& [own, texture] : kept_)
        if (texture->hash == name) return texture;
    return nullptr;
}

GivenTextures TextureStore::all() const {
    const std::lock_guard lock(mutex_);
    GivenTextures textures;
    for (const auto& [name, texture] : kept_) textures.push_back(texture);
    return textures;
}

}  // namespace awan
