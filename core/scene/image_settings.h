// The picture that a scene asks for.
#pragma once

#include <optional>
#include <string>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// kPng16: PNG of 16 bits a channel.
enum class ImageFormat { kPng, kExr, kPng16 };
inline constexpr const char* kImageFormatWords[] = {"png", "exr", "png16"};

enum class Background { kSky, kTransparent };
inline constexpr const char* kBackgroundWords[] = {"sky", "transparent"};

// Of EXR's samples.
enum class Precision { kHalf, kFloat };
inline constexpr const char* kPrecisionWords[] = {"half", "float"};

// How bright colours come to the display (core/shaders/tone.glsl).
enum class Tone { kNeutral, kReinhard };
inline constexpr const char* kToneWords[] = {"neutral", "reinhard"};

struct ImageSettings {
    int width = 800;
    int height = 600;
    ImageFormat format = ImageFormat::kPng;
    Background background = Background::kSky;
    Precision precision = Precision::kHalf;
    // None: automatic (core/formats/image_file.h).
    std::optional<double> exposure;
    Tone tone = Tone::kNeutral;
    // As read_layers() reads it (layers.h).
    std::string layers = "none";
};

inline constexpr Field kImageFields[] = {
    field<&ImageSettings::width>({.name = "width",
                                  .wanted = "an integer from 1 to 8192 (pixels)",
                                  .counts = count_from_to(1, limits::kMaxImageSide),
                                  .unit = "pixels",
                                  .says = "Pixels."}),
    field<&ImageSettings::height>({.name = "height",
                                   .wanted = "an integer from 1 to 8192 (pixels)",
                                   .counts = count_from_to(1, limits::kMaxImageSide),
                                   .unit = "pixels",
                                   .says = "Pixels."}),
    field<&ImageSettings::format>({.name = "format",
                                   .words = kImageFormatWords,
                                   .says =
                                       "PNG: sRGB after exposure and the tone curve, of 8 bits a "
                                       "channel, dithered, or of 16 (png16). EXR: "
                                       "linear radiance, premultiplied, alpha = 1 - "
                                       "transmittance."}),
    field<&ImageSettings::background>({.name = "background",
                                       .words = kBackgroundWords,
                                       .says = "What stands behind the clouds."}),
    field<&ImageSettings::exposure>({.name = "exposure",
                                     .wanted = R"(a number (stops) or "auto")",
                                     .range = within(limits::kMaxExposure),
                                     .absent = "auto",
                                     .unit = "stops",
                                     .says = "Stops: radiance is multiplied by 2^exposure."}),
    field<&ImageSettings::tone>({.name = "tone",
                                 .words = kToneWords,
                                 .says =
                                     "Of PNG: neutral keeps the hue of what is bright; reinhard "
                                     "bends each channel by itself, so that it turns to yellow, "
                                     "cyan or magenta on its way to white."}),
    field<&ImageSettings::precision>(
        {.name = "precision", .words = kPrecisionWords, .says = "Of EXR's samples."}),
    field<&ImageSettings::layers>(
        {.name = "layers",
         .wanted = R"("all", "none" or names of layers with commas between them)",
         .says = "Of EXR, more channels beside the colours: all, none, or some of depth, "
                 "transmittance, sun, sky, multiple, haze and background with commas between them. "
                 "A picture with layers is an EXR; the rungs single and transport-* have them."}),
};
static_assert(covers<ImageSettings>(kImageFields));

inline constexpr Table kImageTable{.name = "Image",
                                   .says = "At most 33554432 pixels.",
                                   .fields = kImageFields,
                                   .standard = standard_of<ImageSettings>};
static_assert(limits::kMaxPixels == 33554432, "the prose above says it");
template <>
inline const Table& table_of<ImageSettings>() {
    return kImageTable;
}

}  // namespace awan
