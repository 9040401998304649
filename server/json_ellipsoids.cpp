// The fields of a cloud of model "ellipsoids".
#include "core/scene/ellipsoids.h"

#include "server/json_models.h"

namespace awan {

std::span<const Field> ellipsoids_fields() {
    return {};
}

void write_ellipsoids(const EllipsoidsCloud&, ObjectText&) {}

}  // namespace awan
