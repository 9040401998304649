// Scenes with hills for tests.
#pragma once

#include "core/truth/oracles.h"
#include "tests/ground_scenes.h"

namespace awan::test {

// A height map of so many pixels a side, values 0..1 by a function of x and z (0..1 across it), as a texture "hills".
template <typename Height>
std::shared_ptr<const Texture> hills_by(int side, const Height& height) {
    Texture texture;
    texture.name = "hills";
    texture.depth.assign(static_cast<std::size_t>(kTextureSide) * kTextureSide, 255);
    texture.hash = texture_hash(texture.depth);
    texture.heights.across = texture.heights.down = side;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
            texture.heights.heights.push_back(static_cast<std::uint16_t>(
                65535 * std::clamp(static_cast<double>(height((i + .5) / side, (j + .5) / side)),
                                   0.0, 1.0)));
    texture.heights.hash = height_map_hash(texture.heights);
    return std::make_shared<const Texture>(std::move(texture));
}

inline SceneDraft with_map(SceneDraft draft, std::shared_ptr<const Texture> map) {
    draft.ground->terrain->map = map->name;
    draft.textures.push_back(std::move(map));
    return draft;
}

// Hills by seed under that cumulus, whose flat base is about as high as their tops.
inline SceneDraft over_hills(double elevation = 25) {
    SceneDraft draft = over_ground(.2);
    draft.sun.elevation = elevation;
    draft.sun.azimuth = 120;
    draft.sky.zenith = {.1, .17, .32};
    draft.sky.horizon = {.3, .34, .38};
    draft.detail = std::nullopt;
    draft.ground->height = -12;
    draft.ground->terrain = Terrain{};
    draft.ground->terrain->height = 7;
    draft.ground->terrain->extent = 120;
    draft.ground->terrain->size = 24;
    draft.ground->terrain->rock = glm::dvec3(.15);
    draft.camera.eye = {6, 0, 40};
    draft.camera.target = {0, -4, 0};
    draft.camera.fov = 50;
    draft.image.width = 60;
    draft.image.height = 40;
    return draft;
}

}  // namespace awan::test
