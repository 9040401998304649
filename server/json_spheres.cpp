// The fields of a cloud of model "spheres".
#include "core/scene/spheres.h"

#include "server/json_models.h"

namespace awan {

std::span<const Field> spheres_fields() {
    return {};
}

void write_spheres(const SpheresCloud&, ObjectText&) {}

}  // namespace awan
