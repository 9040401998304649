// Runs an automaton to a step.
#pragma once

#include "core/generate/automaton/state.h"

namespace awan::automaton {

// From cloud.start where that is set and not later, else from step 0; the result is the same either way. Errors:
// kInvalidScene when the start belongs to another cloud; kOverDeadline, kCancelled.
Result<AutomatonState> run_automaton(const AutomatonCloud& cloud, std::uint64_t key,
                                     std::uint64_t step, int threads, const Deadline& deadline,
                                     AutomatonScratch& scratch);

// Whether cloud.start, which is set, is of this cloud.
Status check_start(const AutomatonCloud& cloud, std::uint64_t key);

}  // namespace awan::automaton
