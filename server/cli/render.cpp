// awan render: one picture, numbered pictures of a sequence, or an animation of it.
#include <array>
#include <cmath>
#include <cstdio>

#include "core/formats/animation.h"
#include "core/formats/image_file.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "core/sequence.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/support.h"
#include "server/service/problem.h"

namespace awan {
namespace {

// What the renders of one command share.
struct Work {
    explicit Work(const RenderCommand& c) : command(c) {}

    const RenderCommand& command;
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

double exposure_of(const Scene& scene) {
    return scene->image.exposure.value_or(auto_exposure(scene));
}

Result<std::string> encode(const Rendered& rendered, const Scene& scene) {
    if (scene->image.format == ImageFormat::kExr)
        return encode_exr(rendered.image, scene->image.precision, notes_of(rendered));
    return encode_png(rendered.image, exposure_of(scene));
}

std::string percent(double share) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g%%", 100 * share);
    return text.data();
}

// Which rung it was, how far off it is, and what was expected; nothing where the picture itself goes to standard
// output.
void say_error(const Rendered& rendered, const std::string& output) {
    if (output == "-") return;
    if (!std::isfinite(rendered.stated_error)) {
        // A look has no error.
        if (!std::isfinite(rendered.plan.predicted.error)) return;
        std::printf("%s: %s, error not measured, the time is too short (expected %s)\n",
                    output.c_str(), rendered.plan.rung.c_str(),
                    percent(rendered.plan.predicted.error).c_str());
        return;
    }
    std::printf("%s: %s, error %s (expected %s)\n", output.c_str(), rendered.plan.rung.c_str(),
                percent(rendered.stated_error).c_str(),
                percent(rendered.plan.predicted.error).c_str());
}

Status render_still(const Scene& scene, Work& work) {
    work.progress.say("planning");
    auto rendered = render_frame(
        scene, plan_scene(scene, work.command.threads, Deadline{}, work.speed, &work.tiles), work);
    if (!rendered) return rendered.error();
    work.progress.say("encoding");
    const auto bytes = encode(*rendered, scene);
    if (!bytes) return bytes.error();
    if (Status failed = write_output(work.command.output, *bytes)) return failed;
    work.progress.clear();
    say_error(*rendered, work.command.output);
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

// Frames as files of their own, or as one animation.
Status render_frames(const Scene& scene, const std::vector<std::uint64_t>& frames,
                     const std::string& format, Work& work) {
    work.progress.say("settling the sequence");
    auto settled = settle(scene, Settling::kMeasured, {nullptr, work.command.threads}, Deadline{});
    if (!settled) return settled.error();
    std::optional<Animation> animation;
    if (format == "webp" || format == "apng") {
        auto begun =
            Animation::begin(format == "webp" ? AnimationFormat::kWebp : AnimationFormat::kApng,
                             work.command.frames_per_second, frames.size());
        if (!begun) return begun.error();
        animation.emplace(*std::move(begun));
    }
    const Sequence& sequence = *scene->sequence;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        work.prefix =
            "frame " + std::to_string(i + 1) + " of " + std::to_string(frames.size()) + ", ";
        work.progress.say(work.prefix + "planning");
        Scene still = scene;
        auto rendered = render_of(*settled, frame_time(sequence, frames[i]), work, still);
        if (!rendered) return rendered.error();
        if (animation) {
            if (Status failed = animation->add(rendered->image, exposure_of(still))) return failed;
            continue;
        }
        auto bytes = encode(*rendered, still);
        if (!bytes) return bytes.error();
        if (Status failed = write_output(numbered_name(work.command.output, frames[i]), *bytes))
            return failed;
    }
    if (!animation) return std::nullopt;
    work.progress.say("encoding");
    auto bytes = animation->end();
    if (!bytes) return bytes.error();
    return write_output(work.command.output, *bytes);
}

}  // namespace

int run_render(const RenderCommand& command) {
    auto draft = read_scene_file(command.scene);
    if (!draft) return report_error(command.scene, draft.error());
    if (const Status wrong = begin_with_state(command.state, *draft))
        return report_error(command.scene, *wrong);
    ImageSettings& image = draft->image;
    if (command.width) image.width = *command.width;
    if (command.height) image.height = *command.height;
    if (command.rung || command.error || command.time_ms)
        draft->accuracy = {command.error, command.time_ms, command.rung};
    if (command.background == "sky") image.background = Background::kSky;
    if (command.background == "transparent") image.background = Background::kTransparent;
    if (command.time) draft->time = *command.time;
    const auto format =
        output_format(command.output, command.format, {"png", "exr", "webp", "apng"},
                      image.format == ImageFormat::kExr ? "exr" : "png");
    if (!format) return bad_usage(format.error().message);
    if (binary_to_terminal(command.output))
        return bad_usage("-o -: an image is not written to a terminal");
    image.format = *format == "exr" ? ImageFormat::kExr : ImageFormat::kPng;

    auto scene = validate(std::move(draft).value());
    if (!scene) return report_error(command.scene, scene.error());
    const bool animated = *format == "webp" || *format == "apng";
    Work work(command);
    if (!animated && command.frames.empty()) {
        if (const Status failed = render_still(*scene, work))
            return report_error(command.scene, *failed);
        return kExitFine;
    }
    if (!(*scene)->sequence)
        return bad_usage(std::string(animated ? "an animation" : "--frames") +
                         " needs a scene with a `sequence`, and " + command.scene + " has none");
    const auto frames = parse_frames(command.frames, (*scene)->sequence->frames);
    if (!frames) return bad_usage(frames.error().message);
    if (!animated)
        if (const Status wrong = check_numbered(command.output, frames->size()))
            return bad_usage(wrong->message);
    if (const Status failed = check_writable(numbered_name(command.output, frames->front())))
        return report_error("", *failed);
    if (const Status failed = render_frames(*scene, *frames, *format, work))
        return report_error(command.scene, *failed);
    return kExitFine;
}

}  // namespace awan
