// The cells of an automaton at a time, as they are, for whoever draws them and not their Gaussians.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/models.h"
#include "core/scene/automaton.h"

namespace awan::automaton {

// A cell with matter, or with cloud.
struct Cell {
    std::uint16_t i, j, k;
    // Whether cld is set, after the last whole step.
    bool cloud;
    // q, 0..1.
    float density;
};

// Of all planes in their order, rows in theirs: cells of more than `threshold`, and those with cloud. hold: of the last
// whole step, else between that and the next. Errors: kInvalidScene when a state to begin with belongs to another
// cloud; kOverDeadline, kCancelled.
Result<std::vector<Cell>> cells_of(const AutomatonCloud& cloud, const ModelRequest& request,
                                   bool hold, const Deadline& deadline);

// The ellipsoids as the wind has moved them at a time; errors of the deadline.
Result<std::vector<AutomatonEllipsoid>> ellipsoids_at(const AutomatonCloud& cloud,
                                                      std::uint64_t key, double time,
                                                      const Deadline& deadline);

}  // namespace awan::automaton
