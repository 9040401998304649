// Optical depth of the haze (core/scene/scene.h, Haze) along rays, in closed form.
#pragma once

#include "core/scene/scene.h"

namespace awan {

// A ray through the layer: from height `y`, rising by `slope` (-1..1) a unit of its length. Scene units.
//
// In the exponential part the depth over a length l is b l (1 - exp(-x)) / x, x = |slope| l / scale height, b the
// extinction at the lower end: nothing cancels or overflows for level rays or for scale heights of any size. Relative
// error < 1e-12.
class HazeRay {
  public:
    HazeRay(const Haze& haze, double y, double slope);

    // From the ray's start to distance t >= 0, which may be infinite: then the depth may be, too.
    double depth(double t) const;
    // 1 - exp(-depth(t)), 0..1.
    double opacity(double t) const;
    // Of `count` <= 64 distances first, first + step, ...: as opacity(t) to 1e-12, by a recurrence where it can.
    void opacities(double first, double step, int count, double* out) const;

  private:
    double above(double start, double length) const;

    // start_: above the layer's `height`, in scale heights.
    double extinction_, start_, slope_;
    // Slope in scale heights; distance of `height`, infinite: not ahead.
    double rate_, crossing_;
};

// Optical depth of the layer over a vertical line from `low` to `high` >= low; `high` may be infinite. A ray between
// these heights has this over the size of its slope.
double vertical_haze_depth(const Haze& haze, double low, double high);

}  // namespace awan
