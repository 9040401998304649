// Columns of a file of ready particles -> ReadyParticles. CSV and PLY share it: both find their
// columns by name.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/scene.h"

namespace awan {

// What a column holds; the order of kColumnNames.
enum class Column { kX, kY, kZ, kRadius, kDensity, kRed, kGreen, kBlue };
inline constexpr std::size_t kColumnCount = 8;

// Nothing for a column that says nothing to us (a velocity, an id): it is skipped.
std::optional<Column> column_from_name(std::string_view name);
const char* column_name(Column column);

// Gathers the particles of a file, whatever columns it has.
class ReadyColumns {
  public:
    // Declares that the file has this column; false when it has had it before.
    bool declare(Column column);

    // After the last declare(): nothing, or what is missing.
    std::optional<std::string> missing() const;

    void reserve(std::size_t count);

    // The values of one particle, in the order of Column; those not declared are not looked at.
    void add(const std::array<double, kColumnCount>& values);

    std::size_t size() const { return ready_.positions.size(); }

    // The draft of read_particles_*(): one cloud, every other value at its default.
    SceneDraft take();

  private:
    bool has(Column column) const { return declared_[static_cast<std::size_t>(column)]; }

    std::array<bool, kColumnCount> declared_{};
    ReadyParticles ready_;
    bool all_white_ = true;
};

// The error of a file with more particles than a scene may have.
Error too_many_particles(std::string pointer);

}  // namespace awan
