// The header of a PLY file (Turk 1994): which elements follow it, and what each row of them holds.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace awan::ply {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct ScalarType {
    std::string_view name, other_name;
    std::size_t size;
    double (*read)(const char*);
    // As a colour, this value means 1.
    double white;
};

struct Property {
    const ScalarType* type = nullptr;
    // Of a list: the type of its length; else null.
    const ScalarType* length = nullptr;
    std::string name;
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
    // The line of the header that names it.
    std::size_t line = 0;

    // Bytes of a row; 0 when lists make that differ from row to row, or when there are no properties.
    std::size_t stride() const;
    bool has_lists() const;
};

struct Header {
    Encoding encoding = Encoding::kAscii;
    std::vector<Element> elements;
    // How many lines it has.
    std::size_t lines = 0;
};

// Takes the header off the front of `bytes`. Lines may end as on any system. Errors: kMalformed, with the line.
Result<Header> take_header(std::string_view& bytes);

// The next word of a line; empty at its end.
std::string_view take_word(std::string_view& line);

}  // namespace awan::ply
