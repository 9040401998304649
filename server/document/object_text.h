// Objects and lists of a document that is being written (write_scene.cpp, <model>.cpp).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/document/json_text.h"

namespace awan {

// One object of the document, members in order. Objects below the top stand on one line.
class ObjectText {
  public:
    ObjectText(std::string& out, const char* between, const char* end)
        : out_(out), between_(between), end_(end) {
        out_ += '{';
    }
    explicit ObjectText(std::string& out) : ObjectText(out, " ", " }") {}

    // Names a member; the caller appends its value.
    std::string& name(const char* field) {
        if (!empty_) out_ += ',';
        empty_ = false;
        out_ += between_;
        out_ += '"';
        out_ += field;
        out_ += "\": ";
        return out_;
    }
    void number(const char* field, double value) { append_json_number(value, name(field)); }
    void integer(const char* field, std::uint64_t value) { name(field) += std::to_string(value); }
    void vector(const char* field, const glm::dvec3& v) { append_json_vector(v, name(field)); }
    void text(const char* field, std::string_view value) { append_json_string(value, name(field)); }

    // Only when it is not the default.
    void number(const char* field, double value, double standard) {
        if (value != standard) number(field, value);
    }
    void vector(const char* field, const glm::dvec3& v, const glm::dvec3& standard) {
        if (v != standard) vector(field, v);
    }

    bool empty() const { return empty_; }
    void end() { out_ += empty_ ? "}" : end_; }

  private:
    std::string& out_;
    const char* between_;
    const char* end_;
    bool empty_ = true;
};

// A member that is an object; left out when `fill_in` finds nothing to say.
template <typename FillIn>
void write_object(ObjectText& parent, const char* field, FillIn fill_in) {
    std::string text;
    ObjectText inner(text);
    fill_in(inner);
    if (inner.empty()) return;
    inner.end();
    parent.name(field) += text;
}

template <typename T, typename Append>
void write_list(ObjectText& parent, const char* field, const std::vector<T>& values,
                Append append) {
    std::string& out = parent.name(field);
    out += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) out += ',';
        append(values[i], out);
    }
    out += ']';
}

}  // namespace awan
