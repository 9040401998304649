// awan impostor: a scene from many sides, on one atlas with its layout beside it.
#include "core/impostor.h"

#include "core/formats/atlas.h"
#include "core/formats/image_file.h"
#include "core/scene/validate.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/pictures.h"
#include "server/cli/result_line.h"
#include "server/cli/support.h"
#include "server/document/impostor_text.h"

namespace awan {
namespace {

// Draws every view in its place.
Result<Atlas> draw_views(const Impostor& impostor, Work& work) {
    Atlas atlas = begin_atlas(impostor.wish.views, impostor.wish.size);
    for (std::size_t i = 0; i < impostor.views.size(); ++i) {
        const Scene& scene = impostor.views[i].scene;
        work.prefix =
            "view " + std::to_string(i + 1) + " of " + std::to_string(impostor.views.size()) + ", ";
        auto planned =
            plan_scene(scene, work.command.threads, work.deadline, work.speed, &work.tiles);
        // The rung is settled, and nobody is told its error.
        if (planned) planned->is_unmeasured = true;
        auto rendered = render_picture(scene, std::move(planned), work);
        if (!rendered) return rendered.error();
        put_on_atlas(i, rendered->image, rendered->layers, atlas);
    }
    return atlas;
}

}  // namespace

int run_impostor(const ImpostorCommand& command) {
    const std::string& name = command.scene.path;
    const auto format = output_format(command.output, command.format, {"png", "exr"}, "png");
    if (!format) return bad_usage(format.error().message);
    if (command.output == "-")
        return bad_usage("an atlas and its layout are two files; give -o a name");
    if (const Status wrong = check_not_numbered(command.output)) return bad_usage(wrong->message);
    const std::string layout = layout_path(command.output);
    const bool skipped =
        command.skip_existing && is_finished(command.output) && is_finished(layout);
    if (skipped && !command.json)
        return end_with(
            write_dependencies(command.depfile, {command.output, layout}, command.scene));
    for (const std::string& file : {command.output, layout})
        if (const Status failed = check_writable(file)) return report_error("", *failed);
    auto draft = read_scene_input(command.scene);
    if (!draft) return report_error(name, draft.error());
    const auto scene = validate(*std::move(draft));
    if (!scene) return report_error(name, scene.error());
    const int side = command.wish.views * command.wish.size;
    FileResult result{name, {command.output, layout}, skipped, side, side, {}};
    if (skipped) return end_with_line(result, *scene, command);
    const bool exr = *format == "exr";
    const auto impostor = impostor_of(*scene, command.wish, exr, command.threads, Deadline{});
    if (!impostor) return report_error(name, impostor.error());

    RenderCommand render;
    render.scene = command.scene;
    render.threads = command.threads;
    render.device = command.device;
    Work work(render, {});
    work.lights.emplace(kLightCacheBytes);
    const auto start = Deadline::Clock::now();
    const auto atlas = draw_views(*impostor, work);
    work.progress.clear();
    if (!atlas) return report_error(name, atlas.error());
    result.times.emplace_back("draw", ms_since(start));
    const auto encoding = Deadline::Clock::now();
    const auto bytes = encode_atlas(*atlas, *scene, exr, Deadline{});
    if (!bytes) return report_error(name, bytes.error());
    if (const Status failed = write_output(command.output, *bytes))
        return report_error("", *failed);
    const std::string file = command.output.substr(command.output.rfind('/') + 1);
    if (const Status failed =
            write_output(layout, impostor_to_json(*impostor, file, exr && !atlas->depth.empty())))
        return report_error("", *failed);
    result.times.emplace_back("encode", ms_since(encoding));
    return end_with_line(result, *scene, command);
}

}  // namespace awan
