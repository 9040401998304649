#include "core/accuracy/accuracy.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/accuracy/accuracy_pictures.h"
#include "core/accuracy/reference.h"
#include "core/accuracy/rung_cost.h"
#include "core/accuracy/steps.h"
#include "core/formats/image_file.h"
#include "core/scene/rungs.h"
#include "core/scene/validate.h"
#include "core/sequence.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

constexpr double kReferenceShare = 0.5;  // of the time allowed
// Of what is left, for one rung at most.
constexpr double kRungShare = 0.6;

std::string seconds_text(double ms) {
    std::array<char, 32> text{};
    const int length = std::snprintf(text.data(), text.size(), "%.2g s", ms / 1000);
    return {text.data(), static_cast<std::size_t>(length)};
}

// What AccuracyOptions::time_ms leaves of itself.
struct TimeAllowed {
    double ms = 0;  // 0: as long as it takes
    Clock::time_point start = Clock::now();

    bool limited() const { return ms > 0; }
    double left_ms() const { return ms - ms_since(start); }
    // For the reference; infinite where there is no limit.
    double for_reference_ms() const {
        return limited() ? kReferenceShare * ms - ms_since(start)
                         : std::numeric_limits<double>::infinity();
    }
};

// Named ones once each, in the ladder's order, so that where time runs out it is the dearest that are missing.
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
        const auto same = [&](const Rung* other) { return *other == *rung; };
        if (std::none_of(rungs.begin(), rungs.end(), same)) rungs.push_back(rung);
    }
    std::sort(rungs.begin(), rungs.end(),
              [](const Rung* a, const Rung* b) { return a->id < b->id; });
    return rungs;
}

// A rung to be measured, what the plan says of it, and about how long measuring it takes.
struct RungAhead {
    const Rung* rung = nullptr;
    const RungForecast* forecast = nullptr;  // null: nothing is predicted
    double measuring_ms = 0;
};

// `plan` outlives what is returned.
std::vector<RungAhead> rungs_ahead(const std::vector<const Rung*>& rungs, const Plan& plan,
                                   const Scene& scene, PictureSize reference, int runs) {
    std::vector<RungAhead> ahead;
    for (const Rung* const rung : rungs) {
        const auto found =
            std::find_if(plan.forecasts.begin(), plan.forecasts.end(),
                         [&](const RungForecast& forecast) { return *forecast.rung == *rung; });
        const RungForecast* const forecast = found != plan.forecasts.end() ? &*found : nullptr;
        ahead.push_back({rung, forecast, measuring_ms(forecast, scene, reference, runs)});
    }
    return ahead;
}

AccuracyReport::Reference reported(const Reference& reference, const Scene& scene) {
    AccuracyReport::Reference report;
    report.width = reference.mean.width;
    report.height = reference.mean.height;
    report.samples = reference.samples;
    report.noise = picture_error(reference.mean, reference.truth).truth_noise;
    report.time_ms = reference.time_ms;
    report.cpu_ms = reference.cpu_ms;
    report.picture = scene->image.background == Background::kSky
                         ? over_sky(reference.mean, scene, reference.view, reference.ground)
                         : reference.mean;
    return report;
}

// Measures one rung within what is left of the time allowed: adds its cost to the report, or why it was left out.
Status add_rung(const RungMeasurement& with, const RungAhead& ahead, const TimeAllowed& allowed,
                const Deadline& deadline, AccuracyReport& report) {
    const double left_ms = allowed.left_ms();
    const std::string left = seconds_text(std::max(left_ms, 0.0));
    if (allowed.limited() && ahead.measuring_ms > left_ms) {
        report.left_out.push_back({ahead.rung->name, "measuring it would take about " +
                                                         seconds_text(ahead.measuring_ms) + ", " +
                                                         left + " were left"});
        return std::nullopt;
    }
    // So that a rung that is slower than predicted leaves some of the time to the others.
    Deadline slice = deadline;
    if (allowed.limited())
        slice.until = std::min(
            slice.until, Clock::now() + std::chrono::microseconds(static_cast<std::int64_t>(
                                            1e3 * kRungShare * std::clamp(left_ms, 0.0, 1e12))));
    auto cost = measure_rung(with, *ahead.rung, ahead.forecast, slice);
    if (!cost) {
        if (cost.error().code != ErrorCode::kOverDeadline || deadline.over()) return cost.error();
        report.left_out.push_back(
            {ahead.rung->name, "it was not done in the " + left + " that were left"});
        return std::nullopt;
    }
    report.rungs.push_back(*std::move(cost));
    return std::nullopt;
}

// Of a scene without a sequence.
Result<AccuracyReport> measure_still(const Scene& scene, const AccuracyOptions& options,
                                     const RenderScene& render, const Progress& progress,
                                     const Deadline& deadline) {
    const TimeAllowed allowed{options.time_ms};
    const auto rungs = chosen_rungs(options);
    if (!rungs) return rungs.error();
    Steps steps(progress, options.on_step);
    AccuracyReport report;
    report.width = scene->image.width;
    report.height = scene->image.height;
    report.film = film_of(scene);

    steps.begin("planning", 0);
    auto planned = plan_scene(scene, options.threads, deadline, options.speed);
    if (!planned) return planned.error();
    steps.begin("sizing the reference", 0);
    const auto shape =
        reference_shape(scene, *planned, options, allowed.for_reference_ms(), deadline);
    if (!shape) return shape.error();
    const std::vector<RungAhead> all =
        rungs_ahead(*rungs, planned->plan, scene, shape->size, options.runs);
    steps.expect(shape->expected_ms);
    for (const RungAhead& ahead : all) steps.expect(ahead.measuring_ms);
    const auto reference =
        trace_reference(scene, *planned, *shape, options, report.film, steps, deadline);
    if (!reference) return reference.error();
    planned->particles = {};
    report.reference = reported(*reference, scene);

    const RungMeasurement with{scene, *reference, options, render, steps, report.film};
    for (const RungAhead& ahead : all) {
        if (auto over = deadline.over()) return *over;
        steps.begin("measuring " + std::string(ahead.rung->name), ahead.measuring_ms);
        if (const Status failed = add_rung(with, ahead, allowed, deadline, report)) return *failed;
    }
    std::stable_sort(report.rungs.begin(), report.rungs.end(),
                     [](const RungCost& a, const RungCost& b) { return a.time_ms < b.time_ms; });
    mark_pareto(report.rungs);
    steps.end();
    return report;
}

}  // namespace

Result<AccuracyReport> measure_accuracy(const Scene& scene, const AccuracyOptions& options,
                                        const RenderScene& render, const Progress& progress,
                                        const Deadline& deadline) {
    if (scene->look != Look::kPhysical)
        return Error{ErrorCode::kInvalidScene, "/look",
                     "a look has no error to measure; must be \"physical\""};
    if (scene->display != Display::kLit)
        return Error{ErrorCode::kInvalidScene, "/display",
                     "only a lit picture has an error to measure; must be \"lit\""};
    if (draws_textures(*scene))
        return Error{ErrorCode::kInvalidScene, "/effects/texture",
                     "a painted billboard has no truth and no error to measure; must be false in "
                     "a scene with textures"};
    if (!scene->sequence) return measure_still(scene, options, render, progress, deadline);
    // Of a sequence one picture is measured, that of the scene's time.
    const auto still = validate(still_of(*scene, *scene->sequence, scene->time));
    if (!still) return still.error();
    return measure_still(*still, options, render, progress, deadline);
}

}  // namespace awan
