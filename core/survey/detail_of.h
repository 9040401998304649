#pragma once

#include <memory>

#include "core/generate/detail.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// The detail that the scene asks for (its defaults where it says nothing), made for what was surveyed; mass is kept
// to what the middles of the density volume's cells (48 along the longest side) can tell, some percent. Null: there
// is nothing to gather.
std::shared_ptr<const DetailField> detail_of(const Scene& scene, const Survey& survey, int threads,
                                             DetailTiles* tiles = nullptr);

}  // namespace awan
