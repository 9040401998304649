// Reports of sweeps that never ran, for tests of what is made of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/accuracy/accuracy.h"

namespace awan::test {

// A bright disc on blue, `gain` times as bright as it should be.
inline Image disc_picture(int width, int height, double gain) {
    Image image;
    image.width = width;
    image.height = height;
    image.opaque = true;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double d = std::hypot(x - width / 2.0, y - height / 2.0) / (0.4 * height);
            const double a = std::exp(-d * d * d * d);
            const auto add = [&](double cloud, double sky) {
                image.pixels.push_back(static_cast<float>(gain * a * cloud + (1 - a) * sky));
            };
            add(4 + 2.0 * x / width, 0.6);
            add(4 + 2.0 * x / width, 0.9);
            add(4 + 2.0 * x / width, 1.5);
            image.pixels.push_back(1);
        }
    return image;
}

struct FakeRung {
    const char* name;
    double time_ms, error;
};

inline AccuracyReport fake_report(const std::vector<FakeRung>& rungs, int width = 128,
                                  int height = 96) {
    AccuracyReport report;
    report.width = 800;
    report.height = 600;
    report.film.exposure = -3;
    report.reference.width = width;
    report.reference.height = height;
    report.reference.samples = 1024;
    report.reference.noise = 0.012;
    report.reference.time_ms = 14'200;
    report.reference.cpu_ms = 28'000;
    report.reference.picture = disc_picture(width, height, 1);
    for (const FakeRung& rung : rungs) {
        RungCost cost;
        cost.rung = rung.name;
        cost.time_ms = rung.time_ms;
        cost.light_ms = 0.6 * rung.time_ms;
        cost.draw_ms = 0.3 * rung.time_ms;
        cost.runs = 3;
        cost.error.nrmse = rung.error;
        cost.error.nrmse_noise = 0.002;
        cost.error.bias = -0.7 * rung.error;
        cost.error.bias_noise = 0.001;
        cost.error.pixels = 5000;
        cost.flip = 0.3 * std::min(1.0, rung.error);
        cost.predicted_error = 1.6 * rung.error;
        cost.stated_error = 1.2 * rung.error;
        cost.predicted_time_ms = 0.8 * rung.time_ms;
        cost.memory_bytes = 1e6 * rung.time_ms;
        cost.picture = disc_picture(width, height, 1 - 0.5 * std::min(1.5, rung.error));
        for (std::size_t i = 0; i < cost.picture.pixel_count(); ++i)
            cost.difference.push_back(
                (cost.picture.pixels[4 * i] - report.reference.picture.pixels[4 * i]) / 3);
        report.rungs.push_back(cost);
    }
    std::sort(report.rungs.begin(), report.rungs.end(),
              [](const RungCost& a, const RungCost& b) { return a.time_ms < b.time_ms; });
    double best = INFINITY;
    for (RungCost& rung : report.rungs) {
        rung.pareto = rung.error.nrmse < best;
        best = std::min(best, rung.error.nrmse);
    }
    return report;
}

inline std::vector<FakeRung> whole_ladder() {
    return {
        {"additive", 3, 2},           {"harris", 48, 0.62},          {"single", 95, 0.71},
        {"transport-16", 190, 0.11},  {"transport-24", 260, 0.07},   {"transport-32", 420, 0.042},
        {"transport-48", 1400, 0.02}, {"transport-64", 3900, 0.012}, {"truth", 60'000, 0.002}};
}

}  // namespace awan::test
