// awan sky: the scene's sky all around, a map for image based lighting.
#include "core/draw/sky_map.h"

#include "core/formats/image_file.h"
#include "core/scene/validate.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/result_line.h"
#include "server/cli/support.h"

namespace awan {
int run_sky(const SkyCommand& command) {
    if (command.width % 2 != 0)
        return bad_usage("--width " + std::to_string(command.width) +
                         ": a map is twice as wide as it is high; give an even number");
    const auto format = output_format(command.output, command.format, {"exr", "png"}, "exr");
    if (!format) return bad_usage(format.error().message);
    if (binary_to_terminal(command.output))
        return bad_usage("-o -: an image is not written to a terminal");
    if (command.json && command.output == "-")
        return bad_usage("--json: standard output takes either the map or the line");
    if (const Status wrong = check_not_numbered(command.output)) return bad_usage(wrong->message);
    const bool skipped = command.skip_existing && is_finished(command.output);
    if (skipped && !command.json)
        return end_with(write_dependencies(command.depfile, {command.output}, command.scene));
    auto draft = read_scene_input(command.scene);
    if (!draft) return report_error(command.scene.path, draft.error());
    auto scene = validate(*std::move(draft));
    if (!scene) return report_error(command.scene.path, scene.error());
    FileResult result{command.scene.path, {command.output},  skipped,
                      command.width,      command.width / 2, {}};
    if (skipped) return end_with_line(result, *scene, command);
    if (const Status failed = check_writable(command.output)) return report_error("", *failed);
    const auto start = Deadline::Clock::now();
    const auto map = sky_map(*scene, command.width, command.threads, {});
    if (!map) return report_error(command.scene.path, map.error());
    result.times.emplace_back("draw", ms_since(start));
    set_exr_threads(command.threads);
    const auto encoding = Deadline::Clock::now();
    const auto bytes = *format == "exr"
                           ? encode_exr(*map, (*scene)->image.precision, sky_notes_of(*scene))
                           : encode_png(*map, film_of(*scene));
    if (!bytes) return report_error(command.scene.path, bytes.error());
    if (const Status failed = write_output(command.output, *bytes))
        return report_error("", *failed);
    result.times.emplace_back("encode", ms_since(encoding));
    return end_with_line(result, *scene, command);
}

}  // namespace awan
