// read_particles_ply(): PLY 1.0 (Turk 1994), ascii or binary little-endian. Only the `vertex`
// element is read; it must come first, as every writer puts it.
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "core/formats/ready_columns.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

Error malformed(std::string message, std::string pointer = "") {
    return {ErrorCode::kMalformed, std::move(pointer), std::move(message)};
}

template <typename T>
double from_bytes(const char* bytes) {
    T value;
    // x86-64 is little-endian too.
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

struct ScalarType {
    std::string_view name, other_name;
    std::size_t size;
    double (*read)(const char*);
    // As a colour, this value means 1.
    double white;
};

constexpr ScalarType kTypes[] = {
    {"char", "int8", 1, from_bytes<std::int8_t>, 127},
    {"uchar", "uint8", 1, from_bytes<std::uint8_t>, 255},
    {"short", "int16", 2, from_bytes<std::int16_t>, 32767},
    {"ushort", "uint16", 2, from_bytes<std::uint16_t>, 65535},
    {"int", "int32", 4, from_bytes<std::int32_t>, 2147483647.0},
    {"uint", "uint32", 4, from_bytes<std::uint32_t>, 4294967295.0},
    {"float", "float32", 4, from_bytes<float>, 1},
    {"double", "float64", 8, from_bytes<double>, 1},
};

struct Property {
    const ScalarType* type = nullptr;
    std::optional<Column> column;
};

struct Header {
    bool binary = false;
    std::uint64_t count = 0;
    std::vector<Property> properties;
    // Whether other elements follow the vertices.
    bool other_elements = false;
    std::size_t lines = 0;
};

// The next word of a line; empty at its end.
std::string_view take_word(std::string_view& line) {
    line = trim(line);
    std::size_t length = 0;
    while (length < line.size() && !is_blank(line[length])) ++length;
    const std::string_view word = line.substr(0, length);
    line.remove_prefix(length);
    return word;
}

Status read_property(std::string_view line, Header& header, ReadyColumns& columns) {
    // More properties than any real file has.
    constexpr std::size_t kMaxProperties = 256;
    const std::string_view type_name = take_word(line), name = take_word(line);
    if (header.properties.size() == kMaxProperties)
        return at_line(header.lines,
                       "at most " + std::to_string(kMaxProperties) + " properties are allowed");
    Property property;
    for (const ScalarType& type : kTypes)
        if (type_name == type.name || type_name == type.other_name) property.type = &type;
    if (property.type == nullptr)
        return at_line(header.lines,
                       "a property of a vertex must be a scalar, not " + short_quote(type_name));
    property.column = column_from_name(name);
    if (property.column && !columns.declare(*property.column))
        return at_line(header.lines, std::string("the property ") + column_name(*property.column) +
                                         " stands twice");
    header.properties.push_back(property);
    return std::nullopt;
}

Status read_format(std::string_view line, Header& header) {
    const std::string_view format = take_word(line);
    if (format != "ascii" && format != "binary_little_endian")
        return at_line(header.lines, "the format must be ascii or binary_little_endian, not " +
                                         short_quote(format));
    if (take_word(line) != "1.0") return at_line(header.lines, "the version must be 1.0");
    header.binary = format != "ascii";
    return std::nullopt;
}

Result<Header> read_header(std::string_view& bytes, ReadyColumns& columns) {
    // The most lines before the end of the header.
    constexpr std::size_t kMaxLines = 1000;
    Header header;
    bool has_format = false, has_vertex = false;
    if (trim(take_line(bytes)) != "ply") return malformed("a PLY file begins with the line `ply`");
    for (header.lines = 2;; ++header.lines) {
        if (bytes.empty() || header.lines > kMaxLines)
            return malformed("the header has no end: `end_header` is missing");
        std::string_view line = take_line(bytes);
        const std::string_view word = take_word(line);
        Status wrong;
        if (word == "end_header") {
            break;
        } else if (word == "comment" || word == "obj_info") {
            continue;
        } else if (word == "format") {
            has_format = true;
            wrong = read_format(line, header);
        } else if (word == "element") {
            if (has_vertex) {
                header.other_elements = true;
            } else if (take_word(line) != "vertex") {
                wrong = at_line(header.lines, "the first element must be vertex");
            } else {
                const std::string_view text = take_word(line);
                const auto count = read_number<std::uint64_t>(text);
                if (!count)
                    wrong = at_line(header.lines,
                                    "the number of vertices must be an integer "
                                    ">= 0, not " +
                                        short_quote(text));
                else
                    header.count = *count;
                has_vertex = true;
            }
        } else if (word == "property") {
            if (!has_vertex)
                wrong = at_line(header.lines, "a property stands before its element");
            else if (!header.other_elements)
                wrong = read_property(line, header, columns);
        } else {
            wrong = at_line(header.lines, "unknown word in the header: " + short_quote(word));
        }
        if (wrong) return *wrong;
    }
    if (!has_format) return malformed("the header has no `format`");
    if (!has_vertex) return malformed("the header has no `element vertex`");
    if (const std::optional<std::string> missing = columns.missing())
        return malformed("properties of a vertex: " + *missing);
    return header;
}

bool is_color(Column column) {
    return column >= Column::kRed;
}

// Colours of integer types span their type; only uchar is common.
void store(const Property& property, double value, std::array<double, kColumnCount>& values) {
    if (!property.column) return;
    if (is_color(*property.column)) value /= property.type->white;
    values[static_cast<std::size_t>(*property.column)] = value + 0.0;
}

Status read_binary(std::string_view bytes, const Header& header, ReadyColumns& columns) {
    std::size_t stride = 0;
    for (const Property& property : header.properties) stride += property.type->size;
    // Before anything is reserved: the header may claim anything.
    if (header.count > bytes.size() / stride)
        return malformed("the header says " + std::to_string(header.count) +
                         " vertices, but there are bytes for " +
                         std::to_string(bytes.size() / stride));
    if (!header.other_elements && bytes.size() != header.count * stride)
        return malformed("there are " + std::to_string(bytes.size() - header.count * stride) +
                         " bytes after the last vertex");
    columns.reserve(static_cast<std::size_t>(header.count));
    const char* at = bytes.data();
    for (std::uint64_t i = 0; i < header.count; ++i) {
        std::array<double, kColumnCount> values{};
        for (const Property& property : header.properties) {
            store(property, property.type->read(at), values);
            at += property.type->size;
        }
        columns.add(values);
    }
    return std::nullopt;
}

Status read_ascii(std::string_view text, const Header& header, ReadyColumns& columns) {
    std::size_t number = header.lines;
    while (columns.size() < header.count) {
        if (text.empty())
            return malformed("the header says " + std::to_string(header.count) +
                             " vertices, but there are lines for " +
                             std::to_string(columns.size()));
        std::string_view line = trim(take_line(text));
        ++number;
        if (line.empty()) continue;
        std::array<double, kColumnCount> values{};
        for (const Property& property : header.properties) {
            const std::string_view word = take_word(line);
            const std::optional<double> value = read_number<double>(word);
            if (!value)
                return at_line(number, "must hold " + std::to_string(header.properties.size()) +
                                           " finite numbers; one of them is " + short_quote(word));
            store(property, *value, values);
        }
        if (!trim(line).empty())
            return at_line(number, "must hold " + std::to_string(header.properties.size()) +
                                       " numbers; there are more");
        columns.add(values);
    }
    while (!header.other_elements && !text.empty()) {
        ++number;
        if (!trim(take_line(text)).empty())
            return at_line(number, "stands after the last vertex that the header announces");
    }
    return std::nullopt;
}

}  // namespace

Result<SceneDraft> read_particles_ply(std::string_view bytes) {
    ReadyColumns columns;
    const Result<Header> header = read_header(bytes, columns);
    if (!header) return header.error();
    if (header->count > limits::kMaxParticles) return too_many_particles("");
    const Status wrong =
        header->binary ? read_binary(bytes, *header, columns) : read_ascii(bytes, *header, columns);
    if (wrong) return *wrong;
    return columns.take();
}

}  // namespace awan
