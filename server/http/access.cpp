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

// Takes as long wherever the first difference is.
bool same_secret(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    return difference == 0;
}

bool only_reads(const RequestHead& head) {
    return head.method == "GET" || head.method == "HEAD";
}

bool needs_token(const RequestHead& head, const AccessRules& rules) {
    const std::string_view path = std::string_view(head.target).substr(0, head.target.find('?'));
    if (path == "/healthz" || path == "/readyz" || head.method == "OPTIONS") return false;
    return !only_reads(head) || std::find(rules.open_paths.begin(), rules.open_paths.end(), path) ==
                                    rules.open_paths.end();
}

bool shows_token(const RequestHead& head, std::string_view token) {
    constexpr std::string_view kScheme = "Bearer ";
    const std::string_view shown = head.header("Authorization");
    return shown.size() > kScheme.size() && same(shown.substr(0, kScheme.size()), kScheme) &&
           same_secret(without_blanks(shown.substr(kScheme.size())), token);
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
    if (!rules.token.empty() && needs_token(head, rules) && !shows_token(head, rules.token))
        return FramingError{401, "this server wants its token: Authorization: Bearer ..."};
    if (only_reads(head)) return std::nullopt;
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
