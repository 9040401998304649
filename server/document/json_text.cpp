#include "server/document/json_text.h"

#include <cmath>
#include <cstddef>

#include "core/formats/particle_files.h"
#include "core/formats/quote.h"

namespace awan {
namespace {

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
