// How accurate, or how fast, a scene wants its picture.
#pragma once

#include <optional>
#include <string>

#include "core/scene/table.h"

namespace awan {

inline constexpr double kDefaultError = 0.1;

// At most one is set; none = error kDefaultError.
struct Accuracy {
    std::optional<double> error;
    std::optional<double> time_ms;
    // By name (core/scene/rungs.h).
    std::optional<std::string> rung;
};

inline constexpr Field kAccuracyFields[] = {
    field<&Accuracy::error>({.name = "error",
                             .wanted = "a number > 0 (relative error)",
                             .range = above_zero(),
                             .says = "The cheapest rung that is predicted to stay under this "
                                     "relative error: RMS over the cloud's pixels, "
                                     "divided by their true mean.",
                             .otherwise = "0.1, where neither of the others is given",
                             .outside = "a relative error > 0"}),
    field<&Accuracy::time_ms>(
        {.name = "time_ms",
         .wanted = "a number > 0 (milliseconds)",
         .range = above_zero(),
         .unit = "ms",
         .says = "The most accurate rung that is predicted to take at most these milliseconds.",
         .outside = "milliseconds > 0"}),
    field<&Accuracy::rung>({.name = "rung",
                            .wanted = "the name of a rung",
                            .says = "This one; POST /v1/plan says what each simulates."}),
};
static_assert(covers<Accuracy>(kAccuracyFields));

inline constexpr Table kAccuracyTable{.name = "Accuracy",
                                      .says = "Exactly one of the three.",
                                      .fields = kAccuracyFields,
                                      .standard = standard_of<Accuracy>};
template <>
inline const Table& table_of<Accuracy>() {
    return kAccuracyTable;
}

}  // namespace awan
