// The density of a cloud that is given none.
#pragma once

#include <cstdint>

#include "core/base/deadline.h"
#include "core/base/result.h"
#include "core/scene/scene.h"

namespace awan {

// The mean optical depth that such a cloud has, over the lines through its matter along the axis on which it is
// thinnest: that of a well grown cumulus. Through the middle it is up to twice that, as a cloud thins out to its rim.
inline constexpr double kAutoDepth = 24;

// What makes a cloud of cubes, of ready particles or of an automaton (models.h) that deep, 1/unit: the peak extinction
// of a particle whose own density is 1. It depends on nothing but the cloud, its fill and its key = keyed(seed, cloud):
// it is the same at all times and on every machine. With 256 particles at most it is exact, with more it is found from
// 256 of them, evenly chosen (within 15%). Three digits; no more than a particle may have; kDefaultDensity for a cloud
// without matter, and for those of other models.
double auto_density(const Cloud& cloud, Fill fill, std::uint64_t key);

// The same of a cloud whose own density is "auto" (Cloud::auto_density), of any model: procedural ones are made
// coarsely for it, by their description alone, as they are when all that they begin with has come (the growth has
// ended, the last key is reached). So it is the same at all times, from all eyes. Errors: those of the model.
Result<double> own_auto_density(const Cloud& cloud, Fill fill, std::uint64_t key,
                                const Deadline& deadline);

}  // namespace awan
