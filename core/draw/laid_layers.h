// Clouds' pictures laid over each other, front to back, and at last over what stands behind them.
//
// A layer u is premultiplied: the light L_u that a cloud sends through no haze, and its opacity A_u. With T_u the
// product of 1 - A of those before it, O_u the opacity of the haze before it, and H_u that haze's light, a pixel is
//     sum_u (T_u^k L_u (1 - O_u) + T_u A_u H_u) + T B,
// B what stands behind, as it comes through all of the haze: by parts, as in air.h, if a cloud is flat to the haze.
// k = 1 - albedo f, f the share of the phase function's forward peak (core/light/transport.h): the march dims the light
// of clouds by the scaled depth, for what the peak scatters still arrives.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/image.h"
#include "core/draw/air.h"
#include "core/draw/backdrop.h"
#include "core/draw/march_light.h"
#include "core/plan/impostor_runs.h"

namespace awan {

// Of every pixel of a frame, row by row from the top.
struct LaidLayers {
    int width = 0, height = 0;
    std::vector<Rgb4> light;   // so far, and nothing
    std::vector<float> left;   // T
    std::vector<float> seen;   // T^k
    std::vector<float> hazed;  // sum of T_u A_u O_u
};
LaidLayers no_layers(int width, int height);

// Where so little is seen, nothing more is laid.
inline constexpr float kLeastSeen = 1e-3F;

// T^k by T, 0 <= T <= 1, k > 0; to 0.1% of 1.
class ScaledClear {
  public:
    explicit ScaledClear(float scaled);
    float of(float clear) const {
        const float at = std::sqrt(clear) * kSteps;
        const auto below =
            std::min(static_cast<std::size_t>(at), static_cast<std::size_t>(kSteps - 1));
        return table_[below] +
               (table_[below + 1] - table_[below]) * (at - static_cast<float>(below));
    }

  private:
    static constexpr int kSteps = 1024;  // even in the root of T, so that it is steep nowhere
    std::array<float, kSteps + 1> table_{};
};

// A cloud's picture and where it is of. texels: width x height, premultiplied.
struct CloudPicture {
    FacingPicture facing;
    Image texels;
};

// Lays a cloud's picture as seen from the frame's eye: its texels stand in its plane, and between them light goes by
// Catmull and Rom's cubic. What lies behind the ground is hidden, where `behind` has distances. air: the frame's; null:
// it is clear. Rows first..end-1, all of which may be laid by different threads.
void lay_picture(const CloudPicture& picture, const PictureRays& rays, const Air* air,
                 const Backdrop* behind, const ScaledClear& scaled, int first, int end,
                 LaidLayers& to);

// Lays a layer that has the frame's own pixels and its haze in it. hazed: about the opacity of the haze before it.
void lay_pixels(const Image& layer, float hazed, const ScaledClear& scaled, int first, int end,
                LaidLayers& to);

}  // namespace awan
