// read_particles_ply(): PLY 1.0 (Turk 1994), ascii or binary of either order. The rows of `vertex` are particles; other
// elements, before and after it, are passed over.
#include <strings.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/formats/numbers.h"
#include "core/formats/particle_files.h"
#include "core/formats/ply_header.h"
#include "core/formats/ready_columns.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

using ply::Element;
using ply::Encoding;
using ply::Property;
using ply::ScalarType;

Error malformed_ply(std::string message) {
    return {ErrorCode::kMalformed, "", std::move(message)};
}

// Whether integers of it are shares of the whole that their type can say.
bool is_share(Says says) {
    return says == Says::kRed || says == Says::kGreen || says == Says::kBlue ||
           says == Says::kOpacity;
}

// What the properties of a vertex say.
struct VertexPlan {
    const Element* element = nullptr;
    std::vector<std::optional<Says>> used;

    // Colours and opacities of integer types span their type.
    void store(std::size_t i, double value, ReadyRow& row) const {
        if (!used[i]) return;
        if (is_share(*used[i])) value /= element->properties[i].type->white;
        row[*used[i]] = value + 0.0;
    }
};

// A value of a binary file.
double value_at(const char* bytes, const ScalarType& type, Encoding encoding) {
    if (encoding != Encoding::kBigEndian) return type.read(bytes);
    std::array<char, 8> turned{};
    std::reverse_copy(bytes, bytes + type.size, turned.begin());
    return type.read(turned.data());
}

// The bytes of one row of an element, of which the front of `bytes` is the first; nothing when the file ends before.
// place: of every property where its value (a list's length) begins, when it is not null.
std::optional<std::size_t> row_bytes(std::string_view bytes, const Element& element,
                                     Encoding encoding, std::vector<std::size_t>* place) {
    std::size_t at = 0;
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const Property& property = element.properties[i];
        if (place != nullptr) (*place)[i] = at;
        const ScalarType& first = property.length != nullptr ? *property.length : *property.type;
        if (bytes.size() - at < first.size) return {};
        if (property.length == nullptr) {
            at += first.size;
            continue;
        }
        const double length = value_at(bytes.data() + at, first, encoding);
        at += first.size;
        if (!(length >= 0) ||
            length > static_cast<double>((bytes.size() - at) / property.type->size))
            return {};
        at += static_cast<std::size_t>(length) * property.type->size;
    }
    return at;
}

std::string ends_early(const Element& element, std::uint64_t rows, const char* what) {
    return "the header says " + std::to_string(element.count) + " rows of " +
           short_quote(element.name) + ", but there are " + what + " for " + std::to_string(rows);
}

// Rows of no properties take no bytes, and those of lists at least one each, so no number of rows costs more than the
// file is long.
Status skip_binary(std::string_view& bytes, const Element& element, Encoding encoding) {
    if (element.properties.empty()) return std::nullopt;
    if (const std::size_t stride = element.stride()) {
        const std::uint64_t there = bytes.size() / stride;
        if (element.count > there) return malformed_ply(ends_early(element, there, "bytes"));
        bytes.remove_prefix(static_cast<std::size_t>(element.count) * stride);
        return std::nullopt;
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
        const auto size = row_bytes(bytes, element, encoding, nullptr);
        if (!size) return malformed_ply(ends_early(element, row, "bytes"));
        bytes.remove_prefix(*size);
    }
    return std::nullopt;
}

Status read_binary(std::string_view& bytes, const VertexPlan& plan, Encoding encoding,
                   ReadyColumns& columns) {
    const Element& element = *plan.element;
    const std::size_t stride = element.stride();
    // Before anything is reserved: the header may claim anything.
    if (stride != 0 && element.count > bytes.size() / stride)
        return malformed_ply(ends_early(element, bytes.size() / stride, "bytes"));
    if (stride != 0) columns.reserve(static_cast<std::size_t>(element.count));
    std::vector<std::size_t> place(element.properties.size());
    std::size_t size = 0;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        if (stride == 0 || i == 0) {
            const auto found = row_bytes(bytes, element, encoding, &place);
            if (!found) return malformed_ply(ends_early(element, i, "bytes"));
            size = *found;
        }
        ReadyRow row;
        for (std::size_t k = 0; k < place.size(); ++k)
            if (plan.used[k])
                plan.store(k,
                           value_at(bytes.data() + place[k], *element.properties[k].type, encoding),
                           row);
        bytes.remove_prefix(size);
        if (const Status wrong = columns.add(row))
            return malformed_ply("vertex " + std::to_string(i) + ": " + wrong->message);
    }
    return std::nullopt;
}

// Takes the next line that is not blank; false at the end.
bool take_full_line(std::string_view& text, std::size_t& number, std::string_view& line) {
    while (!text.empty()) {
        line = trim(take_line(text));
        ++number;
        if (!line.empty()) return true;
    }
    return false;
}

Status read_ascii_row(std::string_view line, std::size_t number, const VertexPlan& plan,
                      ReadyRow& row) {
    const std::vector<Property>& properties = plan.element->properties;
    for (std::size_t i = 0; i < properties.size(); ++i) {
        std::string_view word = ply::take_word(line);
        if (properties[i].length != nullptr) {
            const auto length = read_number<std::uint64_t>(word);
            if (!length)
                return at_line(number, "the length of the list " + short_quote(properties[i].name) +
                                           " must be an integer >= 0, not " + short_quote(word));
            for (std::uint64_t k = 0; k < *length; ++k)
                if (ply::take_word(line).empty())
                    return at_line(number, "the list " + short_quote(properties[i].name) +
                                               " is shorter than it says");
            continue;
        }
        const std::optional<double> value = read_number<double>(word);
        // Whatever else a property says, it is not looked at.
        if (!value && (plan.used[i] || word.empty()))
            return at_line(number, "must hold " + std::to_string(properties.size()) +
                                       " values, and " + short_quote(properties[i].name) +
                                       " must be a finite number, not " + short_quote(word));
        if (value) plan.store(i, *value, row);
    }
    if (!trim(line).empty())
        return at_line(
            number, "must hold " + std::to_string(properties.size()) + " values; there are more");
    return std::nullopt;
}

Status read_ascii(std::string_view& text, const VertexPlan& plan, std::size_t& number,
                  ReadyColumns& columns) {
    for (std::uint64_t i = 0; i < plan.element->count; ++i) {
        std::string_view line;
        if (!take_full_line(text, number, line))
            return malformed_ply(ends_early(*plan.element, i, "lines"));
        ReadyRow row;
        if (Status wrong = read_ascii_row(line, number, plan, row)) return wrong;
        if (const Status wrong = columns.add(row)) return at_line(number, wrong->message);
    }
    return std::nullopt;
}

// A line each; rows that hold nothing are blank lines, or none.
Status skip_ascii(std::string_view& text, const Element& element, std::size_t& number) {
    std::string_view line;
    for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
        if (!take_full_line(text, number, line))
            return malformed_ply(ends_early(element, i, "lines"));
    return std::nullopt;
}

// What follows the last element may be line ends alone.
Status check_end(std::string_view rest, Encoding encoding, std::size_t number) {
    std::string_view line;
    if (encoding == Encoding::kAscii)
        return take_full_line(rest, number, line)
                   ? Status(at_line(number,
                                    "stands after the last row that the header "
                                    "announces"))
                   : std::nullopt;
    if (rest.find_first_not_of("\r\n") == std::string_view::npos && rest.size() <= 2)
        return std::nullopt;
    return malformed_ply("there are " + std::to_string(rest.size()) + " bytes after the last row");
}

Result<VertexPlan> plan_vertices(const ply::Header& header, ReadyColumns& columns) {
    VertexPlan plan;
    std::vector<std::string> names;
    std::string others;
    for (const Element& element : header.elements) {
        if (strcasecmp(element.name.c_str(), "vertex") == 0 && plan.element == nullptr)
            plan.element = &element;
        if (names.size() < 4) others += (names.empty() ? "" : ", ") + short_quote(element.name);
        names.push_back(element.name);
    }
    if (plan.element == nullptr)
        return malformed_ply("the header has no `element vertex`" +
                             (names.empty() ? "" : "; there is " + others));
    names.clear();
    bool packed = false;
    for (const Property& property : plan.element->properties) {
        // A list says nothing of a particle.
        names.push_back(property.length != nullptr ? property.name + "[]" : property.name);
        packed = packed || property.name == "packed_position";
    }
    if (packed)
        return malformed_ply(
            "packed splats are not read; write them unpacked, with x, y, z and scale_0, 1, 2");
    auto used = columns.choose(names);
    if (!used)
        return at_line(plan.element->line, "properties of a vertex: " + used.error().message);
    plan.used = *std::move(used);
    for (std::size_t i = 0; i < plan.used.size(); ++i)
        if (plan.element->properties[i].length != nullptr && plan.used[i])
            return at_line(plan.element->line, short_quote(plan.element->properties[i].name) +
                                                   " is a list, and must be "
                                                   "a number");
    return plan;
}

}  // namespace

Result<SceneDraft> read_particles_ply(std::string_view bytes, const ParticleReading& reading) {
    bytes = without_byte_order_mark(bytes);
    const Result<ply::Header> header = ply::take_header(bytes);
    if (!header) return header.error();
    ReadyColumns columns(reading);
    const Result<VertexPlan> plan = plan_vertices(*header, columns);
    if (!plan) return plan.error();
    if (plan->element->count > limits::kMaxParticles) return too_many_particles("");
    std::size_t number = header->lines;
    const bool ascii = header->encoding == Encoding::kAscii;
    for (const Element& element : header->elements) {
        const bool is_vertex = &element == plan->element;
        Status wrong;
        if (ascii)
            wrong = is_vertex ? read_ascii(bytes, *plan, number, columns)
                              : skip_ascii(bytes, element, number);
        else
            wrong = is_vertex ? read_binary(bytes, *plan, header->encoding, columns)
                              : skip_binary(bytes, element, header->encoding);
        if (wrong) return *wrong;
    }
    if (const Status wrong = check_end(bytes, header->encoding, number)) return *wrong;
    return columns.take();
}

}  // namespace awan
