// Awan's own textures, made by rule: no file is read for them.
#pragma once

#include "core/scene/texture.h"

namespace awan {

// The texture of that hash: one that came beside the scene, or one of Awan's own, which takes some 20 ms to make. Null
// where there is none.
std::shared_ptr<const Texture> texture_of_hash(const SceneDraft& scene, std::string_view hash);

// A texture's colours as linear light, 3 numbers a point; white where it has none.
std::vector<float> linear_colors(const Texture& texture);

// What one of them holds (Texture::depth), the same bytes on every machine. place: in kOwnTextures.
std::vector<std::uint8_t> own_texture_depth(std::size_t place);

// Another puff for every key: opacities 0..1 of side^2 points, row by row from the top left.
std::vector<float> generated_puff(std::uint64_t key, int side);

}  // namespace awan
