#include "core/accuracy/reference.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/light/sun_depth.h"
#include "core/scene/validate.h"
#include "core/survey/detail_of.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

// Two short runs of a small picture tell what a path takes.
constexpr std::array<std::uint32_t, 2> kPilotSamples = {2, 6};
constexpr int kPilotSide = 32;  // pixels
// Above, more pixels are worth more than more samples.
constexpr std::uint32_t kGoodSamples = 64;
constexpr int kLeastSide = 24;  // pixels
// Below, the noise is all there is to see.
constexpr std::uint32_t kFewestSamples = 16;
// Of the cloud's shadow on the ground.
constexpr int kShadowCells = 64;

// Not the seed of rung truth: noise of one picture must not look like that of the other.
constexpr std::uint64_t kReferenceSeed = 0x7275746872656621;

// Of all threads of this process: what a render beside it takes counts too.
double processor_ms() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double pixels_of(PictureSize size) {
    return static_cast<double>(size.width) * size.height;
}

PictureSize fitted(const Scene& scene, int side) {
    return fitted_size(scene->image.width, scene->image.height, std::max(side, 1));
}

// The same rays as the reference has, over nothing.
Result<Scene> reference_sized(const Scene& scene, PictureSize size) {
    SceneDraft draft = *scene;
    draft.image.width = size.width;
    draft.image.height = size.height;
    draft.image.background = Background::kTransparent;
    draft.image.layers = "none";
    return validate(std::move(draft));
}

// In direct sun and under an open sky.
GroundLight ground_below(const Scene& scene, const Planned& planned) {
    GroundLight ground = bare_ground(*scene);
    if (planned.particles.size() > 0 && has_ground(*scene, planned.survey.bounds))
        cast_shadow(sun_depth(planned.particles, sun_direction(scene->sun), kShadowCells, 1),
                    scene->medium.albedo, 0, 0, 1, ground);
    return ground;
}

// What tracing a picture takes: a part that every picture takes before its first path (the tracer's tables), and the
// paths, of which those in thick clouds take a hundred times those in thin ones.
struct TracingTime {
    double fixed_ms = 0, path_ms = 0;

    double of(double paths) const { return fixed_ms + path_ms * paths; }
};

Result<TracingTime> tracing_time(const Scene& scene, const Planned& planned,
                                 const AccuracyOptions& options, const Deadline& deadline) {
    const PictureSize size = fitted(scene, std::min(options.reference_side, kPilotSide));
    const auto pilot_scene = reference_sized(scene, size);
    if (!pilot_scene) return pilot_scene.error();
    const View view =
        resolve_view((*pilot_scene)->camera, (*pilot_scene)->image, planned.survey.bounds);
    std::array<double, kPilotSamples.size()> took_ms{};
    for (std::size_t i = 0; i < kPilotSamples.size(); ++i) {
        TruthOptions pilot;
        pilot.whole_pixels = true;
        pilot.samples = kPilotSamples[i];
        pilot.threads = options.threads;
        const auto start = Clock::now();
        const auto traced =
            trace_truth(*pilot_scene, planned.particles, view, pilot, Progress{}, deadline);
        if (!traced) return traced.error();
        took_ms[i] = ms_since(start);
    }
    const double paths = pixels_of(size) * kPilotSamples[1];
    const double more_paths = paths - pixels_of(size) * kPilotSamples[0];
    TracingTime time;
    // Not below a part of the whole: on a busy machine the longer run may seem the shorter.
    time.path_ms =
        std::max({(took_ms[1] - took_ms[0]) / more_paths, 0.2 * took_ms[1] / paths, 1e-9});
    time.fixed_ms = std::max(took_ms[1] - time.path_ms * paths, 0.0);
    return time;
}

// Whether the scene's picture has the detail that it asks for: at its own size, for what is measured is that picture's
// error, however small the reference is.
Result<bool> shows_detail(const Scene& scene, const Planned& planned,
                          const AccuracyOptions& options) {
    SceneDraft as_truth = *scene;
    as_truth.accuracy = {{}, {}, rung_of(RungId::kTruth).name};
    const auto truth_scene = validate(std::move(as_truth));
    if (!truth_scene) return truth_scene.error();
    return plan(*truth_scene, planned.survey, options.threads, options.speed).on(Effect::kDetail);
}

// A small picture that has the detail which the large one has.
Result<Scene> with_detail_settled(const Result<Scene>& small, bool detailed) {
    if (!small) return small;
    SceneDraft draft = **small;
    Switch& wanted = draft.effects[static_cast<int>(Effect::kDetail)];
    if (wanted == Switch::kAuto) wanted = detailed ? Switch::kOn : Switch::kOff;
    return validate(std::move(draft));
}

}  // namespace

Result<ReferenceShape> reference_shape(const Scene& scene, const Planned& planned,
                                       const AccuracyOptions& options, double allowed_ms,
                                       const Deadline& deadline) {
    ReferenceShape shape{fitted(scene, options.reference_side),
                         std::max(options.samples / 2 * 2, 2u)};
    if (!std::isfinite(allowed_ms) && shape.samples <= 2 * kPilotSamples.back()) return shape;
    const auto time = tracing_time(scene, planned, options, deadline);
    if (!time) return time.error();
    const auto fitting_samples = [&] {
        const double fitting =
            (allowed_ms - time->fixed_ms) / time->path_ms / pixels_of(shape.size);
        return std::clamp(fitting, 1.0, static_cast<double>(shape.samples));
    };
    const double enough = std::min<double>(shape.samples, kGoodSamples);
    if (const double fitting = fitting_samples(); fitting < enough) {
        const int side = std::max(shape.size.width, shape.size.height);
        const int smaller = static_cast<int>(side * std::sqrt(fitting / enough));
        shape.size = fitted(scene, std::clamp(smaller, std::min(kLeastSide, side), side));
    }
    shape.samples =
        std::min(shape.samples,
                 std::max(static_cast<std::uint32_t>(fitting_samples()) / 2 * 2, kFewestSamples));
    shape.expected_ms = time->of(pixels_of(shape.size) * shape.samples);
    return shape;
}

Result<Reference> trace_reference(const Scene& scene, Planned& planned, const ReferenceShape& shape,
                                  const AccuracyOptions& options, const FilmSettings& film,
                                  Steps& steps, const Deadline& deadline) {
    const auto detailed = shows_detail(scene, planned, options);
    if (!detailed) return detailed.error();
    const auto sized = with_detail_settled(reference_sized(scene, shape.size), *detailed);
    if (!sized) return sized.error();
    const View view = resolve_view((*sized)->camera, (*sized)->image, planned.survey.bounds);
    Reference reference{*sized, view, {}, {}, {}, ground_below(scene, planned), shape.samples};
    planned.particles.detail =
        *detailed ? detail_of(scene, planned.survey, options.threads) : nullptr;

    TruthOptions tracing;
    tracing.whole_pixels = true;
    tracing.samples = shape.samples;
    tracing.threads = options.threads;
    tracing.seed = kReferenceSeed;
    steps.begin("tracing the reference", shape.expected_ms);
    const auto start = Clock::now();
    const double cpu_before = processor_ms();
    auto truth = trace_truth(
        reference.scene, planned.particles, view, tracing, [&](double done) { steps.tell(done); },
        deadline);
    if (!truth) return truth.error();
    reference.time_ms = ms_since(start);
    reference.cpu_ms = processor_ms() - cpu_before;
    reference.truth = *std::move(truth);
    reference.mean = mean_of(reference.truth);
    reference.shown = display_bytes(over_sky(reference.mean, scene, view, reference.ground), film);
    return reference;
}

}  // namespace awan
