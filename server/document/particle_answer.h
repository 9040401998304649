// The answer of /v1/particles read back: a document in which `particles` stands where `cubes` or `clouds` would.
#pragma once

#include <array>
#include <string>
#include <string_view>
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

// Such an answer on its way, in the outermost object of a document.
class AnswerInScene {
  public:
    // Where kAnsweredParticles go.
    ParticleAnswer answer;

    // What a key is: `particles`, the first time; what follows from them and is not read (`count`, `bounds`); neither.
    enum class Key { kNone, kParticles, kFollows };
    Key key(std::string_view name);

    // At the end of the object. other_clouds: it has `cubes` or `clouds`. True: the answer is the draft's one cloud
    // now; false: there was none. kInvalidScene where it cannot stand there.
    Result<bool> end(bool other_clouds, SceneDraft& draft);

  private:
    bool is_there_ = false;
    // A key that means something beside particles only, once it has come.
    std::string follows_;
};

// Reads ahead what is written as our own answers are (number_runs.h); how many.
std::size_t take_answered(TextCursor& cursor, ParticleAnswer& answer);

}  // namespace awan
