#include <algorithm>

#include "core/formats/awn.h"
#include "core/formats/particle_files.h"
#include "core/generate/generate.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
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

}  // namespace

int run_particles(const ParticlesCommand& command) {
    const auto format =
        output_format(command.output, command.format, {"json", "csv", "ply", "awn"}, "json");
    if (!format) return bad_usage(format.error().message);
    if (*format == "ply" && binary_to_terminal(command.output))
        return bad_usage("-o -: binary PLY is not written to a terminal");
    auto scene = read_valid_scene(command.scene, command.state);
    if (!scene) return report_error(command.scene, scene.error());
    if (*format == "awn") {
        auto layout = write_awn(**scene);
        if (!layout) return report_error(command.scene, layout.error());
        if (const Status failed = write_output(command.output, *layout))
            return report_error("", *failed);
        return kExitFine;
    }
    auto particles = generate(*scene, command.threads, Deadline{});
    if (!particles) return report_error(command.scene, particles.error());
    if (const Status failed = write_particles(command.output, *format, *particles, (*scene)->seed))
        return report_error("", *failed);
    return kExitFine;
}

int run_plan(const PlanCommand& command) {
    auto scene = read_valid_scene(command.scene, command.state);
    if (!scene) return report_error(command.scene, scene.error());
    auto planned = plan_only(*scene, command.threads, Deadline{}, measure_speed());
    if (!planned) return report_error(command.scene, planned.error());
    if (const Status failed =
            write_output(command.output, plan_to_json(planned->survey, planned->plan)))
        return report_error("", *failed);
    return kExitFine;
}

int run_convert(const ConvertCommand& command) {
    const auto format = output_format(command.output, command.format, {"json", "awn"}, "json");
    if (!format) return bad_usage(format.error().message);
    auto scene = read_valid_scene(command.input);
    if (!scene) return report_error(command.input, scene.error());
    std::string text;
    if (*format == "awn") {
        auto layout = write_awn(**scene);
        if (!layout) return report_error(command.input, layout.error());
        text = std::move(layout).value();
    } else {
        text = scene_to_json(**scene);
        if (!text.ends_with('\n')) text += '\n';
    }
    if (const Status failed = write_output(command.output, text)) return report_error("", *failed);
    return kExitFine;
}

}  // namespace awan
