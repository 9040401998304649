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
#include "core/scene/ellipsoids_plane.h"
#include "core/scene/ellipsoids_texture.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

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
