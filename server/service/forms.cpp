#include "server/service/forms.h"

#include <algorithm>

#include "server/header_text.h"

namespace awan {
namespace {

Error bad_form(std::string message) {
    return {ErrorCode::kMalformed, "", "the form cannot be read: " + std::move(message)};
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char l = static_cast<char>(c | 0x20);
    return l >= 'a' && l <= 'f' ? l - 'a' + 10 : -1;
}

std::string percent_decoded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        if (low >= 0) {
            out += static_cast<char>(high * 16 + low);
            i += 2;
        } else {
            out += text[i] == '+' ? ' ' : text[i];
        }
    }
    return out;
}

// A parameter of a header's value: `name` of `form-data; name="scene"; filename="a.ply"`; "" when it has none.
std::string parameter(std::string_view value, std::string_view name) {
    while (true) {
        const std::size_t semicolon = value.find(';');
        if (semicolon == std::string_view::npos) return {};
        value = without_blanks(value.substr(semicolon + 1));
        const std::size_t equals = value.find('=');
        if (equals == std::string_view::npos) return {};
        const bool wanted = same(without_blanks(value.substr(0, equals)), name);
        value = without_blanks(value.substr(equals + 1));
        std::string text;
        if (value.starts_with('"')) {
            std::size_t i = 1;
            for (; i < value.size() && value[i] != '"'; ++i) {
                if (value[i] == '\\' && i + 1 < value.size() &&
                    (value[i + 1] == '"' || value[i + 1] == '\\'))
                    ++i;
                text += value[i];
            }
            value.remove_prefix(std::min(i + 1, value.size()));
        } else {
            const std::string_view word = value.substr(0, value.find(';'));
            text = without_blanks(word);
            value.remove_prefix(word.size());
        }
        if (wanted) return text;
    }
}

// Head and value of one part, the bytes between two boundaries.
Result<FormPart> read_part(std::string_view bytes) {
    FormPart part;
    for (;;) {
        const std::size_t end = bytes.find("\r\n");
        if (end == std::string_view::npos) return bad_form("a part has no end of its head");
        const std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(end + 2);
        if (line.empty()) break;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos)
            return bad_form("a line of a part's head is no header");
        const std::string_view name = line.substr(0, colon),
                               value = without_blanks(line.substr(colon + 1));
        if (same(name, "Content-Disposition")) {
            part.name = parameter(value, "name");
            part.file_name = parameter(value, "filename");
        } else if (same(name, "Content-Type")) {
            part.content_type = value;
        }
    }
    if (part.name.empty()) return bad_form("a part has no name");
    part.value = bytes;
    return part;
}

std::string percent_encoded(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto u = static_cast<unsigned char>(c);
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~';
        if (plain)
            out += c;
        else
            out += {'%', "0123456789ABCDEF"[u >> 4], "0123456789ABCDEF"[u & 15]};
    }
    return out;
}

}  // namespace

std::string query_text(const std::vector<std::pair<std::string, std::string>>& query) {
    std::string out;
    for (const auto& [name, value] : query)
        out += (out.empty() ? "?" : "&") + percent_encoded(name) + "=" + percent_encoded(value);
    return out;
}

Result<std::vector<FormPart>> read_urlencoded(std::string_view body) {
    std::vector<FormPart> parts;
    while (!body.empty()) {
        const std::string_view field = body.substr(0, body.find('&'));
        body.remove_prefix(std::min(field.size() + 1, body.size()));
        if (field.empty()) continue;
        if (parts.size() == kMostFormParts)
            return bad_form("at most " + std::to_string(kMostFormParts) + " fields are allowed");
        const std::size_t equals = std::min(field.find('='), field.size());
        FormPart part;
        part.name = percent_decoded(field.substr(0, equals));
        part.value = percent_decoded(field.substr(std::min(equals + 1, field.size())));
        parts.push_back(std::move(part));
    }
    return parts;
}

Result<std::vector<FormPart>> read_multipart(std::string_view content_type, std::string_view body) {
    const std::string boundary = parameter(content_type, "boundary");
    // RFC 2046, 5.1.1.
    if (boundary.empty() || boundary.size() > 70) return bad_form("Content-Type names no boundary");
    const std::string delimiter = "\r\n--" + boundary;
    std::vector<FormPart> parts;
    // What stands before the first boundary is nobody's; that one may begin the body.
    if (body.starts_with(std::string_view(delimiter).substr(2))) {
        body.remove_prefix(delimiter.size() - 2);
    } else {
        const std::size_t first = body.find(delimiter);
        if (first == std::string_view::npos) return bad_form("its boundary does not stand in it");
        body.remove_prefix(first + delimiter.size());
    }
    for (;;) {
        if (body.starts_with("--")) return parts;
        while (!body.empty() && (body.front() == ' ' || body.front() == '\t'))
            body.remove_prefix(1);
        if (!body.starts_with("\r\n")) return bad_form("something stands behind a boundary");
        body.remove_prefix(2);
        const std::size_t end = body.find(delimiter);
        if (end == std::string_view::npos) return bad_form("the last part has no end");
        if (parts.size() == kMostFormParts)
            return bad_form("at most " + std::to_string(kMostFormParts) + " fields are allowed");
        auto part = read_part(body.substr(0, end));
        if (!part) return part.error();
        parts.push_back(*std::move(part));
        body.remove_prefix(end + delimiter.size());
    }
}

}  // namespace awan
