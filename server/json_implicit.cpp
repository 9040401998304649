// The fields of a cloud of model "implicit".
#include "core/scene/implicit.h"

#include "server/json_models.h"

namespace awan {

std::span<const Field> implicit_fields() {
    return {};
}

void write_implicit(const ImplicitCloud&, ObjectText&) {}

}  // namespace awan
