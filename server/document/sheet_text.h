// What lies where on a sheet of frames, as JSON.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/formats/sheet.h"

namespace awan {

// The array form that TexturePacker and Aseprite write and PixiJS and Phaser read: `frames`, each with its place
// `frame` {x, y, w, h} in pixels from the top left and its `duration` in ms; `meta` has the name of the picture and its
// size, and of ours `columns` and `rows`. image: the picture's file, without folders. numbers, times: of each frame its
// number in the sequence and its seconds.
std::string sheet_to_json(const SheetLayout& layout, std::string_view image,
                          std::span<const std::uint64_t> numbers, std::span<const double> times,
                          double frames_per_second);

}  // namespace awan
