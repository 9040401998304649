// Pieces of JSON text.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

namespace awan {

// A JSON string with its quotes. Bytes that are not UTF-8 become U+FFFD, so that the text is JSON
// whatever came in.
void append_json_string(std::string_view text, std::string& out);

// The shortest number that reads back the same; null when it is not finite, which JSON cannot say.
void append_json_number(double value, std::string& out);
void append_json_number(float value, std::string& out);

void append_json_vector(const glm::dvec3& v, std::string& out);
void append_json_vector(const glm::vec3& v, std::string& out);

// Members of an object that is being written: `,"name":` and the value, or without the comma at the
// start of the object.
namespace json_text {
void name(const char* field, std::string& out);
void member(const char* field, double value, std::string& out);
void member(const char* field, std::uint64_t value, std::string& out);
void member(const char* field, int value, std::string& out);
void member(const char* field, std::string_view value, std::string& out);
void member(const char* field, bool value, std::string& out);
}  // namespace json_text

}  // namespace awan
