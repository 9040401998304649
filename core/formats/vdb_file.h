// Extinction as an OpenVDB file.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/survey/survey.h"

namespace awan {

// A fog volume `density` of floats, 1/unit, cells without matter left out. light: a number for each of its cells, which
// becomes a grid `light` beside it; EMPTY: none. Errors: kUnsupported where the module that
// writes it is not installed (vdb_module.h), kInvalidScene where there is no matter.
Result<std::string> encode_vdb(const DensityVolume& volume, const std::vector<float>& light = {});

}  // namespace awan
