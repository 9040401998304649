// Bytes of a text as other programs store it -> UTF-8 without a byte order mark.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan {

// A text in UTF-16 of either order, with a byte order mark or recognised by its zero bytes, as UTF-8; nothing for a
// text that is not in UTF-16. The error (kMalformed) is of UTF-32, of UTF-16 that breaks off or has half a letter.
Result<std::optional<std::string>> from_utf16(std::string_view bytes);

// Whether the bytes are a gzip file (RFC 1952).
bool is_gzip(std::string_view bytes);

// What they hold, all members of it. kTooLarge over `most` bytes, before those are made; kMalformed when they are
// damaged or end early.
Result<std::string> gunzip(std::string_view bytes, std::size_t most);

}  // namespace awan
