// The picture of an automaton as Upchurch 2009 draws it ("Rendering"): each cell is a square that faces the eye,
// painted with a texture, or a point. Its density makes it white, opaque and large; no light goes through anything. The
// squares are blended from the front.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/scene/automaton.h"

namespace awan::upchurch {

// How a cell of density q is drawn.
struct CellStyle {
    // Of white, 0..1.
    double whiteness = 1;
    // Of the texture's most opaque point, or of a point.
    double opacity = 1;
    // Cells.
    double side = 1;
};
// The source says that a higher density is whiter, more opaque and larger: each is in proportion to it, as far as there
// is more. Of mode presence all three are the same for every cell.
CellStyle style_of(const AutomatonDrawing& drawing, double density);

// The axes of a billboard in the eye's frame (x to the right, y up, z forward), unit, for one that is seen at q:
//   look = camera - billboard,   right = up_camera x look,   up = look x right.
struct Axes {
    glm::dvec3 right, up;
};
Axes axes_of(const glm::dvec3& q);

// A texture and halves of it, down to one texel: rows from the top, opacities 0..1.
struct Painted {
    std::vector<std::vector<float>> levels;
    int side = 1;
};
Painted painted(std::vector<float> texels);
// Between texels, of the level whose texels are about `texels` of the largest apart. u, v: 0..1 from the top left;
// clear beyond.
float sample(const Painted& texture, int level, float u, float v);

// Of which of `count` textures a cell is, by its place (the source: "so that we do not have to store" it).
std::size_t texture_of_cell(std::size_t i, std::size_t j, std::size_t k, std::size_t count);

}  // namespace awan::upchurch
