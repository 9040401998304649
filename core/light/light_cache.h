// Lights that are kept while a camera moves.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/byte_cache.h"
#include "core/generate/detail.h"
#include "core/light/transport_light.h"
#include "core/plan/transport_settings.h"
#include "core/scene/scene.h"

namespace awan {

using LightCache = ByteCache<TransportLight>;

// What a light depends on, and nothing else: of the scene all but camera, image, haze, accuracy and most effects (the
// plan has turned those into settings), then the settings, then which of the sets that the scene's procedural clouds
// make for different eyes it was made from (ParticleSet::variant). Lights of equal keys are equal.
// `detail`: ParticleSet's. Whether there is detail is the plan's choice, and a sequence makes it for figures of its
// own: the scene alone does not say.
std::string light_key(const Scene& scene, const TransportSettings& settings,
                      std::uint64_t variant = 0, const DetailField* detail = nullptr);

}  // namespace awan
