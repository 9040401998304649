// Squash and stretch (core/scene/implicit_warps.h).
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/generate/implicit/elements.h"
#include "core/scene/implicit.h"

namespace awan::implicit {

// The amount at a time.
double squash_amount(const ImplicitSquash& squash, bool smooth, double time);

// Along `axis` (of any length > 0) `amount` times as long, across it 1 / sqrt(amount) times: the determinant is 1.
glm::dmat3 stretched_along(const glm::dvec3& axis, double amount);

// A box around what is in `box` when it is squashed about `at`, whatever the time.
Box squashed_at_all_times(const ImplicitSquash& squash, const glm::dvec3& at, const Box& box);

// A box around what `map`, about `at`, makes of `box`.
Box mapped(const glm::dmat3& map, const glm::dvec3& at, const Box& box);

}  // namespace awan::implicit
