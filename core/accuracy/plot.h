// What accuracy costs, as a picture: error over time with the Pareto front, and beneath it every
// rung's picture with its difference to the truth.
#pragma once

#include <span>
#include <string>

#include "core/accuracy/accuracy.h"

namespace awan {

enum class PlotTheme { kLight, kDark };

struct AccuracyPlot {
    // The scene's name; may be empty.
    std::string title;
    const AccuracyReport* report = nullptr;
};

// PNG, 1120 pixels wide times `scale` (1..4; above 1 for screens of more pixels an inch). Several
// plots stand one above the other, on the same axes. Errors: kTooLarge for more of them than a
// picture can hold, kInternal.
Result<std::string> plot_accuracy(std::span<const AccuracyPlot> plots, PlotTheme theme,
                                  double scale = 1);

}  // namespace awan
