#include "core/scene/combine.h"

#include <algorithm>

#include "core/scene/checks.h"
#include "core/scene/fingerprint.h"

namespace awan {
namespace {

bool is_same_medium(const Medium& a, const Medium& b) {
    return fingerprint_of(table_of<Medium>(), &a) == fingerprint_of(table_of<Medium>(), &b);
}

bool is_same_detail(const std::optional<Detail>& a, const std::optional<Detail>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return fingerprint_of(table_of<Detail>(), &*a) == fingerprint_of(table_of<Detail>(), &*b);
}

Error other_than_first(const char* member) {
    return invalid(std::string("/") + member,
                   "is not that of the first scene, and scenes that are combined have one");
}

// What a cloud of another scene is painted with, spelled out likewise.
void spell_out_textures(const SceneDraft& scene, const SceneDraft& other, Cloud& cloud) {
    if (!cloud.texture) cloud.texture = other.texture;
    if (!cloud.texture && scene.texture) cloud.texture = std::string(kNoTexture);
    if (!cloud.billboards) cloud.billboards = other.billboards;
    if (cloud.billboards || !scene.billboards) return;
    for (Cube& cube : cloud.cubes)
        if (!cube.billboards) cube.billboards = cube.particles;
}

void add_textures(const GivenTextures& others, GivenTextures& textures) {
    for (const auto& other : others)
        if (std::none_of(textures.begin(), textures.end(), [&](const auto& own) {
                return own->name == other->name && own->hash == other->hash;
            }))
            textures.push_back(other);
}

}  // namespace

Status combine_into(SceneDraft& scene, const SceneDraft& other) {
    if (!is_same_medium(scene.medium, other.medium)) return other_than_first("medium");
    if (!is_same_detail(scene.detail, other.detail)) return other_than_first("detail");
    if (scene.look != other.look) return other_than_first("look");
    for (Cloud cloud : other.clouds) {
        // Spelled out, since the other scene's words for all do not come along.
        cloud.density = density_of(other, cloud);
        cloud.fill = fill_of(other, cloud);
        cloud.seed = seed_of(other, cloud);
        spell_out_textures(scene, other, cloud);
        scene.clouds.push_back(std::move(cloud));
    }
    add_textures(other.textures, scene.textures);
    scene.top_level_cubes = false;
    return std::nullopt;
}

}  // namespace awan
