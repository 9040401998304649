// Columns of a file of ready particles -> ReadyParticles. CSV and PLY share it: both find their columns by name.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/formats/column_names.h"
#include "core/formats/particle_files.h"
#include "core/scene/scene.h"

namespace awan {

// What a file says of one particle.
struct ReadyRow {
    std::array<double, kSaysCount> values{};
    // Bit i: the value i is not given for this particle, though the file has such a column.
    std::uint32_t empty = 0;

    double& operator[](Says says) { return values[static_cast<std::size_t>(says)]; }
    double operator[](Says says) const { return values[static_cast<std::size_t>(says)]; }
    bool lacks(Says says) const { return (empty >> static_cast<int>(says) & 1u) != 0; }
    void leave_empty(Says says) { empty |= 1u << static_cast<int>(says); }
};

// Gathers the particles of a file, whatever columns it has.
class ReadyColumns {
  public:
    explicit ReadyColumns(const ParticleReading& reading) : reading_(reading) {}

    // What each column of the file says, from their names in the file's order; nothing for those that are not used.
    // The error names the column and what was expected.
    Result<std::vector<std::optional<Says>>> choose(const std::vector<std::string>& names);

    void reserve(std::size_t count);

    // One particle; columns that the file does not have are not looked at. The error says which value cannot be.
    Status add(const ReadyRow& row);

    std::size_t size() const { return ready_.positions.size(); }

    // The draft of read_particles_*(): one cloud, every other value at its default. Says in reading.notes what was
    // taken for what.
    SceneDraft take();

  private:
    bool has(Says says) const { return has_[static_cast<std::size_t>(says)]; }
    void drop(Says says) { has_[static_cast<std::size_t>(says)] = false; }
    void note(std::string text) const;
    Status choose_radius(const std::vector<std::string>& names,
                         std::vector<std::optional<Says>>& used);
    Status check_units(const std::vector<std::string>& names,
                       const std::vector<std::optional<Says>>& used) const;
    float radius_of(const ReadyRow& row) const;
    Status add_density(const ReadyRow& row, float radius);
    Status add_color(const ReadyRow& row);
    void fill_densities();
    void scale_colors();

    ParticleReading reading_;
    std::array<bool, kSaysCount> has_{};
    // Whether it is a file of 3D Gaussian splats, whose opacity is a logit.
    bool splats_ = false;
    ReadyParticles ready_;
    // Particles whose density, whose colour is not given.
    std::vector<std::size_t> without_density_, without_color_;
    // What has been seen of colours: white alone; whole numbers alone; the largest.
    bool all_white_ = true, all_whole_ = true;
    float largest_color_ = 0;
};

// The error of a file with more particles than a scene may have.
Error too_many_particles(std::string pointer);

}  // namespace awan
