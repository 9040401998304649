// A primitive of an implicit cloud (implicit.h), and what it is at other times.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

enum class ImplicitShape {
    // The closest point q is within `core` of the centre.
    kSphere,
    // A sphere scaled by `radii`.
    kEllipsoid,
    // Solid, flat ends at two `points`, of radius `core`.
    kCylinder,
    // A skeleton: q is within `core` of the line through `points`.
    kSegment,
};
inline constexpr const char* kImplicitShapeWords[] = {"sphere", "ellipsoid", "cylinder", "segment"};

inline constexpr Range kImplicitPlace = within(limits::kMaxImplicitCoordinate);
inline constexpr Range kImplicitRadius =
    from_to(limits::kMinImplicitRadius, limits::kMaxImplicitRadius);
inline constexpr Range kImplicitWeight = within(limits::kMaxImplicitWeight);
inline constexpr Range kImplicitRadii =
    from_to(limits::kMinImplicitRadii, limits::kMaxImplicitRadii);
inline constexpr const char* kRadiiWanted = "[x, y, z]: three numbers > 0 (times the radius)";
inline constexpr const char* kPointWanted = "[x, y, z]: three numbers";

// What is given holds at that time; between keys that have it a value is interpolated, before the first and after the
// last it holds.
struct ImplicitKey {
    // The keys of a primitive rise.
    double time = 0;
    std::optional<glm::dvec3> center;
    std::optional<double> radius;
    std::optional<double> weight;
    // As the primitive's own, and of the shapes that have them.
    std::optional<glm::dvec3> radii;
    std::optional<double> core;
    // As many as the primitive's.
    std::optional<std::vector<glm::dvec3>> points;
    std::optional<glm::dvec3> rotate;
};

inline constexpr Field kImplicitKeyFields[] = {
    field<&ImplicitKey::time>({.name = "time",
                               .wanted = "a number (seconds)",
                               .range = within(limits::kMaxTime),
                               .required = true,
                               .unit = "seconds",
                               .says = "Seconds."}),
    field<&ImplicitKey::center>({.name = "center",
                                 .wanted = kPointWanted,
                                 .range = kImplicitPlace,
                                 .unit = "units",
                                 .says = "Where it is then.",
                                 .otherwise = "by the keys around"}),
    field<&ImplicitKey::radius>({.name = "radius",
                                 .wanted = "a number > 0",
                                 .range = kImplicitRadius,
                                 .unit = "units",
                                 .says = "Its radius of influence then.",
                                 .otherwise = "by the keys around"}),
    field<&ImplicitKey::weight>({.name = "weight",
                                 .wanted = "a number",
                                 .range = kImplicitWeight,
                                 .says = "Its weight then.",
                                 .otherwise = "by the keys around"}),
    field<&ImplicitKey::radii>({.name = "radii",
                                .wanted = kRadiiWanted,
                                .range = kImplicitRadii,
                                .says = "An ellipsoid's semi-axes over its radius then.",
                                .otherwise = "by the keys around"}),
    field<&ImplicitKey::core>({.name = "core",
                               .wanted = "a number >= 0",
                               .range = from_to(0, limits::kMaxImplicitRadius),
                               .unit = "units",
                               .says = "How far it is solid then.",
                               .otherwise = "by the keys around"}),
    field<&ImplicitKey::points>({.name = "points",
                                 .wanted = "a list of [x, y, z]",
                                 .range = kImplicitPlace,
                                 .counts = at_most(limits::kMaxImplicitElements + 1),
                                 .unit = "units",
                                 .says =
                                     "Where its ends or the points of its skeleton are then; as "
                                     "many as its `points`.",
                                 .otherwise = "by the keys around"}),
    field<&ImplicitKey::rotate>({.name = "rotate",
                                 .wanted = "[x, y, z]: three numbers (degrees)",
                                 .range = within(limits::kMaxAngle),
                                 .unit = "degrees",
                                 .says = "How it is turned then; each angle goes on by itself.",
                                 .otherwise = "by the keys around"}),
};
static_assert(covers<ImplicitKey>(kImplicitKeyFields));
inline constexpr Table kImplicitKeyTable{.name = "ImplicitKey",
                                         .says = "What a primitive is at one time.",
                                         .fields = kImplicitKeyFields,
                                         .standard = standard_of<ImplicitKey>};
template <>
inline const Table& table_of<ImplicitKey>() {
    return kImplicitKeyTable;
}

struct ImplicitPrimitive {
    ImplicitShape shape = ImplicitShape::kSphere;
    glm::dvec3 center{0};
    double radius = 1;
    glm::dvec3 radii{1};
    double core = 0;
    std::vector<glm::dvec3> points;
    // Turns ellipsoids and points.
    glm::dvec3 rotate{0};
    double weight = 1;
    std::vector<ImplicitKey> keys;
};

inline constexpr Field kImplicitPrimitiveFields[] = {
    field<&ImplicitPrimitive::shape>(
        {.name = "shape", .words = kImplicitShapeWords, .says = "From what distances are taken."}),
    field<&ImplicitPrimitive::center>({.name = "center",
                                       .wanted = kPointWanted,
                                       .range = kImplicitPlace,
                                       .unit = "units",
                                       .says = "Units."}),
    field<&ImplicitPrimitive::radius>({.name = "radius",
                                       .wanted = "a number > 0",
                                       .range = kImplicitRadius,
                                       .unit = "units",
                                       .says = "Of influence, from the primitive outward; units."}),
    field<&ImplicitPrimitive::radii>({.name = "radii",
                                      .wanted = kRadiiWanted,
                                      .range = kImplicitRadii,
                                      .says = "An ellipsoid's semi-axes over `radius`."}),
    field<&ImplicitPrimitive::core>({.name = "core",
                                     .wanted = "a number >= 0",
                                     .range = from_to(0, limits::kMaxImplicitRadius),
                                     .unit = "units",
                                     .says = "As far as that from its middle, line or axis a "
                                             "sphere, segment or cylinder is solid; units."}),
    // A skeleton of n pieces has n + 1 points.
    field<&ImplicitPrimitive::points>(
        {.name = "points",
         .wanted = "a list of [x, y, z]",
         .range = kImplicitPlace,
         .counts = at_most(limits::kMaxImplicitElements + 1),
         .unit = "units",
         .says = "From `center`: the two ends of a cylinder, two or more points of a segment."}),
    field<&ImplicitPrimitive::rotate>({.name = "rotate",
                                       .wanted = "[x, y, z]: three numbers (degrees)",
                                       .range = within(limits::kMaxAngle),
                                       .unit = "degrees",
                                       .says = "Degrees about x, then y, then z."}),
    field<&ImplicitPrimitive::weight>({.name = "weight",
                                       .wanted = "a number",
                                       .range = kImplicitWeight,
                                       .says = "Negative takes away."}),
    field<&ImplicitPrimitive::keys>({.name = "keys",
                                     .wanted = "a list of keys",
                                     .counts = at_most(limits::kMaxImplicitKeys),
                                     .says = "In rising order of time."}),
};
static_assert(covers<ImplicitPrimitive>(kImplicitPrimitiveFields));
inline constexpr Table kImplicitPrimitiveTable{
    .name = "ImplicitPrimitive",
    .says = "A weight and a density that falls off from a shape.",
    .fields = kImplicitPrimitiveFields,
    .standard = standard_of<ImplicitPrimitive>};
template <>
inline const Table& table_of<ImplicitPrimitive>() {
    return kImplicitPrimitiveTable;
}

// One of the rows of a particle system that was run elsewhere: where particle `id` is at a time, a sphere. Between its
// rows it goes on as between keys; after its last it rests and stays, as Ebert's do; before its first it is not there,
// and it grows in from the time before in the table.
struct ImplicitParticle {
    double time = 0;
    std::uint64_t id = 0;
    glm::dvec3 center{0};
    double radius = 1;
    double weight = 1;
};

inline constexpr Field kImplicitParticleFields[] = {
    field<&ImplicitParticle::time>({.name = "time",
                                    .wanted = "a number (seconds)",
                                    .range = within(limits::kMaxTime),
                                    .required = true,
                                    .unit = "seconds",
                                    .says = "Seconds."}),
    field<&ImplicitParticle::id>({.name = "id",
                                  .wanted = "an integer >= 0",
                                  .required = true,
                                  .says = "Which particle it is: rows of one are one sphere."}),
    field<&ImplicitParticle::center>({.name = "center",
                                      .wanted = kPointWanted,
                                      .range = kImplicitPlace,
                                      .required = true,
                                      .unit = "units",
                                      .says = "Where it is then."}),
    field<&ImplicitParticle::radius>({.name = "radius",
                                      .wanted = "a number > 0",
                                      .range = kImplicitRadius,
                                      .required = true,
                                      .unit = "units",
                                      .says = "Its radius of influence then."}),
    field<&ImplicitParticle::weight>({.name = "weight",
                                      .wanted = "a number",
                                      .range = kImplicitWeight,
                                      .says = "Its weight then."}),
};
static_assert(covers<ImplicitParticle>(kImplicitParticleFields));
inline constexpr Table kImplicitParticleTable{
    .name = "ImplicitParticle",
    .says = "A particle of an outside particle system at one time.",
    .fields = kImplicitParticleFields,
    .standard = standard_of<ImplicitParticle>};
template <>
inline const Table& table_of<ImplicitParticle>() {
    return kImplicitParticleTable;
}

}  // namespace awan
