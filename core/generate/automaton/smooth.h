// From bits to a density: Dobashi et al.'s q (document 001, "Continuous Density Distribution"), weights 1.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/generate/automaton/grid.h"

namespace awan {

using CloudBits = const std::vector<std::uint64_t>*;

// How many of the cells around each are clouds, plane after plane: sums along x, then y, then z, of whole numbers, so
// that no order shows. Cells beyond the grid are none.
class PlaneSmoother {
  public:
    // fields: cld after each of the last steps, 1 to kMaxAutomatonHistory of them, each grid.all_words() long, not
    // owned; reach: i0, j0, k0, at most kMaxAutomatonSmooth each.
    PlaneSmoother(const AutomatonGrid& grid, std::vector<CloudBits> fields,
                  std::array<std::size_t, 3> reach);

    struct Plane {
        // [j * stride + i], i < nx; valid until the next call.
        const std::uint16_t* counts;
        // 0: all counts of row j are 0 (and may not have been written).
        const std::uint8_t* rows;
        std::size_t stride;
    };
    // Cheap when called for k, k + 1, k + 2, ...
    Plane plane(std::size_t k);

    // The largest count there can be: density is counts / most().
    double most() const;

  private:
    // Over x and y.
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
    // Plane k is in ring_[k % size].
    std::vector<Sums> ring_;
    // Of one plane.
    std::vector<std::uint8_t> x_sums_;
    std::vector<std::uint8_t> x_rows_;
    // Of the answer.
    std::vector<std::uint16_t> counts_;
    std::vector<std::uint8_t> rows_;
};

}  // namespace awan
