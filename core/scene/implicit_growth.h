// The particle system of an implicit cloud (implicit.h).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/scene/implicit_primitive.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

inline constexpr Range kGrowthSeconds =
    from_to(limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
inline constexpr Range kGrowthMotion = within(limits::kMaxGrowthMotion);
inline constexpr Range kGrowthRadius =
    from_to(limits::kMinImplicitRadius, limits::kMaxImplicitRadius / 10);

// What a growth is at one time, as ImplicitKey of a primitive. `center`, `radius` and `weight` are of the whole colony
// as it is seen then; the others act on the particles while they move, so what they did stays.
struct ImplicitGrowthKey {
    double time = 0;
    std::optional<glm::dvec3> center;
    std::optional<double> radius;
    std::optional<double> weight;
    std::optional<glm::dvec3> force;
    std::optional<double> turbulence;
    std::optional<double> drag;
    std::optional<double> rate;
};

inline constexpr Field kImplicitGrowthKeyFields[] = {
    field<&ImplicitGrowthKey::time>({.name = "time",
                                     .wanted = "a number (seconds)",
                                     .range = within(limits::kMaxTime),
                                     .required = true,
                                     .unit = "seconds",
                                     .says = "Seconds."}),
    field<&ImplicitGrowthKey::center>({.name = "center",
                                       .wanted = kPointWanted,
                                       .range = kImplicitPlace,
                                       .unit = "units",
                                       .says = "Where the middle of the whole colony is then.",
                                       .otherwise = "by the keys around"}),
    field<&ImplicitGrowthKey::radius>({.name = "radius",
                                       .wanted = "a number > 0",
                                       .range = kGrowthRadius,
                                       .unit = "units",
                                       .says = "The measure of the whole colony then.",
                                       .otherwise = "by the keys around"}),
    field<&ImplicitGrowthKey::weight>({.name = "weight",
                                       .wanted = "a number",
                                       .range = kImplicitWeight,
                                       .says = "Of each then.",
                                       .otherwise = "by the keys around"}),
    field<&ImplicitGrowthKey::force>(
        {.name = "force",
         .wanted = "[x, y, z]: three numbers (radii a second, each second)",
         .range = kGrowthMotion,
         .unit = "radii a second^2",
         .says = "The force then.",
         .otherwise = "by the keys around"}),
    field<&ImplicitGrowthKey::turbulence>({.name = "turbulence",
                                           .wanted = "a number >= 0",
                                           .range = from_to(0, limits::kMaxGrowthMotion),
                                           .unit = "radii a second^2",
                                           .says = "Of the force then.",
                                           .otherwise = "by the keys around"}),
    field<&ImplicitGrowthKey::drag>({.name = "drag",
                                     .wanted = "a number >= 0",
                                     .range = from_to(0, limits::kMaxGrowthMotion),
                                     .unit = "1/second",
                                     .says = "The drag then.",
                                     .otherwise = "by the keys around"}),
    field<&ImplicitGrowthKey::rate>({.name = "rate",
                                     .wanted = "a number >= 0 (children a second)",
                                     .range = from_to(0, 1000),
                                     .unit = "1/second",
                                     .says = "Children a second then.",
                                     .otherwise = "by the keys around"}),
};
static_assert(covers<ImplicitGrowthKey>(kImplicitGrowthKeyFields));
inline constexpr Table kImplicitGrowthKeyTable{.name = "ImplicitGrowthKey",
                                               .says = "What a growth is at one time.",
                                               .fields = kImplicitGrowthKeyFields,
                                               .standard = standard_of<ImplicitGrowthKey>};
template <>
inline const Table& table_of<ImplicitGrowthKey>() {
    return kImplicitGrowthKeyTable;
}

// The particle system whose particles are primitives (spheres): seeds rise and wander in a turbulent force, bear
// children as often as the turbulence where they are is strong, come to rest after their lifetime, and never die.
// Lengths are in `radius`.
struct ImplicitGrowth {
    std::uint64_t seeds = 12;
    std::uint64_t most = 50;
    double radius = 54;
    // Of a full-grown child.
    double shrink = 0.85;
    // Of each when full-grown.
    double weight = 1;
    glm::dvec3 center{0};
    glm::dvec3 spread{2.2, 0.15, 1.6};
    glm::dvec3 velocity{0, 0.03, 0};
    glm::dvec3 force{0, 0.006, 0};
    double turbulence = 0.05;
    double drag = 0.12;
    // They are full-grown halfway.
    double lifetime = 25;
    double rate = 0.175;
    double duration = 60;
    std::vector<ImplicitGrowthKey> keys{};
};

inline constexpr Field kImplicitGrowthFields[] = {
    field<&ImplicitGrowth::seeds>({.name = "seeds",
                                   .wanted = "an integer from 1 to 500",
                                   .counts = count_from_to(1, limits::kMaxGrowth),
                                   .says = "Particles at time 0."}),
    field<&ImplicitGrowth::most>({.name = "most",
                                  .wanted = "an integer from 1 to 500",
                                  .counts = count_from_to(1, limits::kMaxGrowth),
                                  .says = "Particles in all, at least `seeds`."}),
    field<&ImplicitGrowth::radius>(
        {.name = "radius",
         .wanted = "a number > 0",
         .range = kGrowthRadius,
         .unit = "units",
         .says = "Of a full-grown seed, units. Lengths below are in it."}),
    field<&ImplicitGrowth::shrink>({.name = "shrink",
                                    .wanted = "a number from 0.1 to 1",
                                    .range = from_to(0.1, 1),
                                    .says = "A child's radius over its parent's."}),
    field<&ImplicitGrowth::weight>(
        {.name = "weight", .wanted = "a number", .range = kImplicitWeight, .says = "Of each."}),
    field<&ImplicitGrowth::center>({.name = "center",
                                    .wanted = kPointWanted,
                                    .range = kImplicitPlace,
                                    .unit = "units",
                                    .says = "Of the seeds, units."}),
    field<&ImplicitGrowth::spread>({.name = "spread",
                                    .wanted = "[x, y, z]: three numbers >= 0 (radii)",
                                    .range = from_to(0, limits::kMaxGrowthSpread),
                                    .unit = "radii",
                                    .says = "Seeds stand within so much of it, either way."}),
    field<&ImplicitGrowth::velocity>({.name = "velocity",
                                      .wanted = "[x, y, z]: three numbers (radii a second)",
                                      .range = kGrowthMotion,
                                      .unit = "radii a second",
                                      .says = "At birth, radii a second."}),
    field<&ImplicitGrowth::force>(
        {.name = "force",
         .wanted = "[x, y, z]: three numbers (radii a second, each second)",
         .range = kGrowthMotion,
         .unit = "radii a second^2",
         .says = "Radii a second, each second."}),
    field<&ImplicitGrowth::turbulence>({.name = "turbulence",
                                        .wanted = "a number >= 0",
                                        .range = from_to(0, limits::kMaxGrowthMotion),
                                        .unit = "radii a second^2",
                                        .says = "Of the force."}),
    field<&ImplicitGrowth::drag>({.name = "drag",
                                  .wanted = "a number >= 0",
                                  .range = from_to(0, limits::kMaxGrowthMotion),
                                  .unit = "1/second",
                                  .says = "1/second."}),
    field<&ImplicitGrowth::lifetime>({.name = "lifetime",
                                      .wanted = "a number > 0 (seconds)",
                                      .range = kGrowthSeconds,
                                      .unit = "seconds",
                                      .says = "Seconds from birth to rest."}),
    field<&ImplicitGrowth::rate>(
        {.name = "rate",
         .wanted = "a number >= 0 (children a second)",
         .range = from_to(0, 1000),
         .unit = "1/second",
         .says = "Children a second, times the turbulence where a particle is."}),
    field<&ImplicitGrowth::duration>({.name = "duration",
                                      .wanted = "a number > 0 (seconds)",
                                      .range = kGrowthSeconds,
                                      .unit = "seconds",
                                      .says = "Seconds from time 0; then all rests."}),
    field<&ImplicitGrowth::keys>({.name = "keys",
                                  .wanted = "a list of keys",
                                  .counts = at_most(limits::kMaxImplicitKeys),
                                  .says = "In rising order of time.",
                                  .traceless = true}),
};
static_assert(covers<ImplicitGrowth>(kImplicitGrowthFields));
inline constexpr Table kImplicitGrowthTable{
    .name = "ImplicitGrowth",
    .says =
        "A particle system whose particles are primitives. Without `primitives` of its own a cloud "
        "has only these.",
    .fields = kImplicitGrowthFields,
    .standard = standard_of<ImplicitGrowth>};
template <>
inline const Table& table_of<ImplicitGrowth>() {
    return kImplicitGrowthTable;
}

}  // namespace awan
