// What accuracy costs, as JSON and CSV.
#pragma once

#include <span>
#include <string>

#include "core/accuracy/accuracy.h"

namespace awan {

struct NamedAccuracy {
    std::string name;  // of the scene; may be empty
    AccuracyReport report;
};

// {"width","height","reference":{"rung":"truth","width","height","samples","noise","time_ms",
// "cpu_ms"},"rungs":[{"rung","time_ms","light_ms","draw_ms","error","error_noise","bias",
// "bias_noise","flip","predicted":{"error","time_ms"},"memory_bytes","runs","pareto"}],
// "left_out":[{"rung","reason"}]}, cheapest first; null for what is not known. Several reports:
// {"scenes":[{"scene", ...}]}.
std::string accuracy_to_json(std::span<const NamedAccuracy> reports);

// A line a rung, with the columns of the JSON (predicted_error, predicted_time_ms); what is not
// known is empty. Several reports: a first column "scene".
std::string accuracy_to_csv(std::span<const NamedAccuracy> reports);

}  // namespace awan
