#include "core/accuracy/error_measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/exact_math.h"

namespace awan {

PictureError picture_error(const Image& x, const TruthImage& truth) {
    const Image &a = truth.half_a, &b = truth.half_b;
    assert(x.pixels.size() == a.pixels.size() && a.pixels.size() == b.pixels.size());
    PictureError error;
    const std::size_t all = a.pixel_count();
    const auto at = [](const Image& image, std::size_t pixel, std::size_t channel) {
        return static_cast<double>(image.pixels[4 * pixel + channel]);
    };
    double most_alpha = 0;
    for (std::size_t i = 0; i < all; ++i) most_alpha = std::max(most_alpha, at(a, i, 3));
    if (!(most_alpha > 0)) return error;

    // The truth t of a pixel is known from two halves with independent noises na and nb, of variances va and vb:
    //   a = t + na,  b = t + nb,  and the picture's error is e = x - t.
    // Then (x - a)(x - b) has the mean e^2, without any noise in it, and the variance e^2 (va + vb) + va vb, of which
    //   (a - b)^2 (x - (a + b) / 2)^2
    // is an unbiased estimate where the noise is normal. The three channels share their paths, so that their noises
    // are not independent: they are summed before squaring.
    double sum_x = 0, sum_truth = 0, square = 0, square_variance = 0, mean_variance = 0,
           noise_square = 0;
    for (std::size_t i = 0; i < all; ++i) {
        if (at(a, i, 3) < 0.05 * most_alpha) continue;
        ++error.pixels;
        double product = 0, spread = 0, apart = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double xc = at(x, i, c), ac = at(a, i, c), bc = at(b, i, c);
            sum_x += xc / 3;
            sum_truth += (ac + bc) / 6;
            product += (xc - ac) * (xc - bc) / 3;
            spread += (ac - bc) * (xc - 0.5 * (ac + bc)) / 3;
            apart += (ac - bc) / 6;
            noise_square += (ac - bc) * (ac - bc) / 12;
        }
        square += product;
        square_variance += spread * spread;
        mean_variance += apart * apart;
    }
    const auto n = static_cast<double>(error.pixels);
    const double mean_x = sum_x / n, mean_truth = sum_truth / n;
    if (mean_truth == 0) {
        error.nrmse = error.bias = mean_x == 0 ? 0 : 1;
        return error;
    }
    const double mean_square = std::max(square / n, 0.0);
    const double square_noise = std::sqrt(square_variance) / n;
    const double truth_noise = std::sqrt(mean_variance) / n / mean_truth;  // of the mean
    error.nrmse = std::sqrt(mean_square) / mean_truth;
    // Half of what two standard errors of the square move the root by, to the side where they move it more.
    const double root = std::sqrt(mean_square);
    const double up = std::sqrt(mean_square + 2 * square_noise) - root;
    const double down = root - std::sqrt(std::max(mean_square - 2 * square_noise, 0.0));
    error.nrmse_noise =
        exact::hypot(0.5 * std::max(up, down) / mean_truth, error.nrmse * truth_noise);
    error.bias = (mean_x - mean_truth) / mean_truth;
    error.bias_noise = mean_x / mean_truth * truth_noise;
    error.truth_noise = std::sqrt(noise_square / n) / mean_truth;
    return error;
}

}  // namespace awan
