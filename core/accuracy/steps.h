// How far a measurement has come.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "core/base/progress.h"

namespace awan {

// Progress of a whole that is made of weighted steps. Weights are the milliseconds that a step is expected to take, so
// that the bar moves about evenly. All weights are expected before the first of them begins.
class Steps {
  public:
    using OnStep = std::function<void(const std::string&)>;

    // Both outlive this; either may be empty.
    Steps(const Progress& progress, const OnStep& on_step)
        : progress_(progress), on_step_(on_step) {}

    void expect(double weight) { total_ += weight; }
    void begin(const std::string& what, double weight) {
        done_ += std::exchange(weight_, weight);
        if (on_step_) on_step_(what);
        tell(0);
    }
    // share: of the step that was begun last, 0..1.
    void tell(double share) const {
        if (progress_ && total_ > 0) progress_(std::min(1.0, (done_ + share * weight_) / total_));
    }
    void end() const {
        if (progress_) progress_(1);
    }

  private:
    const Progress& progress_;
    const OnStep& on_step_;
    double total_ = 0, done_ = 0, weight_ = 0;
};

}  // namespace awan
