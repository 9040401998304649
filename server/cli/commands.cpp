#include <algorithm>

#include "core/formats/awa.h"
#include "core/formats/awn.h"
#include "core/formats/flightgear.h"
#include "core/formats/particle_files.h"
#include "core/formats/vdb_file.h"
#include "core/generate/generate.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "core/sequence.h"
#include "core/survey/volume.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/lit_volume.h"
#include "server/cli/support.h"
#include "server/document/json.h"
#include "server/service/problem.h"

namespace awan {
namespace {

constexpr std::size_t kPiece = limits::kParticlesPerPiece;

Status write_particles(const std::string& path, const std::string& format,
                       const ParticleSet& particles, std::uint64_t seed) {
    auto file = OutputFile::open(path);
    if (!file) return file.error();
    std::string piece;
    if (format == "json") piece = particles_json_head(particles, seed);
    if (format == "csv") append_csv_header(piece);
    if (format == "ply") append_ply_header(particles, piece);
    for (std::size_t first = 0; first < particles.size(); first += kPiece) {
        const std::size_t last = std::min(first + kPiece, particles.size());
        if (format == "json") append_particles_json(particles, first, last, piece);
        if (format == "csv") append_csv(particles, first, last, piece);
        if (format == "ply") append_ply(particles, first, last, piece);
        if (const Status failed = file->write(piece)) return failed;
        piece.clear();
    }
    if (format == "json") piece += particles_json_tail();
    if (const Status failed = file->write(piece)) return failed;
    return file->commit();
}

// Cell updates of a volume: some ten seconds.
constexpr double kVolumeWork = 1e10;

// The particles of one scene to one file, as points or as the volume that they make.
Status particles_to(const std::string& path, const std::string& format, const Scene& scene,
                    const ParticlesCommand& command) {
    if (format == "awn" || format == "awa") {
        auto layout = format == "awn" ? write_awn(*scene) : write_awa(*scene);
        if (!layout) return layout.error();
        return write_output(path, *layout);
    }
    if (command.light) {
        auto bytes = encode_lit_vdb(scene, command.voxels, kVolumeWork, command.threads);
        if (!bytes) return bytes.error();
        return write_output(path, *bytes);
    }
    auto particles = generate(scene, command.threads, Deadline{});
    if (!particles) return particles.error();
    if (format == "glb" || format == "vdb" || format == "xml") {
        auto bytes = format == "glb" ? write_glb(*particles)
                     : format == "xml"
                         ? write_flightgear(scene, *particles, command.unit)
                         : encode_vdb(density_volume(*particles, command.voxels, kVolumeWork));
        if (!bytes) return bytes.error();
        return write_output(path, *bytes);
    }
    return write_particles(path, format, *particles, scene->seed);
}

// Seconds and the file of each set of particles that is asked for. The error is of bad usage.
struct Moment {
    std::optional<double> time;
    std::string path;
};
Result<std::vector<Moment>> moments_of(const ParticlesCommand& command, const SceneDraft& draft) {
    if (command.frames.empty()) {
        if (Status wrong = check_not_numbered(command.output)) return *wrong;
        return std::vector<Moment>{{command.time, command.output}};
    }
    const auto unusable = [](std::string what) {
        return Error{ErrorCode::kInvalidScene, "", std::move(what)};
    };
    if (command.time) return unusable("--time and --frames exclude each other");
    if (!draft.sequence)
        return unusable("--frames needs a scene with a `sequence`, and " + command.scene.path +
                        " has none");
    const auto frames = parse_frames(command.frames, draft.sequence->frames);
    if (!frames) return frames.error();
    if (Status wrong = check_numbered(command.output, frames->size())) return *wrong;
    std::vector<Moment> moments;
    for (const std::uint64_t frame : *frames)
        moments.push_back(
            {frame_time(*draft.sequence, frame), numbered_name(command.output, frame)});
    return moments;
}

}  // namespace

int run_particles(const ParticlesCommand& command) {
    const auto format =
        output_format(command.output, command.format,
                      {"json", "csv", "ply", "awn", "awa", "glb", "vdb", "xml"}, "json");
    if (!format) return bad_usage(format.error().message);
    if (command.light && *format != "vdb") return bad_usage("--light is of a .vdb");
    const bool binary = *format == "ply" || *format == "glb" || *format == "vdb";
    if (binary && binary_to_terminal(command.output))
        return bad_usage("-o -: " + *format + " is not written to a terminal");
    auto draft = read_scene_input(command.scene);
    if (!draft) return report_error(command.scene.path, draft.error());
    // A sequence counts its frames; whether it can be is asked first.
    if (auto scene = validate(*draft); !scene)
        return report_error(command.scene.path, scene.error());
    const auto moments = moments_of(command, *draft);
    if (!moments) return bad_usage(moments.error().message);
    std::vector<std::string> outputs;
    for (const Moment& moment : *moments) {
        outputs.push_back(moment.path);
        if (command.skip_existing && is_finished(moment.path)) continue;
        if (moment.time) draft->time = *moment.time;
        auto scene = validate(*draft);
        if (!scene) return report_error(command.scene.path, scene.error());
        if (const Status failed = particles_to(moment.path, *format, *scene, command))
            return report_error(failed->code == ErrorCode::kIo ? "" : command.scene.path, *failed);
    }
    if (const Status failed = write_dependencies(command.depfile, outputs, command.scene))
        return report_error("", *failed);
    return kExitFine;
}

int run_plan(const PlanCommand& command) {
    if (const Status wrong = check_not_numbered(command.output)) return bad_usage(wrong->message);
    if (command.skip_existing && is_finished(command.output))
        return end_with(write_dependencies(command.depfile, {command.output}, command.scene));
    auto scene = read_valid_scene(command.scene);
    if (!scene) return report_error(command.scene.path, scene.error());
    auto planned = plan_only(*scene, command.threads, Deadline{}, measure_speed());
    if (!planned) return report_error(command.scene.path, planned.error());
    if (const Status failed =
            write_output(command.output, plan_to_json(planned->survey, planned->plan)))
        return report_error("", *failed);
    return end_with(write_dependencies(command.depfile, {command.output}, command.scene));
}

int run_convert(const ConvertCommand& command) {
    const auto format =
        output_format(command.output, command.format, {"json", "awn", "awa"}, "json");
    if (!format) return bad_usage(format.error().message);
    if (const Status wrong = check_not_numbered(command.output)) return bad_usage(wrong->message);
    if (command.skip_existing && is_finished(command.output))
        return end_with(write_dependencies(command.depfile, {command.output}, command.input));
    auto scene = read_valid_scene(command.input);
    if (!scene) return report_error(command.input.path, scene.error());
    std::string text;
    if (*format == "awn" || *format == "awa") {
        auto layout = *format == "awn" ? write_awn(**scene) : write_awa(**scene);
        if (!layout) return report_error(command.input.path, layout.error());
        text = std::move(layout).value();
    } else {
        text = scene_to_json(**scene);
        if (!text.ends_with('\n')) text += '\n';
    }
    if (const Status failed = write_output(command.output, text)) return report_error("", *failed);
    return end_with(write_dependencies(command.depfile, {command.output}, command.input));
}

}  // namespace awan
