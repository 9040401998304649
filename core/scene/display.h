// What a picture shows of a scene: its light, or as the editor of Sunar et al. 2005 does, what it is made of.
#pragma once

namespace awan {

// kLit: the clouds, by light. The others are flat drawings (core/draw/display.h): kCubes the cubes as solids, kQuads
// their textures pasted on the cubes' faces, kBillboards on the squares that face the eye, kBoundingBoxes the edges of
// the cubes, kShowTexture each cube's texture by itself. kEllipsoids: as in Upchurch 2009, the ellipsoids of automata
// and the boundaries of their grids.
enum class Display { kLit, kCubes, kQuads, kBillboards, kBoundingBoxes, kShowTexture, kEllipsoids };
inline constexpr const char* kDisplayWords[] = {
    "lit", "cubes", "quads", "billboards", "bounding_boxes", "show_texture", "ellipsoids"};

}  // namespace awan
