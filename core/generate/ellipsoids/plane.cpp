#include "core/generate/ellipsoids/plane.h"

#include <algorithm>
#include <cmath>

#include "core/generate/ellipsoids/formations.h"

namespace awan::ellipsoids {

PlaneTexture plane_texture(const SkyPlane& plane, const glm::dvec3& shift) {
    PlaneTexture made;
    made.own = texture_function(plane.texture, false, shift);
    for (const PlanePattern& pattern : plane.patterns)
        made.patterns.push_back(texture_function(pattern.texture, false, shift));
    return made;
}

double share_of(const PlanePattern& pattern, const glm::dvec3& place) {
    const double x = (place.x - pattern.x) / pattern.radius_x;
    const double z = (place.z - pattern.z) / pattern.radius_z;
    const double inside = 1 - std::sqrt(x * x + z * z);
    if (!(inside > 0)) return 0;
    if (inside >= pattern.edge) return 1;
    // No corner at either end.
    const double t = inside / pattern.edge;
    return t * t * (3 - 2 * t);
}

double PlaneParts::texture() const {
    double sum = 0;
    for (const PlanePart& part : all()) sum += part.weight * part.value.mean;
    return sum;
}

double PlaneParts::opacity(double more, double least, double most) const {
    double sum = 0;
    for (const PlanePart& part : all())
        sum += part.weight *
               ellipsoids::opacity(part.value, part.threshold + part.range * more, part.range);
    return limited(sum, least, most);
}

}  // namespace awan::ellipsoids
