// The cloud that the benchmarks of the transport rungs share, and how far two of its pictures are apart.
#pragma once

#include <cmath>
#include <string>

#include "core/base/image.h"
#include "tests/scenes.h"

namespace awan::bench {

// Table 4.4, g = .85, over nothing.
inline SceneDraft table_draft(const std::string& rung, int width = 800, int height = 600) {
    SceneDraft draft = test::table_4_4();
    draft.medium.g = 0.85;
    draft.image.width = width;
    draft.image.height = height;
    draft.image.background = Background::kTransparent;
    draft.accuracy.rung = rung;
    return draft;
}

// Root mean square difference of cloud pixels (alpha at least 5% of the largest), relative to the mean of `b`.
inline double difference(const Image& a, const Image& b) {
    float most = 0;
    for (std::size_t i = 3; i < b.pixels.size(); i += 4) most = std::max(most, b.pixels[i]);
    double square = 0, sum = 0, count = 0;
    for (std::size_t i = 0; i < b.pixels.size(); i += 4) {
        if (!(b.pixels[i + 3] >= 0.05F * most)) continue;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double d = static_cast<double>(a.pixels[c]) - static_cast<double>(b.pixels[c]);
            square += d * d;
            sum += static_cast<double>(b.pixels[c]);
            ++count;
        }
    }
    return count > 0 && sum > 0 ? std::sqrt(square / count) / (sum / count) : 0;
}

}  // namespace awan::bench
