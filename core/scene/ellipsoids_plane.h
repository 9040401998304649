// The textured plane of a cloud of model "ellipsoids": Gardner's skies without clouds of their own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/scene/ellipsoids_texture.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Another pattern over a part of the plane: an ellipse about (x, z).
struct PlanePattern {
    double x = 0;
    double z = 0;
    double radius_x = 40;
    double radius_z = 40;
    double edge = 0.4;
    double threshold = 0.3;
    double range = 0.3;
    SineTexture texture{TextureForm::kClean, 6, 0.6, 0.6, 1, {}};
};

inline constexpr Range kPatternRadius = from_to(limits::kMinPlaneExtent, limits::kMaxPlaneExtent);

inline constexpr Field kPlanePatternFields[] = {
    field<&PlanePattern::x>({.name = "x",
                             .wanted = "a number",
                             .range = within(limits::kMaxEllipsoidCoordinate),
                             .unit = "units",
                             .says = "Of its middle."}),
    field<&PlanePattern::z>({.name = "z",
                             .wanted = "a number",
                             .range = within(limits::kMaxEllipsoidCoordinate),
                             .unit = "units",
                             .says = "Of its middle."}),
    field<&PlanePattern::radius_x>({.name = "radius_x",
                                    .wanted = "a number > 0",
                                    .range = kPatternRadius,
                                    .unit = "units",
                                    .says = "How far it reaches along x."}),
    field<&PlanePattern::radius_z>({.name = "radius_z",
                                    .wanted = "a number > 0",
                                    .range = kPatternRadius,
                                    .unit = "units",
                                    .says = "And along z."}),
    field<&PlanePattern::edge>({.name = "edge",
                                .wanted = "a number from 0 to 1",
                                .range = from_to(0, 1),
                                .says = "The share of its radii over which it passes into what is "
                                        "around."}),
    field<&PlanePattern::threshold>({.name = "threshold",
                                     .wanted = "a number (of texture, T1)",
                                     .range = kTextureThreshold,
                                     .says = "Of its texture, T1."}),
    field<&PlanePattern::range>({.name = "range",
                                 .wanted = "a number > 0 (of texture, D)",
                                 .range = kTextureRange,
                                 .says = "Of its texture, D."}),
    field<&PlanePattern::texture>(
        {.name = "texture", .wanted = "an object", .says = "Its own, over x and z."}),
};
static_assert(covers<PlanePattern>(kPlanePatternFields));
inline constexpr Table kPlanePatternTable{.name = "EllipsoidsPattern",
                                          .says =
                                              "A pattern over a part of the sky plane; later ones "
                                              "lie over earlier ones.",
                                          .fields = kPlanePatternFields,
                                          .standard = standard_of<PlanePattern>};
template <>
inline const Table& table_of<PlanePattern>() {
    return kPlanePatternTable;
}

// TR = clamp(1 - (It - T1)/D, 0, 1). Endless in the look; in the volume a square slab around the cloud's origin.
struct SkyPlane {
    double altitude = 10;
    double extent = 120;
    double thickness = 1.5;
    double threshold = 0.3;
    double range = 0.3;
    double density = 10;
    std::uint64_t resolution = 128;
    SineTexture texture{TextureForm::kClean, 6, 0.3, 0.3, 1, {}};
    std::vector<PlanePattern> patterns;
    // How far from the eye, along the ground, the look's plane has faded out; it begins to half way there. None: it
    // does not.
    std::optional<double> horizon;
    // Between which TR stays.
    double least = 0;
    double most = 1;
};

inline constexpr Field kSkyPlaneFields[] = {
    field<&SkyPlane::altitude>({.name = "altitude",
                                .wanted = "a number",
                                .range = within(limits::kMaxEllipsoidCoordinate),
                                .unit = "units",
                                .says = "Of the plane, along y."}),
    field<&SkyPlane::extent>(
        {.name = "extent",
         .wanted = "a number > 0",
         .range = from_to(limits::kMinPlaneExtent, limits::kMaxPlaneExtent),
         .unit = "units",
         .says = "Side of the square that is matter; in the look the plane has no end."}),
    field<&SkyPlane::thickness>({.name = "thickness",
                                 .wanted = "a number >= 0",
                                 .range = from_to(0, limits::kMaxPlaneExtent),
                                 .unit = "units",
                                 .says = "Of the matter, at most extent."}),
    field<&SkyPlane::threshold>({.name = "threshold",
                                 .wanted = "a number (of texture, T1)",
                                 .range = kTextureThreshold,
                                 .says = "Of texture, T1: below it there is no cloud."}),
    field<&SkyPlane::range>({.name = "range",
                             .wanted = "a number > 0 (of texture, D)",
                             .range = kTextureRange,
                             .says = "Of texture, D: opaque from the threshold and this on."}),
    field<&SkyPlane::density>({.name = "density",
                               .wanted = "a number >= 0 (multiplies the cloud's)",
                               .range = from_to(0, limits::kMaxDensity),
                               .says = "Multiplies the cloud's."}),
    field<&SkyPlane::resolution>(
        {.name = "resolution",
         .wanted = "an integer from 8 to 1000 (cells along a side)",
         .counts = count_from_to(limits::kMinLatticeResolution, limits::kMaxPlaneResolution),
         .says = "Cells along a side."}),
    field<&SkyPlane::texture>(
        {.name = "texture", .wanted = "an object", .says = "The plane's own, over x and z."}),
    field<&SkyPlane::patterns>({.name = "patterns",
                                .wanted = "a list of patterns",
                                .counts = at_most(limits::kMaxPlanePatterns),
                                .says = "Other patterns in parts of the plane."}),
    field<&SkyPlane::horizon>({.name = "horizon",
                               .wanted = "a number > 0 (units from the eye)",
                               .range = kPatternRadius,
                               .unit = "units",
                               .says = "How far from the eye the plane has faded out in the look "
                                       "gardner.",
                               .otherwise = "it has no end"}),
    field<&SkyPlane::least>({.name = "translucence_min",
                             .wanted = "a number from 0 to 1",
                             .range = from_to(0, 1),
                             .says = "Its translucence is at least this; at most "
                                     "translucence_max."}),
    field<&SkyPlane::most>({.name = "translucence_max",
                            .wanted = "a number from 0 to 1",
                            .range = from_to(0, 1),
                            .says = "And at most this."}),
};
static_assert(covers<SkyPlane>(kSkyPlaneFields));
inline constexpr Table kSkyPlaneTable{.name = "EllipsoidsPlane",
                                      .says = "A textured plane of high cloud.",
                                      .fields = kSkyPlaneFields,
                                      .standard = standard_of<SkyPlane>};
template <>
inline const Table& table_of<SkyPlane>() {
    return kSkyPlaneTable;
}

}  // namespace awan
