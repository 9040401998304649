#include "core/scene/table.h"

namespace awan {

std::string wanted_of(const Row& row) {
    if (row.wanted[0] != '\0') return row.wanted;
    const bool two = row.words.size() == 2;
    std::string text = two ? "" : "one of ";
    for (std::size_t i = 0; i < row.words.size(); ++i) {
        if (i > 0) text += two ? " or " : ", ";
        text += '"' + std::string(row.words[i]) + '"';
    }
    return text;
}

const Field* absence_of(const Table& table) {
    for (const Field& field : table.fields)
        if (field.access.holds == Holds::kAbsence) return &field;
    return nullptr;
}

bool is_absent(const Table& table, const void* object) {
    const Field* const absence = absence_of(table);
    return absence != nullptr && *static_cast<const bool*>(absence->access.member(object));
}

bool Given::has(std::string_view name) const {
    for (std::size_t i = 0; i < table.fields.size(); ++i)
        if (table.fields[i].name == name) return (bits >> i & 1) != 0;
    return false;
}

}  // namespace awan
