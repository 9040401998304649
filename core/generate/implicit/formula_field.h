// A formula of the user's (core/scene/formula.h) at work: sixteen places at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/generate/implicit/noise.h"
#include "core/scene/formula.h"

namespace awan::implicit {

// A formula with all that does not depend on the place.
struct PreparedFormula {
    Formula formula;
    Octaves octaves;
    float time = 0, seed = 0;
    // Where the primitives begin, in the frame, and 1 / how high they are.
    float floor = 0, slope = 1;
    // A place p of the frame is p * unit + middle in the cloud's coordinates.
    float unit = 1;
    glm::vec3 middle{0};
    // Of the field's elements, all.
    std::vector<std::uint32_t> every;
};

// Sixteen places, in the frame, and what the model has there.
struct FormulaPlaces {
    float x[lanes::kCount], y[lanes::kCount], z[lanes::kCount];
    float density[lanes::kCount], primitives[lanes::kCount], turbulence[lanes::kCount];
};

// Writes what the formula says, from 0 to limits::kMaxImplicitDensity, to out[0 .. lanes::kCount).
void run_formula(const PreparedFormula& formula, const Element* elements,
                 const FormulaPlaces& places, float* out);

}  // namespace awan::implicit
