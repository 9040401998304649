// What an implicit cloud as a whole (implicit.h) is at one time.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/scene/implicit_primitive.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// As ImplicitKey, of the cloud's own parameters.
struct ImplicitCloudKey {
    double time = 0;
    std::optional<double> amount;
    std::optional<double> exponent;
    std::optional<double> blend;
    std::optional<double> displacement;
    std::optional<double> noise_size;
    std::optional<double> gain;
    std::optional<double> stretch;
    std::optional<glm::dvec3> jet;
    std::optional<double> jet_turbulence;
    std::optional<double> warp;
    std::optional<double> ripple_depth;
    std::optional<double> ripple_turbulence;
    std::optional<double> base;
};

inline constexpr Field kImplicitCloudKeyFields[] = {
    field<&ImplicitCloudKey::time>({.name = "time",
                                    .wanted = "a number (seconds)",
                                    .range = within(limits::kMaxTime),
                                    .required = true,
                                    .unit = "seconds",
                                    .says = "Seconds."}),
    field<&ImplicitCloudKey::amount>({.name = "amount",
                                      .wanted = "a number >= 0",
                                      .range = from_to(0, limits::kMaxImplicitAmount),
                                      .says = "p1 then.",
                                      .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::exponent>(
        {.name = "exponent",
         .wanted = "a number > 0",
         .range = from_to(limits::kMinImplicitExponent, limits::kMaxImplicitExponent),
         .says = "p2 then.",
         .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::blend>({.name = "blend",
                                     .wanted = "a number from 0 to 1",
                                     .range = from_to(0, 1),
                                     .says = "p3 then.",
                                     .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::displacement>({.name = "displacement",
                                            .wanted = "a number >= 0 (mean radii)",
                                            .range = from_to(0, limits::kMaxDisplacement),
                                            .unit = "mean radii",
                                            .says = "p4 then.",
                                            .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::noise_size>(
        {.name = "noise_size",
         .wanted = "a number > 0 (mean radii)",
         .range = from_to(limits::kMinNoiseSize, limits::kMaxNoiseSize),
         .unit = "mean radii",
         .says = "The size of the largest bumps then.",
         .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::gain>(
        {.name = "gain",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "Strength of an octave over that of the one before, then.",
         .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::stretch>({.name = "stretch",
                                       .wanted = "a number >= 1",
                                       .range = from_to(1, limits::kMaxStretch),
                                       .says = "Of the noise along the jet stream, then.",
                                       .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::jet>({.name = "jet",
                                   .wanted = "[x, y, z]: three numbers (mean radii)",
                                   .range = within(limits::kMaxJet),
                                   .unit = "mean radii",
                                   .says = "The jet stream then.",
                                   .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::jet_turbulence>({.name = "jet_turbulence",
                                              .wanted = "a number >= 0",
                                              .range = from_to(0, 10),
                                              .says = "Of the jet stream, then.",
                                              .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::warp>(
        {.name = "warp",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "What share of the jet stream, flow, attractors and vortices there is then; times "
                 "that of `warp_from` and `warp_to`.",
         .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::ripple_depth>({.name = "ripple_depth",
                                            .wanted = "a number from 0 to 1",
                                            .range = from_to(0, 1),
                                            .says = "How much of the density the waves take then.",
                                            .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::ripple_turbulence>({.name = "ripple_turbulence",
                                                 .wanted = "a number >= 0 (radians)",
                                                 .range = from_to(0, 100),
                                                 .unit = "radians",
                                                 .says = "Of the waves, then.",
                                                 .otherwise = "by the keys around"}),
    field<&ImplicitCloudKey::base>({.name = "base",
                                    .wanted = "a number (height of a flat base)",
                                    .range = kImplicitPlace,
                                    .unit = "units",
                                    .says = "Height of the flat base then.",
                                    .otherwise = "by the keys around"}),
};
static_assert(covers<ImplicitCloudKey>(kImplicitCloudKeyFields));
inline constexpr Table kImplicitCloudKeyTable{.name = "ImplicitCloudKey",
                                              .says = "What the cloud is at one time.",
                                              .fields = kImplicitCloudKeyFields,
                                              .standard = standard_of<ImplicitCloudKey>};
template <>
inline const Table& table_of<ImplicitCloudKey>() {
    return kImplicitCloudKeyTable;
}

}  // namespace awan
