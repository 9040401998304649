// How far a picture is from the truth.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/image.h"
#include "core/truth/path_tracer.h"

namespace awan {

// Over cloud pixels: those whose true alpha is at least 5% of the largest. All three channels count.
// The pictures are premultiplied cloud radiance over nothing (background "transparent").
struct PictureError {
    // sqrt(max(0, mean (x - a)(x - b))) / mean truth: noise of the truth does not inflate it.
    double nrmse = 0;
    // One standard error of nrmse, from the spread over pixels and the halves' difference.
    double nrmse_noise = 0;
    // (mean x - mean truth) / mean truth.
    double bias = 0;
    double bias_noise = 0;  // one standard error of bias
    // Rms noise of a pixel of (a + b) / 2, relative to the mean truth.
    double truth_noise = 0;
    // Cloud pixels; 0: no cloud in the picture, all else 0.
    std::size_t pixels = 0;
};

// Pictures of one size. Relative to the truth's mean over cloud pixels; 0 when that is 0 and x is too,
// 1 when that is 0 and x is not.
PictureError picture_error(const Image& x, const TruthImage& truth);

// LDR-FLIP (Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"): mean over
// the picture of the difference that a person sees when the two are flipped, 0..1, and its map (row by row). Pictures
// are sRGB bytes, 3 a pixel. pixels_per_degree: 67 is a 0.7 m wide 3840-pixel monitor at 0.7 m, the paper's default.
struct FlipResult {
    double mean = 0;
    std::vector<float> map;
};
FlipResult flip(const std::vector<std::uint8_t>& reference, const std::vector<std::uint8_t>& test,
                int width, int height, double pixels_per_degree = 67.02);

}  // namespace awan
