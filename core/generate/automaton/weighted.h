// Smoothing with weights: q of Upchurch 2009 ("Continuous Density Distribution"), whose w(i', j', k') is here a product
// of one weight along each axis (shape.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/generate/automaton/smooth.h"

namespace awan::automaton {

// What PlaneSmoother counts, weighted. Floats, always added in the same order.
class WeightedSmoother {
  public:
    // fields: as of PlaneSmoother. weights: of cells 0, 1, ... away along x, y and z, one at least; the first above 0.
    WeightedSmoother(const AutomatonGrid& grid, std::vector<CloudBits> fields,
                     std::array<std::vector<float>, 3> weights);

    struct Plane {
        // The weighted sum of cell (i, j) is sums[j * stride + i]; valid until the next call.
        const float* sums;
        // Of row j: 0 where all its sums are 0, and then they may not have been written.
        const std::uint8_t* rows;
        std::size_t stride;
    };
    // Plane k. Cheap when called for k, k + 1, k + 2, ...
    Plane plane(std::size_t k);

    // The largest sum there can be: the density is sums / most().
    double most() const;

  private:
    // Sums over x and y of one plane.
    struct Sums {
        std::size_t k = SIZE_MAX;
        std::vector<float> sums;
        std::vector<std::uint8_t> rows;
    };
    const Sums& sums(std::size_t k);
    bool sum_along_x(std::size_t row, float* out) const;

    AutomatonGrid grid_;
    std::vector<CloudBits> fields_;
    std::array<std::vector<float>, 3> weights_;
    std::size_t stride_;
    // The planes that the box reaches; plane k is in ring_[k % size].
    std::vector<Sums> ring_;
    // Sums along x of one plane.
    std::vector<float> x_sums_;
    std::vector<std::uint8_t> x_rows_;
    // The plane that is handed out.
    std::vector<float> sums_;
    std::vector<std::uint8_t> rows_;
};

}  // namespace awan::automaton
