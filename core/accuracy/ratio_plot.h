// How many times as fast something is as something else, as a picture: a bar a row on a logarithmic scale.
#pragma once

#include <span>
#include <string>

#include "core/accuracy/plot.h"

namespace awan {

struct RatioRow {
    // The rows of one group stand together, under its name, in the order in which they come.
    std::string group;
    std::string what;
    // At the right end, "90 ms: 2.1 ms here".
    std::string figures;
    // > 0.
    double times_as_fast = 1;
};

// PNG, 1120 pixels wide. Errors: kTooLarge for more rows than a picture can hold, kInternal.
Result<std::string> plot_ratios(const std::string& title, const std::string& about,
                                std::span<const RatioRow> rows, PlotTheme theme);

}  // namespace awan
