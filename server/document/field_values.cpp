#include "server/document/field_values.h"

#include "core/scene/limits.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace awan {
namespace {

bool set_word(const Field& field, void* object, std::string_view word) {
    for (std::size_t i = 0; i < field.words.size(); ++i)
        if (field.words[i] == word) {
            field.access.set_word(field.access.put(object), i);
            return true;
        }
    return false;
}

// A word in place of an object.
bool set_object_by_word(const Field& field, void* object, std::string_view word) {
    const Table& table = field.access.table();
    const Field* const absence = absence_of(table);
    if (absence != nullptr && absence->absent == word) {
        set_absent(table, field.access.put(object), true);
        return true;
    }
    if (table.shorthand == nullptr) return false;
    const int which = find_field(table, table.shorthand);
    void* const inner = field.access.put(object);
    if (!set_word(table.fields[static_cast<std::size_t>(which)], inner, word)) return false;
    complete_defaults(table, std::uint64_t{1} << which, inner);
    return true;
}

// Takes the word that a field has for "not given".
void set_not_given(const Field& field, void* object) {
    if (field.access.set_unused != nullptr)
        *field.access.set_unused(object) = true;
    else if (field.access.holds == Holds::kSwitch)
        *static_cast<Switch*>(field.access.put(object)) = Switch::kAuto;
    else if (field.access.clear != nullptr)
        field.access.clear(object);
}

// Out of float32's range becomes infinite, which validate() refuses.
float to_float(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (std::abs(value) <= kLargest) return static_cast<float>(value);
    return std::copysign(std::numeric_limits<float>::infinity(),
                         static_cast<float>(value > 0) - 0.5f);
}

}  // namespace

int find_field(const Table& table, std::string_view name) {
    for (std::size_t i = 0; i < table.fields.size(); ++i)
        if (table.fields[i].in_documents() && table.fields[i].name == name)
            return static_cast<int>(i);
    return -1;
}

std::string allowed_names(const Table& table) {
    std::string names;
    for (const Field& field : table.fields) {
        if (!field.in_documents()) continue;
        names += names.empty() ? "\"" : ", \"";
        names += field.name;
        names += '"';
    }
    return names;
}

bool takes_words(const Field& field) {
    if (field.absent != nullptr || !field.words.empty()) return true;
    if (field.access.holds == Holds::kText) return true;
    if (field.access.holds != Holds::kObject) return false;
    const Table& table = field.access.table();
    return table.shorthand != nullptr || absence_of(table) != nullptr;
}

std::uint64_t most_bytes(const Field& field) {
    const bool own = field.access.holds == Holds::kText && field.counts.highest != Counts{}.highest;
    return own ? field.counts.highest : limits::kMaxString;
}

void set_absent(const Table& table, void* object, bool absent) {
    if (const Field* const field = absence_of(table))
        *static_cast<bool*>(field->access.put(object)) = absent;
}

void complete_defaults(const Table& table, std::uint64_t seen, void* object) {
    if (table.complete != nullptr) table.complete(object, Given{table, seen});
    for (std::size_t i = 0; i < table.fields.size(); ++i) {
        const Field& field = table.fields[i];
        if (field.usual == nullptr || field.access.optional || (seen >> i & 1) != 0) continue;
        *static_cast<double*>(field.access.put(object)) = field.usual(object);
    }
}

void* put_field(const Field& field, void* object) {
    if (field.access.set_unused != nullptr) *field.access.set_unused(object) = false;
    return field.access.put(object);
}

bool take_word(const Field& field, void* object, std::string& word) {
    if (field.absent != nullptr && word == field.absent) {
        set_not_given(field, object);
        return true;
    }
    switch (field.access.holds) {
        case Holds::kText:
            *static_cast<std::string*>(put_field(field, object)) = std::move(word);
            return true;
        case Holds::kWord:
            return set_word(field, object, word);
        case Holds::kObject:
            return set_object_by_word(field, object, word);
        default:
            return false;
    }
}

bool is_list_field(const Field& field) {
    return field.access.holds == Holds::kObjects || field.access.holds == Holds::kFloats ||
           is_of_rows(field);
}

bool is_integer_field(const Field& field) {
    return field.access.holds == Holds::kInteger || field.access.holds == Holds::kInt;
}

bool is_of_rows(const Field& list) {
    return list.access.holds == Holds::kPoints || list.access.holds == Holds::kColors;
}

const char* wanted_element(const Field& list) {
    switch (list.access.holds) {
        case Holds::kFloats:
            return "a number";
        case Holds::kPoints:
            return "[x, y, z]: three numbers";
        case Holds::kColors:
            return "[r, g, b]: three numbers";
        default:
            return "an object";
    }
}

void append_to_list(void* list, double value) {
    static_cast<std::vector<float>*>(list)->push_back(to_float(value));
}

void append_row(const Field& field, void* list, const glm::dvec3& v) {
    if (field.access.holds == Holds::kPoints)
        static_cast<std::vector<glm::dvec3>*>(list)->push_back(v);
    else
        static_cast<std::vector<glm::vec3>*>(list)->emplace_back(to_float(v.x), to_float(v.y),
                                                                 to_float(v.z));
}

}  // namespace awan
