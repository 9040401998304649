// The densities of an automaton's cells between two steps, plane by plane.
#pragma once

#include <optional>
#include <vector>

#include "core/generate/automaton/weighted.h"
#include "core/scene/automaton.h"

namespace awan::automaton {

// The density of an automaton's cells between two steps.
struct CellDensity {
    // The cloud bits (cld) after the steps to smooth over, the last one first; `next` the same one step later, or
    // empty.
    std::vector<CloudBits> now, next;
    // How far between the two, 0..1.
    double share_of_next = 0;
};

// Sums of one time, by whichever smoother the cloud asks for.
class SummedPlanes {
  public:
    SummedPlanes(const AutomatonCloud& cloud, const AutomatonGrid& grid,
                 const std::vector<CloudBits>& fields);

    void go_to(std::size_t k) {
        if (even_)
            counted_ = even_->plane(k);
        else
            summed_ = weighted_->plane(k);
    }
    bool row_is_empty(std::size_t j) const {
        return (even_ ? counted_.rows : summed_.rows)[j] == 0;
    }
    double operator()(std::size_t i, std::size_t j) const {
        if (row_is_empty(j)) return 0;
        return even_ ? counted_.counts[j * counted_.stride + i]
                     : static_cast<double>(summed_.sums[j * summed_.stride + i]);
    }
    double most() const { return even_ ? even_->most() : weighted_->most(); }

  private:
    std::optional<PlaneSmoother> even_;
    std::optional<WeightedSmoother> weighted_;
    PlaneSmoother::Plane counted_{};
    WeightedSmoother::Plane summed_{};
};

// The densities of cells, 0..1, interpolated between two steps.
class DensityPlanes {
  public:
    DensityPlanes(const AutomatonCloud& cloud, const AutomatonGrid& grid,
                  const CellDensity& density);

    void go_to(std::size_t k) {
        now_.go_to(k);
        if (next_) next_->go_to(k);
    }
    bool row_is_empty(std::size_t j) const {
        return now_.row_is_empty(j) && (!next_ || next_->row_is_empty(j));
    }
    double operator()(std::size_t i, std::size_t j) const {
        const double a = now_(i, j);
        if (!next_) return a * scale_;
        return (a + share_ * ((*next_)(i, j) - a)) * scale_;
    }

  private:
    SummedPlanes now_;
    std::optional<SummedPlanes> next_;
    double share_, scale_;
};

}  // namespace awan::automaton
