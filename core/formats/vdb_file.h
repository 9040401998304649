// Extinction as an OpenVDB file.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/survey/survey.h"

namespace awan {

// A fog volume `density` of floats, 1/unit, cells without matter left out. Errors: kUnsupported where the module that
// writes it is not installed (vdb_module.h), kInvalidScene where there is no matter.
Result<std::string> encode_vdb(const DensityVolume& volume);

}  // namespace awan
