#include "core/draw/picture_difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/plan/forecast.h"
#include "core/scene/validate.h"

namespace awan {
namespace {

// Of the largest alpha: pixels below are not cloud.
constexpr float kCloud = 0.05F;

}  // namespace

Result<Scene> for_measuring(const Scene& scene) {
    const int width = scene->image.width, height = scene->image.height;
    int apart = 1;
    while (static_cast<double>(width / apart) * (height / apart) > kMostMeasuredPixels) apart += 2;
    SceneDraft draft = *scene;
    draft.image.width = std::max(width / apart, 1);
    draft.image.height = std::max(height / apart, 1);
    draft.image.background = Background::kTransparent;
    return validate(std::move(draft));
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
