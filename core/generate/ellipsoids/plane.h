// What covers the sky plane at a place: its own texture, and over it the patterns of its parts.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/generate/ellipsoids/texture.h"
#include "core/scene/ellipsoids.h"

namespace awan::ellipsoids {

struct PlaneTexture {
    TextureFunction own;
    // As many as the plane has patterns.
    std::vector<TextureFunction> patterns;
};
PlaneTexture plane_texture(const SkyPlane& plane, const glm::dvec3& shift);

// The share, 0..1, of a pattern at a place: 1 in its middle, 0 from its radii on; the pattern alone counts where it
// is 1.
double share_of(const PlanePattern& pattern, const glm::dvec3& place);

// One of the textures at a place.
struct PlanePart {
    // Of all parts together 1.
    double weight = 1;
    TextureValue value;
    double threshold = 0, range = 1;
};
class PlaneParts {
  public:
    void add(const PlanePart& part) { parts_[count_++] = part; }
    std::span<const PlanePart> all() const { return {parts_.data(), count_}; }
    // The texture that shades, It.
    double texture() const;
    // The share that is opaque where the thresholds are `more` of their ranges higher.
    double opacity(double more, double least, double most) const;

  private:
    std::size_t count_ = 0;
    std::array<PlanePart, limits::kMaxPlanePatterns + 1> parts_;
};

// What a place sees; value(texture): of that texture there, a TextureValue.
template <typename Value>
PlaneParts parts_of(const SkyPlane& plane, const PlaneTexture& texture, const glm::dvec3& place,
                    const Value& value) {
    PlaneParts parts;
    // From the last pattern on, which lies over the others.
    double left = 1;
    for (std::size_t i = plane.patterns.size(); i-- > 0 && left > 0;) {
        const PlanePattern& pattern = plane.patterns[i];
        const double share = share_of(pattern, place);
        if (!(share > 0)) continue;
        parts.add({left * share, value(texture.patterns[i]), pattern.threshold, pattern.range});
        left *= 1 - share;
    }
    if (left > 0) parts.add({left, value(texture.own), plane.threshold, plane.range});
    return parts;
}

}  // namespace awan::ellipsoids
