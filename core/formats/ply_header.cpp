#include "core/formats/ply_header.h"

#include <cstring>

#include "core/formats/numbers.h"

namespace awan::ply {
namespace {

template <typename T>
double from_bytes(const char* bytes) {
    T value;
    // x86-64 is little-endian; bytes of the other order are turned before.
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

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

const ScalarType* type_of(std::string_view name) {
    for (const ScalarType& type : kTypes)
        if (name == type.name || name == type.other_name) return &type;
    return nullptr;
}

// As many as any real file has, and more.
constexpr std::size_t kMaxLines = 2000, kMaxElements = 100, kMaxProperties = 1000;

Error ply_error(std::string message) {
    return {ErrorCode::kMalformed, "", std::move(message)};
}

Status read_format(std::string_view line, Header& header) {
    const std::string_view format = take_word(line);
    if (format == "ascii")
        header.encoding = Encoding::kAscii;
    else if (format == "binary_little_endian")
        header.encoding = Encoding::kLittleEndian;
    else if (format == "binary_big_endian")
        header.encoding = Encoding::kBigEndian;
    else
        return at_line(header.lines,
                       "the format must be ascii, binary_little_endian or binary_big_endian, not " +
                           short_quote(format));
    if (take_word(line) != "1.0") return at_line(header.lines, "the version must be 1.0");
    return std::nullopt;
}

Status read_element(std::string_view line, Header& header) {
    if (header.elements.size() == kMaxElements)
        return at_line(header.lines,
                       "at most " + std::to_string(kMaxElements) + " elements are allowed");
    Element element;
    element.name = take_word(line);
    element.line = header.lines;
    const std::string_view text = take_word(line);
    const auto count = read_number<std::uint64_t>(text);
    if (element.name.empty() || !count)
        return at_line(header.lines,
                       "an element must have a name and a number of rows, an integer >= 0, not " +
                           short_quote(text));
    element.count = *count;
    header.elements.push_back(std::move(element));
    return std::nullopt;
}

Status read_property(std::string_view line, Header& header) {
    if (header.elements.empty())
        return at_line(header.lines, "a property stands before its element");
    std::vector<Property>& properties = header.elements.back().properties;
    if (properties.size() == kMaxProperties)
        return at_line(header.lines,
                       "at most " + std::to_string(kMaxProperties) + " properties are allowed");
    Property property;
    std::string_view type = take_word(line);
    if (type == "list") {
        const std::string_view length = take_word(line);
        property.length = type_of(length);
        if (property.length == nullptr || property.length->white == 1)
            return at_line(header.lines, "the length of a list must be of an integer type, not " +
                                             short_quote(length));
        type = take_word(line);
    }
    property.type = type_of(type);
    property.name = take_word(line);
    if (property.type == nullptr)
        return at_line(header.lines, "a property must be of a type such as float or uchar, not " +
                                         short_quote(type));
    if (property.name.empty()) return at_line(header.lines, "a property must have a name");
    properties.push_back(std::move(property));
    return std::nullopt;
}

Status read_line(std::string_view line, Header& header, bool& has_format) {
    const std::string_view word = take_word(line);
    if (word == "comment" || word == "obj_info" || word.empty()) return std::nullopt;
    if (word == "element") return read_element(line, header);
    if (word == "property") return read_property(line, header);
    if (word != "format")
        return at_line(header.lines, "unknown word in the header: " + short_quote(word));
    has_format = true;
    return read_format(line, header);
}

// How the lines of this header end: as its first one does. What follows may be bytes that look like line ends.
std::string_view line_end_of(std::string_view bytes) {
    const std::size_t at = bytes.find_first_of("\r\n");
    if (at == std::string_view::npos || bytes[at] == '\n') return "\n";
    return bytes.substr(at, 2) == "\r\n" ? "\r\n" : "\r";
}

std::string_view take_up_to(std::string_view& bytes, std::string_view end) {
    const std::size_t at = bytes.find(end);
    const std::string_view line = bytes.substr(0, at);
    bytes.remove_prefix(at == std::string_view::npos ? bytes.size() : at + end.size());
    return line;
}

}  // namespace

bool Element::has_lists() const {
    for (const Property& property : properties)
        if (property.length != nullptr) return true;
    return false;
}

std::size_t Element::stride() const {
    if (has_lists()) return 0;
    std::size_t bytes = 0;
    for (const Property& property : properties) bytes += property.type->size;
    return bytes;
}

std::string_view take_word(std::string_view& line) {
    line = trim(line);
    std::size_t length = 0;
    while (length < line.size() && !is_blank(line[length])) ++length;
    const std::string_view word = line.substr(0, length);
    line.remove_prefix(length);
    return word;
}

Result<Header> take_header(std::string_view& bytes) {
    Header header;
    bool has_format = false;
    const std::string_view end = line_end_of(bytes.substr(0, 64));
    if (trim(take_up_to(bytes, end)) != "ply")
        return ply_error("a PLY file begins with the line `ply`");
    for (header.lines = 2;; ++header.lines) {
        if (bytes.empty() || header.lines > kMaxLines)
            return ply_error("the header has no end: `end_header` is missing");
        const std::string_view line = trim(take_up_to(bytes, end));
        if (line == "end_header") break;
        if (const Status wrong = read_line(line, header, has_format)) return *wrong;
    }
    if (!has_format) return ply_error("the header has no `format`");
    return header;
}

}  // namespace awan::ply
