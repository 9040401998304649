#include "server/document/json_text.h"

#include <cmath>
#include <cstddef>

#include "core/formats/particle_files.h"

namespace awan {
namespace {

// Length of the UTF-8 sequence at the start of `text`, 0 when it is not one (RFC 3629: no overlong
// forms, no surrogates, nothing beyond U+10FFFF).
std::size_t utf8_length(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
    const unsigned first = byte(0), second = byte(1);
    if (first < 0x80) return 1;
    if (first >= 0xC2 && first <= 0xDF) return continues(1) ? 2 : 0;
    if (first >= 0xE0 && first <= 0xEF) {
        if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F)) return 0;
        return continues(1) && continues(2) ? 3 : 0;
    }
    if (first >= 0xF0 && first <= 0xF4) {
        if ((first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F)) return 0;
        return continues(1) && continues(2) && continues(3) ? 4 : 0;
    }
    return 0;
}

template <typename T>
void append_finite(T value, std::string& out) {
    if (std::isfinite(value))
        append_number(value, out);
    else
        out += "null";
}

template <typename V>
void append_vector(const V& v, std::string& out) {
    out += '[';
    append_finite(v.x, out);
    out += ',';
    append_finite(v.y, out);
    out += ',';
    append_finite(v.z, out);
    out += ']';
}

}  // namespace

void append_json_string(std::string_view text, std::string& out) {
    out += '"';
    while (!text.empty()) {
        const std::size_t length = utf8_length(text);
        const char c = text.front();
        if (length == 0) {
            out += "\\ufffd";
        } else if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (c >= 0 && c < ' ') {
            out += "\\u00";
            out += "01"[c >> 4];
            out += "0123456789abcdef"[c & 15];
        } else {
            out.append(text.substr(0, length));
        }
        text.remove_prefix(length == 0 ? 1 : length);
    }
    out += '"';
}

void append_json_number(double value, std::string& out) {
    append_finite(value, out);
}
void append_json_number(float value, std::string& out) {
    append_finite(value, out);
}
void append_json_vector(const glm::dvec3& v, std::string& out) {
    append_vector(v, out);
}
void append_json_vector(const glm::vec3& v, std::string& out) {
    append_vector(v, out);
}

namespace json_text {

void name(const char* field, std::string& out) {
    if (out.empty() || (out.back() != '{' && out.back() != '[')) out += ',';
    out += '"';
    out += field;
    out += "\":";
}

void member(const char* field, double value, std::string& out) {
    name(field, out);
    append_json_number(value, out);
}

void member(const char* field, std::uint64_t value, std::string& out) {
    name(field, out);
    out += std::to_string(value);
}

void member(const char* field, int value, std::string& out) {
    name(field, out);
    out += std::to_string(value);
}

void member(const char* field, std::string_view value, std::string& out) {
    name(field, out);
    append_json_string(value, out);
}

void member(const char* field, bool value, std::string& out) {
    name(field, out);
    out += value ? "true" : "false";
}

}  // namespace json_text

}  // namespace awan
