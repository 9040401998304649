// The shaders' shared formulas as C++ functions: the very text that the GPU compiles, written in what GLSL and GLM
// have in common. In namespace awan::shader; float32 throughout, as there.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include "core/base/exact_math.h"

namespace awan::shader {
// GLSL has no `inline`: each file that includes this gets copies of its own.
namespace {

using glm::abs;
using glm::dot;
using glm::lessThan;
using glm::max;
using glm::mix;
using glm::sqrt;
using glm::vec3;
using glm::vec4;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
float exp(float x) {
    return exact::exp(x);
}
vec4 exp(const vec4& v) {
    return {exp(v.x), exp(v.y), exp(v.z), exp(v.w)};
}
#include "core/shaders/optics.glsl"
#include "core/shaders/phase.glsl"
#include "core/shaders/sky.glsl"
#pragma GCC diagnostic pop

}  // namespace
}  // namespace awan::shader
