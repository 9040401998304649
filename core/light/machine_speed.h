#pragma once

#include "core/plan/forecast.h"

namespace awan {

// Times a small fixed piece of the transport solve, about 5 ms, the best of five.
MachineSpeed measure_speed();

// What it takes on the machine on which times were calibrated, ms.
inline constexpr double kCalibratedSweepMs = 0.74;

}  // namespace awan
