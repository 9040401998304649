// Blank space in headers of HTTP.
#pragma once

#include <string_view>

namespace awan {

// `text` without the optional white space (blanks and tabs: RFC 9110, section 5.6.3) at its ends.
inline std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

}  // namespace awan
