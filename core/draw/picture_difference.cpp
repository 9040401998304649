#include "core/draw/picture_difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/plan/forecast.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

// As kSmallPixels, where their middles are to be those of other pixels.
constexpr double kMostAligned = 5000;
// Of the largest alpha: pixels below are not cloud.
constexpr float kCloud = 0.05F;

Result<Scene> of_size(const Scene& scene, int width, int height) {
    SceneDraft draft = *scene;
    draft.image.width = width;
    draft.image.height = height;
    draft.image.background = Background::kTransparent;
    return validate(std::move(draft));
}

}  // namespace

Result<Scene> in_small(const Scene& scene) {
    const double pixels = static_cast<double>(scene->image.width) * scene->image.height;
    const double smaller = std::min(1.0, std::sqrt(kSmallPixels / pixels));
    const auto shrunk = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(side * smaller)));
    };
    return of_size(scene, shrunk(scene->image.width), shrunk(scene->image.height));
}

Result<Scene> in_small_aligned(const Scene& scene) {
    const int width = scene->image.width, height = scene->image.height;
    int apart = 1;
    while (static_cast<double>(width / apart) * (height / apart) > kMostAligned) apart += 2;
    return of_size(scene, std::max(width / apart, 1), std::max(height / apart, 1));
}

double picture_difference(const Image& x, const Image& truth) {
    assert(x.pixels.size() == truth.pixels.size());
    const std::size_t pixels = truth.pixel_count();
    float most = 0;
    for (std::size_t i = 0; i < pixels; ++i) most = std::max(most, truth.pixels[4 * i + 3]);
    double square = 0, sum = 0, count = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!(most > 0) || truth.pixels[4 * i + 3] < kCloud * most) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const auto value = static_cast<double>(truth.pixels[4 * i + c]);
            const double apart = static_cast<double>(x.pixels[4 * i + c]) - value;
            square += apart * apart;
            sum += value;
            ++count;
        }
    }
    return sum > 0 ? std::sqrt(square / count) / (sum / count) : 0;
}

}  // namespace awan
