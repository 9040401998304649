// The shaders' shared formulas as C++ functions: the very text that the GPU compiles, written in what GLSL and GLM
// have in common. In namespace awan::shader; float32 throughout, as there.
#pragma once

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

namespace awan::shader {
// GLSL has no `inline`: each file that includes this gets copies of its own.
namespace {

using glm::abs;
using glm::dot;
using glm::exp;
using glm::lessThan;
using glm::max;
using glm::mix;
using glm::sqrt;
using glm::vec3;
using glm::vec4;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "core/shaders/optics.glsl"
#include "core/shaders/phase.glsl"
#include "core/shaders/sky.glsl"
#pragma GCC diagnostic pop

}  // namespace
}  // namespace awan::shader
