#include "core/accuracy/rung_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/scene/validate.h"

namespace awan {
namespace {

// A first run this long is counted: the picture at the reference's size has warmed up what there is to warm.
constexpr double kLongRunMs = 500;
// Of counted runs of one rung.
constexpr double kEnoughMs = 3000;

Result<Scene> with_rung(const Scene& scene, const Rung& rung) {
    SceneDraft draft = *scene;
    draft.accuracy = {{}, {}, rung.name};
    draft.image.layers = "none";
    return validate(std::move(draft));
}

double whole_ms(const StageTimes& times) {
    return times.generate_ms + times.survey_ms + times.light_ms + times.draw_ms + times.measure_ms;
}

struct Timed {
    double whole_ms = 0;
    StageTimes stages;
};

// The median of several renders.
struct MedianTime {
    int runs = 0;
    double whole_ms = 0;
    // Of the run at the median, the faster one of two.
    StageTimes stages;
};

MedianTime median_of(std::vector<Timed> timed) {
    std::sort(timed.begin(), timed.end(),
              [](const Timed& a, const Timed& b) { return a.whole_ms < b.whole_ms; });
    const Timed& upper = timed[timed.size() / 2];
    const Timed& lower = timed[(timed.size() - 1) / 2];
    return {static_cast<int>(timed.size()), (lower.whole_ms + upper.whole_ms) / 2, lower.stages};
}

// Renders `scene` as often as wanted. share_before: of the step, that is done already.
Result<MedianTime> time_renders(const RungMeasurement& with, const Scene& scene,
                                double share_before, const Deadline& deadline) {
    const int runs = std::max(with.options.runs, 1);
    std::vector<Timed> timed;
    double all_ms = 0;
    for (int i = 0; i < runs; ++i) {
        auto rendered = with.render(scene, deadline);
        if (!rendered) {
            // Fewer runs than wanted are better than none.
            if (rendered.error().code == ErrorCode::kOverDeadline && !timed.empty()) break;
            return rendered.error();
        }
        timed.push_back({whole_ms(rendered->times), rendered->times});
        with.steps.tell(share_before + (1 - share_before) * (i + 1) / runs);
        all_ms += timed.back().whole_ms;
        if (timed[0].whole_ms > kLongRunMs && all_ms > kEnoughMs) break;
    }
    if (timed.size() > 1 && timed[0].whole_ms <= kLongRunMs) timed.erase(timed.begin());
    return median_of(std::move(timed));
}

// Luminance of each pixel less the truth's, relative to the truth's mean over the cloud's pixels (as
// picture_error has them).
std::vector<float> relative_difference(const Image& x, const Image& truth) {
    const auto luminance = [](const float* p) {
        return 0.2126F * p[0] + 0.7152F * p[1] + 0.0722F * p[2];  // Rec. 709
    };
    const std::size_t pixels = truth.pixel_count();
    float densest = 0;
    for (std::size_t i = 0; i < pixels; ++i) densest = std::max(densest, truth.pixels[4 * i + 3]);
    double sum = 0;
    std::size_t cloud = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const float* const p = truth.pixels.data() + 4 * i;
        if (densest <= 0 || p[3] < 0.05F * densest) continue;
        sum += static_cast<double>(luminance(p));
        ++cloud;
    }
    // 0: no light.
    const float scale = sum > 0 ? static_cast<float>(static_cast<double>(cloud) / sum) : 0.0F;
    std::vector<float> difference(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        difference[i] =
            scale * (luminance(x.pixels.data() + 4 * i) - luminance(truth.pixels.data() + 4 * i));
    return difference;
}

// The rung's picture with the reference's rays, and how far it is from the reference.
Status compare_with_reference(const RungMeasurement& with, const Rung& rung,
                              const Deadline& deadline, RungCost& cost) {
    const Reference& reference = with.reference;
    const auto small = with_rung(reference.scene, rung);
    if (!small) return small.error();
    const auto rendered = with.render(*small, deadline);
    if (!rendered) return rendered.error();
    const Image& picture = rendered->image;
    if (picture.width != reference.truth.half_a.width ||
        picture.height != reference.truth.half_a.height)
        return Error{ErrorCode::kInternal, "", "a render has not the size that was asked for"};
    cost.error = picture_error(picture, reference.truth);
    cost.stated_error = rendered->stated_error;
    const Image seen = over_sky(picture, with.scene, reference.view, reference.ground);
    cost.flip =
        flip(reference.shown, display_bytes(seen, with.film), picture.width, picture.height).mean;
    cost.difference = relative_difference(picture, reference.mean);
    cost.picture = with.scene->image.background == Background::kSky ? seen : picture;
    return std::nullopt;
}

void note_forecast(const RungForecast* forecast, RungCost& cost) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    cost.predicted_error = forecast != nullptr ? forecast->error : kUnknown;
    cost.predicted_time_ms = forecast != nullptr ? forecast->time_ms : kUnknown;
    cost.memory_bytes = forecast != nullptr ? forecast->bytes : kUnknown;
}

bool beats(const RungCost& a, const RungCost& b) {
    return a.time_ms <= b.time_ms && a.error.nrmse <= b.error.nrmse &&
           (a.time_ms < b.time_ms || a.error.nrmse < b.error.nrmse);
}

}  // namespace

Result<RungCost> measure_rung(const RungMeasurement& with, const Rung& rung,
                              const RungForecast* forecast, const Deadline& deadline) {
    RungCost cost;
    cost.rung = rung.name;
    const auto own = with_rung(with.scene, rung);
    if (!own) return own.error();
    if (const Status failed = compare_with_reference(with, rung, deadline, cost)) return *failed;
    const double small_share = 1.0 / (1 + std::max(with.options.runs, 1));
    with.steps.tell(small_share);
    const auto time = time_renders(with, *own, small_share, deadline);
    if (!time) return time.error();
    cost.runs = time->runs;
    cost.time_ms = time->whole_ms;
    cost.light_ms = time->stages.light_ms;
    cost.draw_ms = time->stages.draw_ms;
    note_forecast(forecast, cost);
    return cost;
}

double measuring_ms(const RungForecast* forecast, const Scene& scene, PictureSize small, int runs) {
    // Of a render that nobody predicts.
    constexpr double kUnknownMs = 200;
    const double one =
        forecast != nullptr && std::isfinite(forecast->time_ms) && forecast->time_ms > 0
            ? forecast->time_ms
            : kUnknownMs;
    const double pixels = static_cast<double>(scene->image.width) * scene->image.height;
    const double small_pixels = static_cast<double>(small.width) * small.height;
    // Light is the same for either size, drawing goes with the pixels: half each.
    const double small_render = one * (0.5 + 0.5 * small_pixels / pixels);
    return small_render + std::max(one, std::min(one * std::max(runs, 1), kEnoughMs));
}

void mark_pareto(std::vector<RungCost>& rungs) {
    for (RungCost& rung : rungs)
        rung.pareto = std::none_of(rungs.begin(), rungs.end(),
                                   [&](const RungCost& other) { return beats(other, rung); });
}

}  // namespace awan
