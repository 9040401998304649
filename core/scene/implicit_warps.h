// What warps the space of an implicit cloud (implicit.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/scene/implicit_primitive.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// What an attractor is at one time. Members that are given at no key are as the attractor has them; between keys that
// give them they go on, as those of primitives do.
struct ImplicitAttractorKey {
    double time = 0;
    std::optional<glm::dvec3> at;
    std::optional<double> strength;
    std::optional<double> reach;
};

inline constexpr Range kAttraction = from_to(limits::kMinAttraction, limits::kMaxAttraction);

inline constexpr Field kImplicitAttractorKeyFields[] = {
    field<&ImplicitAttractorKey::time>({.name = "time",
                                        .wanted = "a number (seconds)",
                                        .range = within(limits::kMaxTime),
                                        .required = true,
                                        .unit = "seconds",
                                        .says = "Seconds."}),
    field<&ImplicitAttractorKey::at>({.name = "at",
                                      .wanted = kPointWanted,
                                      .range = kImplicitPlace,
                                      .unit = "units",
                                      .says = "Its place then.",
                                      .otherwise = "by the keys around"}),
    field<&ImplicitAttractorKey::strength>({.name = "strength",
                                            .wanted = "a number",
                                            .range = kAttraction,
                                            .says = "Its strength then.",
                                            .otherwise = "by the keys around"}),
    field<&ImplicitAttractorKey::reach>({.name = "reach",
                                         .wanted = "a number > 0",
                                         .range = kImplicitRadius,
                                         .unit = "units",
                                         .says = "Its reach then.",
                                         .otherwise = "by the keys around"}),
};
static_assert(covers<ImplicitAttractorKey>(kImplicitAttractorKeyFields));
inline constexpr Table kImplicitAttractorKeyTable{.name = "ImplicitAttractorKey",
                                                  .says = "What an attractor is at one time.",
                                                  .fields = kImplicitAttractorKeyFields,
                                                  .standard = standard_of<ImplicitAttractorKey>};
template <>
inline const Table& table_of<ImplicitAttractorKey>() {
    return kImplicitAttractorKeyTable;
}

// Draws matter towards (or, negative, pushes it from) a place: what is seen at p is what was at
// p + strength h(d / reach) (p - at), d the distance from `at`.
struct ImplicitAttractor {
    glm::dvec3 at{0};
    double strength = 0;
    double reach = 1;
    std::vector<ImplicitAttractorKey> keys{};
};

inline constexpr Field kImplicitAttractorFields[] = {
    field<&ImplicitAttractor::at>({.name = "at",
                                   .wanted = kPointWanted,
                                   .range = kImplicitPlace,
                                   .unit = "units",
                                   .says = "Its place."}),
    field<&ImplicitAttractor::strength>({.name = "strength",
                                         .wanted = "a number",
                                         .range = kAttraction,
                                         .required = true,
                                         .says = "Positive draws matter in."}),
    field<&ImplicitAttractor::reach>({.name = "reach",
                                      .wanted = "a number > 0",
                                      .range = kImplicitRadius,
                                      .required = true,
                                      .unit = "units",
                                      .says = "Beyond it moves nothing."}),
    field<&ImplicitAttractor::keys>({.name = "keys",
                                     .wanted = "a list of keys",
                                     .counts = at_most(limits::kMaxImplicitKeys),
                                     .says = "In rising order of time.",
                                     .traceless = true}),
};
static_assert(covers<ImplicitAttractor>(kImplicitAttractorFields));
inline constexpr Table kImplicitAttractorTable{
    .name = "ImplicitAttractor",
    .says = "Draws matter towards a place, or pushes it away.",
    .fields = kImplicitAttractorFields,
    .standard = standard_of<ImplicitAttractor>};
template <>
inline const Table& table_of<ImplicitAttractor>() {
    return kImplicitAttractorTable;
}

// The same of a vortex. Its axis goes straight from one key's to the next, and is that of the vortex where it would
// have no length.
struct ImplicitVortexKey {
    double time = 0;
    std::optional<glm::dvec3> at;
    std::optional<glm::dvec3> axis;
    std::optional<double> angle;
    std::optional<double> reach;
};

inline constexpr Field kImplicitVortexKeyFields[] = {
    field<&ImplicitVortexKey::time>({.name = "time",
                                     .wanted = "a number (seconds)",
                                     .range = within(limits::kMaxTime),
                                     .required = true,
                                     .unit = "seconds",
                                     .says = "Seconds."}),
    field<&ImplicitVortexKey::at>({.name = "at",
                                   .wanted = kPointWanted,
                                   .range = kImplicitPlace,
                                   .unit = "units",
                                   .says = "Its place then.",
                                   .otherwise = "by the keys around"}),
    field<&ImplicitVortexKey::axis>({.name = "axis",
                                     .wanted = kPointWanted,
                                     .range = kImplicitPlace,
                                     .says = "Its axis then, of any length > 0.",
                                     .otherwise = "by the keys around"}),
    field<&ImplicitVortexKey::angle>({.name = "angle",
                                      .wanted = "a number (degrees)",
                                      .range = within(limits::kMaxVortexAngle),
                                      .unit = "degrees",
                                      .says = "How far it turns then, in the middle.",
                                      .otherwise = "by the keys around"}),
    field<&ImplicitVortexKey::reach>({.name = "reach",
                                      .wanted = "a number > 0",
                                      .range = kImplicitRadius,
                                      .unit = "units",
                                      .says = "Its reach then.",
                                      .otherwise = "by the keys around"}),
};
static_assert(covers<ImplicitVortexKey>(kImplicitVortexKeyFields));
inline constexpr Table kImplicitVortexKeyTable{.name = "ImplicitVortexKey",
                                               .says = "What a vortex is at one time.",
                                               .fields = kImplicitVortexKeyFields,
                                               .standard = standard_of<ImplicitVortexKey>};
template <>
inline const Table& table_of<ImplicitVortexKey>() {
    return kImplicitVortexKeyTable;
}

// Turns matter about an axis through `at` by angle h(d / reach).
struct ImplicitVortex {
    glm::dvec3 at{0};
    glm::dvec3 axis{0, 1, 0};
    // Right-handed.
    double angle = 0;
    double reach = 1;
    std::vector<ImplicitVortexKey> keys{};
};

inline constexpr Field kImplicitVortexFields[] = {
    field<&ImplicitVortex::at>({.name = "at",
                                .wanted = kPointWanted,
                                .range = kImplicitPlace,
                                .unit = "units",
                                .says = "Its place."}),
    field<&ImplicitVortex::axis>({.name = "axis",
                                  .wanted = kPointWanted,
                                  .range = kImplicitPlace,
                                  .says = "Of any length > 0."}),
    field<&ImplicitVortex::angle>({.name = "angle",
                                   .wanted = "a number (degrees)",
                                   .range = within(limits::kMaxVortexAngle),
                                   .required = true,
                                   .unit = "degrees",
                                   .says = "Degrees, in the middle."}),
    field<&ImplicitVortex::reach>({.name = "reach",
                                   .wanted = "a number > 0",
                                   .range = kImplicitRadius,
                                   .required = true,
                                   .unit = "units",
                                   .says = "Beyond it turns nothing."}),
    field<&ImplicitVortex::keys>({.name = "keys",
                                  .wanted = "a list of keys",
                                  .counts = at_most(limits::kMaxImplicitKeys),
                                  .says = "In rising order of time.",
                                  .traceless = true}),
};
static_assert(covers<ImplicitVortex>(kImplicitVortexFields));
inline constexpr Table kImplicitVortexTable{.name = "ImplicitVortex",
                                            .says = "Turns matter about an axis.",
                                            .fields = kImplicitVortexFields,
                                            .standard = standard_of<ImplicitVortex>};
template <>
inline const Table& table_of<ImplicitVortex>() {
    return kImplicitVortexTable;
}

// A vector flow table: matter at p was moved there by the vector of p, trilinear between the table's, those of the
// faces outside.
struct ImplicitFlow {
    // Of the box; the first and the last vectors of a row stand on its faces.
    glm::dvec3 min{-1};
    glm::dvec3 max{1};
    // Whole numbers.
    glm::dvec3 size{0};
    std::vector<glm::dvec3> vectors;
};

inline constexpr Field kImplicitFlowFields[] = {
    field<&ImplicitFlow::min>({.name = "min",
                               .wanted = kPointWanted,
                               .range = kImplicitPlace,
                               .required = true,
                               .unit = "units",
                               .says = "Corner of the box."}),
    field<&ImplicitFlow::max>({.name = "max",
                               .wanted = kPointWanted,
                               .range = kImplicitPlace,
                               .required = true,
                               .unit = "units",
                               .says = "The corner opposite."}),
    field<&ImplicitFlow::size>(
        {.name = "size",
         .wanted = "[x, y, z]: three whole numbers, how many vectors along each axis",
         .range = from_to(1, static_cast<double>(limits::kMaxFlowVectors)),
         .whole = true,
         .required = true,
         .says = "Vectors along x, y, z."}),
    field<&ImplicitFlow::vectors>({.name = "vectors",
                                   .wanted = "a list of [x, y, z]",
                                   .range = within(limits::kMaxImplicitRadius),
                                   .counts = count_from_to(1, limits::kMaxFlowVectors),
                                   .required = true,
                                   .unit = "units",
                                   .says = "Units by which matter was moved there; x fastest, then "
                                           "y, then z; trilinear between."}),
};
static_assert(covers<ImplicitFlow>(kImplicitFlowFields));
inline constexpr Table kImplicitFlowTable{.name = "ImplicitFlow",
                                          .says = "A vector flow table.",
                                          .fields = kImplicitFlowFields,
                                          .standard = standard_of<ImplicitFlow>};
template <>
inline const Table& table_of<ImplicitFlow>() {
    return kImplicitFlowTable;
}

// What `amount` of a squash is at one time.
struct ImplicitSquashKey {
    double time = 0;
    double amount = 1;
};

inline constexpr Range kSquashAmount = from_to(limits::kMinSquash, limits::kMaxSquash);

inline constexpr Field kImplicitSquashKeyFields[] = {
    field<&ImplicitSquashKey::time>({.name = "time",
                                     .wanted = "a number (seconds)",
                                     .range = within(limits::kMaxTime),
                                     .required = true,
                                     .unit = "seconds",
                                     .says = "Seconds."}),
    field<&ImplicitSquashKey::amount>({.name = "amount",
                                       .wanted = "a number > 0",
                                       .range = kSquashAmount,
                                       .required = true,
                                       .says = "How many times as long it is then."}),
};
static_assert(covers<ImplicitSquashKey>(kImplicitSquashKeyFields));
inline constexpr Table kImplicitSquashKeyTable{.name = "ImplicitSquashKey",
                                               .says = "How far a squash goes at one time.",
                                               .fields = kImplicitSquashKeyFields,
                                               .standard = standard_of<ImplicitSquashKey>};
template <>
inline const Table& table_of<ImplicitSquashKey>() {
    return kImplicitSquashKeyTable;
}

// Squash and stretch (Bloomenthal et al. 1997, which Ebert 2002 names): the whole cloud, noise and all, is `amount`
// times as long along the axis through `at`, and 1 / sqrt(amount) times as wide across it, so that its volume and its
// mass stay.
struct ImplicitSquash {
    glm::dvec3 at{0};
    glm::dvec3 axis{0, 1, 0};
    double amount = 1;
    std::vector<ImplicitSquashKey> keys;
};

inline constexpr Field kImplicitSquashFields[] = {
    field<&ImplicitSquash::at>({.name = "at",
                                .wanted = kPointWanted,
                                .range = kImplicitPlace,
                                .unit = "units",
                                .says = "The place that stays."}),
    field<&ImplicitSquash::axis>({.name = "axis",
                                  .wanted = kPointWanted,
                                  .range = kImplicitPlace,
                                  .says = "Of any length > 0."}),
    field<&ImplicitSquash::amount>({.name = "amount",
                                    .wanted = "a number > 0",
                                    .range = kSquashAmount,
                                    .says =
                                        "How many times as long it is along the axis; across it "
                                        "1 / sqrt of that, so that the volume stays."}),
    field<&ImplicitSquash::keys>({.name = "keys",
                                  .wanted = "a list of keys",
                                  .counts = at_most(limits::kMaxImplicitKeys),
                                  .says = "Of the amount, in rising order of time."}),
};
static_assert(covers<ImplicitSquash>(kImplicitSquashFields));
inline constexpr Table kImplicitSquashTable{.name = "ImplicitSquash",
                                            .says = "Squash and stretch, the volume kept.",
                                            .fields = kImplicitSquashFields,
                                            .standard = standard_of<ImplicitSquash>};
template <>
inline const Table& table_of<ImplicitSquash>() {
    return kImplicitSquashTable;
}

}  // namespace awan
