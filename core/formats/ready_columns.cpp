#include "core/formats/ready_columns.h"

#include <cmath>
#include <limits>

#include "core/scene/limits.h"

namespace awan {
namespace {

constexpr std::array<const char*, kColumnCount> kColumnNames = {"x",       "y",   "z",     "radius",
                                                                "density", "red", "green", "blue"};

// What is out of float32's range becomes infinite, which validate() refuses.
float to_float(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (std::isfinite(value) && std::abs(value) > kLargest)
        return static_cast<float>(std::copysign(std::numeric_limits<double>::infinity(), value));
    return static_cast<float>(value);
}

}  // namespace

std::optional<Column> column_from_name(std::string_view name) {
    if (name == "r") return Column::kRed;
    if (name == "g") return Column::kGreen;
    if (name == "b") return Column::kBlue;
    for (std::size_t i = 0; i < kColumnCount; ++i)
        if (name == kColumnNames[i]) return static_cast<Column>(i);
    return std::nullopt;
}

const char* column_name(Column column) {
    return kColumnNames[static_cast<std::size_t>(column)];
}

bool ReadyColumns::declare(Column column) {
    bool& declared = declared_[static_cast<std::size_t>(column)];
    if (declared) return false;
    declared = true;
    return true;
}

std::optional<std::string> ReadyColumns::missing() const {
    for (const Column column : {Column::kX, Column::kY, Column::kZ, Column::kRadius})
        if (!has(column))
            return std::string("x, y, z and radius are required; there is no ") +
                   column_name(column);
    const bool any = has(Column::kRed) || has(Column::kGreen) || has(Column::kBlue);
    const bool all = has(Column::kRed) && has(Column::kGreen) && has(Column::kBlue);
    if (any && !all) return "a colour needs all of red, green and blue (or r, g, b)";
    return std::nullopt;
}

void ReadyColumns::reserve(std::size_t count) {
    ready_.positions.reserve(count);
    ready_.radii.reserve(count);
    if (has(Column::kDensity)) ready_.densities.reserve(count);
    if (has(Column::kRed)) ready_.colors.reserve(count);
}

void ReadyColumns::add(const std::array<double, kColumnCount>& values) {
    const auto value = [&](Column column) { return values[static_cast<std::size_t>(column)]; };
    ready_.positions.emplace_back(value(Column::kX), value(Column::kY), value(Column::kZ));
    ready_.radii.push_back(to_float(value(Column::kRadius)));
    if (has(Column::kDensity)) ready_.densities.push_back(to_float(value(Column::kDensity)));
    if (!has(Column::kRed)) return;
    const glm::vec3 color(to_float(value(Column::kRed)), to_float(value(Column::kGreen)),
                          to_float(value(Column::kBlue)));
    all_white_ = all_white_ && color == glm::vec3(1.0f);
    ready_.colors.push_back(color);
}

SceneDraft ReadyColumns::take() {
    // White is the default, though our own answers write it out.
    if (all_white_) ready_.colors.clear();
    SceneDraft draft;
    draft.top_level_cubes = false;
    Cloud& cloud = draft.clouds.emplace_back();
    cloud.model = CloudModel::kParticles;
    // The column holds extinction itself.
    if (has(Column::kDensity)) cloud.density = 1.0;
    cloud.ready = std::move(ready_);
    return draft;
}

Error too_many_particles(std::string pointer) {
    return {
        ErrorCode::kTooLarge, std::move(pointer),
        "a scene may have at most " + std::to_string(limits::kMaxParticles) + " particles in all"};
}

}  // namespace awan
