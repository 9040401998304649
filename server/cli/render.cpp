// awan render: a scene to its picture, or its sequence to frames.
#include <algorithm>

#include "core/scene/layers.h"
#include "core/scene/validate.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/pictures.h"
#include "server/cli/support.h"
#include "server/cli/targets.h"

namespace awan {
namespace {

Status render_still(const Scene& scene, Work& work) {
    PictureResult result{
        work.command.scene.path, files_of_frame(work.targets, nullptr), {}, false, 0};
    if (work.command.skip_existing && all_finished(result.outputs)) {
        result.skipped = true;
        say_result(result, scene, nullptr, work);
        return std::nullopt;
    }
    work.progress.say("planning");
    auto planned = plan_scene(scene, work.command.threads, Deadline{}, work.speed, &work.tiles);
    if (planned && work.command.preview) planned = as_preview(scene, *std::move(planned));
    auto rendered = render_picture(scene, std::move(planned), work);
    if (!rendered) return rendered.error();
    work.progress.say("encoding");
    if (Status failed = write_picture(*rendered, scene, nullptr, work, result.encode_ms))
        return failed;
    say_result(result, scene, &*rendered, work);
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
    if (command.layers) image.layers = *command.layers;
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
    const auto holds_layers = [&](const Target& target) { return is_exr(target) && !target.sheet; };
    if (read_layers(draft->image.layers).value_or(Layers{}).any() &&
        std::none_of(targets->begin(), targets->end(), holds_layers))
        return bad_usage("layers (" + draft->image.layers +
                         ") are written to an .exr alone: give -o one, or --layers none");
    const auto is_standard = [](const Target& target) { return target.path == "-"; };
    const auto is_sheet = [](const Target& target) { return target.sheet; };
    if (command.flipbook && std::none_of(targets->begin(), targets->end(), is_sheet))
        return bad_usage("--flipbook: a sheet is a .png or an .exr");
    for (const Target& target : *targets)
        if (target.sheet && is_standard(target))
            return bad_usage("--flipbook: a sheet and its layout are two files; give -o a name");
    const auto is_png = [](const Target& target) { return target.format == "png"; };
    if (command.bits && std::none_of(targets->begin(), targets->end(), is_png))
        return bad_usage("--bits is of a .png");
    if (command.columns > 0 && !command.flipbook) return bad_usage("--columns is of --flipbook");
    if (command.json && std::any_of(targets->begin(), targets->end(), is_standard))
        return bad_usage("--json: standard output takes either the picture or the line");

    auto scene = validate(std::move(draft).value());
    if (!scene) return report_error(name, scene.error());
    if (command.preview) scene = for_preview(*scene);
    Work work(command, *std::move(targets));
    work.png_bits = bits;
    const bool animated = std::any_of(work.targets.begin(), work.targets.end(),
                                      [](const Target& t) { return t.animated(); });
    if (!animated && command.frames.empty()) {
        for (const Target& target : work.targets) {
            if (const Status wrong = check_not_numbered(target.path))
                return bad_usage(wrong->message);
            if (const Status failed = check_writable(target.path)) return report_error("", *failed);
        }
        if (const Status failed = render_still(*scene, work)) return report_error(name, *failed);
        if (const Status failed =
                write_dependencies(command.depfile, command.outputs, command.scene))
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
    const auto made = render_frames(*scene, *frames, work);
    if (!made) return report_error(name, made.error());
    if (const Status failed = write_dependencies(command.depfile, outputs, command.scene))
        return report_error("", *failed);
    return kExitFine;
}

}  // namespace awan
