// Is this one unambiguous HTTP/1.1 message, and how long is its body? Pure functions on bytes.
//
// Everything is refused that two parsers might read differently (RFC 9112, sections 2.2, 5.1, 6.3
// and 11.2), so that no second request hides in the first, whatever proxy stands in front.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace awan {

// Why something is no request that is answered: status, and one sentence.
struct FramingError {
    int status = 400;
    std::string detail;
};

// A head that passed. `method` is one of the registered ones; `target` starts with '/' or is "*".
struct RequestHead {
    std::string method;
    std::string target;
    bool http10 = false;
    // Host, or the authority of an absolute target; "" only in HTTP/1.0.
    std::string host;
    // Names as they came, values trimmed.
    std::vector<std::pair<std::string, std::string>> headers;
    std::size_t content_length = 0;
    bool keep_alive = true;
    bool expects_continue = false;

    // "" when absent; names ignore case.
    std::string_view header(std::string_view name) const;
};

// Bytes up to and including the empty line that ends a head, or nothing when it is not complete.
// `scanned` remembers how far earlier calls looked. An error as soon as no continuation could make
// these bytes a head: a NUL, a bare LF or CR, too many bytes.
struct HeadEnd {
    std::optional<std::size_t> bytes;
    std::optional<FramingError> error;
};
HeadEnd find_head_end(std::string_view received, std::size_t& scanned);

// `head`: the bytes up to and including the empty line.
struct ParsedHead {
    RequestHead head;
    std::optional<FramingError> error;
};
ParsedHead parse_head(std::string_view head);

}  // namespace awan
