// awan render: one picture, numbered pictures of a sequence, or an animation of it; each in one file or several.
#include <algorithm>
#include <cstdio>

#include "core/formats/animation.h"
#include "core/formats/image_file.h"
#include "core/formats/sheet.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "core/sequence.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/result_line.h"
#include "server/cli/support.h"
#include "server/cli/targets.h"
#include "server/document/sheet_text.h"
#include "server/service/problem.h"

namespace awan {
namespace {

// What the renders of one command share.
struct Work {
    Work(const RenderCommand& c, std::vector<Target> t, int bits)
        : command(c), targets(std::move(t)), png_bits(bits) {}

    const RenderCommand& command;
    const std::vector<Target> targets;
    // A channel.
    const int png_bits;
    MachineSpeed speed = measure_speed();
    std::optional<Device> device;
    ProgressLine progress;
    DetailTiles tiles;
    // Put before what is said, e.g. "frame 3 of 12, ".
    std::string prefix;
};

Result<Rendered> render_frame(const Scene& scene, Result<Planned> planned, Work& work) {
    if (!planned) return planned.error();
    if (const Status failed = open_for(planned->plan, work.command.device, work.device))
        return *failed;
    work.progress.say(work.prefix + "rendering, rung " + planned->plan.rung);
    const Tools tools{work.device ? &*work.device : nullptr, work.command.threads, nullptr,
                      [&](double share) { work.progress.done(share); }, work.speed};
    return render_planned(scene, *std::move(planned), tools, Deadline{});
}

// Pixels of an EXR that take one thread longer than others take to begin.
constexpr std::size_t kLargePicture = 1u << 18;

Result<std::string> encode(const Rendered& rendered, const Scene& scene, const std::string& format,
                           int bits, int threads) {
    if (format == "exr") {
        if (rendered.image.pixel_count() >= kLargePicture) set_exr_threads(threads);
        return encode_exr(rendered.image, scene->image.precision, notes_of(rendered));
    }
    return encode_png(rendered.image, film_of(scene), bits);
}

// Writes the picture to every file that is not an animation. frame: none for a scene that stands still.
Status write_picture(const Rendered& rendered, const Scene& scene, const std::uint64_t* frame,
                     Work& work, double& encode_ms) {
    const auto start = Deadline::Clock::now();
    for (const Target& target : work.targets) {
        if (target.animated()) continue;
        const auto bytes =
            encode(rendered, scene, target.format, work.png_bits, work.command.threads);
        if (!bytes) return bytes.error();
        const std::string path =
            frame == nullptr ? target.path : numbered_name(target.path, *frame);
        if (Status failed = write_output(path, *bytes)) return failed;
    }
    encode_ms = ms_since(start);
    return std::nullopt;
}

// Says what came of a picture; nothing where the picture itself goes to standard output.
void say_result(const PictureResult& result, const Scene& scene, const Rendered* rendered,
                Work& work) {
    const bool taken = std::any_of(work.targets.begin(), work.targets.end(),
                                   [](const Target& target) { return target.path == "-"; });
    if (taken) return;
    work.progress.clear();
    std::string text;
    if (work.command.json) {
        text = result_json(result, scene, rendered);
    } else if (result.skipped) {
        for (const std::string& file : result.outputs) text += file + ": is there already\n";
    } else if (rendered != nullptr && !result.frame) {
        for (const std::string& file : result.outputs) text += result_text(file, *rendered);
    }
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

bool all_finished(const std::vector<std::string>& files) {
    return std::all_of(files.begin(), files.end(), is_finished);
}

Status render_still(const Scene& scene, Work& work) {
    PictureResult result{
        work.command.scene.path, files_of_frame(work.targets, nullptr), {}, false, 0};
    if (work.command.skip_existing && all_finished(result.outputs)) {
        result.skipped = true;
        say_result(result, scene, nullptr, work);
        return std::nullopt;
    }
    work.progress.say("planning");
    auto rendered = render_frame(
        scene, plan_scene(scene, work.command.threads, Deadline{}, work.speed, &work.tiles), work);
    if (!rendered) return rendered.error();
    work.progress.say("encoding");
    if (Status failed = write_picture(*rendered, scene, nullptr, work, result.encode_ms))
        return failed;
    say_result(result, scene, &*rendered, work);
    return std::nullopt;
}

Result<Rendered> render_of(const Settled& settled, double time, Work& work, Scene& scene) {
    Frame frame = frame_at(settled, time);
    auto planned = with_detail_made(frame.scene,
                                    plan_frame(frame, work.command.threads, Deadline{}, work.speed),
                                    work.command.threads, &work.tiles);
    scene = std::move(frame.scene);
    return render_frame(scene, std::move(planned), work);
}

// What holds every frame and is being made, and where it goes: an animation, or a sheet.
struct MovingPicture {
    const Target* target;
    std::optional<Animation> animation;
    SheetLayout layout;
    Image sheet;
    std::uint64_t frames = 0;

    Status add(const Image& picture, const FilmSettings& film) {
        if (animation) return animation->add(picture, film);
        if (frames == 0) sheet = begin_sheet(layout, picture.opaque);
        put_on_sheet(layout, frames++, picture, sheet);
        return std::nullopt;
    }
};

// The file of a sheet's layout: clouds.png has clouds.json beside it.
std::string layout_path(const std::string& sheet) {
    return sheet.substr(0, sheet.rfind('.')) + ".json";
}

Status write_sheet(const MovingPicture& picture, const std::vector<std::uint64_t>& frames,
                   const Scene& scene, const Work& work) {
    const std::string& path = picture.target->path;
    auto bytes = picture.target->format == "exr"
                     ? encode_exr(picture.sheet, scene->image.precision)
                     : encode_png(picture.sheet, film_of(scene), work.png_bits);
    if (!bytes) return bytes.error();
    if (Status failed = write_output(path, *bytes)) return failed;
    std::vector<double> times;
    for (const std::uint64_t frame : frames) times.push_back(frame_time(*scene->sequence, frame));
    return write_output(layout_path(path),
                        sheet_to_json(picture.layout, path.substr(path.rfind('/') + 1), frames,
                                      times, work.command.frames_per_second));
}

Result<std::vector<MovingPicture>> begin_moving(const Scene& scene, const Work& work,
                                                std::size_t frames) {
    std::vector<MovingPicture> moving;
    for (const Target& target : work.targets) {
        if (!target.animated()) continue;
        if (target.sheet) {
            const auto layout =
                sheet_layout(frames, scene->image.width, scene->image.height, work.command.columns);
            if (!layout) return layout.error();
            moving.push_back({&target, std::nullopt, *layout, {}});
            continue;
        }
        auto begun = Animation::begin(
            target.format == "webp" ? AnimationFormat::kWebp : AnimationFormat::kApng,
            work.command.frames_per_second, frames);
        if (!begun) return begun.error();
        moving.push_back({&target, *std::move(begun), {}, {}});
    }
    return moving;
}

// The frames that are to be made: all, or those of which a file is missing.
std::vector<std::uint64_t> missing_frames(const Scene& scene,
                                          const std::vector<std::uint64_t>& frames, Work& work) {
    std::vector<std::uint64_t> missing;
    for (const std::uint64_t frame : frames) {
        PictureResult result{work.command.scene.path, files_of_frame(work.targets, &frame), frame,
                             true, 0};
        if (all_finished(result.outputs))
            say_result(result, scene, nullptr, work);
        else
            missing.push_back(frame);
    }
    return missing;
}

// Frames as files of their own, or as animations.
Status render_frames(const Scene& scene, std::vector<std::uint64_t> frames, Work& work) {
    auto moving = begin_moving(scene, work, frames.size());
    if (!moving) return moving.error();
    if (work.command.skip_existing) {
        // An animation holds every frame.
        if (moving->empty()) frames = missing_frames(scene, frames, work);
        if (frames.empty()) return std::nullopt;
    }
    work.progress.say("settling the sequence");
    auto settled = settle(scene, Settling::kMeasured, {nullptr, work.command.threads}, Deadline{});
    if (!settled) return settled.error();
    const Sequence& sequence = *scene->sequence;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        work.prefix =
            "frame " + std::to_string(i + 1) + " of " + std::to_string(frames.size()) + ", ";
        work.progress.say(work.prefix + "planning");
        Scene still = scene;
        auto rendered = render_of(*settled, frame_time(sequence, frames[i]), work, still);
        if (!rendered) return rendered.error();
        for (MovingPicture& picture : *moving)
            if (Status failed = picture.add(rendered->image, film_of(still))) return failed;
        PictureResult result{work.command.scene.path, files_of_frame(work.targets, &frames[i]),
                             frames[i], false, 0};
        if (Status failed = write_picture(*rendered, still, &frames[i], work, result.encode_ms))
            return failed;
        say_result(result, still, &*rendered, work);
    }
    work.progress.say("encoding");
    for (MovingPicture& picture : *moving) {
        if (!picture.animation) {
            if (Status failed = write_sheet(picture, frames, scene, work)) return failed;
            continue;
        }
        auto bytes = picture.animation->end();
        if (!bytes) return bytes.error();
        if (Status failed = write_output(picture.target->path, *bytes)) return failed;
    }
    return std::nullopt;
}

// What the flags put in place of what the document says.
void apply_flags(const RenderCommand& command, SceneDraft& draft) {
    ImageSettings& image = draft.image;
    if (command.width) image.width = *command.width;
    if (command.height) image.height = *command.height;
    if (command.rung || command.error || command.time_ms)
        draft.accuracy = {command.error, command.time_ms, command.rung};
    if (command.background == "sky") image.background = Background::kSky;
    if (command.background == "transparent") image.background = Background::kTransparent;
    if (command.time) draft.time = *command.time;
}

// A channel of PNG: as the flags say, else as the document does.
int png_bits_of(const RenderCommand& command, ImageFormat format) {
    if (command.bits) return *command.bits;
    if (!command.format.empty()) return command.format == "png16" ? 16 : 8;
    return format == ImageFormat::kPng16 ? 16 : 8;
}

// The frames that are asked for, once it is sure that each has a name. The error is of bad usage.
Result<std::vector<std::uint64_t>> frames_of(const Scene& scene, const Work& work) {
    auto frames = parse_frames(work.command.frames, scene->sequence->frames);
    if (!frames) return frames.error();
    for (const Target& target : work.targets) {
        const Status wrong = target.animated() ? check_not_numbered(target.path)
                                               : check_numbered(target.path, frames->size());
        if (wrong) return *wrong;
    }
    return frames;
}

Status write_dependencies(const RenderCommand& command, const std::vector<std::string>& outputs) {
    if (command.depfile.empty()) return std::nullopt;
    return write_depfile(command.depfile, outputs, files_of(command.scene));
}

}  // namespace

int run_render(const RenderCommand& command) {
    const std::string& name = command.scene.path;
    auto draft = read_scene_input(command.scene);
    if (!draft) return report_error(name, draft.error());
    apply_flags(command, *draft);
    auto targets = targets_of(command, draft->image.format == ImageFormat::kExr ? "exr" : "png");
    if (!targets) return bad_usage(targets.error().message);
    const auto is_exr = [](const Target& target) { return target.format == "exr"; };
    const int bits = png_bits_of(command, draft->image.format);
    draft->image.format = std::any_of(targets->begin(), targets->end(), is_exr) ? ImageFormat::kExr
                          : bits == 16 ? ImageFormat::kPng16
                                       : ImageFormat::kPng;
    const auto is_standard = [](const Target& target) { return target.path == "-"; };
    const auto is_sheet = [](const Target& target) { return target.sheet; };
    if (command.flipbook && std::none_of(targets->begin(), targets->end(), is_sheet))
        return bad_usage("--flipbook: a sheet is a .png or an .exr");
    for (const Target& target : *targets)
        if (target.sheet && is_standard(target))
            return bad_usage("--flipbook: a sheet and its layout are two files; give -o a name");
    if (command.columns > 0 && !command.flipbook) return bad_usage("--columns is of --flipbook");
    if (command.json && std::any_of(targets->begin(), targets->end(), is_standard))
        return bad_usage("--json: standard output takes either the picture or the line");

    auto scene = validate(std::move(draft).value());
    if (!scene) return report_error(name, scene.error());
    Work work(command, *std::move(targets), bits);
    const bool animated = std::any_of(work.targets.begin(), work.targets.end(),
                                      [](const Target& t) { return t.animated(); });
    if (!animated && command.frames.empty()) {
        for (const Target& target : work.targets) {
            if (const Status wrong = check_not_numbered(target.path))
                return bad_usage(wrong->message);
            if (const Status failed = check_writable(target.path)) return report_error("", *failed);
        }
        if (const Status failed = render_still(*scene, work)) return report_error(name, *failed);
        if (const Status failed = write_dependencies(command, command.outputs))
            return report_error("", *failed);
        return kExitFine;
    }
    if (!(*scene)->sequence)
        return bad_usage(std::string(command.flipbook ? "--flipbook"
                                     : animated       ? "an animation"
                                                      : "--frames") +
                         " needs a scene with a `sequence`, and " + name + " has none");
    const auto frames = frames_of(*scene, work);
    if (!frames) return bad_usage(frames.error().message);
    std::vector<std::string> outputs;
    for (const Target& target : work.targets) {
        if (const Status failed = check_writable(numbered_name(target.path, frames->front())))
            return report_error("", *failed);
        if (target.animated()) outputs.push_back(target.path);
        if (target.sheet) outputs.push_back(layout_path(target.path));
    }
    for (const std::uint64_t frame : *frames)
        for (std::string& file : files_of_frame(work.targets, &frame))
            outputs.push_back(std::move(file));
    if (const Status failed = render_frames(*scene, *frames, work))
        return report_error(name, *failed);
    if (const Status failed = write_dependencies(command, outputs))
        return report_error("", *failed);
    return kExitFine;
}

}  // namespace awan
