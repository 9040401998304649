#include "core/scene/check_ranges.h"

#include <cmath>

#include "core/scene/checks.h"

namespace awan {
namespace {

// Ends as a float has them: the smallest radius allowed rounds to just below itself.
bool in_range(float value, const Range& range) {
    return value >= static_cast<float>(range.lowest) && value <= static_cast<float>(range.highest);
}

bool in_range(double value, const Field& field) {
    const Range& range = field.range;
    const bool high_enough = range.above ? value > range.lowest : value >= range.lowest;
    return (high_enough && value <= range.highest) || (field.or_zero && value == 0);
}

// Where the walk is; its pointer is spelled out only to report.
struct Place {
    const Place* above = nullptr;
    // A field's; empty: element `index` of a list.
    std::string_view name;
    std::size_t index = 0;
};

std::string pointer_to(const Place& place) {
    if (place.above == nullptr) return std::string(place.name);
    const std::string last =
        place.name.empty() ? std::to_string(place.index) : std::string(place.name);
    return pointer_to(*place.above) + "/" + last;
}

Place part(const Place& at, std::size_t index) {
    return {&at, "", index};
}

Status check_object(const Table& table, const void* object, const Place& at);

Error out_of(const Field& field, double value, const Place& at) {
    if (field.outside != nullptr)
        return invalid(pointer_to(at),
                       std::string("must be ") + field.outside + ", not " + to_text(value));
    if (field.or_zero)
        return invalid(pointer_to(at), "must be 0 or from " + to_text(field.range.lowest) + " to " +
                                           to_text(field.range.highest) + ", not " +
                                           to_text(value));
    return out_of_range(pointer_to(at), value, field.range.lowest, field.range.highest);
}

Status check_vector(const Field& field, const glm::dvec3& v, const Place& at) {
    for (int i = 0; i < 3; ++i) {
        const Place place = part(at, static_cast<std::size_t>(i));
        if (!in_range(v[i], field)) return out_of(field, v[i], place);
        if (field.whole && v[i] != std::floor(v[i]))
            return invalid(pointer_to(place), "must be a whole number, not " + to_text(v[i]));
    }
    return std::nullopt;
}

Status check_count(const Field& field, std::uint64_t count, const Place& at) {
    const auto [lowest, highest] = field.counts;
    if (count >= lowest && count <= highest) return std::nullopt;
    return out_of_range(pointer_to(at), count, lowest, highest);
}

Status check_length(const Field& field, std::size_t length, const Place& at) {
    if (length <= field.counts.highest) return std::nullopt;
    return invalid(pointer_to(part(at, field.counts.highest)),
                   "at most " + std::to_string(field.counts.highest) + " elements are allowed");
}

Status check_floats(const Field& field, const std::vector<float>& list, const Place& at) {
    for (std::size_t i = 0; i < list.size(); ++i)
        if (!in_range(list[i], field.range)) return out_of(field, list[i], part(at, i));
    return std::nullopt;
}

template <typename Vector>
Status check_vectors(const Field& field, const std::vector<Vector>& list, const Place& at) {
    for (std::size_t i = 0; i < list.size(); ++i) {
        const glm::dvec3 v(list[i]);
        if (in_range(v.x, field) && in_range(v.y, field) && in_range(v.z, field)) continue;
        return check_vector(field, v, part(at, i));
    }
    return std::nullopt;
}

Status check_objects(const Field& field, const void* list, const Place& at) {
    const std::size_t size = field.access.size(list);
    for (std::size_t i = 0; i < size; ++i)
        if (Status wrong =
                check_object(field.access.table(), field.access.element(list, i), part(at, i)))
            return wrong;
    return std::nullopt;
}

Status check_list(const Field& field, const void* list, const Place& at) {
    switch (field.access.holds) {
        case Holds::kObjects: {
            if (Status wrong = check_length(field, field.access.size(list), at)) return wrong;
            return check_objects(field, list, at);
        }
        case Holds::kFloats: {
            const auto& floats = *static_cast<const std::vector<float>*>(list);
            if (Status wrong = check_length(field, floats.size(), at)) return wrong;
            return check_floats(field, floats, at);
        }
        case Holds::kPoints: {
            const auto& points = *static_cast<const std::vector<glm::dvec3>*>(list);
            if (Status wrong = check_length(field, points.size(), at)) return wrong;
            return check_vectors(field, points, at);
        }
        default: {
            const auto& colors = *static_cast<const std::vector<glm::vec3>*>(list);
            if (Status wrong = check_length(field, colors.size(), at)) return wrong;
            return check_vectors(field, colors, at);
        }
    }
}

Status check_word(const Field& field, const void* value, const Place& at) {
    if (field.access.word(value) < field.words.size()) return std::nullopt;
    return invalid(pointer_to(at), "must be " + wanted_of(field));
}

Status check_value(const Field& field, const void* value, const Place& at) {
    switch (field.access.holds) {
        case Holds::kNumber: {
            const double number = *static_cast<const double*>(value);
            if (in_range(number, field)) return std::nullopt;
            return out_of(field, number, at);
        }
        case Holds::kInteger:
            return check_count(field, *static_cast<const std::uint64_t*>(value), at);
        case Holds::kInt: {
            const int count = *static_cast<const int*>(value);
            if (count < 0)
                return out_of_range(pointer_to(at), count, static_cast<double>(field.counts.lowest),
                                    static_cast<double>(field.counts.highest));
            return check_count(field, static_cast<std::uint64_t>(count), at);
        }
        case Holds::kVector:
            return check_vector(field, *static_cast<const glm::dvec3*>(value), at);
        case Holds::kWord:
            return check_word(field, value, at);
        case Holds::kObject:
            return check_object(field.access.table(), value, at);
        case Holds::kObjects:
        case Holds::kFloats:
        case Holds::kPoints:
        case Holds::kColors:
            return check_list(field, value, at);
        case Holds::kText:
        case Holds::kSwitch:
        case Holds::kAbsence:
        case Holds::kOutside:
            return std::nullopt;
    }
    return std::nullopt;
}

Status check_object(const Table& table, const void* object, const Place& at) {
    if (is_absent(table, object)) return std::nullopt;
    for (const Field& field : table.fields) {
        if (!field.in_documents()) continue;
        const void* const value = field.access.get(object);
        if (value == nullptr) continue;
        if (Status wrong = check_value(field, value, {&at, field.name, 0})) return wrong;
    }
    return std::nullopt;
}

}  // namespace

Status check_ranges(const Table& table, const void* object, const std::string& at) {
    return check_object(table, object, {nullptr, at, 0});
}

}  // namespace awan
