// The bricks along a ray, one after the other (Amanatides & Woo 1987, every t counted from the ray's origin).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/truth/matter.h"

namespace awan::truth {

class BrickWalk {
  public:
    // The part of o + t d with t in [from, to] that is in the matter's box; q (matter.h), d unit.
    BrickWalk(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double from, double to)
        : t_(from), end_(to) {
        double inverse[3];
        for (int a = 0; a < 3; ++a) {
            // Upwards where it does not move at all, also if that is -0.
            inverse[a] = 1 / (std::abs(d[a]) < 1e-30 ? (d[a] >= 0 ? 1e-30 : -1e-30) : d[a]);
            const double u = -o[a] * inverse[a],
                         v = (m.bricks[a] * double{kBrick} - o[a]) * inverse[a];
            t_ = std::max(t_, std::min(u, v));
            end_ = std::min(end_, std::max(u, v));
        }
        if (!inside()) return;
        std::ptrdiff_t stride = 1;
        for (int a = 2; a >= 0; --a) {
            const int n = m.bricks[a];
            const int at =
                std::clamp(static_cast<int>((o[a] + t_ * d[a]) * (1.0 / kBrick)), 0, n - 1);
            const bool up = d[a] >= 0;
            at_[a] = at;
            left_[a] = up ? n - 1 - at : at;
            way_[a] = up ? 1 : -1;
            step_[a] = up ? stride : -stride;
            next_[a] = ((at + (up ? 1 : 0)) * kBrick - o[a]) * inverse[a];
            delta_[a] = kBrick * std::abs(inverse[a]);
            brick_ += at * stride;
            stride *= n;
        }
        choose();
    }

    bool inside() const { return t_ < end_; }  // else there is no more
    std::size_t brick() const { return static_cast<std::size_t>(brick_); }
    // Its place among the bricks.
    const glm::ivec3& at() const { return at_; }
    double enter() const { return t_; }
    double leave() const { return std::min(next_[axis_], end_); }

    double end() const { return end_; }

    void advance() {
        t_ = std::max(t_, leave());
        if (left_[axis_]-- == 0) {
            t_ = end_;
            return;
        }
        brick_ += step_[axis_];
        at_[axis_] += way_[axis_];
        next_[axis_] += delta_[axis_];
        choose();
    }

  private:
    void choose() {
        axis_ = next_[0] < next_[1] ? (next_[0] < next_[2] ? 0 : 2) : (next_[1] < next_[2] ? 1 : 2);
    }

    double t_, end_;
    double next_[3], delta_[3];
    std::ptrdiff_t step_[3], brick_ = 0;
    glm::ivec3 at_{0}, way_{0};
    int left_[3], axis_ = 0;
};

}  // namespace awan::truth
