// What a displayed scene is drawn of, as triangles: geometry only, no GL.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Laid out as in display.glsl.
struct DisplayVertex {
    glm::vec4 place, color, texture;
};

// Three vertices a triangle. `solid` hides what is behind it, `sheer` is blended over it, the farthest first.
struct DisplayShapes {
    std::vector<DisplayVertex> solid, sheer;
};

// A box with its corners in the scene: bit 0 of a corner's number is x, bit 1 y, bit 2 z.
struct DisplayBox {
    std::array<glm::dvec3, 8> corner;
    // The place of its texture in textures_of(scene); -1: it has none.
    int texture = -1;
    glm::dvec3 middle() const { return 0.5 * (corner[0] + corner[7]); }
};

// An ellipsoid of an automaton, in the scene: its middle, and from there to where its axes end.
struct DisplayEllipsoid {
    glm::dvec3 center;
    std::array<glm::dvec3, 3> axis;
    // It is the one that is shown in red.
    bool chosen = false;
};

// Of all automata, where the wind has taken them, if that is what is displayed. Errors: of the deadline.
Result<std::vector<DisplayEllipsoid>> display_ellipsoids(const Scene& scene,
                                                         const Deadline& deadline);

// The cubes of clouds of cubes; of others the box around their particles, where they have any. Of automata whose
// ellipsoids are displayed: their grids.
std::vector<DisplayBox> display_boxes(const Scene& scene, const ParticleSet& particles);

// Everything that scene->display asks for but kBillboards' squares. scene->display is not kLit.
DisplayShapes display_shapes(const Scene& scene, const std::vector<DisplayBox>& boxes,
                             const std::vector<DisplayEllipsoid>& ellipsoids, const View& view);

// Particles from the eye outward, those before it. order[n]: which; for display_billboards.
std::vector<std::uint32_t> display_order(const ParticleSet& particles, const View& view);

// The squares of order[first] .. order[last - 1], the farthest first; of a particle without paint, of layer `plain`.
std::vector<DisplayVertex> display_billboards(const Scene& scene, const ParticleSet& particles,
                                              const std::vector<DisplayBox>& boxes,
                                              const View& view,
                                              const std::vector<std::uint32_t>& order,
                                              std::size_t first, std::size_t last, int plain);

}  // namespace awan
