// From bits to a density: the smoothing q of Dobashi et al. 2000 (Upchurch 2009, "Continuous Density Distribution"),
// with all weights 1; with others, weighted.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/generate/automaton/grid.h"

namespace awan::automaton {

using CloudBits = const std::vector<std::uint64_t>*;

// Adds the 64 bits of a word to as many bytes, that of bit 0 first in memory.
void add_bits(std::uint64_t bits, std::uint64_t* bytes);

// Counts how many of the cells around each are clouds, plane after plane: sums of whole numbers along x, then y, then
// z, so that their order does not show. Cells beyond the grid are none.
class PlaneSmoother {
  public:
    // fields: the cloud bits (cld) after each of the last steps, 1 to kMaxAutomatonHistory of them, each
    // grid.all_words() long, not owned. reach: i0, j0, k0, the half sides of the box, at most kMaxAutomatonSmooth
    // each.
    PlaneSmoother(const AutomatonGrid& grid, std::vector<CloudBits> fields,
                  std::array<std::size_t, 3> reach);

    struct Plane {
        // The count of cell (i, j) is counts[j * stride + i]; valid until the next call.
        const std::uint16_t* counts;
        // Of row j: 0 where all its counts are 0, and then they may not have been written.
        const std::uint8_t* rows;
        std::size_t stride;
    };
    // Plane k. Cheap when called for k, k + 1, k + 2, ...
    Plane plane(std::size_t k);

    // The largest count there can be: the density is counts / most().
    double most() const;

  private:
    // Sums over x and y of one plane.
    struct Sums {
        std::size_t k = SIZE_MAX;
        std::vector<std::uint16_t> counts;
        std::vector<std::uint8_t> rows;
    };
    const Sums& sums(std::size_t k);
    bool sum_along_x(std::size_t row, std::uint8_t* out) const;

    AutomatonGrid grid_;
    std::vector<CloudBits> fields_;
    std::size_t i0_, j0_, k0_, stride_;
    // The planes that the box reaches; plane k is in ring_[k % size].
    std::vector<Sums> ring_;
    // Sums along x of one plane.
    std::vector<std::uint8_t> x_sums_;
    std::vector<std::uint8_t> x_rows_;
    // The plane that is handed out.
    std::vector<std::uint16_t> counts_;
    std::vector<std::uint8_t> rows_;
};

}  // namespace awan::automaton
