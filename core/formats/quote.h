// A client's text in a message: short, whole letters, nothing that a terminal would obey.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace awan {

// Length of the UTF-8 sequence at the start of `text`, 1 to 4; 0 when it is not one (RFC 3629: no overlong forms, no
// surrogates, nothing beyond U+10FFFF).
std::size_t utf8_length(std::string_view text);

// `text` in double quotes, at most 40 letters of it, and fewer where they take long to write. Letters of every script
// stay; control characters, marks that turn the direction of writing, and bytes that are no UTF-8 are written as \x1B.
std::string short_quote(std::string_view text);

}  // namespace awan
