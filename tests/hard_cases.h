// Hard cases as rows of a table: what is hard, a scene, and how far each oracle may be from every rung.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "core/survey/merge.h"
#include "core/truth/oracles.h"
#include "tests/patience.h"
#include "tests/physical_bounds.h"
#include "tests/scenes.h"

namespace awan::test {

// 0: not compared. Oracles: core/truth/oracles.h, double precision.
struct CaseBounds {
    // |alpha - exact|, of the exact alpha's largest in the picture. Splats are cut at 3.5 s and scaled by 1.0022 for
    // it, those of the march at 3.8 s. Of splats it holds where s is no less than .6 pixels: thinner ones are
    // widened by design.
    double alpha_splats = 2.5e-3, alpha_march = 1e-3, alpha_truth = 2e-6;
    // |radiance - sunlight scattered once|, of the brightest pixel: of rung single, and, where matter is so thin that
    // there is no more light than that, of transport and harris. Truth: of the pictures' sums.
    double once = 0, once_transport = 0, once_harris = 0, once_truth = 0;
};

struct HardCase {
    // Of the table of hard cases in float32 (core/README.md); "-": found beside it.
    const char* row;
    const char* name;  // letters, digits and underscores
    std::function<SceneDraft()> scene;
    CaseBounds bounds{};
    std::uint32_t paths = 2;  // a pixel, of rung truth
    std::vector<const char*> rungs = {"harris", "single", "transport-16", "truth"};
};

struct CaseOnRung {
    const HardCase* hard;
    const char* rung;
};
inline void PrintTo(const CaseOnRung& which, std::ostream* out) {
    *out << which.hard->row << " / " << which.rung;
}

inline std::vector<CaseOnRung> on_all_rungs(const std::vector<HardCase>& cases) {
    std::vector<CaseOnRung> all;
    for (const HardCase& hard : cases)
        for (const char* rung : hard.rungs) all.push_back({&hard, rung});
    return all;
}

inline std::string name_of(const ::testing::TestParamInfo<CaseOnRung>& info) {
    std::string name = std::string(info.param.hard->name) + "__" + info.param.rung;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

struct Outcome {
    Scene scene;
    ParticleSet particles;
    Rendered rendered;
};

// Through all stages; with `paths` a pixel on rung truth, whatever noise its plan would like.
inline Outcome render_on(SceneDraft draft, const char* rung, std::uint32_t paths, int threads = 2) {
    draft.accuracy = {};
    draft.accuracy.rung = rung;
    const Scene scene = valid(draft);
    auto planned = plan_scene(scene, threads, {});
    if (!planned.ok()) {
        ADD_FAILURE() << planned.error().message;
        std::abort();
    }
    planned->plan.samples = paths;
    // What was generated: what merging costs is part of what a rung may be off.
    ParticleSet particles = unmerged(planned->particles);
    auto rendered =
        render_planned(scene, *std::move(planned), {&device(), threads, nullptr, {}, {}}, {});
    if (!rendered.ok()) {
        ADD_FAILURE() << rendered.error().message;
        std::abort();
    }
    return {scene, std::move(particles), *std::move(rendered)};
}

struct Place {
    int x, y;
};
// At most about `most` pixels, spread over the picture, its middle among them.
inline std::vector<Place> places_in(const Image& image, double most) {
    std::vector<Place> places{{image.width / 2, image.height / 2}};
    const double pixels = static_cast<double>(image.width) * image.height;
    const double step = std::max(1.0, std::sqrt(pixels / most));
    for (double y = 0; y < image.height; y += step)
        for (double x = 0; x < image.width; x += step)
            places.push_back({static_cast<int>(x), static_cast<int>(y)});
    return places;
}

// Opacity of the ray through a point of the picture, pixels.
inline double exact_alpha(const Outcome& outcome, double x, double y) {
    const View& view = outcome.rendered.survey.view;
    const double u = (x / outcome.rendered.image.width * 2 - 1) * view.tan_half_fov * view.aspect;
    const double v = (1 - y / outcome.rendered.image.height * 2) * view.tan_half_fov;
    return -std::expm1(-line_optical_depth(
        outcome.particles, view.eye, glm::normalize(view.forward + u * view.right + v * view.up), 0,
        INFINITY));
}

// A pixel shows its middle's ray where all matter is wide beside it, and the mean over its area, within
// 5%, where some is not.
inline void expect_alpha(const Outcome& outcome, double bound) {
    const Image& image = outcome.rendered.image;
    double worst = 0, largest = 0;
    const double most =
        std::clamp(3e6 / (1 + static_cast<double>(outcome.particles.size())), 12.0, 600.0);
    constexpr int kRays = 12;  // along a side of a pixel
    for (const auto [x, y] : places_in(image, most)) {
        const double middle = exact_alpha(outcome, x + 0.5, y + 0.5);
        const double alpha = pixel(image, x, y).a;
        double off = std::abs(alpha - middle);
        largest = std::max(largest, middle);
        if (off > bound * largest) {
            double mean = 0;
            for (int j = 0; j < kRays; ++j)
                for (int i = 0; i < kRays; ++i)
                    mean += exact_alpha(outcome, x + (i + 0.5) / kRays, y + (j + 0.5) / kRays);
            mean /= kRays * kRays;
            off = std::min(off, std::max(0.0, std::abs(alpha - mean) - 0.05 * mean));
            largest = std::max(largest, mean);
        }
        worst = std::max(worst, off);
    }
    EXPECT_LE(worst, bound * largest + 1e-30)
        << "of alpha; largest " << largest << ", relative " << worst / largest;
}

// Of sunlight scattered once, channel green: the mean of a pixel's rays half a pixel apart.
inline double mean_of_four(const Outcome& outcome, int x, int y) {
    const Image& image = outcome.rendered.image;
    double sum = 0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const PixelRay ray = pixel_ray(outcome.rendered.survey.view, 2 * image.width,
                                           2 * image.height, 2 * x + i, 2 * y + j);
            sum += single_scattering(outcome.scene, outcome.particles, ray.origin, ray.direction).y;
        }
    return sum / 4;
}

// Sunlight scattered once, channel green. `sums`: of the sums over the pixels looked at, for rungs with noise.
inline void expect_once(const Outcome& outcome, double bound, bool sums) {
    const Image& image = outcome.rendered.image;
    double worst = 0, brightest = 0, sum = 0, exact_sum = 0;
    const double most =
        sums ? 1e4
             : std::clamp(1e4 / static_cast<double>(1 + outcome.particles.size()), 12.0, 100.0);
    for (const auto [x, y] : places_in(image, most)) {
        const PixelRay ray =
            pixel_ray(outcome.rendered.survey.view, image.width, image.height, x, y);
        const double exact =
            single_scattering(outcome.scene, outcome.particles, ray.origin, ray.direction).y;
        brightest = std::max(brightest, exact);
        double off = std::abs(pixel(image, x, y).g - exact);
        // Where pixels change sharply, they are the mean of 2 x 2 rays.
        if (!sums && off > bound * brightest) {
            const double mean = mean_of_four(outcome, x, y);
            brightest = std::max(brightest, mean);
            off = std::min(off, std::abs(pixel(image, x, y).g - mean));
        }
        worst = std::max(worst, off);
        sum += pixel(image, x, y).g;
        exact_sum += exact;
    }
    if (sums)
        EXPECT_NEAR(sum / exact_sum, 1, bound);
    else
        EXPECT_LE(worst, bound * brightest) << "of the radiance, relative " << worst / brightest;
    EXPECT_GT(brightest, 0) << "the oracle sees nothing";
}

inline void expect_hard_case(const HardCase& hard, const char* rung) {
    const SceneDraft draft = hard.scene();
    const Outcome outcome = render_on(draft, rung, hard.paths);
    expect_figures(outcome.rendered);
    expect_within_bounds(draft, outcome.rendered);
    const bool splats = find_rung(rung)->method == Method::kSplats;
    const bool paths = find_rung(rung)->method == Method::kPaths;
    const CaseBounds& bounds = hard.bounds;
    const double alpha = splats  ? bounds.alpha_splats
                         : paths ? bounds.alpha_truth
                                 : bounds.alpha_march;
    if (alpha > 0 && draft.image.background == Background::kTransparent)
        expect_alpha(outcome, alpha);
    const double once = splats                        ? bounds.once_harris
                        : paths                       ? bounds.once_truth
                        : find_rung(rung)->cells == 0 ? bounds.once
                                                      : bounds.once_transport;
    if (once > 0) expect_once(outcome, once, paths);
}

}  // namespace awan::test
