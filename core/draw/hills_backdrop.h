// What stands behind the clouds where the ground has hills: every pixel's ray meets hills, the level ground or the sky.
#pragma once

#include <span>

#include "core/draw/air.h"
#include "core/draw/backdrop.h"
#include "core/light/relief_light.h"

namespace awan {

// What rays from one eye meet. It refers to what it is made from.
class HillsInView {
  public:
    // Precondition: the ground has hills. light: how they are lit; null: not at all.
    HillsInView(const Scene& scene, const View& view, const GroundLight& ground,
                const ReliefLight* light);
    // Distance along a direction (unit) from the eye; infinite: to the sky. An eye below the level ground sees neither.
    double ahead(const glm::dvec3& direction) const;
    // At that distance; aside: as radiance_at (core/light/relief_light.h).
    glm::dvec3 radiance(const glm::dvec3& direction, double distance,
                        const glm::dvec2& aside = glm::dvec2(0)) const;

  private:
    SkyDome sky_;
    glm::dvec3 eye_;
    const GroundLight& ground_;
    const ReliefLight* light_;
    bool seen_;
};

// As make_backdrop. Each pixel by its middle's ray, or, where that differs much from its neighbours', by four; with the
// haze before it where there is some. air, light: may be null. wanted: as there; elsewhere nothing is looked at.
Backdrop hills_backdrop(const Scene& scene, const View& view, int width, int height,
                        const GroundLight& ground, const ReliefLight* light, const Air* air,
                        int threads, std::span<const std::uint8_t> wanted = {});

}  // namespace awan
