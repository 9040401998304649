// Text of HTTP headers.
#pragma once

#include <strings.h>

#include <string_view>

namespace awan {

// `text` without the optional white space (blanks and tabs: RFC 9110, section 5.6.3) at its ends.
inline std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

// Whether two texts are the same, capital letters or not: names of headers, hosts, schemes, media types.
inline bool same(std::string_view a, std::string_view b) {
    return a.size() == b.size() && strncasecmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace awan
