// The texturing function of a cloud of model "ellipsoids" (Gardner 1985), and what it does to light and to opacity.
#pragma once

#include <cstdint>
#include <vector>

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

}  // namespace awan
