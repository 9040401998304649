// A cloud of a scene: what it is made of, where it stands, how it moves.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// How a cube is filled (core/generate/cubes.h).
enum class Fill { kUniform, kGardner, kPrinted, kCumulus, kStratus };
inline constexpr const char* kFillWords[] = {"uniform", "gardner", "printed", "cumulus", "stratus"};

struct Cube {
    std::uint64_t particles = 0;
    glm::dvec3 size{0};
    glm::dvec3 center{0};
    double radius = 0;
    double density = 1;
    // What it is painted with (core/scene/texture.h), and how many billboards it has then in the place of particles.
    // Where not given, the cloud's hold.
    std::optional<std::string> texture;
    std::optional<std::uint64_t> billboards{};
};

inline constexpr Field kCubeFields[] = {
    field<&Cube::particles>({.name = "particles",
                             .wanted = "an integer >= 0",
                             .counts = at_most(limits::kMaxParticles),
                             .required = true,
                             .says = "How many."}),
    field<&Cube::size>({.name = "size",
                        .wanted = "[x, y, z]: three numbers",
                        .range = from_to(limits::kMinLength, limits::kMaxLength),
                        .required = true,
                        .unit = "units",
                        .says = "Side lengths, scene units."}),
    field<&Cube::center>({.name = "center",
                          .wanted = "[x, y, z]: three numbers",
                          .range = within(limits::kMaxCoordinate),
                          .required = true,
                          .unit = "units",
                          .says = "Scene units."}),
    field<&Cube::radius>({.name = "radius",
                          .wanted = "a number > 0",
                          .range = from_to(limits::kMinRadius, limits::kMaxRadius),
                          .required = true,
                          .unit = "units",
                          .says = "The largest particle radius in it, scene units; s of a particle "
                                  "is half its radius."}),
    field<&Cube::density>({.name = "density",
                           .wanted = "a number >= 0 (multiplies the cloud's)",
                           .range = from_to(0, limits::kMaxDensity),
                           .says = "Multiplies the cloud's."}),
    field<&Cube::texture>({.name = "texture",
                           .wanted = "the name of a texture",
                           .says = "What its billboards are painted with: soft, puff, "
                                   "cauliflower, torn, wisp, hard, one that was uploaded, or a "
                                   "texture's hash; none: they are particles.",
                           .otherwise = "the cloud's"}),
    field<&Cube::billboards>({.name = "billboards",
                              .wanted = "an integer >= 0",
                              .counts = at_most(limits::kMaxParticles),
                              .says = "How many billboards a cube with a texture has, in the place "
                                      "of its particles.",
                              .otherwise = "the cloud's"}),
};
static_assert(covers<Cube>(kCubeFields));

inline constexpr Table kCubeTable{.name = "Cube",
                                  .says = "A box of particles.",
                                  .fields = kCubeFields,
                                  .standard = standard_of<Cube>};
template <>
inline const Table& table_of<Cube>() {
    return kCubeTable;
}

// Particles that come ready-made. All lists are as long as `positions`, or empty for the default.
struct ReadyParticles {
    std::vector<glm::dvec3> positions;
    std::vector<float> radii;
    // Each multiplies the cloud's density; default 1.
    std::vector<float> densities;
    // 0..1, multiply the albedo; default white.
    std::vector<glm::vec3> colors;
};

enum class CloudModel { kCubes, kParticles, kAutomaton, kSpheres, kImplicit, kEllipsoids };
inline constexpr const char* kCloudModelWords[] = {"cubes",   "particles", "automaton",
                                                   "spheres", "implicit",  "ellipsoids"};

// The other models, each in a header of its own (automaton.h, ...).
struct AutomatonCloud;
struct SpheresCloud;
struct ImplicitCloud;
struct EllipsoidsCloud;
template <>
const Table& table_of<AutomatonCloud>();
template <>
const Table& table_of<SpheresCloud>();
template <>
const Table& table_of<ImplicitCloud>();
template <>
const Table& table_of<EllipsoidsCloud>();

// A point p of the model stands at translate + rotate_y(scale * p) in the scene; radii scale too, extinction (1/unit)
// does not: a cloud made twice as large is twice as deep.
struct Cloud {
    CloudModel model = CloudModel::kCubes;
    // Of model kCubes.
    std::vector<Cube> cubes;
    // Of model kParticles.
    ReadyParticles ready;
    // Of the model that it is, the others null.
    std::shared_ptr<const AutomatonCloud> automaton;
    std::shared_ptr<const SpheresCloud> spheres;
    std::shared_ptr<const ImplicitCloud> implicit;
    std::shared_ptr<const EllipsoidsCloud> ellipsoids;
    glm::dvec3 velocity{0};
    glm::dvec3 translate{0};
    double scale = 1;
    double rotate_y = 0;
    // Where not given, the scene's holds.
    std::optional<Fill> fill;
    std::optional<double> density;
    // Its density is what makes it deep enough (core/generate/auto_density.h), whatever its model; the scene's own
    // "auto" leaves procedural models but automata at kDefaultDensity.
    bool auto_density = false;
    std::optional<std::uint64_t> seed;
    std::optional<std::string> texture;
    std::optional<std::uint64_t> billboards;
};

// Its table is in cloud.cpp, as it needs the models'.
template <>
const Table& table_of<Cloud>();

// Of the models automaton, spheres, implicit and ellipsoids.
bool is_procedural(const Cloud& cloud);

// No more particles are made of a cloud that is_procedural(). 0 for others.
std::uint64_t most_particles(const Cloud& cloud);

}  // namespace awan
