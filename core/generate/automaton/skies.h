// The cloud bits from which the density of an automaton at a time is made.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/base/result.h"
#include "core/generate/automaton/density_planes.h"

namespace awan::automaton {

// Owns what CellDensity points to.
struct Skies {
    // After the steps to smooth over, the last one first; `next` one step later, EMPTY where nothing of it shows.
    std::vector<std::vector<std::uint64_t>> now, next;
    double share_of_next = 0;

    // Valid as long as these.
    CellDensity density() const;
};

// steps: how many have been made, and what share of the next. Errors: of run_automaton().
Result<Skies> skies_at(const AutomatonCloud& cloud, std::uint64_t key, double steps, int threads,
                       const Deadline& deadline);

}  // namespace awan::automaton
