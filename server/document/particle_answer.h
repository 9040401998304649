// The answer of /v1/particles read back: a document in which `particles` stands where `cubes` or `clouds` would.
#pragma once

#include <array>
#include <vector>

#include "core/base/result.h"
#include "core/scene/limits.h"
#include "core/scene/scene.h"
#include "server/document/number_runs.h"

namespace awan {

struct AnsweredParticle {
    glm::dvec3 center{0};
    double radius = 0;
    double density = 0;
    glm::dvec3 color{1};
};
inline constexpr Field kAnsweredParticleFields[] = {
    field<&AnsweredParticle::center>({.name = "center",
                                      .wanted = "[x, y, z]: three numbers",
                                      .range = within(limits::kMaxCoordinate),
                                      .required = true,
                                      .unit = "units",
                                      .says = "Scene units."}),
    field<&AnsweredParticle::radius>({.name = "radius",
                                      .wanted = "a number > 0",
                                      .range = from_to(limits::kMinRadius, limits::kMaxRadius),
                                      .required = true,
                                      .unit = "units",
                                      .says = "Scene units; s is half of it."}),
    field<&AnsweredParticle::density>({.name = "density",
                                       .wanted = "a number >= 0",
                                       .range = from_to(0, limits::kMaxDensity),
                                       .required = true,
                                       .unit = "1/unit",
                                       .says = "Extinction at the middle."}),
    field<&AnsweredParticle::color>({.name = "color",
                                     .wanted = "[r, g, b]: three numbers",
                                     .range = from_to(0, 1),
                                     .says = "Multiplies the albedo."}),
};
static_assert(covers<AnsweredParticle>(kAnsweredParticleFields));

inline constexpr Table kAnsweredParticleTable{.name = "Particle",
                                              .says = "One particle of an answer.",
                                              .fields = kAnsweredParticleFields,
                                              .standard = standard_of<AnsweredParticle>};
template <>
inline const Table& table_of<AnsweredParticle>() {
    return kAnsweredParticleTable;
}

struct ParticleAnswer {
    std::vector<AnsweredParticle> particles;
};
inline constexpr Field kAnsweredParticles =
    field<&ParticleAnswer::particles>({.name = "particles",
                                       .wanted = "a list of particles, as /v1/particles answers",
                                       .counts = at_most(limits::kMaxParticles),
                                       .says = "Ready particles, in place of cubes and clouds."});

// The answer as a scene's one cloud. The error's pointer is into the answer, "/particles/7/radius".
Result<Cloud> cloud_of(const ParticleAnswer& answer);

// Reads ahead what is written as our own answers are (number_runs.h); how many.
std::size_t take_answered(TextCursor& cursor, ParticleAnswer& answer);

}  // namespace awan
