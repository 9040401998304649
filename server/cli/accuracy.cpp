// awan accuracy: what accuracy costs, of one scene or several.
#include <algorithm>
#include <optional>

#include "core/accuracy/plot.h"
#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/support.h"
#include "server/document/accuracy_text.h"

namespace awan {
namespace {

// "clouds/congestus.json" is congestus.
std::string name_of_scene(const std::string& path) {
    if (path == "-") return {};
    const std::size_t slash = path.rfind('/');
    std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

AccuracyOptions options_of(const AccuracyCommand& command) {
    AccuracyOptions options;
    options.threads = command.threads;
    options.runs = command.runs;
    options.reference_side = command.side;
    options.samples = command.samples;
    options.rungs = command.rungs;
    options.time_ms = 1000 * command.within_seconds;
    return options;
}

Result<std::string> written(const std::string& format, const std::vector<NamedAccuracy>& reports,
                            const AccuracyCommand& command) {
    if (format == "json") return accuracy_to_json(reports);
    if (format == "csv") return accuracy_to_csv(reports);
    std::vector<AccuracyPlot> plots;
    for (const NamedAccuracy& named : reports) plots.push_back({named.name, &named.report});
    return plot_accuracy(plots, command.theme == "dark" ? PlotTheme::kDark : PlotTheme::kLight,
                         command.scale);
}

// One sweep a scene, with one renderer.
Result<std::vector<NamedAccuracy>> measured(const std::vector<Scene>& scenes,
                                            const AccuracyCommand& command, std::string& subject) {
    ProgressLine line;
    const MachineSpeed speed = measure_speed();
    // Opened when the first rung needs it.
    std::optional<Device> device;
    const RenderScene render = [&](const Scene& scene,
                                   const Deadline& deadline) -> Result<Rendered> {
        auto planned = plan_scene(scene, command.threads, deadline, speed);
        if (!planned) return planned.error();
        if (const Status failed = open_for(planned->plan, command.device, device)) return *failed;
        const Tools tools{device ? &*device : nullptr, command.threads, nullptr, {}, speed};
        return render_planned(scene, *std::move(planned), tools, deadline);
    };
    std::vector<NamedAccuracy> reports;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        subject = command.scenes[i];
        const std::string name = name_of_scene(subject);
        AccuracyOptions options = options_of(command);
        options.speed = speed;
        options.on_step = [&](const std::string& step) {
            line.say(name.empty() ? step : name + ": " + step);
        };
        const auto progress = [&](double share) {
            line.done((static_cast<double>(i) + share) / static_cast<double>(scenes.size()));
        };
        auto report = measure_accuracy(scenes[i], options, render, progress, Deadline{});
        if (!report) return report.error();
        reports.push_back({name, *std::move(report)});
    }
    return reports;
}

}  // namespace

int run_accuracy(const AccuracyCommand& command) {
    // All that can be wrong is said before minutes are spent.
    std::vector<std::string> formats;
    for (const std::string& output : command.outputs) {
        const auto format = output_format(output, command.format, {"json", "csv", "png"}, "json");
        if (!format) return bad_usage(format.error().message);
        if (const Status wrong = check_not_numbered(output)) return bad_usage(wrong->message);
        if (*format == "png" && binary_to_terminal(output))
            return bad_usage("-o -: a plot is not written to a terminal");
        if (std::count(command.outputs.begin(), command.outputs.end(), output) > 1)
            return bad_usage("-o " + output + " is given twice");
        formats.push_back(*format);
    }
    if (std::count(command.scenes.begin(), command.scenes.end(), "-") > 1)
        return bad_usage("only one scene comes from standard input");
    std::vector<Scene> scenes;
    for (const std::string& path : command.scenes) {
        SceneInput input = command.input;
        input.path = path;
        auto scene = read_valid_scene(input);
        if (!scene) return report_error(path, scene.error());
        scenes.push_back(*std::move(scene));
    }
    for (const std::string& output : command.outputs)
        if (const Status failed = check_writable(output)) return report_error("", *failed);

    std::string subject;
    const auto reports = measured(scenes, command, subject);
    if (!reports) return report_error(subject, reports.error());
    for (std::size_t i = 0; i < formats.size(); ++i) {
        const auto bytes = written(formats[i], *reports, command);
        if (!bytes) return report_error("", bytes.error());
        if (const Status failed = write_output(command.outputs[i], *bytes))
            return report_error("", *failed);
    }
    return kExitFine;
}

}  // namespace awan
