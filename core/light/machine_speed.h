// How fast this machine is beside the one on which the forecasts of times were calibrated.
#pragma once

#include "core/plan/forecast.h"

namespace awan {

// Times a small fixed piece of the transport solve five times, about 1 ms in all, and takes the best.
MachineSpeed measure_speed();

// What that piece takes on the machine of the calibration, ms.
inline constexpr double kCalibratedSweepMs = 0.168;

}  // namespace awan
