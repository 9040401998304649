// Particles as billboards: squares through their centres that face the eye, painted with textures. As in Dobashi et al.
// 2000, the opacity of a texture is not in proportion to the depth of its matter, so there is a picture of it for each
// of kDepthLevels depths, and a billboard takes that of the depth that is nearest to its own.
#pragma once

#include <vector>

#include "core/draw/splats.h"
#include "core/gl/objects.h"

namespace awan {

// Half the side of a billboard, in a particle's s. A Gaussian has 98.9% of its mass within it.
inline constexpr double kBillboardReach = 3;

// Of the particles that are painted.
DepthLevels depth_levels(const ParticleSet& particles);

// The opacity of a texture's points for a particle of that depth through its centre, 0..1, row by row. The particle's
// mass is kept: that of its Gaussian is shared out over the square by the texture.
std::vector<float> opacity_of(const Texture& texture, double depth);

// Half as many rows and columns: the means of four. Their side: a power of 2.
std::vector<float> halved(const std::vector<float>& texels, std::size_t channels = 1);

// Whether any of the textures that the scene is painted with has colours.
bool has_colors(const Scene& scene);

// textures_of(scene) and, if `plain`, a white one behind them: a layer of three channels each.
gl::TextureArray upload_colors(const Scene& scene, bool plain = false);

// On the renderer: textures_of(scene), kDepthLevels layers each. Errors: of the deadline.
Result<gl::TextureArray> upload_textures(const Scene& scene, const DepthLevels& levels,
                                         const Deadline& deadline);

// The axes of a texture on the square about a place q in the eye's frame, half as long as its side and at right angles
// to the line to the eye. `up` is towards `vertical` (unit, in the eye's frame) before it is turned.
struct BillboardAxes {
    glm::dvec3 across, up;
};
BillboardAxes billboard_axes(const glm::dvec3& q, double half_side, const Paint& paint,
                             const glm::dvec3& vertical);

// The scene's y axis in the eye's frame.
glm::dvec3 vertical_in(const View& view);

}  // namespace awan
