#include "server/http/framing.h"

#include <algorithm>
#include <array>

#include "server/header_text.h"
#include "server/limits.h"

namespace awan {
namespace {

// Methods that RFC 9110 and 5789 register. Others are answered 501 before they are looked at
// further, since nobody can say whether they have a body.
constexpr std::array<std::string_view, 9> kMethods = {
    "GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "CONNECT", "TRACE"};

bool is_token_char(char c) {
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) return true;
    return c != '\0' && std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool is_token(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_token_char);
}

std::optional<FramingError> fail(int status, std::string detail) {
    return FramingError{status, std::move(detail)};
}

// "GET /path HTTP/1.1": single spaces, nothing else.
std::optional<FramingError> parse_request_line(std::string_view line, RequestHead& head) {
    const std::size_t first = line.find(' ');
    const std::size_t last = line.rfind(' ');
    if (first == std::string_view::npos || first == last)
        return fail(400, "the request line is not METHOD TARGET HTTP/1.1");
    const std::string_view method = line.substr(0, first);
    std::string_view target = line.substr(first + 1, last - first - 1);
    const std::string_view version = line.substr(last + 1);
    if (!is_token(method)) return fail(400, "the method is not a token");
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
        return fail(400, "the version is not HTTP/1.1 or HTTP/1.0");
    head.http10 = version == "HTTP/1.0";
    if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end())
        return fail(501, "this method is not known here");
    if (target.size() > limits::kMaxTargetBytes)
        return fail(414, "the request target is longer than " +
                             std::to_string(limits::kMaxTargetBytes) + " bytes");
    const auto bad = [](char c) { return c <= ' ' || c >= '\x7f' || c == '#'; };
    if (target.empty() || std::any_of(target.begin(), target.end(), bad))
        return fail(400, "the request target holds a character that must be percent-encoded");

    // An absolute target, as proxies send it, names the host itself (RFC 9112, 3.2.2).
    if (target.size() > 7 && same(target.substr(0, 7), "http://")) {
        target.remove_prefix(7);
        const std::size_t slash = std::min(target.find_first_of("/?"), target.size());
        head.host = target.substr(0, slash);
        if (head.host.empty()) return fail(400, "the request target has no host");
        target.remove_prefix(slash);
        head.target = target.empty() || target.front() == '?' ? "/" + std::string(target)
                                                              : std::string(target);
    } else {
        head.target = target;
    }
    head.method = method;
    if (method == "CONNECT") return fail(501, "this is not a proxy");
    const bool star = head.target == "*" && method == "OPTIONS";
    if (!star && head.target.front() != '/')
        return fail(400, "the request target does not start with /");
    return std::nullopt;
}

std::optional<FramingError> parse_field(std::string_view line, RequestHead& head) {
    if (line.front() == ' ' || line.front() == '\t')
        return fail(400, "a header is folded over several lines");
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return fail(400, "a header line has no colon");
    const std::string_view name = line.substr(0, colon);
    if (!is_token(name)) return fail(400, "a header name is not a token");
    const std::string_view value = without_blanks(line.substr(colon + 1));
    const auto bad = [](char c) {
        const auto u = static_cast<unsigned char>(c);
        return (u < 0x20 && c != '\t') || u == 0x7f;
    };
    if (std::any_of(value.begin(), value.end(), bad))
        return fail(400, "a header value holds a control character");
    if (head.headers.size() == limits::kMaxHeaders)
        return fail(431, "there are more than " + std::to_string(limits::kMaxHeaders) + " headers");
    head.headers.emplace_back(name, value);
    return std::nullopt;
}

std::size_t count(const RequestHead& head, std::string_view name) {
    return static_cast<std::size_t>(
        std::count_if(head.headers.begin(), head.headers.end(),
                      [&](const auto& h) { return same(h.first, name); }));
}

bool lists(std::string_view value, std::string_view member) {
    while (!value.empty()) {
        const std::size_t comma = std::min(value.find(','), value.size());
        if (same(without_blanks(value.substr(0, comma)), member)) return true;
        value.remove_prefix(std::min(comma + 1, value.size()));
    }
    return false;
}

std::optional<FramingError> check_host(RequestHead& head) {
    const std::size_t hosts = count(head, "Host");
    if (hosts > 1) return fail(400, "there is more than one Host");
    if (hosts == 0 && !head.http10) return fail(400, "there is no Host");
    if (hosts == 0) return std::nullopt;
    const std::string_view host = head.header("Host");
    if (!head.host.empty() && !same(head.host, host))
        return fail(400, "Host is not the host of the request target");
    if (host.find_first_of(" \t,/@\\?#") != std::string_view::npos)
        return fail(400, "Host is not a host");
    head.host = host;
    return std::nullopt;
}

std::optional<FramingError> check_length(RequestHead& head) {
    const std::size_t lengths = count(head, "Content-Length");
    if (count(head, "Transfer-Encoding") > 0) {
        if (lengths > 0)
            return fail(400, "Content-Length and Transfer-Encoding exclude each other");
        if (head.http10) return fail(400, "HTTP/1.0 has no Transfer-Encoding");
        if (count(head, "Transfer-Encoding") > 1 ||
            !same(head.header("Transfer-Encoding"), "chunked"))
            return fail(400, "this Transfer-Encoding is not understood");
        return fail(411, "send the body with a Content-Length, not in chunks");
    }
    if (lengths > 1) return fail(400, "there is more than one Content-Length");
    const bool bodiless = head.method == "GET" || head.method == "HEAD" ||
                          head.method == "OPTIONS" || head.method == "TRACE";
    if (lengths == 0) {
        // No length is no body (RFC 9112, 6.3); only POST and PUT have routes that want one, the rest are told so
        // by 405.
        if (head.method == "POST" || head.method == "PUT")
            return fail(411, "there is no Content-Length");
        return std::nullopt;
    }
    const std::string_view digits = head.header("Content-Length");
    if (digits.empty() ||
        !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
        return fail(400, "Content-Length is not a number of digits");
    for (const char digit : digits) {
        if (head.content_length > (std::size_t{1} << 48)) return fail(413, "the body is too long");
        head.content_length = head.content_length * 10 + static_cast<std::size_t>(digit - '0');
    }
    if (bodiless && head.content_length > 0) return fail(400, "a " + head.method + " has no body");
    return std::nullopt;
}

std::optional<FramingError> check_rest(RequestHead& head) {
    for (const auto& [name, value] : head.headers) {
        const bool packed = same(value, "gzip") || same(value, "x-gzip");
        if (same(name, "Content-Encoding") && !same(value, "identity") && !packed)
            return fail(415, "bodies are taken as they are or with Content-Encoding: gzip");
        if (same(name, "Content-Encoding") && count(head, name) > 1)
            return fail(415, "a body is compressed once; there is more than one Content-Encoding");
        if (same(name, "Expect")) {
            if (!same(value, "100-continue"))
                return fail(417, "only Expect: 100-continue is understood");
            head.expects_continue = !head.http10 && head.content_length > 0;
        }
        if (same(name, "Connection") && lists(value, "close")) head.keep_alive = false;
    }
    if (head.http10) head.keep_alive = false;
    return std::nullopt;
}

}  // namespace

std::string_view RequestHead::header(std::string_view name) const {
    for (const auto& [key, value] : headers)
        if (same(key, name)) return value;
    return {};
}

HeadEnd find_head_end(std::string_view received, std::size_t& scanned) {
    for (std::size_t i = scanned; i < received.size(); ++i) {
        const char c = received[i];
        if (i == 0 && !is_token_char(c))
            return {std::nullopt, FramingError{400, "this is not an HTTP request"}};
        if (c == '\0') return {std::nullopt, FramingError{400, "the head holds a NUL"}};
        if (c == '\n' && received[i - 1] != '\r')
            return {std::nullopt, FramingError{400, "a line of the head ends without CR"}};
        if (c != '\n' && i > 0 && received[i - 1] == '\r')
            return {std::nullopt, FramingError{400, "the head holds a CR inside a line"}};
        if (c == '\n' && i >= 3 && received[i - 2] == '\n') {
            scanned = 0;
            return {i + 1, std::nullopt};
        }
        if (i >= limits::kMaxHeadBytes) {
            const bool in_line = received.substr(0, i).find('\n') == std::string_view::npos;
            return {std::nullopt,
                    FramingError{in_line ? 414 : 431, "the head is longer than " +
                                                          std::to_string(limits::kMaxHeadBytes) +
                                                          " bytes"}};
        }
    }
    scanned = received.size();
    return {};
}

ParsedHead parse_head(std::string_view text) {
    ParsedHead parsed;
    RequestHead& head = parsed.head;
    bool first = true;
    // What is left at the end is the empty line.
    while (text.size() > 2) {
        const std::size_t end = text.find("\r\n");
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end + 2);
        parsed.error = first ? parse_request_line(line, head) : parse_field(line, head);
        if (parsed.error) return parsed;
        first = false;
    }
    for (const auto check : {check_host, check_length, check_rest}) {
        parsed.error = check(head);
        if (parsed.error) return parsed;
    }
    return parsed;
}

}  // namespace awan
