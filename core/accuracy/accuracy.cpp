#include "core/accuracy/accuracy.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/accuracy/accuracy_pictures.h"
#include "core/light/sun_depth.h"
#include "core/plan/ladder.h"
#include "core/scene/validate.h"
#include "core/survey/detail_of.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

constexpr std::array<std::uint32_t, 2> kPilotSamples = {2, 6};  // to know what a sample takes
constexpr int kPilotSide = 32;                                  // pixels
constexpr std::uint32_t kGoodSamples = 64;    // above, more pixels are worth more than more samples
constexpr int kLeastSide = 24;                // pixels
constexpr std::uint32_t kFewestSamples = 16;  // below, the noise is all there is to see
constexpr double kReferenceShare = 0.5;       // of the time allowed
constexpr double kRungShare = 0.6;            // of what is left, for one rung at most
constexpr double kLongRunMs = 500;  // a first run this long is counted: the picture at the
                                    // reference's size has warmed up what there is to warm
constexpr int kShadowCells = 64;    // of the cloud's shadow on the ground
constexpr double kEnoughMs = 3000;  // of counted runs of one rung

// Not the seed of rung truth: noise of one picture must not look like that of the other.
constexpr std::uint64_t kReferenceSeed = 0x7275746872656621;

// Of all threads of this process: what a render beside it takes counts too.
double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

std::string seconds_text(double ms) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.2g s", ms / 1000);
    return {text.data(), static_cast<std::size_t>(length)};
}

// Progress of a whole that is made of weighted steps; weights in the milliseconds they are expected
// to take, so that the bar moves about evenly.
class Steps {
  public:
    Steps(const Progress& progress, const std::function<void(const std::string&)>& on_step)
        : progress_(progress), on_step_(on_step) {}

    void expect(double weight) { total_ += weight; }
    void begin(const std::string& what, double weight) {
        done_ += std::exchange(weight_, weight);
        if (on_step_) on_step_(what);
        tell(0);
    }
    // Of the step that was begun last.
    void tell(double share) const {
        if (progress_ && total_ > 0) progress_(std::min(1.0, (done_ + share * weight_) / total_));
    }
    void end() const {
        if (progress_) progress_(1);
    }

  private:
    const Progress& progress_;
    const std::function<void(const std::string&)>& on_step_;
    double total_ = 0, done_ = 0, weight_ = 0;
};

Result<Scene> with_rung(const Scene& scene, const std::string& rung) {
    SceneDraft draft = *scene;
    draft.accuracy.error.reset();
    draft.accuracy.time_ms.reset();
    draft.accuracy.rung.emplace(rung);
    return validate(std::move(draft));
}

// The same rays as the reference has, over nothing.
Result<Scene> reference_sized(const Scene& scene, PictureSize size) {
    SceneDraft draft = *scene;
    draft.image.width = size.width;
    draft.image.height = size.height;
    draft.image.background = Background::kTransparent;
    return validate(std::move(draft));
}

// In direct sun and under an open sky.
GroundLight ground_below(const Scene& scene, const Planned& planned) {
    GroundLight ground = bare_ground(*scene);
    if (planned.particles.size() > 0 && has_ground(*scene, planned.survey.bounds))
        cast_shadow(sun_depth(planned.particles, sun_direction(scene->sun), kShadowCells, 1),
                    scene->medium.albedo, 0, scene->medium.g, 1, ground);
    return ground;
}

Result<std::vector<const Rung*>> chosen_rungs(const AccuracyOptions& options) {
    std::vector<const Rung*> rungs;
    if (options.rungs.empty()) {
        for (const Rung& rung : ladder())
            if (rung.method != Method::kPaths) rungs.push_back(&rung);
        return rungs;
    }
    for (const std::string& name : options.rungs) {
        const Rung* const rung = find_rung(name);
        if (rung == nullptr)
            return Error{ErrorCode::kInvalidScene, "/accuracy/rung",
                         "there is no rung \"" + name + "\""};
        if (std::find(rungs.begin(), rungs.end(), rung) == rungs.end()) rungs.push_back(rung);
    }
    // In the ladder's order, so that where time runs out it is the dearest that are missing.
    std::sort(rungs.begin(), rungs.end());
    return rungs;
}

const RungForecast* forecast_of(const Plan& plan, const Rung& rung) {
    for (const RungForecast& forecast : plan.forecasts)
        if (forecast.rung == &rung) return &forecast;
    return nullptr;
}

double whole_ms(const StageTimes& times) {
    return times.generate_ms + times.survey_ms + times.light_ms + times.draw_ms;
}

// --- the reference

struct Reference {
    TruthImage truth;
    Scene scene;  // of its size, over nothing
    View view;
    Image mean;                       // of `truth`
    std::vector<std::uint8_t> shown;  // the samples of its PNG, over the sky
    GroundLight ground;               // the same under every picture: what differs is the cloud
};

// How large the reference is and how many paths a pixel it has.
struct ReferenceShape {
    PictureSize size;
    std::uint32_t samples = 2;
    double expected_ms = 0;  // 0: unknown
};

double pixels_of(PictureSize size) {
    return static_cast<double>(size.width) * size.height;
}

// As asked for, or what fits into `allowed_ms`: fewer samples first, then fewer pixels. Two short
// runs of a small picture tell what a path takes from what every picture takes before its first
// (the tracer's tables): paths of thick clouds take a hundred times those of thin ones.
Result<ReferenceShape> reference_shape(const Scene& scene, const Planned& planned,
                                       const AccuracyOptions& options, double allowed_ms,
                                       const Deadline& deadline) {
    const auto fitted = [&](int side) {
        return fitted_size(scene->image.width, scene->image.height, std::max(side, 1));
    };
    ReferenceShape shape{fitted(options.reference_side), std::max(options.samples / 2 * 2, 2u)};
    if (!std::isfinite(allowed_ms) && shape.samples <= 2 * kPilotSamples.back()) return shape;

    const PictureSize pilot_size = fitted(std::min(options.reference_side, kPilotSide));
    const auto pilot_scene = reference_sized(scene, pilot_size);
    if (!pilot_scene) return pilot_scene.error();
    const View view =
        resolve_view((*pilot_scene)->camera, (*pilot_scene)->image, planned.survey.bounds);
    std::array<double, kPilotSamples.size()> took_ms{};
    for (std::size_t i = 0; i < kPilotSamples.size(); ++i) {
        TruthOptions pilot;
        pilot.samples = kPilotSamples[i];
        pilot.threads = options.threads;
        const auto start = Clock::now();
        const auto traced =
            trace_truth(*pilot_scene, planned.particles, view, pilot, Progress{}, deadline);
        if (!traced) return traced.error();
        took_ms[i] = ms_since(start);
    }
    const double paths = pixels_of(pilot_size) * kPilotSamples[1];
    const double more_paths = paths - pixels_of(pilot_size) * kPilotSamples[0];
    // Not below a part of the whole: on a busy machine the longer run may seem the shorter.
    const double path_ms =
        std::max({(took_ms[1] - took_ms[0]) / more_paths, 0.2 * took_ms[1] / paths, 1e-9});
    const double fixed_ms = std::max(took_ms[1] - path_ms * paths, 0.0);

    const auto fitting_samples = [&] {
        const double fitting = (allowed_ms - fixed_ms) / path_ms / pixels_of(shape.size);
        return std::clamp(fitting, 1.0, static_cast<double>(shape.samples));
    };
    const double enough = std::min<double>(shape.samples, kGoodSamples);
    if (const double fitting = fitting_samples(); fitting < enough) {
        const int side = std::max(shape.size.width, shape.size.height);
        const int smaller = static_cast<int>(side * std::sqrt(fitting / enough));
        shape.size = fitted(std::clamp(smaller, std::min(kLeastSide, side), side));
    }
    shape.samples =
        std::min(shape.samples,
                 std::max(static_cast<std::uint32_t>(fitting_samples()) / 2 * 2, kFewestSamples));
    shape.expected_ms = fixed_ms + path_ms * pixels_of(shape.size) * shape.samples;
    return shape;
}

// --- one rung

struct Timed {
    double whole_ms = 0;
    StageTimes stages;
};

Status time_rung(const Scene& scene, int runs, const RenderScene& render, const Steps& steps,
                 double share_before, const Deadline& deadline, RungCost& cost) {
    std::vector<Timed> timed;
    double all_ms = 0;
    for (int i = 0; i < std::max(runs, 1); ++i) {
        auto rendered = render(scene, deadline);
        if (!rendered) {
            // Fewer runs than wanted are better than none.
            if (rendered.error().code == ErrorCode::kOverDeadline && !timed.empty()) break;
            return rendered.error();
        }
        timed.push_back({whole_ms(rendered->times), rendered->times});
        steps.tell(share_before + (1 - share_before) * (i + 1) / std::max(runs, 1));
        all_ms += timed.back().whole_ms;
        if (timed[0].whole_ms > kLongRunMs && all_ms > kEnoughMs) break;
    }
    if (timed.size() > 1 && timed[0].whole_ms <= kLongRunMs) timed.erase(timed.begin());
    std::sort(timed.begin(), timed.end(),
              [](const Timed& a, const Timed& b) { return a.whole_ms < b.whole_ms; });
    const Timed& upper = timed[timed.size() / 2];
    const Timed& lower = timed[(timed.size() - 1) / 2];
    cost.runs = static_cast<int>(timed.size());
    cost.time_ms = (lower.whole_ms + upper.whole_ms) / 2;
    cost.light_ms = lower.stages.light_ms;
    cost.draw_ms = lower.stages.draw_ms;
    return std::nullopt;
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
    const float scale =
        sum > 0 ? static_cast<float>(static_cast<double>(cloud) / sum) : 0.0F;  // 0: no light
    std::vector<float> difference(pixels);
    for (std::size_t i = 0; i < pixels; ++i)
        difference[i] =
            scale * (luminance(x.pixels.data() + 4 * i) - luminance(truth.pixels.data() + 4 * i));
    return difference;
}

// Times come out of `render`; errors and pictures out of its image at the reference's size.
Result<RungCost> measure_rung(const Scene& scene, const Rung& rung, const Reference& reference,
                              double exposure, const AccuracyOptions& options,
                              const RenderScene& render, const Steps& steps,
                              const Deadline& deadline) {
    RungCost cost;
    cost.rung = rung.name;
    const auto own = with_rung(scene, rung.name);
    if (!own) return own.error();
    const auto small = with_rung(reference.scene, rung.name);
    if (!small) return small.error();

    auto rendered = render(*small, deadline);
    if (!rendered) return rendered.error();
    const Image& picture = rendered->image;
    if (picture.width != reference.truth.half_a.width ||
        picture.height != reference.truth.half_a.height)
        return Error{ErrorCode::kInternal, "", "a render has not the size that was asked for"};
    cost.error = picture_error(picture, reference.truth);
    const Image seen = over_sky(picture, scene, reference.view, reference.ground);
    cost.flip =
        flip(reference.shown, display_bytes(seen, exposure), picture.width, picture.height).mean;
    cost.difference = relative_difference(picture, reference.mean);
    cost.picture = scene->image.background == Background::kSky ? seen : picture;
    const double small_share = 1.0 / (1 + std::max(options.runs, 1));
    steps.tell(small_share);
    if (const Status failed =
            time_rung(*own, options.runs, render, steps, small_share, deadline, cost))
        return *failed;
    return cost;
}

// About what measuring a rung takes.
double expected_ms(const RungForecast* forecast, const Scene& scene, PictureSize small, int runs) {
    constexpr double kUnknownMs = 200;  // of a render that nobody predicts
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

bool beats(const RungCost& a, const RungCost& b) {
    return a.time_ms <= b.time_ms && a.error.nrmse <= b.error.nrmse &&
           (a.time_ms < b.time_ms || a.error.nrmse < b.error.nrmse);
}

void mark_pareto(std::vector<RungCost>& rungs) {
    for (RungCost& rung : rungs)
        rung.pareto = std::none_of(rungs.begin(), rungs.end(),
                                   [&](const RungCost& other) { return beats(other, rung); });
}

}  // namespace

Result<AccuracyReport> measure_accuracy(const Scene& scene, const AccuracyOptions& options,
                                        const RenderScene& render, const Progress& progress,
                                        const Deadline& deadline) {
    if (scene->look != Look::kPhysical)
        return Error{ErrorCode::kInvalidScene, "/look",
                     "a look has no error to measure; must be \"physical\""};
    if (scene->sequence) {  // one picture of it is measured, that of the scene's time
        SceneDraft still = *scene;
        still.sequence.reset();
        auto alone = validate(std::move(still));
        if (!alone) return alone.error();
        return measure_accuracy(*alone, options, render, progress, deadline);
    }
    const auto start = Clock::now();
    const auto rungs = chosen_rungs(options);
    if (!rungs) return rungs.error();
    Steps steps(progress, options.on_step);
    AccuracyReport report;
    report.width = scene->image.width;
    report.height = scene->image.height;
    report.exposure = exposure_of(scene);

    steps.begin("planning", 0);
    auto planned = plan_scene(scene, options.threads, deadline, options.speed);
    if (!planned) return planned.error();
    steps.begin("sizing the reference", 0);
    const double allowed_ms = options.time_ms > 0
                                  ? kReferenceShare * options.time_ms - ms_since(start)
                                  : std::numeric_limits<double>::infinity();
    const auto shape = reference_shape(scene, *planned, options, allowed_ms, deadline);
    if (!shape) return shape.error();
    const PictureSize size = shape->size;
    const double reference_ms = shape->expected_ms;
    auto small = reference_sized(scene, size);
    if (!small) return small.error();
    const View view = resolve_view((*small)->camera, (*small)->image, planned->survey.bounds);
    Reference reference{{}, *small, view, {}, {}, ground_below(scene, *planned)};

    // The reference, with the detail that its size shows.
    SceneDraft as_truth = **small;
    as_truth.accuracy = {{}, {}, "truth"};
    auto truth_scene = validate(as_truth);
    if (!truth_scene) return truth_scene.error();
    const bool detailed =
        plan(*truth_scene, planned->survey, options.threads, options.speed).on(Effect::kDetail);
    planned->particles.detail =
        detailed ? detail_of(scene, planned->survey, options.threads) : nullptr;
    TruthOptions truth_options;
    truth_options.samples = shape->samples;
    truth_options.threads = options.threads;
    truth_options.seed = kReferenceSeed;
    steps.expect(reference_ms);
    std::vector<double> expected;
    for (const Rung* const rung : *rungs) {
        expected.push_back(
            expected_ms(forecast_of(planned->plan, *rung), scene, size, options.runs));
        steps.expect(expected.back());
    }
    steps.begin("tracing the reference", reference_ms);
    const auto reference_start = Clock::now();
    const double reference_cpu = processor_ms();
    auto truth = trace_truth(
        reference.scene, planned->particles, view, truth_options,
        [&](double done) { steps.tell(done); }, deadline);
    if (!truth) return truth.error();
    report.reference.time_ms = ms_since(reference_start);
    report.reference.cpu_ms = processor_ms() - reference_cpu;
    reference.truth = *std::move(truth);
    planned->particles = {};

    reference.mean = mean_of(reference.truth);
    const Image seen = over_sky(reference.mean, scene, view, reference.ground);
    reference.shown = display_bytes(seen, report.exposure);
    report.reference.width = size.width;
    report.reference.height = size.height;
    report.reference.samples = truth_options.samples;
    report.reference.noise = picture_error(reference.mean, reference.truth).truth_noise;
    report.reference.picture = scene->image.background == Background::kSky ? seen : reference.mean;

    // Every rung.
    for (std::size_t i = 0; i < rungs->size(); ++i) {
        const Rung& rung = *(*rungs)[i];
        if (auto over = deadline.over()) return *over;
        steps.begin("measuring " + std::string(rung.name), expected[i]);
        const RungForecast* const forecast = forecast_of(planned->plan, rung);
        const double left_ms = options.time_ms - ms_since(start);
        if (options.time_ms > 0 && expected[i] > left_ms) {
            report.left_out.push_back(
                {rung.name, "measuring it would take about " + seconds_text(expected[i]) + ", " +
                                seconds_text(std::max(left_ms, 0.0)) + " were left"});
            continue;
        }
        Deadline slice =
            deadline;  // so that one that is slower than predicted leaves some to others
        if (options.time_ms > 0)
            slice.until =
                std::min(slice.until,
                         Clock::now() + std::chrono::microseconds(static_cast<std::int64_t>(
                                            1e3 * kRungShare * std::clamp(left_ms, 0.0, 1e12))));
        auto cost =
            measure_rung(scene, rung, reference, report.exposure, options, render, steps, slice);
        if (!cost) {
            if (cost.error().code == ErrorCode::kOverDeadline && !deadline.over()) {
                report.left_out.push_back({rung.name, "it was not done in the " +
                                                          seconds_text(std::max(left_ms, 0.0)) +
                                                          " that were left"});
                continue;
            }
            return cost.error();
        }
        if (forecast != nullptr) {
            cost->predicted_error = forecast->error;
            cost->predicted_time_ms = forecast->time_ms;
            cost->memory_bytes = forecast->bytes;
        } else {  // not "nothing": unknown
            cost->predicted_error = cost->predicted_time_ms = cost->memory_bytes =
                std::numeric_limits<double>::quiet_NaN();
        }
        report.rungs.push_back(*std::move(cost));
    }
    std::stable_sort(report.rungs.begin(), report.rungs.end(),
                     [](const RungCost& a, const RungCost& b) { return a.time_ms < b.time_ms; });
    mark_pareto(report.rungs);
    steps.end();
    return report;
}

}  // namespace awan
