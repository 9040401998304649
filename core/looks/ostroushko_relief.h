// The relief of a user's on the spheres of the look of Ostroushko et al. 2010: f(u, v, n) of (4), "represented
// analytically", as waves, or "sampling from the texture map".
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "core/scene/scene.h"
#include "core/scene/spheres.h"
#include "core/scene/texture.h"

namespace awan::looks {

struct Relief {
    SpheresBump bump;
    // Of the bump's texture; null: it has none.
    std::shared_ptr<const Texture> texture;

    // Whether the user says what it is. Else it is waves by chance (bumped(), ostroushko_shade.h).
    bool given() const { return texture != nullptr || !bump.waves.empty(); }
};
Relief relief_of(const SceneDraft& scene, const SpheresCloud& cloud);

// Its height in radii at u, v: 0..1 round the upright axis and from the top to the bottom.
double height_at(const Relief& relief, double u, double v);

// n' = f(u, v, n), by Blinn 1978: the normal less the relief's slope on the unit sphere. u = azimuth of n + a turn of
// the sphere's own (key), so that spheres are not alike. n, n': unit.
glm::dvec3 turned_normal(const Relief& relief, const glm::dvec3& normal, std::uint64_t key);

}  // namespace awan::looks
