// The transport solve of one part of a scene, or of all of it: what transport.h and islands.h are made from.
#pragma once

#include <functional>

#include "core/light/transport.h"

namespace awan {

// Radiance that reaches a part along `direction` (unit, the way the light goes), in units of the colour of band `band`,
// where the open sky would send `sky`.
using Surroundings =
    std::function<double(std::size_t band, const glm::dvec3& direction, double sky)>;

struct LightPart {
    const ParticleSet& own;  // the grid goes around these; not empty, with mass
    const ParticleSet& all;  // and holds what of these lies in it
    SunDepth sun;
    double deepest = 0;           // optical depth of the longest line towards the sun or the zenith
    Surroundings surroundings{};  // empty: the open sky
    // The solve of the whole scene, of which this is a part: the part's bands come in its order. Null: this is all.
    const TransportLight* whole = nullptr;
    // Where hills shade `sun`: the same without them. Null: nothing but matter does.
    std::shared_ptr<const SunDepth> open_sun{};
};

// As transport_light; settings.islands is not looked at.
Result<TransportLight> light_of_part(const Scene& scene, LightPart part,
                                     const TransportSettings& settings, const SharedLight& coarser,
                                     int threads, const Deadline& deadline);

// The whole scene as one part. Precondition: the particles have mass.
Result<TransportLight> light_of_whole(const Scene& scene, const ParticleSet& particles,
                                      const Survey& survey, const TransportSettings& settings,
                                      const SharedLight& coarser, int threads,
                                      const Deadline& deadline);

}  // namespace awan
