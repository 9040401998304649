// A kept answer as a file, that says of itself whether it is whole. Pure functions.
//
// 64 bytes of header, numbers little-endian: "AWANKEPT"; the format's version, 4 bytes; bytes of the text, 4; bytes of
// the body, 8; XXH3-128 of the text, 16; XXH3-128 of the body, 16; XXH3-64 of the 56 bytes before it. Then the text:
// the entity tag and the headers, "Name: value", a line each. Then the body. The checksums are against accidents:
// whoever may write the folder may write its answers.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "server/service/result_cache.h"

namespace awan {

inline constexpr std::size_t kKeptHeaderBytes = 64;

// What stands before the body. "": one of the headers cannot stand in a line.
std::string kept_head(const std::string& tag, const KeptResult& result);

// The answer to `tag` from all bytes of a file; nothing when the file is not whole, not of this format, or another's.
std::optional<KeptResult> read_kept(std::string file, const std::string& tag);

}  // namespace awan
