#include "server/http/access.h"

#include <algorithm>

#include "server/header_text.h"

namespace awan {
namespace {

bool contains(const std::vector<std::string>& list, std::string_view value) {
    return std::any_of(list.begin(), list.end(),
                       [&](const auto& item) { return same(item, value); });
}

// A proxy that ends TLS in front of this server leaves an https Origin and its own Host.
bool own_origin(std::string_view origin, std::string_view host) {
    for (const std::string_view scheme : {"http://", "https://"})
        if (origin.size() > scheme.size() && same(origin.substr(0, scheme.size()), scheme) &&
            same(origin.substr(scheme.size()), host))
            return !host.empty();
    return false;
}

}  // namespace

std::string_view without_port(std::string_view authority) {
    const std::size_t bracket = authority.rfind(']');
    const std::size_t colon = authority.rfind(':');
    if (colon == std::string_view::npos || (bracket != std::string_view::npos && colon < bracket))
        return authority;
    const std::string_view port = authority.substr(colon + 1);
    const bool digits =
        std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
    return digits ? authority.substr(0, colon) : authority;
}

std::optional<FramingError> check_access(const RequestHead& head, const AccessRules& rules) {
    if (!(head.http10 && head.host.empty()) && !contains(rules.hosts, without_port(head.host)))
        return FramingError{421,
                            "this server does not answer for that Host; "
                            "awan serve --allow-host names more"};
    if (head.method == "GET" || head.method == "HEAD") return std::nullopt;
    for (const auto& [name, value] : head.headers)
        if (same(name, "Origin") && !own_origin(value, head.host) &&
            !contains(rules.origins, value))
            return FramingError{403,
                                "pages of that Origin may not post here; "
                                "awan serve --allow-origin names more"};
    return std::nullopt;
}

std::string_view allowed_foreign_origin(const RequestHead& head, const AccessRules& rules) {
    const std::string_view origin = head.header("Origin");
    if (origin.empty() || own_origin(origin, head.host) || !contains(rules.origins, origin))
        return {};
    return origin;
}

}  // namespace awan
