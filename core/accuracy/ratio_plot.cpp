#include "core/accuracy/ratio_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/accuracy/plot_canvas.h"
#include "core/accuracy/plot_layout.h"

namespace awan {
namespace {

// Pixels.
constexpr double kRatioWidth = 1120, kRatioMargin = 28;
constexpr double kRatioHeader = 62, kRatioGroup = 34, kRatioRow = 24, kRatioFoot = 44;
// The columns of text are as wide as what stands in them, within these; the bars have the rest.
constexpr double kFewestNames = 200, kMostNames = 470, kFewestFigures = 60, kMostFigures = 260;
// Of the ratio, before the figures.
constexpr double kRatioTimes = 72;
// More would be a picture that nobody looks at.
constexpr std::size_t kMostRows = 400;

constexpr TextStyle kRatioTitle{19, true, Align::kLeft};
constexpr TextStyle kRatioSmall{11.5, false, Align::kLeft};
constexpr TextStyle kRatioName{12, false, Align::kLeft};
constexpr TextStyle kRatioGroupName{12.5, true, Align::kLeft};

std::string times_text(double ratio) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), ratio < 10 ? "%.2g\xC3\x97" : "%.0f\xC3\x97", ratio);
    return text.data();
}

LogAxis axis_with_one(std::span<const RatioRow> rows) {
    std::vector<double> values = {1};
    for (const RatioRow& row : rows) values.push_back(row.times_as_fast);
    return axis_of(values);
}

}  // namespace

Result<std::string> plot_ratios(const std::string& title, const std::string& about,
                                std::span<const RatioRow> rows, PlotTheme theme) {
    if (rows.size() > kMostRows)
        return Error{ErrorCode::kTooLarge, "",
                     std::to_string(rows.size()) + " rows are too many for a plot"};
    std::size_t groups = 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
        groups += i == 0 || rows[i].group != rows[i - 1].group;
    const double height = kRatioHeader + kRatioGroup * static_cast<double>(groups) +
                          kRatioRow * static_cast<double>(rows.size()) + kRatioFoot;
    const PlotColors& colors = plot_colors(theme);
    const PlotCanvas canvas(static_cast<int>(kRatioWidth), static_cast<int>(std::lround(height)),
                            1);
    canvas.color(colors.ground);
    canvas.rectangle({0, 0, kRatioWidth, height});
    canvas.color(colors.ink);
    canvas.text(canvas.cut(title, kRatioWidth - 2 * kRatioMargin, kRatioTitle), kRatioMargin, 30,
                kRatioTitle);
    canvas.color(colors.quiet);
    canvas.text(canvas.cut(about, kRatioWidth - 2 * kRatioMargin, kRatioSmall), kRatioMargin, 49,
                kRatioSmall);

    double name_width = kFewestNames, figure_width = kFewestFigures;
    for (const RatioRow& row : rows) {
        name_width = std::max(name_width, canvas.text_width(row.what, kRatioName) + 13);
        figure_width = std::max(figure_width, canvas.text_width(row.figures, kRatioSmall) + 1);
    }
    name_width = std::min(name_width, kMostNames);
    figure_width = std::min(figure_width, kMostFigures);

    const LogAxis axis = axis_with_one(rows);
    const PlotBox area{kRatioMargin + name_width, kRatioHeader,
                       kRatioWidth - 2 * kRatioMargin - name_width - kRatioTimes - figure_width,
                       height - kRatioHeader - kRatioFoot};
    const auto x_of = [&](double ratio) { return area.x + area.width * axis.share(ratio); };
    canvas.color(colors.panel);
    canvas.rectangle(area);
    for (const Tick& tick : ticks_of(axis)) {
        canvas.color(tick.labelled ? colors.line : colors.faint);
        canvas.line({x_of(tick.value), area.y}, {x_of(tick.value), area.bottom()}, 0.75);
        if (!tick.labelled) continue;
        canvas.color(colors.quiet);
        canvas.text(times_text(tick.value), x_of(tick.value), area.bottom() + 17,
                    {11.5, false, Align::kMiddle});
    }
    canvas.color(colors.quiet);
    canvas.text("times as fast (logarithmic)", area.x + area.width / 2, area.bottom() + 36,
                {12, false, Align::kMiddle});
    canvas.color(colors.ink);
    canvas.line({x_of(1), area.y + kRatioGroup}, {x_of(1), area.bottom()}, 1.5);

    double y = kRatioHeader;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RatioRow& row = rows[i];
        if (i == 0 || row.group != rows[i - 1].group) {
            y += kRatioGroup;
            canvas.color(colors.ground);
            canvas.rectangle(
                {kRatioMargin, y - kRatioGroup, kRatioWidth - 2 * kRatioMargin, kRatioGroup});
            canvas.color(colors.ink);
            canvas.text(canvas.cut(row.group, kRatioWidth - 2 * kRatioMargin, kRatioGroupName),
                        kRatioMargin, y - 10, kRatioGroupName);
        }
        y += kRatioRow;
        canvas.color(colors.ink);
        canvas.text(canvas.cut(row.what, name_width - 12, kRatioName), kRatioMargin, y - 8,
                    kRatioName);
        const double from = x_of(1), to = x_of(row.times_as_fast);
        canvas.color(row.times_as_fast >= 1 ? colors.accent : colors.above);
        canvas.rectangle(
            {std::min(from, to), y - kRatioRow + 5, std::abs(to - from), kRatioRow - 10});
        canvas.color(colors.ink);
        canvas.text(times_text(row.times_as_fast), area.right() + 12, y - 8,
                    {12, true, Align::kLeft});
        canvas.color(colors.quiet);
        canvas.text(canvas.cut(row.figures, figure_width, kRatioSmall), area.right() + kRatioTimes,
                    y - 8, kRatioSmall);
    }
    return canvas.png();
}

}  // namespace awan
