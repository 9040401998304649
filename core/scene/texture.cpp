#include "core/scene/texture.h"

#include <xxhash.h>

#include <algorithm>

#include "core/scene/limits.h"
#include "core/scene/scene.h"

namespace awan {
namespace {

constexpr std::size_t kHashDigits = 32;

bool is_hash(std::string_view name) {
    return name.size() == kHashDigits &&
           name.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// What names a cloud's texture: its own word, else the scene's. Null: nothing does.
const std::string* name_for(const SceneDraft& scene, const Cloud& cloud, const Cube* cube) {
    if (cube != nullptr && cube->texture) return &*cube->texture;
    if (cloud.texture) return &*cloud.texture;
    return scene.texture ? &*scene.texture : nullptr;
}

}  // namespace

std::string texture_hash(const std::vector<std::uint8_t>& depth,
                         const std::vector<std::uint8_t>& color) {
    std::vector<std::uint8_t> all(depth);
    all.insert(all.end(), color.begin(), color.end());
    XXH128_canonical_t bytes;
    XXH128_canonicalFromHash(&bytes, XXH3_128bits(all.data(), all.size()));
    std::string text;
    for (const unsigned char byte : bytes.digest) {
        text += "0123456789abcdef"[byte >> 4];
        text += "0123456789abcdef"[byte & 15];
    }
    return text;
}

std::string height_map_hash(const HeightMap& map) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(8 + 2 * map.heights.size());
    for (const int side : {map.across, map.down})
        for (int shift = 0; shift < 32; shift += 8)
            bytes.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(side) >> shift & 255U));
    for (const std::uint16_t height : map.heights) {
        bytes.push_back(static_cast<std::uint8_t>(height & 255U));
        bytes.push_back(static_cast<std::uint8_t>(height >> 8U));
    }
    return texture_hash(bytes);
}

std::shared_ptr<const Texture> map_of(const SceneDraft& scene) {
    if (!scene.ground || !scene.ground->terrain || !scene.ground->terrain->map) return nullptr;
    const std::string& name = *scene.ground->terrain->map;
    for (const auto& given : scene.textures)
        if ((name == given->name || name == given->hash || name == given->heights.hash) &&
            !given->heights.heights.empty())
            return given;
    return nullptr;
}

std::string_view map_hash(const SceneDraft& scene) {
    if (const auto map = map_of(scene)) return map->heights.hash;
    if (!scene.ground || !scene.ground->terrain || !scene.ground->terrain->map) return {};
    for (const OwnTexture& own : kOwnTextures)
        if (*scene.ground->terrain->map == own.name || *scene.ground->terrain->map == own.hash)
            return own.hash;
    return {};
}

bool has_terrain(const SceneDraft& scene) {
    return scene.ground && scene.ground->terrain && scene.ground->terrain->height > 0 &&
           scene.look == Look::kPhysical &&
           scene.effects[static_cast<std::size_t>(Effect::kTerrain)] != Switch::kOff;
}

Status check_texture_name(std::string_view name) {
    const auto wrong = [](const char* message) {
        return Error{ErrorCode::kInvalidScene, "", message};
    };
    const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
        return is_letter_or_digit(c) || c == '-' || c == '_' || c == '.';
    });
    if (name.empty() || name.size() > limits::kMaxTextureName || !plain ||
        !is_letter_or_digit(name.front()))
        return wrong(
            "the name of a texture must be 1 to 64 letters, digits, '-', '_' and '.', the first "
            "a letter or a digit");
    if (is_hash(name)) return wrong("32 hex digits are the hash of a texture, not its name");
    if (name == kNoTexture) return wrong("\"none\" stands for no texture");
    for (const OwnTexture& own : kOwnTextures)
        if (name == own.name) return wrong("one of Awan's own textures has that name");
    return std::nullopt;
}

std::string_view find_texture(const SceneDraft& scene, std::string_view name) {
    for (const auto& given : scene.textures)
        if (name == given->name || name == given->hash) return given->hash;
    for (const OwnTexture& own : kOwnTextures)
        if (name == own.name || name == own.hash) return own.hash;
    return {};
}

std::string_view texture_of(const SceneDraft& scene, const Cloud& cloud, const Cube* cube) {
    const std::string* const name = name_for(scene, cloud, cube);
    if (name == nullptr || *name == kNoTexture) return {};
    return find_texture(scene, *name);
}

std::uint64_t particles_of(const SceneDraft& scene, const Cloud& cloud, const Cube& cube) {
    const auto billboards = cube.billboards    ? cube.billboards
                            : cloud.billboards ? cloud.billboards
                                               : scene.billboards;
    if (!billboards || texture_of(scene, cloud, &cube).empty()) return cube.particles;
    return *billboards;
}

std::vector<std::string_view> textures_of(const SceneDraft& scene) {
    std::vector<std::string_view> all;
    const auto add = [&](std::string_view hash) {
        if (!hash.empty() && std::find(all.begin(), all.end(), hash) == all.end())
            all.push_back(hash);
    };
    for (const Cloud& cloud : scene.clouds) {
        if (cloud.model != CloudModel::kCubes) add(texture_of(scene, cloud, nullptr));
        for (const Cube& cube : cloud.cubes) add(texture_of(scene, cloud, &cube));
    }
    return all;
}

bool draws_textures(const SceneDraft& scene) {
    return scene.effects[static_cast<std::size_t>(Effect::kTexture)] != Switch::kOff &&
           !textures_of(scene).empty();
}

}  // namespace awan
