// awan bench: the figures of time that the source documents print, and this machine's beside them.
#include <algorithm>
#include <array>
#include <cstdio>

#include "core/accuracy/ratio_plot.h"
#include "server/cli/cli.h"
#include "server/cli/files.h"
#include "server/cli/frames.h"
#include "server/cli/source_figures.h"
#include "server/cli/support.h"
#include "server/document/json_text.h"

namespace awan {
namespace {

constexpr const char* kUnits[] = {"ms", "frames/s"};

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(),
                  value < 1    ? "%.2f"
                  : value < 10 ? "%.1f"
                               : "%.0f",
                  value);
    return text.data();
}

std::string with_unit(double value, BenchUnit unit) {
    return number(value) + " " + kUnits[static_cast<int>(unit)];
}

std::string ratio(const BenchFigure& figure) {
    const auto times = figure.times_as_fast();
    return times ? number(*times) + "x" : "";
}

void print_head(BenchSource source) {
    const BenchDocument& document = document_of(source);
    std::printf("\n%s\n  there: %s\n  %-58s %14s %14s %8s\n", document.title, document.machine, "",
                "there", "here", "");
}

void print_figure(const BenchFigure& figure) {
    const std::string what =
        figure.place.empty() ? figure.what : figure.what + " (" + figure.place + ")";
    std::printf("  %-58s %14s %14s %8s\n", what.c_str(),
                figure.theirs ? with_unit(*figure.theirs, figure.unit).c_str() : "",
                with_unit(figure.ours, figure.unit).c_str(), ratio(figure).c_str());
    std::fflush(stdout);
}

std::string figures_json(const std::vector<BenchFigure>& figures, const std::string& renderer,
                         const BenchCommand& command) {
    using json_text::member;
    std::string out = "{";
    member("version", std::string_view(engine_version()), out);
    member("threads", command.threads, out);
    if (!renderer.empty()) member("renderer", std::string_view(renderer), out);
    json_text::name("figures", out);
    out += '[';
    for (const BenchFigure& figure : figures) {
        if (out.back() != '[') out += ',';
        out += '{';
        member("source", std::string_view(kBenchSourceWords[static_cast<int>(figure.source)]), out);
        member("title", std::string_view(document_of(figure.source).title), out);
        member("place", std::string_view(figure.place), out);
        member("what", std::string_view(figure.what), out);
        member("unit", std::string_view(kUnits[static_cast<int>(figure.unit)]), out);
        if (figure.theirs) member("there", *figure.theirs, out);
        member("here", figure.ours, out);
        if (const auto times = figure.times_as_fast()) member("times_as_fast", *times, out);
        out += '}';
    }
    return out + "]}\n";
}

Result<std::string> figures_plot(const std::vector<BenchFigure>& figures,
                                 const std::string& renderer, const BenchCommand& command) {
    std::vector<RatioRow> rows;
    for (const BenchFigure& figure : figures) {
        const auto times = figure.times_as_fast();
        if (!times) continue;
        rows.push_back(
            {document_of(figure.source).title, figure.what,
             with_unit(*figure.theirs, figure.unit) + " / " + with_unit(figure.ours, figure.unit),
             *times});
    }
    return plot_ratios("The sources' figures, and this machine's",
                       "There / here, by " + std::to_string(command.threads) +
                           (command.threads == 1 ? " thread" : " threads") +
                           (renderer.empty() ? "" : ", splats by " + renderer) +
                           ". Orange: slower than there.",
                       rows, command.theme == "dark" ? PlotTheme::kDark : PlotTheme::kLight);
}

}  // namespace

int run_bench(const BenchCommand& command) {
    std::vector<std::string> formats;
    bool to_terminal = true;
    for (const std::string& output : command.outputs) {
        const auto format = output_format(output, command.format, {"json", "png"}, "json");
        if (!format) return bad_usage(format.error().message);
        if (const Status wrong = check_not_numbered(output)) return bad_usage(wrong->message);
        if (*format == "png" && binary_to_terminal(output))
            return bad_usage("-o -: a plot is not written to a terminal");
        if (const Status failed = check_writable(output)) return report_error("", *failed);
        to_terminal = to_terminal && output != "-";
        formats.push_back(*format);
    }
    BenchWish wish;
    wish.threads = command.threads;
    wish.device = command.device;
    for (std::size_t i = 0; i < std::size(kBenchSourceWords); ++i)
        if (command.sources.empty() ||
            std::count(command.sources.begin(), command.sources.end(), kBenchSourceWords[i]) > 0)
            wish.sources.push_back(static_cast<BenchSource>(i));

    std::vector<BenchFigure> figures;
    std::string renderer;
    ProgressLine line;
    const Status failed = measure_figures(
        wish, [&](const std::string& what) { line.say(what); },
        [&](BenchFigure figure) {
            line.clear();
            if (to_terminal) {
                if (figures.empty() || figures.back().source != figure.source)
                    print_head(figure.source);
                print_figure(figure);
            }
            figures.push_back(std::move(figure));
        },
        renderer, Deadline{});
    line.clear();
    if (failed) return report_error("", *failed);
    if (to_terminal && !renderer.empty())
        std::printf("\nSplats were drawn by %s.\n", renderer.c_str());
    for (std::size_t i = 0; i < formats.size(); ++i) {
        const auto bytes = formats[i] == "json"
                               ? Result<std::string>(figures_json(figures, renderer, command))
                               : figures_plot(figures, renderer, command);
        if (!bytes) return report_error("", bytes.error());
        if (const Status wrong = write_output(command.outputs[i], *bytes))
            return report_error("", *wrong);
    }
    return kExitFine;
}

}  // namespace awan
