#include "core/scene/checks.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace awan {
namespace {

Error not_from_to(std::string pointer, const std::string& value, const std::string& lowest,
                  const std::string& highest) {
    return invalid(std::move(pointer),
                   "must be from " + lowest + " to " + highest + ", not " + value);
}

}  // namespace

std::string to_text(double value) {
    if (std::isnan(value)) return "not a number";
    if (std::isinf(value)) return value > 0 ? "infinite" : "minus infinite";
    std::array<char, 32> buffer{};
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

Error invalid(std::string pointer, std::string message) {
    return {ErrorCode::kInvalidScene, std::move(pointer), std::move(message)};
}

Error out_of_range(std::string pointer, double value, double lowest, double highest) {
    return not_from_to(std::move(pointer), to_text(value), to_text(lowest), to_text(highest));
}

Error out_of_range(std::string pointer, std::uint64_t value, std::uint64_t lowest,
                   std::uint64_t highest) {
    return not_from_to(std::move(pointer), std::to_string(value), std::to_string(lowest),
                       std::to_string(highest));
}

Status in_range(double value, double lowest, double highest, const std::string& pointer) {
    if (value >= lowest && value <= highest) return std::nullopt;
    return out_of_range(pointer, value, lowest, highest);
}

Status count_in_range(std::uint64_t value, std::uint64_t lowest, std::uint64_t highest,
                      const std::string& pointer) {
    if (value >= lowest && value <= highest) return std::nullopt;
    return out_of_range(pointer, value, lowest, highest);
}

}  // namespace awan
