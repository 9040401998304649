#include "core/scene/table.h"

namespace awan {

const Field* absence_of(const Table& table) {
    for (const Field& field : table.fields)
        if (field.access.holds == Holds::kAbsence) return &field;
    return nullptr;
}

bool is_absent(const Table& table, const void* object) {
    const Field* const absence = absence_of(table);
    return absence != nullptr && *static_cast<const bool*>(absence->access.member(object));
}

}  // namespace awan
