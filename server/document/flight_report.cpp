#include "server/document/flight_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/scene/rungs.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

using json_text::member;
using json_text::name;

// Milliseconds and seconds with as many digits as mean something.
double thousandths(double value) {
    return std::round(1000 * value) / 1000;
}

struct Stage {
    const char* name;
    double (*ms)(const FlownFrame& frame);
};
constexpr Stage kStages[] = {{"generate", [](const FlownFrame& f) { return f.times.generate_ms; }},
                             {"survey", [](const FlownFrame& f) { return f.times.survey_ms; }},
                             {"light", [](const FlownFrame& f) { return f.times.light_ms; }},
                             {"draw", [](const FlownFrame& f) { return f.times.draw_ms; }},
                             {"measure", [](const FlownFrame& f) { return f.times.measure_ms; }},
                             {"encode", [](const FlownFrame& f) { return f.encode_ms; }}};

template <typename Value>
double mean_of_frames(const FlightReport& report, Value value) {
    double sum = 0;
    for (const FlownFrame& frame : report.frames) sum += static_cast<double>(value(frame));
    return report.frames.empty() ? std::numeric_limits<double>::quiet_NaN()
                                 : sum / static_cast<double>(report.frames.size());
}

std::uint64_t lights_made(const FlightReport& report) {
    return static_cast<std::uint64_t>(
        std::count_if(report.frames.begin(), report.frames.end(),
                      [](const FlownFrame& frame) { return !frame.light_was_kept; }));
}

double mebibytes(std::uint64_t bytes) {
    return std::round(static_cast<double>(bytes) / (1 << 20) * 10) / 10;
}

// Over all frames.
struct ImpostorSums {
    std::uint64_t frames = 0, kept = 0, drawn = 0, redrawn = 0, whole = 0;
    double pictures_ms = 0, frame_ms = 0, all_ms = 0;
};

ImpostorSums sums_of(const FlightReport& report) {
    ImpostorSums sums;
    for (const FlownFrame& frame : report.frames) {
        const ImpostorFrame& own = frame.impostors;
        sums.frames += own.kept + own.drawn > 0 ? 1 : 0;
        sums.kept += own.kept;
        sums.drawn += own.drawn;
        sums.redrawn += own.redrawn;
        sums.whole += own.whole;
        sums.pictures_ms += own.pictures_ms;
        sums.frame_ms += own.frame_ms;
        sums.all_ms += frame.ms;
    }
    return sums;
}

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

void append_impostors(const FlightReport& report, std::string& out) {
    const ImpostorReport& how = report.impostors;
    const ImpostorSums sums = sums_of(report);
    name("impostors", out);
    out += '{';
    member("mode", std::string_view(kImpostorsWords[static_cast<int>(how.wish.mode)]), out);
    member("pixels", how.wish.pixels, out);
    member("on", how.on, out);
    member("reason", std::string_view(how.reason), out);
    member("clouds", how.clouds, out);
    member("saved_forecast", thousandths(how.saved), out);
    member("frames", sums.frames, out);
    member("kept", sums.kept, out);
    member("drawn", sums.drawn, out);
    member("redrawn", sums.redrawn, out);
    member("whole", sums.whole, out);
    member("pictures_share", thousandths(share(sums.pictures_ms, sums.all_ms)), out);
    member("eye_share", thousandths(share(sums.frame_ms, sums.all_ms)), out);
    out += '}';
}

void append_frame(const FlownFrame& frame, std::string& out) {
    out += '{';
    member("frame", frame.frame, out);
    member("time", frame.time, out);
    member("particles", static_cast<std::uint64_t>(frame.particles), out);
    member("in_view", static_cast<std::uint64_t>(frame.in_view), out);
    member("billboards", static_cast<std::uint64_t>(frame.billboards), out);
    member("ms", thousandths(frame.ms), out);
    member("light_was_kept", frame.light_was_kept, out);
    name("impostors", out);
    out += '{';
    member("kept", static_cast<std::uint64_t>(frame.impostors.kept), out);
    member("drawn", static_cast<std::uint64_t>(frame.impostors.drawn), out);
    member("redrawn", static_cast<std::uint64_t>(frame.impostors.redrawn), out);
    member("whole", static_cast<std::uint64_t>(frame.impostors.whole), out);
    out += '}';
    name("stages_ms", out);
    out += '{';
    for (const Stage& stage : kStages) member(stage.name, thousandths(stage.ms(frame)), out);
    out += "}}";
}

// "name                 value"
void append_line(const char* what, const std::string& value, std::string& out) {
    std::string line = what;
    line.resize(std::max<std::size_t>(line.size(), 20), ' ');
    out += line + ' ' + value + '\n';
}

std::string number(const char* format, double value) {
    if (!std::isfinite(value)) return "none";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

void append_impostor_lines(const FlightReport& report, std::string& out) {
    const ImpostorReport& how = report.impostors;
    append_line("Impostors", (how.on ? "on: " : "off: ") + how.reason, out);
    if (!how.on) return;
    const ImpostorSums sums = sums_of(report);
    append_line("  bound", number("%g pixels", how.wish.pixels), out);
    append_line("  clouds", std::to_string(how.clouds) + " that stand apart", out);
    append_line("  frames", std::to_string(sums.frames), out);
    append_line("  kept", std::to_string(sums.kept), out);
    append_line("  drawn",
                std::to_string(sums.drawn) + ", " + std::to_string(sums.redrawn) +
                    " of them again, as the bound was crossed",
                out);
    append_line("  drawn whole", std::to_string(sums.whole), out);
    append_line(
        "  time",
        number("%.1f%% of the frames' for pictures, ", 100 * share(sums.pictures_ms, sums.all_ms)) +
            number("%.1f%% for the rest of the eye pass", 100 * share(sums.frame_ms, sums.all_ms)),
        out);
}

}  // namespace

double FlightReport::frames_per_second() const {
    double ms = 0;
    for (const FlownFrame& frame : frames) ms += frame.ms;
    return ms > 0 ? 1000 * static_cast<double>(frames.size()) / ms
                  : std::numeric_limits<double>::quiet_NaN();
}

FlownFrame flown_frame(std::uint64_t frame, double time, std::size_t particles, std::size_t in_view,
                       const Rendered& rendered) {
    const bool splats = rendered.rung != nullptr && rendered.rung->method == Method::kSplats;
    FlownFrame flown;
    flown.frame = frame;
    flown.time = time;
    flown.particles = particles;
    flown.in_view = in_view;
    flown.billboards = splats ? in_view : 0;
    flown.times = rendered.times;
    flown.light_was_kept = rendered.light_was_kept;
    flown.impostors = rendered.impostors;
    return flown;
}

std::uint64_t peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    // Linux counts it in KiB.
    return static_cast<std::uint64_t>(usage.ru_maxrss) << 10;
}

std::string flight_to_json(const FlightReport& report) {
    std::string out = "{";
    member("awan", std::string_view(engine_version()), out);
    name("scenes", out);
    out += '[';
    for (const std::string& scene : report.scenes) {
        if (out.back() != '[') out += ',';
        append_json_string(scene, out);
    }
    out += ']';
    member("path", std::string_view(report.path), out);
    member("mode", std::string_view(report.mode.empty() ? "as it stands" : report.mode), out);
    member("width", report.width, out);
    member("height", report.height, out);
    member("threads", report.threads, out);
    member("rung", std::string_view(report.rung), out);
    member("renderer", std::string_view(report.renderer), out);
    member("frames", static_cast<std::uint64_t>(report.frames.size()), out);
    member("frames_asked", report.frames_asked, out);
    member("timed_out", report.timed_out, out);
    member("time_s", thousandths(report.seconds), out);
    member("settle_s", thousandths(report.settle_seconds), out);
    member("fps", thousandths(report.frames_per_second()), out);
    const auto mean = [&](const char* field, auto value) {
        member(field, thousandths(mean_of_frames(report, value)), out);
    };
    mean("particles", [](const FlownFrame& f) { return f.particles; });
    mean("in_view", [](const FlownFrame& f) { return f.in_view; });
    mean("billboards", [](const FlownFrame& f) { return f.billboards; });
    member("lights_made", lights_made(report), out);
    name("stages_ms", out);
    out += '{';
    for (const Stage& stage : kStages) mean(stage.name, stage.ms);
    out += '}';
    append_impostors(report, out);
    member("peak_memory_mib", mebibytes(peak_memory()), out);
    name("each", out);
    out += '[';
    for (const FlownFrame& frame : report.frames) {
        out += &frame == report.frames.data() ? "\n" : ",\n";
        append_frame(frame, out);
    }
    return out + "]}\n";
}

std::string flight_to_text(const FlightReport& report) {
    std::string out = std::string("Awan ") + engine_version() + ": report of a flight\n";
    for (const std::string& scene : report.scenes) append_line("Cloud model", scene, out);
    append_line("Path", report.path, out);
    append_line("Cloud mode", report.mode.empty() ? "as it stands" : report.mode, out);
    append_line("Window size", std::to_string(report.width) + " x " + std::to_string(report.height),
                out);
    append_line("Rung", report.rung, out);
    append_line("Renderer", report.renderer, out);
    append_line("Time", number("%.3f s", report.seconds), out);
    append_line("Before the first", number("%.3f s", report.settle_seconds), out);
    append_line("Frames",
                std::to_string(report.frames.size()) + " of " +
                    std::to_string(report.frames_asked) + (report.timed_out ? ", timed out" : ""),
                out);
    append_line("FPS", number("%.2f", report.frames_per_second()), out);
    const auto mean = [&](const char* what, auto value) {
        append_line(what, number("%.0f", mean_of_frames(report, value)), out);
    };
    mean("Particles", [](const FlownFrame& f) { return f.particles; });
    mean("Particles in view", [](const FlownFrame& f) { return f.in_view; });
    mean("Billboards used", [](const FlownFrame& f) { return f.billboards; });
    append_line("Lights made", std::to_string(lights_made(report)), out);
    for (const Stage& stage : kStages)
        append_line((std::string("  ") + stage.name).c_str(),
                    number("%.3f ms a frame", mean_of_frames(report, stage.ms)), out);
    append_impostor_lines(report, out);
    append_line("Peak memory", number("%.1f MiB", mebibytes(peak_memory())), out);
    return out;
}

}  // namespace awan
