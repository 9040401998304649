// awan fly: a flight around clouds or through them, and a report of how it went.
#include <algorithm>
#include <cstdio>

#include "core/flight_path.h"
#include "core/scene/combine.h"
#include "core/scene/validate.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/pictures.h"
#include "server/cli/support.h"
#include "server/cli/targets.h"
#include "server/document/camera_text.h"
#include "server/document/json.h"
#include "server/service/problem.h"

namespace awan {
namespace {

using Clock = Deadline::Clock;

// An error, and the file that it is of.
struct Failure {
    std::string subject;
    Error error;
};

// All scenes as one. Values by flag are of the first.
std::optional<Failure> read_scenes(const FlyCommand& command, SceneDraft& draft) {
    for (std::size_t i = 0; i < command.scenes.size(); ++i) {
        SceneInput input = command.input;
        if (i > 0)
            input = SceneInput{.path = "",
                               .sets = {},
                               .seed = {},
                               .radius = command.input.radius,
                               .states = {},
                               .textures = command.input.textures};
        input.path = command.scenes[i];
        auto read = read_scene_input(input);
        if (!read) return Failure{input.path, read.error()};
        // What is wrong with one by itself is said of it.
        if (auto valid = validate(*read); !valid) return Failure{input.path, valid.error()};
        if (i == 0) {
            draft = *std::move(read);
        } else if (const Status wrong = combine_into(draft, *read)) {
            return Failure{input.path, *wrong};
        }
    }
    return std::nullopt;
}

bool is_word(const std::string& text, std::span<const char* const> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

template <typename Word>
Word word_at(const std::string& text, std::span<const char* const> words) {
    return static_cast<Word>(std::find(words.begin(), words.end(), text) - words.begin());
}

// The path: one there is, or keys in a file.
std::optional<Failure> read_path(const std::string& path, SceneDraft& draft, FlightWish& wish) {
    if (path.empty()) return std::nullopt;
    if (is_word(path, kFlightPathWords)) {
        wish.path = word_at<FlightPath>(path, kFlightPathWords);
        return std::nullopt;
    }
    const auto text = read_input(path);
    if (!text) return Failure{"", text.error()};
    if (const Status wrong = set_camera_keys(*text, draft)) return Failure{path, *wrong};
    if (auto valid = validate(draft); !valid) {
        Error error = valid.error();
        error.pointer = text_pointer(*text, error.pointer);
        return Failure{path, error};
    }
    wish.path = FlightPath::kKeys;
    return std::nullopt;
}

bool ends_with(const std::string& name, std::string_view ending) {
    return name.size() > ending.size() && std::string_view(name).ends_with(ending);
}

// What the frames are drawn with: pictures only, the flight's document aside.
RenderCommand drawing(const FlyCommand& command) {
    RenderCommand render;
    render.scene = command.input;
    render.scene.path = command.scenes.front();
    for (const std::string& output : command.outputs)
        if (!ends_with(output, ".json")) render.outputs.push_back(output);
    render.frames_per_second = command.frames_per_second;
    render.threads = command.threads;
    render.device = command.device;
    return render;
}

// That each frame has a name, and each file can be written. The code to exit with, if one cannot.
std::optional<int> check_outputs(const FlyCommand& command, const std::vector<Target>& targets,
                                 std::uint64_t frames) {
    for (const Target& target : targets) {
        const Status wrong = target.animated() ? check_not_numbered(target.path)
                                               : check_numbered(target.path, frames);
        if (wrong) return bad_usage(wrong->message);
        if (const Status failed = check_writable(numbered_name(target.path, 0)))
            return report_error("", *failed);
    }
    if (!command.report.empty() && !ends_with(command.report, ".json") &&
        !ends_with(command.report, ".txt"))
        return bad_usage("--report " + command.report + ": a report is a .json or a .txt");
    if (!command.report.empty())
        if (const Status failed = check_writable(command.report)) return report_error("", *failed);
    return std::nullopt;
}

FlightReport begin_report(const FlyCommand& command, const Scene& scene, bool own_keys) {
    FlightReport report;
    report.scenes = command.scenes;
    report.path =
        !command.path.empty()
            ? command.path
            : kFlightPathWords[static_cast<int>(own_keys ? FlightPath::kKeys : FlightPath::kOrbit)];
    report.mode = command.mode;
    report.width = scene->image.width;
    report.height = scene->image.height;
    report.threads = command.threads;
    report.rung = scene->accuracy.rung.value_or(kLookWords[static_cast<int>(scene->look)]);
    report.frames_asked = scene->sequence->frames;
    return report;
}

Status write_report(const FlyCommand& command, const FlightReport& report) {
    const bool taken = std::any_of(command.outputs.begin(), command.outputs.end(),
                                   [](const std::string& output) { return output == "-"; });
    const std::string text = flight_to_text(report);
    if (!taken) {
        std::fputs(text.c_str(), stdout);
        std::fflush(stdout);
    }
    if (command.report.empty()) return std::nullopt;
    return write_output(command.report,
                        ends_with(command.report, ".json") ? flight_to_json(report) : text);
}

// What the clock said to the flight.
void say_stopped(const FlyCommand& command, const FlightReport& report) {
    std::fprintf(stderr, "awan: stopped after %g s: %zu of %llu frames are done\n",
                 command.timeout_seconds, report.frames.size(),
                 static_cast<unsigned long long>(report.frames_asked));
}

}  // namespace

int run_fly(const FlyCommand& command) {
    const auto start = Clock::now();
    SceneDraft draft;
    FlightWish wish;
    if (const auto failure = read_scenes(command, draft))
        return report_error(failure->subject, failure->error);
    if (const auto failure = read_path(command.path, draft, wish))
        return report_error(failure->subject, failure->error);
    if (command.width) draft.image.width = *command.width;
    if (command.height) draft.image.height = *command.height;
    if (!command.mode.empty()) wish.thickness = word_at<Thickness>(command.mode, kThicknessWords);
    wish.frames = command.frames;
    wish.frames_per_second = command.frames_per_second;
    wish.rung = command.rung;

    const RenderCommand render = drawing(command);
    auto targets = targets_of(render, "png");
    if (!targets) return bad_usage(targets.error().message);
    // Animations and reports have no use for them.
    const auto is_exr = [](const Target& target) { return target.format == "exr"; };
    if (std::none_of(targets->begin(), targets->end(), is_exr)) draft.image.layers = "none";
    Work work(render, *std::move(targets));
    if (command.timeout_seconds > 0)
        work.deadline.until = start + std::chrono::duration_cast<Clock::duration>(
                                          std::chrono::duration<double>(command.timeout_seconds));
    const std::string& name = command.scenes.front();
    const bool own_keys = draft.sequence && !draft.sequence->camera.empty();
    const auto scene = flight_of(draft, wish, command.threads, work.deadline);
    if (!scene) return report_error(name, scene.error());
    const std::uint64_t frames = (*scene)->sequence->frames;
    if (const auto wrong = check_outputs(command, work.targets, frames)) return *wrong;
    for (const std::string& output : command.outputs)
        if (ends_with(output, ".json"))
            if (const Status failed = write_output(output, scene_to_json(**scene)))
                return report_error("", *failed);

    FlightReport report = begin_report(command, *scene, own_keys);
    work.flown = [&](const FlownFrame& frame) { report.frames.push_back(frame); };
    work.impostor_wish = {word_at<Impostors>(command.impostors, kImpostorsWords),
                          command.impostor_pixels};
    const auto all = parse_frames("all", frames);
    const auto made = render_frames(*scene, *all, work);
    work.progress.clear();
    const bool none_in_time = !made && made.error().code == ErrorCode::kOverDeadline;
    if (!made && !none_in_time) return report_error(name, made.error());
    if (work.impostors) report.impostors = work.impostors->report();
    report.timed_out = none_in_time || made->timed_out;
    report.settle_seconds = made ? made->settle_ms / 1000 : 0;
    report.seconds = ms_since(start) / 1000;
    report.renderer = work.device ? work.device->info().renderer : "processor";
    if (report.timed_out) say_stopped(command, report);
    if (const Status failed = write_report(command, report)) return report_error("", *failed);
    return none_in_time ? exit_code_of(ErrorCode::kOverDeadline) : kExitFine;
}

}  // namespace awan
