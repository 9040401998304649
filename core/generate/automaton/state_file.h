// A state of an automaton as bytes, so that a long run can go on another day (awan state, --state).
//
// 64-bit words, little-endian: "AWANSTA1"; version; nx, ny, nz; key; rules; step; number of earlier skies; number of
// ellipsoids; six doubles an ellipsoid (centre, radii); hum, act, cld and the earlier skies, a bit a cell in rows of
// words (grid.h); a sum over all words before it, which finds what was damaged, not what was forged.
#pragma once

#include <string>
#include <string_view>

#include "core/generate/automaton/state.h"

namespace awan::automaton {

std::string write_state(const AutomatonState& state);

// bytes: any. kMalformed: not such a file, or a damaged one. Whether it belongs to a cloud is for check_start()
// (run.h) to say.
Result<AutomatonState> read_state(std::string_view bytes);

}  // namespace awan::automaton
