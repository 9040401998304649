// How what is most in the middle falls off to its edge: probabilities in an automaton's ellipsoids, weights of
// smoothing.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// F(u), u from 0 in the middle to 1 at the edge:
//   linear 1 - u,   quadratic 1 - u^2,   smooth 1 - 3 u^2 + 2 u^3 (level at both ends),
//   table: values at equal steps of u, straight between them.
enum class AutomatonShape { kLinear, kQuadratic, kSmooth, kTable };
inline constexpr const char* kAutomatonShapeWords[] = {"linear", "quadratic", "smooth", "table"};

// The same, after kEven: F = 1.
enum class AutomatonWeight { kEven, kLinear, kQuadratic, kSmooth, kTable };
inline constexpr const char* kAutomatonWeightWords[] = {"even", "linear", "quadratic", "smooth",
                                                        "table"};

static_assert(static_cast<int>(AutomatonWeight::kTable) ==
              static_cast<int>(AutomatonShape::kTable) + 1);

// A table of kTable, 2 to kMaxAutomatonTable values.
constexpr Row shape_table(Row row) {
    row.wanted = "a list of numbers from 0 to 1";
    row.range = from_to(0, 1);
    row.counts = at_most(limits::kMaxAutomatonTable);
    return row;
}

}  // namespace awan
