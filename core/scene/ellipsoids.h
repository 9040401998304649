// What a cloud of model "ellipsoids" is: Gardner 1985, "Visual simulation of clouds": a textured sky
// plane and ellipsoids whose shading and translucence a sum of sines modulates.
//
// Gardner's axes have Z up; ours have y up: his X, Y, Z are our x, z, y. A formation that moves apart from the others
// is a cloud of its own, with a velocity.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/scene/cloud.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// How the texturing function is taken (core/generate/ellipsoids/texture.h says what differs and why).
enum class TextureForm { kClean, kPrinted };
inline constexpr const char* kTextureFormWords[] = {"clean", "printed"};

// T(X,Y,Z) = k sum Ci [sin(FXi X + PXi) + T0] * sum Ci [sin(FYi Y + PYi) + T0], 0..1.
struct SineTexture {
    TextureForm form = TextureForm::kClean;
    // Of either sum; Gardner 1985 has 4 to 7.
    std::uint64_t terms = 6;
    double frequency_x = 0.9;
    double frequency_z = 0.9;
    // T0, "controls the contrast".
    double offset = 1;
    bool operator==(const SineTexture&) const = default;
};

inline constexpr Range kTextureFrequency =
    from_to(limits::kMinTextureFrequency, limits::kMaxTextureFrequency);

inline constexpr Field kSineTextureFields[] = {
    field<&SineTexture::form>(
        {.name = "form",
         .words = kTextureFormWords,
         .says = "printed: with the phases as Rekawan quotes them, and negative factors."}),
    field<&SineTexture::terms>({.name = "terms",
                                .wanted = "an integer from 1 to 8",
                                .counts = count_from_to(1, limits::kMaxTextureTerms),
                                .says = "Of either sum."}),
    field<&SineTexture::frequency_x>({.name = "frequency_x",
                                      .wanted = "a number > 0 (radians/unit)",
                                      .range = kTextureFrequency,
                                      .unit = "radians/unit",
                                      .says = "FX1, radians/unit, along x and upward."}),
    field<&SineTexture::frequency_z>({.name = "frequency_z",
                                      .wanted = "a number > 0 (radians/unit)",
                                      .range = kTextureFrequency,
                                      .unit = "radians/unit",
                                      .says = "FY1, radians/unit, along z."}),
    field<&SineTexture::offset>({.name = "offset",
                                 .wanted = "a number >= 0 (T0)",
                                 .range = from_to(0, limits::kMaxTextureOffset),
                                 .says = "T0: the larger, the less contrast."}),
};
static_assert(covers<SineTexture>(kSineTextureFields));
inline constexpr Table kSineTextureTable{
    .name = "EllipsoidsTexture",
    .says = "k sum Ci [sin(FXi X + PXi) + T0] sum Ci [sin(FYi Y + PYi) + T0], from 0 to 1.",
    .fields = kSineTextureFields,
    .standard = standard_of<SineTexture>};
template <>
inline const Table& table_of<SineTexture>() {
    return kSineTextureTable;
}

// Intensity I = (1-a){(1-t)[(1-s) Id + s Is] + t It} + a.
struct SineShading {
    double specular = 0.1;
    double texture = 0.35;
    double ambient = 0.25;
    // Phong's; Gardner 1985 gives none.
    double shininess = 4;
};

inline constexpr Field kSineShadingFields[] = {
    field<&SineShading::specular>({.name = "specular",
                                   .wanted = "a number from 0 to 1",
                                   .range = from_to(0, 1),
                                   .says = "s"}),
    field<&SineShading::texture>(
        {.name = "texture", .wanted = "a number from 0 to 1", .range = from_to(0, 1), .says = "t"}),
    field<&SineShading::ambient>(
        {.name = "ambient", .wanted = "a number from 0 to 1", .range = from_to(0, 1), .says = "a"}),
    field<&SineShading::shininess>({.name = "shininess",
                                    .wanted = "a number >= 1",
                                    .range = from_to(1, limits::kMaxShininess),
                                    .says = "Exponent of the specular part."}),
};
static_assert(covers<SineShading>(kSineShadingFields));
inline constexpr Table kSineShadingTable{
    .name = "EllipsoidsShading",
    .says = "I = (1-a){(1-t)[(1-s) Id + s Is] + t It} + a; of the look gardner only.",
    .fields = kSineShadingFields,
    .standard = standard_of<SineShading>};
template <>
inline const Table& table_of<SineShading>() {
    return kSineShadingTable;
}

// TR = clamp(1 - (It - T1 - (T2-T1)(1-g))/D, 0, 1). In documents its parts stand in the cloud's object.
struct Translucence {
    // T1, at the centre of the limb curve.
    double threshold = 0;
    // T2, on the silhouette.
    double threshold_edge = 0.65;
    // D, of texture, from clear to opaque.
    double range = 0.2;
};

inline constexpr Range kTextureThreshold =
    from_to(limits::kMinTextureThreshold, limits::kMaxTextureThreshold);
inline constexpr Range kTextureRange = from_to(limits::kMinTextureRange, limits::kMaxTextureRange);

// TR = clamp(1 - (It - T1)/D, 0, 1). Endless in the look; in the volume a square slab around the cloud's origin.
struct SkyPlane {
    double altitude = 10;
    double extent = 120;
    double thickness = 1.5;
    double threshold = 0.3;
    double range = 0.3;
    double density = 10;
    std::uint64_t resolution = 128;
    SineTexture texture{TextureForm::kClean, 6, 0.3, 0.3, 1};
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

// Rows and patches, towers, or towers on a patch. Ellipsoids are linked: each but the first overlaps an earlier one.
enum class FormationKind { kHorizontal, kVertical, kCombined };
inline constexpr const char* kFormationKindWords[] = {"horizontal", "vertical", "combined"};

struct Formation {
    FormationKind kind = FormationKind::kCombined;
    std::uint64_t count = 40;
    glm::dvec3 center{0};
    glm::dvec3 radii{2.4, 1.6, 2.4};
    // Radii are between (1 - v) and (1 + v) times `radii`.
    double variation = 0.3;
    double link = 0.5;
    double heading = 90;
    double spread = 50;
};

inline constexpr Range kEllipsoidPlace = within(limits::kMaxEllipsoidCoordinate);
inline constexpr Range kEllipsoidRadius =
    from_to(limits::kMinEllipsoidRadius, limits::kMaxEllipsoidRadius);

inline constexpr Field kFormationFields[] = {
    field<&Formation::kind>({.name = "kind",
                             .words = kFormationKindWords,
                             .says = "Rows and patches, towers, or towers on a patch."}),
    field<&Formation::count>({.name = "count",
                              .wanted = "an integer >= 1",
                              .counts = count_from_to(1, limits::kMaxEllipsoids),
                              .says = "Ellipsoids."}),
    field<&Formation::center>({.name = "center",
                               .wanted = "[x, y, z]: three numbers",
                               .range = kEllipsoidPlace,
                               .unit = "units",
                               .says = "Of the first ellipsoid."}),
    field<&Formation::radii>({.name = "radii",
                              .wanted = "[x, y, z]: three numbers",
                              .range = kEllipsoidRadius,
                              .unit = "units",
                              .says = "Semi-axes of an ellipsoid of mean size."}),
    field<&Formation::variation>({.name = "variation",
                                  .wanted = "a number from 0 to 0.9",
                                  .range = from_to(0, limits::kMaxRadiusVariation),
                                  .says = "Share by which radii vary."}),
    field<&Formation::link>({.name = "link",
                             .wanted = "a number from 0.05 to 0.95",
                             .range = from_to(limits::kMinLink, limits::kMaxLink),
                             .says = "From touching, 0, to the same middle, 1."}),
    field<&Formation::heading>({.name = "heading",
                                .wanted = "a number (degrees)",
                                .range = within(limits::kMaxAngle),
                                .unit = "degrees",
                                .says = "Degrees, from +z towards +x: which way a row goes."}),
    field<&Formation::spread>(
        {.name = "spread",
         .wanted = "a number from 0 to 180 (degrees)",
         .range = from_to(0, 180),
         .unit = "degrees",
         .says = "Degrees by which a link departs from the heading or from upward."}),
};
static_assert(covers<Formation>(kFormationFields));
inline constexpr Table kFormationTable{.name = "EllipsoidsFormation",
                                       .says = "Linked ellipsoids, drawn at random.",
                                       .fields = kFormationFields,
                                       .standard = standard_of<Formation>};
template <>
inline const Table& table_of<Formation>() {
    return kFormationTable;
}

struct Ellipsoid {
    glm::dvec3 center{0};
    glm::dvec3 radii{1};
    double rotate_y = 0;
    // Instead of the cloud's.
    std::optional<double> threshold;
    std::optional<double> threshold_edge;
    std::optional<double> range;
};

inline constexpr Field kEllipsoidFields[] = {
    field<&Ellipsoid::center>({.name = "center",
                               .wanted = "[x, y, z]: three numbers",
                               .range = kEllipsoidPlace,
                               .required = true,
                               .unit = "units",
                               .says = "Units."}),
    field<&Ellipsoid::radii>({.name = "radii",
                              .wanted = "[x, y, z]: three numbers",
                              .range = kEllipsoidRadius,
                              .required = true,
                              .unit = "units",
                              .says = "Semi-axes, units."}),
    field<&Ellipsoid::rotate_y>({.name = "rotate_y",
                                 .wanted = "a number (degrees)",
                                 .range = within(limits::kMaxAngle),
                                 .unit = "degrees",
                                 .says = "Degrees, from +z towards +x."}),
    field<&Ellipsoid::threshold>({.name = "threshold",
                                  .wanted = "a number (of texture, T1)",
                                  .range = kTextureThreshold,
                                  .says = "Instead of the cloud's.",
                                  .otherwise = "the cloud's"}),
    field<&Ellipsoid::threshold_edge>({.name = "threshold_edge",
                                       .wanted = "a number (of texture, T2)",
                                       .range = kTextureThreshold,
                                       .says = "Instead of the cloud's.",
                                       .otherwise = "the cloud's"}),
    field<&Ellipsoid::range>({.name = "range",
                              .wanted = "a number > 0 (of texture, D)",
                              .range = kTextureRange,
                              .says = "Instead of the cloud's.",
                              .otherwise = "the cloud's"}),
};
static_assert(covers<Ellipsoid>(kEllipsoidFields));
inline constexpr Table kEllipsoidTable{.name = "EllipsoidsEllipsoid",
                                       .says = "One ellipsoid.",
                                       .fields = kEllipsoidFields,
                                       .standard = standard_of<Ellipsoid>};
template <>
inline const Table& table_of<Ellipsoid>() {
    return kEllipsoidTable;
}

struct EllipsoidsCloud {
    SineTexture texture;
    SineShading shading;
    Translucence translucence;
    std::optional<SkyPlane> plane;
    // Where there is no plane, no formation and no ellipsoid there is one Formation of the defaults.
    std::vector<Formation> formations;
    std::vector<Ellipsoid> ellipsoids;
    // Whatever the ellipsoids do.
    glm::dvec3 drift{0};
    double density = 10;
    std::uint64_t resolution = 64;
};

inline constexpr Field kEllipsoidsFields[] = {
    field<&EllipsoidsCloud::texture>({.name = "texture",
                                      .wanted = "an object",
                                      .says = "The texturing function of the ellipsoids."}),
    field<&EllipsoidsCloud::shading>(
        {.name = "shading", .wanted = "an object", .says = "Of the look gardner only."}),
    field_within<&EllipsoidsCloud::translucence, &Translucence::threshold>(
        {.name = "threshold",
         .wanted = "a number (of texture, T1)",
         .range = kTextureThreshold,
         .says = "T1, at the middle of an ellipsoid: below it there is no cloud.",
         .part_of = "translucence"}),
    field_within<&EllipsoidsCloud::translucence, &Translucence::threshold_edge>(
        {.name = "threshold_edge",
         .wanted = "a number (of texture, T2)",
         .range = kTextureThreshold,
         .says = "T2, at its edge.",
         .part_of = "translucence"}),
    field_within<&EllipsoidsCloud::translucence, &Translucence::range>(
        {.name = "range",
         .wanted = "a number > 0 (of texture, D)",
         .range = kTextureRange,
         .says = "Of texture, D: opaque from the threshold and this on.",
         .part_of = "translucence"}),
    field<&EllipsoidsCloud::plane>({.name = "plane",
                                    .wanted = R"(an object or "none")",
                                    .absent = "none",
                                    .says = "High cloud over all."}),
    field<&EllipsoidsCloud::formations>({.name = "formations",
                                         .wanted = "a list of formations",
                                         .counts = at_most(limits::kMaxEllipsoids),
                                         .says =
                                             "Linked ellipsoids, 1000 in all with those given. "
                                             "Without plane, formations and ellipsoids there is "
                                             "one formation of the defaults."}),
    field<&EllipsoidsCloud::ellipsoids>({.name = "ellipsoids",
                                         .wanted = "a list of ellipsoids",
                                         .counts = at_most(limits::kMaxEllipsoids),
                                         .says = "Each where it is said to be."}),
    field<&EllipsoidsCloud::drift>({.name = "drift",
                                    .wanted = "[x, y, z]: three numbers (units a second)",
                                    .range = within(limits::kMaxVelocity),
                                    .unit = "units a second",
                                    .says = "Of the texture, units a second."}),
    field<&EllipsoidsCloud::density>(
        {.name = "density",
         .wanted = "a number >= 0 (multiplies the cloud's)",
         .range = from_to(0, limits::kMaxDensity),
         .says = "Multiplies the cloud's density: extinction where the texture is opaque."}),
    field<&EllipsoidsCloud::resolution>(
        {.name = "resolution",
         .wanted = "an integer from 8 to 160 (cells along the longest side)",
         .counts = count_from_to(limits::kMinLatticeResolution, limits::kMaxLatticeResolution),
         .says = "Cells along the longest side of the ellipsoids' box."}),
};
static_assert(covers<EllipsoidsCloud>(kEllipsoidsFields));
static_assert(covers_part<Translucence>(kEllipsoidsFields, "translucence"));
inline constexpr Table kEllipsoidsTable{.name = "Ellipsoids",
                                        .says =
                                            "Gardner 1985: textured ellipsoids and a sky plane; as "
                                            "matter, or drawn his way by the look gardner.",
                                        .fields = kEllipsoidsFields,
                                        .standard = standard_of<EllipsoidsCloud>};

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const EllipsoidsCloud& cloud);

}  // namespace awan
