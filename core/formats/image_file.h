// Image -> PNG or EXR bytes, made in memory.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/deadline.h"
#include "core/base/image.h"
#include "core/draw/layers.h"
#include "core/formats/tone.h"
#include "core/scene/scene.h"

namespace awan {

// sRGB of 8 bits a channel, dithered (dithered_code), or of 16, after exposure and tone curve; RGB when image.opaque,
// else RGBA with straight (not premultiplied) alpha as PNG wants it, which is not dithered. Errors: kOverDeadline,
// kCancelled, kOutOfMemory.
Result<std::string> encode_png(const Image& image, const FilmSettings& film, int bits = 8,
                               const Deadline& deadline = {});

// What an encoder of pictures answers when it cannot.
inline Error encoder_error(const std::string& what) {
    return {ErrorCode::kInternal, "", "the image could not be encoded: " + what};
}

// That the picture has as many pixels as it says, and some.
Status check_pixels(const Image& image);

// The pixels of it in 8 bits, row by row: 3 bytes each when image.opaque, else 4. Rounded: for encoders that lose
// detail and would spend their bits on dither.
std::vector<std::uint8_t> display_pixels(const Image& image, const FilmSettings& film);

// What the header of a sky's map says: awan:sun_direction (unit, towards it) and awan:sun_irradiance (r g b, at normal
// incidence), of the sun that the map lacks. OpenEXR's own `envmap` says that it is one.
struct SkyNotes {
    glm::dvec3 to_sun{0, 1, 0}, sun{0};
};

// How a picture came about, kept in its file as the attributes awan:rung, awan:error and awan:error_forecast. Of
// numbers that are not finite nothing is kept.
struct PictureNotes {
    // EMPTY: nothing is kept.
    std::string rung;
    // As stated, and what the plan expected.
    double error = 0, error_forecast = 0;
    // Of a map of the sky alone (core/draw/sky_map.h).
    std::optional<SkyNotes> sky{};
};
PictureNotes sky_notes_of(const Scene& scene);

// A further channel of an EXR: of every pixel, row by row from the top left, the value `apart` floats behind the last.
struct ExrChannel {
    // As compositing programs read it, "sun.R".
    std::string name;
    const float* first;
    std::size_t apart = 1;
    // It needs more than half floats have: it is of floats whatever the picture is of.
    bool exact = false;
};
// Those of a picture's layers, which must outlive them: depth.Z, transmittance.Y, sun.R, sun.G, sun.B, ...
std::vector<ExrChannel> channels_of(const PictureLayers& layers);

// Linear radiance, premultiplied alpha, channels R G B A and `more`, no tone curve, ZIP compression. Errors as of
// encode_png.
Result<std::string> encode_exr(const Image& image, Precision precision,
                               const PictureNotes& notes = {}, const Deadline& deadline = {},
                               const std::vector<ExrChannel>& more = {});

// How many threads pack EXR from now on, 1 to 256; before it is said, the caller alone. The bytes are the same. OpenEXR
// has one set of threads for the whole process, so it is said where that begins, before anything is encoded.
void set_exr_threads(int threads);

// Exposure in stops for "auto": what a photographer would meter on the sunlit side of a thick cloud, which is half of
// the sun's light, as from a white wall at 45 degrees, and the sky's mean radiance. It is brought to kMeteredLevel
// before the tone curve. Depends on the lights only, so it does not flicker as a camera moves. Of what a low sun takes
// away from the light of a high one, three stops in four are made up for: the eye adapts, but evening stays evening.
double auto_exposure(const Scene& scene);

// The scene's own exposure, or that one, in stops; of what is displayed instead of lit, 0.
double exposure_of(const Scene& scene);
// With the tone curve that it names.
FilmSettings film_of(const Scene& scene);

}  // namespace awan
