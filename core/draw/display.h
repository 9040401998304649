// What a scene is made of, drawn flat by the renderer (scene field `display`): the display modes of the editor of Sunar
// et al. 2005. Nothing is lit, so there is neither a rung nor an error.
//
//   cubes           cubes as solids, with their edges
//   quads           their textures pasted on their faces, with edges; a face without a texture is tinted
//   billboards      textures on the squares that face the eye, one a particle, with edges; nearer ones brighter, and of
//                   a particle without a texture, Awan's texture "soft"
//   bounding_boxes  edges alone
//   show_texture    the texture of each cube, once, on one square that faces the eye
//   ellipsoids      the ellipsoids of automata as rings, the chosen one red, and the edges of their grids (the
//                   editor of Upchurch 2009)
//
// A cloud of another model counts as one cube, the box around its particles.
#pragma once

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/generate/particle_set.h"
#include "core/gl/device.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Before a plain grey, or with image.background "transparent" before nothing. Colours are meant for an exposure of 0
// stops. scene->display is not kLit. Errors: kOverDeadline, kCancelled, kNoRenderer, kOutOfMemory, kInternal.
Result<Image> draw_display(const Scene& scene, const ParticleSet& particles, const View& view,
                           Device& device, const Deadline& deadline);

}  // namespace awan
