// Measures rungs on numbered scenes against the path tracer: what forecasts are fitted to and checked on.
//   calibrate --set fit --count 60 -o fit.csv        then tests/calibration/fit.py
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/accuracy/error_measures.h"
#include "core/draw/picture_difference.h"
#include "core/gl/device.h"
#include "core/light/light_cache.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/plan/criteria.h"
#include "core/plan/forecast_figures.h"
#include "core/plan/known_error.h"
#include "core/scene/validate.h"
#include "core/truth/path_tracer.h"
#include "server/document/json.h"
#include "tests/calibration/scenes.h"

namespace {

using namespace awan;

struct Options {
    std::string set = "fit", output = "-";
    int first = 0, count = 10, width = 80, height = 60, threads = 2;
    double noise = 0.1;   // of a pixel of the truth that is wanted
    double seconds = 20;  // of a truth, at most
    int runs = 3;         // timed renders; the least counts
    std::vector<double> errors, times;
    bool only_grids = false, write = false, untraced = false;
    std::string keep;  // folder of references from an earlier run; EMPTY: none are kept
};

template <typename T>
T must(Result<T> result) {
    if (!result.ok()) {
        std::fprintf(stderr, "%s: %s\n", result.error().pointer.c_str(),
                     result.error().message.c_str());
        std::exit(1);
    }
    return *std::move(result);
}

double seconds_since(Deadline::Clock::time_point start) {
    return std::chrono::duration<double>(Deadline::Clock::now() - start).count();
}

// A truth with the wanted noise, or what the time allows.
struct Reference {
    TruthImage image;
    std::uint32_t samples = 0;
    double noise = 0, seconds = 0;
};

// Traces with so many samples a pixel.
Reference traced(const Scene& scene, const Planned& planned, const Options& options,
                 std::uint32_t samples) {
    TruthOptions truth;
    truth.eye_effects = planned.plan.eye_effects();
    truth.whole_pixels = true;
    truth.threads = options.threads;
    truth.samples = samples;
    Reference reference;
    const auto start = Deadline::Clock::now();
    reference.image =
        must(trace_truth(scene, planned.particles, planned.survey.view, truth, {}, {}));
    reference.seconds = seconds_since(start);
    reference.samples = samples;
    reference.noise = picture_error(mean_of(reference.image), reference.image).truth_noise;
    return reference;
}

Reference reference_of(const Scene& scene, const Planned& planned, const Options& options) {
    constexpr std::uint32_t kFew = 2, kSome = 16;
    const Reference few = traced(scene, planned, options, kFew);
    if (options.noise >= 1) return few;
    Reference reference = traced(scene, planned, options, kSome);
    // Where there are many particles a pixel costs more before its first path than the paths do.
    const double one = std::max((reference.seconds - few.seconds) / (kSome - kFew), 1e-6);
    const double before = std::max(reference.seconds - kSome * one, 0.0);
    const double ratio = reference.noise / options.noise;
    const double wanted = std::min(kSome * ratio * ratio, (options.seconds - before) / one);
    if (wanted < 1.2 * kSome) return reference;
    const double most = std::clamp(wanted / 2, 1.0, 2e6);
    return traced(scene, planned, options, 2 * static_cast<std::uint32_t>(most));
}

// A reference as a file: samples, noise, seconds, then the pixels of both halves.
std::string kept_name(const Options& options, int index) {
    return options.keep + "/" + options.set + "-" + std::to_string(index) + "-" +
           std::to_string(options.width) + "x" + std::to_string(options.height) + ".reference";
}

bool read_kept(const Options& options, int index, Reference& reference) {
    if (options.keep.empty()) return false;
    std::ifstream file(kept_name(options, index), std::ios::binary);
    const auto take = [&](auto* to, std::size_t count) {
        file.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count * sizeof *to));
    };
    take(&reference.samples, 1);
    take(&reference.noise, 1);
    take(&reference.seconds, 1);
    for (Image* half : {&reference.image.half_a, &reference.image.half_b}) {
        half->width = options.width;
        half->height = options.height;
        half->pixels.resize(4 * half->pixel_count());
        take(half->pixels.data(), half->pixels.size());
    }
    return file.good();
}

void keep(const Options& options, int index, const Reference& reference) {
    if (options.keep.empty()) return;
    std::ofstream file(kept_name(options, index), std::ios::binary);
    const auto put = [&](const auto* from, std::size_t count) {
        file.write(reinterpret_cast<const char*>(from),
                   static_cast<std::streamsize>(count * sizeof *from));
    };
    put(&reference.samples, 1);
    put(&reference.noise, 1);
    put(&reference.seconds, 1);
    for (const Image* half : {&reference.image.half_a, &reference.image.half_b})
        put(half->pixels.data(), half->pixels.size());
}

struct TimedRender {
    Rendered rendered;
    double time_ms = 0, cpu_ms = 0;  // of all threads
};

// The fastest of some runs.
TimedRender timed_render(const Scene& scene, const Options& options, Device& device,
                         LightCache* lights) {
    std::optional<TimedRender> best;
    for (int run = 0; run < options.runs; ++run) {
        const auto start = Deadline::Clock::now();
        const std::clock_t cpu = std::clock();
        auto rendered = must(render_scene(scene, {&device, options.threads, lights, {}, {}}, {}));
        const double cpu_ms = 1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
        const double ms = 1e3 * seconds_since(start);
        if (!best || ms < best->time_ms) best = TimedRender{std::move(rendered), ms, cpu_ms};
    }
    return *std::move(best);
}

// What a row compares a picture with.
struct Truth {
    const std::string& kind;
    const Scene& scene;
    const Planned& planned;
    const Reference& reference;
};

std::string ask_name(const char* what, double ask) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%s %g", what, ask);
    return text.data();
}

// name: what was asked for; rung: that the picture is of.
// difference: to the picture of the rung before, of grids.
void write_row(const Options& options, int index, const std::string& name, const Rung& rung,
               const Truth& truth, const TimedRender& made, double difference, std::FILE* out) {
    const Rendered& rendered = made.rendered;
    // Without a reference, only what is stated counts.
    const PictureError error = truth.reference.samples > 0
                                   ? picture_error(rendered.image, truth.reference.image)
                                   : PictureError{};
    const Survey& survey = truth.planned.survey;
    const Scene& scene = truth.scene;
    std::fprintf(
        out,
        "%s,%d,%s,%s,%d,%zu,%.4g,%.4g,%.3g,%.3g,%.4g,%.5g,%.3g,%.4g,%.3g,%.3g,%u,%.5g,"
        "%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%s",
        options.set.c_str(), index, truth.kind.c_str(), name.c_str(), rung.cells, survey.particles,
        survey.optical_depth_eye, survey.optical_depth_sun, scene->medium.g, scene->medium.albedo,
        survey.sun_cosine, error.nrmse, error.nrmse_noise, error.bias, error.bias_noise,
        truth.reference.noise, truth.reference.samples, rendered.plan.predicted.error, made.time_ms,
        rendered.times.light_ms, rendered.times.draw_ms, rendered.times.measure_ms,
        rendered.plan.predicted.time_ms, rendered.stated_error,
        rung.cells > 0
            ? std::hypot(known_error(scene, survey, detail_counts(scene, survey), rung.cells),
                         survey.model_error)
            : 0.0,
        difference, made.cpu_ms, rung.name);
    for (const double figure : error_figures(rung, scene, survey))
        std::fprintf(out, ",%.6g", figure);
    for (const double figure : time_figures(rung, scene, survey, 0))
        std::fprintf(out, ",%.6g", figure);
    for (const double figure : measuring_figures(rung, scene, survey))
        std::fprintf(out, ",%.6g", figure);
    std::fputc('\n', out);
}

void measure(const Options& options, int index, Device& device, std::FILE* out) {
    const auto numbered =
        calibration::numbered_scene(options.set, index, options.width, options.height);
    const Scene scene = must(validate(numbered.draft));
    if (options.write) {
        std::ofstream(options.keep + "/" + options.set + "-" + std::to_string(index) + ".json")
            << scene_to_json(*scene);
        return;
    }
    // As the truth sees it: with its detail.
    SceneDraft named = numbered.draft;
    named.accuracy.rung = "truth";
    const Planned planned = must(plan_scene(must(validate(named)), options.threads, {}));
    Reference reference;
    if (!options.untraced && !read_kept(options, index, reference)) {
        reference = reference_of(scene, planned, options);
        keep(options, index, reference);
    }
    // Where times do not count, a grid goes on from the coarser rung's. What asks cost is held against them.
    LightCache lights(std::size_t{1} << 30);
    const bool timed = !options.untraced &&
                       (options.noise >= 1 || !options.errors.empty() || !options.times.empty());
    const Truth against{numbered.kind, scene, planned, reference};
    const auto rendered_as = [&](const Accuracy& accuracy) {
        SceneDraft draft = numbered.draft;
        draft.accuracy = accuracy;
        return timed_render(must(validate(draft)), options, device, timed ? nullptr : &lights);
    };
    std::optional<Image> coarser;
    for (const Rung& rung : ladder()) {
        if (rung.method == Method::kPaths || (options.only_grids && rung.cells == 0)) continue;
        const TimedRender made = rendered_as({{}, {}, std::string(rung.name)});
        const Image& image = made.rendered.image;
        write_row(options, index, rung.name, rung, against, made,
                  coarser ? picture_difference(*coarser, image) : 0, out);
        if (rung.cells > 0) coarser = image;
    }
    for (const double ask : options.errors) {
        const TimedRender made = rendered_as({ask, {}, {}});
        write_row(options, index, ask_name("error", ask), *made.rendered.rung, against, made, 0,
                  out);
    }
    for (const double ask : options.times) {
        const TimedRender made = rendered_as({{}, ask, {}});
        write_row(options, index, ask_name("time", ask), *made.rendered.rung, against, made, 0,
                  out);
    }
    if (options.untraced) return;
    // The truth's own figures: noise of one path and what it took.
    std::fprintf(out,
                 "%s,%d,%s,truth,0,%zu,%.4g,%.4g,%.3g,%.3g,%.4g,%.5g,0,0,0,%.3g,%u,0,%.5g,0,%.5g,0,"
                 "0,0,0,0,0,truth",
                 options.set.c_str(), index, numbered.kind.c_str(), planned.survey.particles,
                 planned.survey.optical_depth_eye, planned.survey.optical_depth_sun,
                 scene->medium.g, scene->medium.albedo, planned.survey.sun_cosine, reference.noise,
                 reference.noise, reference.samples, 1e3 * reference.seconds,
                 1e3 * reference.seconds);
    const Rung& truth = rung_of(RungId::kTruth);
    for (const double figure : error_figures(truth, scene, planned.survey))
        std::fprintf(out, ",%.6g", figure);
    for (const double figure : time_figures(truth, scene, planned.survey, reference.samples))
        std::fprintf(out, ",%.6g", figure);
    for (std::size_t i = 0; i < kTimeFigureCount; ++i) std::fputs(",0", out);  // is not measured
    std::fputc('\n', out);
    std::fflush(out);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Measures every rung on numbered scenes.");
    Options options;
    app.add_option("--set", options.set, "fit, check or any other name: each is another set");
    app.add_option("--first", options.first);
    app.add_option("--count", options.count);
    app.add_option("--width", options.width);
    app.add_option("--height", options.height);
    app.add_option("--threads", options.threads);
    app.add_option("--noise", options.noise,
                   "of a pixel of the truth that is wanted; 1 and more: only times count");
    app.add_option("--seconds", options.seconds, "that a truth may take");
    app.add_option("--runs", options.runs);
    app.add_option("--ask-error", options.errors, "render each scene with these wishes too");
    app.add_option("--ask-time", options.times, "milliseconds; the same");
    app.add_option(
        "--keep", options.keep,
        "a folder that keeps references for the next run: only while the truth stays the same");
    app.add_flag("--write", options.write,
                 "write the scenes as documents, as SET-NUMBER.json in --keep's folder, and "
                 "measure nothing");
    app.add_flag("--untraced", options.untraced,
                 "without references: what is stated is all that counts");
    app.add_flag("--only-grids", options.only_grids, "leave out all but the transport rungs");
    app.add_option("-o,--output", options.output);
    CLI11_PARSE(app, argc, argv);
    Device device = must(Device::open(DeviceChoice::kSoftware));
    std::FILE* out = options.output == "-" ? stdout : std::fopen(options.output.c_str(), "w");
    if (!out) return 1;
    std::fputs(
        "set,index,kind,rung,cells,particles,depth_eye,depth_sun,g,albedo,sun_cosine,error,error_"
        "noise,bias,bias_noise,"
        "truth_noise,samples,predicted_error,time_ms,light_ms,draw_ms,measure_ms,predicted_ms,"
        "stated,known,difference,cpu_ms,chosen",
        out);
    for (const char* name : kErrorFigureNames) std::fprintf(out, ",e_%s", name);
    for (const char* name : kTimeFigureNames) std::fprintf(out, ",t_%s", name);
    for (const char* name : kTimeFigureNames) std::fprintf(out, ",m_%s", name);
    std::fputc('\n', out);
    for (int i = 0; i < options.count; ++i) {
        measure(options, options.first + i, device, out);
        std::fprintf(stderr, "\r%d of %d", i + 1, options.count);
    }
    std::fputc('\n', stderr);
    if (out != stdout) std::fclose(out);
    return 0;
}
