// Runs an automaton to a step.
#pragma once

#include "core/generate/automaton/state.h"

namespace awan::automaton {

// From the latest of cloud.starts and of the states in cloud.kept that is not later, else from step 0; the result is
// the same either way. On the way states go into cloud.kept, where that is set. Errors: kInvalidScene when one of the
// starts belongs to another cloud; kOverDeadline, kCancelled.
Result<AutomatonState> run_automaton(const AutomatonCloud& cloud, std::uint64_t key,
                                     std::uint64_t step, int threads, const Deadline& deadline,
                                     AutomatonScratch& scratch);

// Whether all of cloud.starts are of this cloud.
Status check_starts(const AutomatonCloud& cloud, std::uint64_t key);

}  // namespace awan::automaton
