// What a cloud of model "ellipsoids" is: Gardner 1985, "Visual simulation of clouds": a textured sky
// plane and ellipsoids whose shading and translucence a sum of sines modulates.
//
// Gardner's axes have Z up; ours have y up: his X, Y, Z are our x, z, y. A formation that moves apart from the others
// is a cloud of its own, with a velocity.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
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

// One row of the two sums, by hand: Ci, FXi and FYi, and what is added to PXi and PYi.
struct Sine {
    double amplitude = 1;
    double frequency_x = 1;
    double frequency_z = 1;
    double phase_x = 0;
    double phase_z = 0;
    bool operator==(const Sine&) const = default;
};

inline constexpr Range kTextureFrequency =
    from_to(limits::kMinTextureFrequency, limits::kMaxTextureFrequency);

inline constexpr Field kSineFields[] = {
    field<&Sine::amplitude>({.name = "amplitude",
                             .wanted = "a number > 0 (Ci)",
                             .range = from_to(limits::kMinSineAmplitude, limits::kMaxSineAmplitude),
                             .says = "Ci, of both sums."}),
    field<&Sine::frequency_x>({.name = "frequency_x",
                               .wanted = "a number > 0 (radians/unit)",
                               .range = kTextureFrequency,
                               .unit = "radians/unit",
                               .says = "FXi, radians/unit, along x and upward."}),
    field<&Sine::frequency_z>({.name = "frequency_z",
                               .wanted = "a number > 0 (radians/unit)",
                               .range = kTextureFrequency,
                               .unit = "radians/unit",
                               .says = "FYi, radians/unit, along z."}),
    field<&Sine::phase_x>({.name = "phase_x",
                           .wanted = "a number (degrees)",
                           .range = within(limits::kMaxAngle),
                           .unit = "degrees",
                           .says = "Added to PXi, degrees."}),
    field<&Sine::phase_z>({.name = "phase_z",
                           .wanted = "a number (degrees)",
                           .range = within(limits::kMaxAngle),
                           .unit = "degrees",
                           .says = "Added to PYi, degrees."}),
};
static_assert(covers<Sine>(kSineFields));
inline constexpr Table kSineTable{.name = "EllipsoidsSine",
                                  .says = "One sine of either sum, by hand.",
                                  .fields = kSineFields,
                                  .standard = standard_of<Sine>};
template <>
inline const Table& table_of<Sine>() {
    return kSineTable;
}

// T(X,Y,Z) = k sum Ci [sin(FXi X + PXi) + T0] * sum Ci [sin(FYi Y + PYi) + T0], 0..1.
struct SineTexture {
    TextureForm form = TextureForm::kClean;
    // Of either sum; Gardner 1985 has 4 to 7.
    std::uint64_t terms = 6;
    double frequency_x = 0.9;
    double frequency_z = 0.9;
    // T0, "controls the contrast".
    double offset = 1;
    // Instead of `terms` sines by rule.
    std::vector<Sine> sines{};
    bool operator==(const SineTexture&) const = default;
};

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
    field<&SineTexture::sines>({.name = "sines",
                                .wanted = "a list of sines",
                                .counts = at_most(limits::kMaxTextureTerms),
                                .says = "Amplitudes, frequencies and phases by hand; none: terms "
                                        "by the rule F doubled, C times .707, from frequency_x "
                                        "and frequency_z on."}),
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
    // Between which TR stays: 0 and 1 in print.
    double least = 0;
    double most = 1;
};

inline constexpr Range kTextureThreshold =
    from_to(limits::kMinTextureThreshold, limits::kMaxTextureThreshold);
inline constexpr Range kTextureRange = from_to(limits::kMinTextureRange, limits::kMaxTextureRange);

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
    double tilt = 0;
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
    field<&Formation::tilt>({.name = "tilt",
                             .wanted = "a number from 0 to 90 (degrees)",
                             .range = from_to(0, 90),
                             .unit = "degrees",
                             .says = "Degrees by which ellipsoids are tilted at most, to any "
                                     "side."}),
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
    // Turned by rotate_z first, then rotate_x, then rotate_y.
    double rotate_x = 0;
    double rotate_z = 0;
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
                                 .says = "Degrees, from +z towards +x, after the others."}),
    field<&Ellipsoid::rotate_x>({.name = "rotate_x",
                                 .wanted = "a number (degrees)",
                                 .range = within(limits::kMaxAngle),
                                 .unit = "degrees",
                                 .says = "Degrees, from +y towards +z, after rotate_z."}),
    field<&Ellipsoid::rotate_z>({.name = "rotate_z",
                                 .wanted = "a number (degrees)",
                                 .range = within(limits::kMaxAngle),
                                 .unit = "degrees",
                                 .says = "Degrees, from +x towards +y."}),
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

// A general quadric that is an ellipsoid, as Gardner 1985 has it:
//   Q1 X^2 + Q2 Y^2 + Q3 Z^2 + Q4 XY + Q5 YZ + Q6 XZ + Q7 X + Q8 Y + Q9 Z + Q0 = 0,
// in his axes, of which Z is up: X, Y, Z are our x, z, y.
struct Quadric {
    double q1 = 1, q2 = 1, q3 = 1, q4 = 0, q5 = 0, q6 = 0, q7 = 0, q8 = 0, q9 = 0, q0 = -1;
};

inline constexpr Range kQuadricRange = within(limits::kMaxQuadric);
// Of an ellipsoid they are all of one sign, and its equation may be multiplied by -1.
inline constexpr Range kQuadricSquare = from_to(limits::kMinQuadricSquare, limits::kMaxQuadric);

inline constexpr Field kQuadricFields[] = {
    field<&Quadric::q1>(
        {.name = "q1", .wanted = "a number > 0", .range = kQuadricSquare, .says = "Of X^2."}),
    field<&Quadric::q2>(
        {.name = "q2", .wanted = "a number > 0", .range = kQuadricSquare, .says = "Of Y^2."}),
    field<&Quadric::q3>(
        {.name = "q3", .wanted = "a number > 0", .range = kQuadricSquare, .says = "Of Z^2."}),
    field<&Quadric::q4>(
        {.name = "q4", .wanted = "a number", .range = kQuadricRange, .says = "Of XY."}),
    field<&Quadric::q5>(
        {.name = "q5", .wanted = "a number", .range = kQuadricRange, .says = "Of YZ."}),
    field<&Quadric::q6>(
        {.name = "q6", .wanted = "a number", .range = kQuadricRange, .says = "Of XZ."}),
    field<&Quadric::q7>(
        {.name = "q7", .wanted = "a number", .range = kQuadricRange, .says = "Of X."}),
    field<&Quadric::q8>(
        {.name = "q8", .wanted = "a number", .range = kQuadricRange, .says = "Of Y."}),
    field<&Quadric::q9>(
        {.name = "q9", .wanted = "a number", .range = kQuadricRange, .says = "Of Z."}),
    field<&Quadric::q0>(
        {.name = "q0", .wanted = "a number", .range = kQuadricRange, .says = "Of 1."}),
};
static_assert(covers<Quadric>(kQuadricFields));
inline constexpr Table kQuadricTable{.name = "EllipsoidsQuadric",
                                     .says =
                                         "q1 X^2 + q2 Y^2 + q3 Z^2 + q4 XY + q5 YZ + q6 XZ + "
                                         "q7 X + q8 Y + q9 Z + q0 = 0, an ellipsoid; X, Y, Z "
                                         "are x, z, y: Z is up in the source.",
                                     .fields = kQuadricFields,
                                     .standard = standard_of<Quadric>};
template <>
inline const Table& table_of<Quadric>() {
    return kQuadricTable;
}

// The same by its centre, semi-axes, and the directions of these, by columns. None where the quadric is no ellipsoid.
struct QuadricShape {
    glm::dvec3 center{0}, radii{1};
    glm::dmat3 axes{1};
};
std::optional<QuadricShape> shape_of(const Quadric& quadric);

struct EllipsoidsCloud {
    SineTexture texture;
    SineShading shading;
    Translucence translucence;
    std::optional<SkyPlane> plane;
    // Where there is no plane, no formation and no ellipsoid there is one Formation of the defaults.
    std::vector<Formation> formations;
    std::vector<Ellipsoid> ellipsoids;
    std::vector<Quadric> quadrics;
    // How far ellipsoids that overlap are one: their shading near the crease between them, and, as matter, their limb
    // curves. 0, as printed: each is by itself, and where one ends there is a crease, or as matter a gap.
    double join = 0;
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
    field_within<&EllipsoidsCloud::translucence, &Translucence::least>(
        {.name = "translucence_min",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "The translucence of ellipsoids is at least this; at most translucence_max.",
         .part_of = "translucence"}),
    field_within<&EllipsoidsCloud::translucence, &Translucence::most>(
        {.name = "translucence_max",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "And at most this.",
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
    field<&EllipsoidsCloud::quadrics>({.name = "quadrics",
                                       .wanted = "a list of quadrics",
                                       .counts = at_most(limits::kMaxEllipsoids),
                                       .says = "Ellipsoids by the coefficients of their "
                                               "equations."}),
    field<&EllipsoidsCloud::join>({.name = "join",
                                   .wanted = "a number from 0 to 1",
                                   .range = from_to(0, 1),
                                   .says = "How far ellipsoids that overlap are one: 0, as "
                                           "printed, leaves creases and gaps between them."}),
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
