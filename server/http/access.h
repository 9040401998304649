// Who may call: the Host a request names, the Origin of the page that sent it, the token that it shows. Pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/framing.h"

namespace awan {

// Names by which this server may be called, and pages that may call it.
struct AccessRules {
    // Names without port, in any case; IPv6 in brackets.
    std::vector<std::string> hosts;
    // scheme://host[:port].
    std::vector<std::string> origins;
    // "": none is needed.
    std::string token;
    // Paths that anyone may read: what they say is the same for everyone.
    std::vector<std::string> open_paths;
};

// 421 for a foreign Host: a page on evil.example whose name has been rebound to 127.0.0.1 must not
// talk to this server. 403 for anything but GET and HEAD from a foreign Origin, "null" included. 401 without the token
// (Authorization: Bearer, RFC 6750), except for OPTIONS, /healthz and /readyz, which tell nothing, and for GET and HEAD
// of open paths.
std::optional<FramingError> check_access(const RequestHead& head, const AccessRules& rules);

// The Origin to name in Access-Control-Allow-Origin: an allowed one that is not this server's own.
std::string_view allowed_foreign_origin(const RequestHead& head, const AccessRules& rules);

// "example.org:8080" -> "example.org"; "[::1]:80" -> "[::1]".
std::string_view without_port(std::string_view authority);

}  // namespace awan
