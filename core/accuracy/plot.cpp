#include "core/accuracy/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/accuracy/plot_canvas.h"
#include "core/accuracy/plot_layout.h"
#include "core/base/exact_math.h"

namespace awan {
namespace {

// Pixels, before the scale.
constexpr double kWidth = 1120;
constexpr double kMargin = 28;
// Numbers and title of the error axis.
constexpr double kAxisWidth = 58;
constexpr double kHeaderHeight = 66;
constexpr double kChartHeight = 380, kChartHeightOfMany = 300;
// Numbers and title of the time axis.
constexpr double kAxisHeight = 46;
constexpr double kStripGap = 14;
constexpr double kCaptionHeight = 34;
constexpr double kLeastDifferenceHeight = 54;  // the scale's words
constexpr double kCellGap = 10;
constexpr double kMostCellWidth = 150, kLeastCellWidth = 96;
constexpr double kFootHeight = 20;
constexpr double kMarker = 5;  // radius

constexpr TextStyle kTitle{19, true, Align::kLeft};
constexpr TextStyle kSmall{11.5, false, Align::kLeft};
constexpr TextStyle kName{12, true, Align::kLeft};
constexpr double kLabelHeight = 29;

constexpr const char* kNarrowSpace = "\xE2\x80\x89";
constexpr const char* kTimes = "\xE2\x80\x89\xC3\x97\xE2\x80\x89";  // between thin spaces

std::string size_text(int width, int height) {
    return std::to_string(width) + kTimes + std::to_string(height);
}

// --- what is measured, as marks

// Below twice its own noise an error is not told from none: then the mark says "at most".
bool in_noise(const RungCost& rung) {
    return !(rung.error.nrmse > 2 * rung.error.nrmse_noise) || rung.error.nrmse <= 0;
}
double shown_error(const RungCost& rung) {
    return in_noise(rung) ? std::max(rung.error.nrmse, 2 * rung.error.nrmse_noise)
                          : rung.error.nrmse;
}
std::string error_text(const RungCost& rung) {
    const std::string value = percent_text(shown_error(rung));
    return in_noise(rung) && shown_error(rung) > 0
               ? "\xE2\x89\xA4" + std::string(kNarrowSpace) + value
               : value;
}
bool has_prediction(const RungCost& rung) {
    return std::isfinite(rung.predicted_error) && rung.predicted_error > 0 &&
           std::isfinite(rung.predicted_time_ms) && rung.predicted_time_ms > 0;
}

struct Axes {
    LogAxis time, error;
};

Axes axes_of(std::span<const AccuracyPlot> plots) {
    std::vector<double> times;
    std::vector<double> errors;
    for (const AccuracyPlot& plot : plots)
        for (const RungCost& rung : plot.report->rungs) {
            times.push_back(rung.time_ms);
            errors.push_back(shown_error(rung));
            errors.push_back(rung.error.nrmse + 2 * rung.error.nrmse_noise);
            if (!has_prediction(rung)) continue;
            times.push_back(rung.predicted_time_ms);
            errors.push_back(rung.predicted_error);
        }
    Axes axes{axis_of(times), axis_of(errors)};
    // Room for the name of the last mark.
    axes.time.high *= exact::pow(axes.time.high / axes.time.low, 0.08);
    if (std::none_of(errors.begin(), errors.end(), [](double e) { return e > 0; }))
        axes.error = {0.001, 1};
    return axes;
}

// --- one block: a chart and its strip

class Block {
  public:
    Block(const PlotCanvas& canvas, const AccuracyPlot& plot, const Axes& axes,
          const PlotColors& colors, double chart_height, bool bare_title)
        : canvas_(canvas),
          report_(*plot.report),
          axes_(axes),
          colors_(colors),
          chart_height_(chart_height),
          bare_title_(bare_title),
          title_(plot.title) {}

    static double height(const AccuracyReport& report, double chart_height);
    void draw(double top);

  private:
    struct Strip {
        int columns = 1;
        double cell_width = 0, picture_width = 0, picture_height = 0, row_height = 0;
        int rows = 1;
    };
    static Strip strip_of(const AccuracyReport& report);

    PlotPoint at(double time_ms, double error) const {
        return {area_.x + area_.width * axes_.time.share(time_ms),
                area_.bottom() - area_.height * axes_.error.share(error)};
    }
    // An error of nothing stands on the axis.
    PlotPoint mark_of(const RungCost& rung) const {
        const double error = std::max(shown_error(rung), axes_.error.low);
        PlotPoint point = at(std::max(rung.time_ms, axes_.time.low), error);
        point.y = std::min(point.y, area_.bottom() - 8);
        return point;
    }

    // Its two ends: twice the noise up and down.
    std::pair<double, double> error_bar(const RungCost& rung) const {
        const double noise = 2 * rung.error.nrmse_noise;
        const double low = std::max(rung.error.nrmse - noise, axes_.error.low);
        return {at(rung.time_ms, rung.error.nrmse + noise).y, at(rung.time_ms, low).y};
    }

    void header(double top) const;
    void legend(double baseline) const;
    void grid() const;
    void predictions() const;
    void front() const;
    void marks() const;
    void labels() const;
    void strip(double top) const;
    void scale_bar(const PlotBox& cell, double full_scale) const;
    double full_scale() const;

    const PlotCanvas& canvas_;
    const AccuracyReport& report_;
    const Axes& axes_;
    const PlotColors& colors_;
    const double chart_height_;
    const bool bare_title_;
    const std::string& title_;
    PlotBox area_;
};

Block::Strip Block::strip_of(const AccuracyReport& report) {
    const double room = kWidth - 2 * kMargin;
    const int cells = static_cast<int>(report.rungs.size()) + 1;
    Strip strip;
    const int most = static_cast<int>((room + kCellGap) / (kLeastCellWidth + kCellGap));
    strip.rows = (cells + most - 1) / most;
    strip.columns = (cells + strip.rows - 1) / strip.rows;
    strip.cell_width = std::min((room + kCellGap) / strip.columns - kCellGap, kMostCellWidth);
    // Any shape of picture in cells that are no taller than wide, and never a hair thin.
    const double ratio = static_cast<double>(std::max(report.reference.height, 1)) /
                         std::max(report.reference.width, 1);
    strip.picture_width = ratio > 1 ? strip.cell_width / ratio : strip.cell_width;
    strip.picture_height = ratio > 1 ? strip.cell_width : strip.cell_width * ratio;
    strip.picture_width = std::max(strip.picture_width, 6.0);
    strip.picture_height = std::max(strip.picture_height, 6.0);
    strip.row_height = strip.picture_height +
                       std::max(strip.picture_height, kLeastDifferenceHeight) + 2 * kCaptionHeight +
                       14;
    return strip;
}

double Block::height(const AccuracyReport& report, double chart_height) {
    const Strip strip = strip_of(report);
    return kHeaderHeight + chart_height + kAxisHeight + kStripGap + strip.rows * strip.row_height +
           (report.left_out.empty() ? 0 : kFootHeight) + kMargin;
}

void Block::draw(double top) {
    header(top);
    area_ = {kMargin + kAxisWidth, top + kHeaderHeight, kWidth - 2 * kMargin - kAxisWidth,
             chart_height_};
    grid();
    if (report_.rungs.empty()) {
        canvas_.color(colors_.quiet);
        canvas_.text("nothing was measured", area_.x + area_.width / 2, area_.y + area_.height / 2,
                     {13, false, Align::kMiddle});
    }
    predictions();
    front();
    marks();
    labels();
    strip(area_.bottom() + kAxisHeight + kStripGap);
}

void Block::header(double top) const {
    const std::string what = title_.empty() ? "What accuracy costs"
                             : bare_title_  ? title_
                                            : "What accuracy costs: " + title_;
    canvas_.color(colors_.ink);
    const double baseline = top + 22;
    canvas_.text(canvas_.cut(what, kWidth - 2 * kMargin, kTitle), kMargin, baseline, kTitle);
    const AccuracyReport::Reference& r = report_.reference;
    const std::string about = "Times at " + size_text(report_.width, report_.height) +
                              " pixels. Errors against the truth at " +
                              size_text(r.width, r.height) + ", " + std::to_string(r.samples) +
                              " paths a pixel, noise of a pixel " + percent_text(r.noise) +
                              ", traced in " + time_text(r.time_ms) + ".";
    canvas_.color(colors_.quiet);
    canvas_.text(canvas_.cut(about, kWidth - 2 * kMargin, kSmall), kMargin, baseline + 19, kSmall);
    legend(top + kHeaderHeight - 7);
}

// At the right, above the chart.
void Block::legend(double baseline) const {
    double right = kWidth - kMargin;
    const auto entry = [&](const std::string& text, auto&& mark) {
        right -= canvas_.text_width(text, kSmall);
        canvas_.color(colors_.quiet);
        canvas_.text(text, right, baseline, kSmall);
        right -= 14;
        mark(PlotPoint{right, baseline - 4});
        right -= 20;
    };
    if (std::any_of(report_.rungs.begin(), report_.rungs.end(), has_prediction))
        entry("predicted", [&](PlotPoint p) {
            canvas_.color(colors_.quiet);
            canvas_.disc(p, kMarker - 1, false);
        });
    if (std::any_of(report_.rungs.begin(), report_.rungs.end(),
                    [](const RungCost& rung) { return !rung.pareto; }))
        entry("another is faster and better", [&](PlotPoint p) {
            canvas_.color(colors_.quiet);
            canvas_.disc(p, kMarker, true);
        });
    entry("Pareto front: none is both faster and better", [&](PlotPoint p) {
        canvas_.color(colors_.accent);
        canvas_.line({p.x - 11, p.y}, {p.x + 7, p.y}, 2);
        canvas_.disc({p.x - 2, p.y}, kMarker, true);
    });
}

void Block::grid() const {
    canvas_.color(colors_.panel);
    canvas_.rectangle(area_);
    for (const Tick& tick : ticks_of(axes_.time)) {
        const double x = at(tick.value, axes_.error.low).x;
        canvas_.color(tick.labelled ? colors_.line : colors_.faint);
        canvas_.line({x, area_.y}, {x, area_.bottom()}, tick.labelled ? 1 : 0.75);
        if (!tick.labelled) continue;
        canvas_.color(colors_.quiet);
        canvas_.text(time_tick_text(tick.value), x, area_.bottom() + 17,
                     {11.5, false, Align::kMiddle});
    }
    for (const Tick& tick : ticks_of(axes_.error)) {
        const double y = at(axes_.time.low, tick.value).y;
        canvas_.color(tick.labelled ? colors_.line : colors_.faint);
        canvas_.line({area_.x, y}, {area_.right(), y}, tick.labelled ? 1 : 0.75);
        if (!tick.labelled) continue;
        canvas_.color(colors_.quiet);
        canvas_.text(percent_tick_text(tick.value), area_.x - 8, y + 4,
                     {11.5, false, Align::kRight});
    }
    canvas_.color(colors_.ink);
    canvas_.text("time of one picture, ms or s (logarithmic)", area_.x + area_.width / 2,
                 area_.bottom() + 37, {12, false, Align::kMiddle});
    cairo_save(canvas_.pen());
    cairo_translate(canvas_.pen(), kMargin + 6, area_.y + area_.height / 2);
    cairo_rotate(canvas_.pen(), -std::numbers::pi / 2);
    canvas_.text("error: RMS, % of the mean truth (logarithmic)", 0, 0,
                 {12, false, Align::kMiddle});
    cairo_restore(canvas_.pen());
}

// Hollow, with a dotted line to what was measured.
void Block::predictions() const {
    const std::array<double, 2> dots = {1, 4};
    for (const RungCost& rung : report_.rungs) {
        if (!has_prediction(rung)) continue;
        const PlotPoint point = at(rung.predicted_time_ms, rung.predicted_error);
        canvas_.color(rung.pareto ? colors_.accent : colors_.quiet, 0.8);
        cairo_set_dash(canvas_.pen(), dots.data(), static_cast<int>(dots.size()), 0);
        canvas_.line(mark_of(rung), point, 1.25);
        cairo_set_dash(canvas_.pen(), nullptr, 0, 0);
        canvas_.color(colors_.panel);
        canvas_.disc(point, kMarker - 1, true);
        canvas_.color(rung.pareto ? colors_.accent : colors_.quiet);
        canvas_.disc(point, kMarker - 1, false);
    }
}

// A staircase: from a mark on, its error can be had until the next one's time.
void Block::front() const {
    canvas_.color(colors_.accent);
    cairo_set_line_width(canvas_.pen(), 2);
    bool begun = false;
    PlotPoint last;
    for (const RungCost& rung : report_.rungs) {
        if (!rung.pareto) continue;
        const PlotPoint point = mark_of(rung);
        if (begun) {
            cairo_line_to(canvas_.pen(), point.x, last.y);
            cairo_line_to(canvas_.pen(), point.x, point.y);
        } else {
            cairo_move_to(canvas_.pen(), point.x, point.y);
        }
        begun = true;
        last = point;
    }
    cairo_stroke(canvas_.pen());
}

void Block::marks() const {
    for (const RungCost& rung : report_.rungs) {
        const PlotPoint point = mark_of(rung);
        canvas_.color(rung.pareto ? colors_.accent : colors_.quiet);
        // "at most": an arrow to where the error may be.
        if (in_noise(rung)) {
            canvas_.line(point, {point.x, point.y + 16}, 1.5);
            canvas_.line({point.x - 3.5, point.y + 12}, {point.x, point.y + 16}, 1.5);
            canvas_.line({point.x + 3.5, point.y + 12}, {point.x, point.y + 16}, 1.5);
        } else {
            const auto [top, bottom] = error_bar(rung);
            if (bottom - top > 2 * kMarker + 2) {  // else the mark covers it
                canvas_.line({point.x, top}, {point.x, bottom}, 1.5);
                canvas_.line({point.x - 4, top}, {point.x + 4, top}, 1.5);
                canvas_.line({point.x - 4, bottom}, {point.x + 4, bottom}, 1.5);
            }
        }
        canvas_.disc(point, kMarker, true);
        canvas_.color(colors_.panel);
        cairo_new_sub_path(canvas_.pen());
        cairo_arc(canvas_.pen(), point.x, point.y, kMarker + 0.75, 0, 2 * std::numbers::pi);
        cairo_set_line_width(canvas_.pen(), 1.5);
        cairo_stroke(canvas_.pen());
    }
}

void Block::labels() const {
    std::vector<LabelWish> wishes;
    LabelSurroundings around;
    around.area = {area_.x + 3, area_.y + 3, area_.width - 6, area_.height - 6};
    around.marker = kMarker + 3;
    PlotPoint last;
    bool begun = false;
    for (const RungCost& rung : report_.rungs) {
        const PlotPoint point = mark_of(rung);
        const std::string numbers = time_text(rung.time_ms) + ", " + error_text(rung);
        const double width =
            std::max(canvas_.text_width(rung.rung, kName), canvas_.text_width(numbers, kSmall));
        wishes.push_back({point, width + 2, kLabelHeight});
        if (in_noise(rung)) around.avoided.push_back({point.x - 5, point.y, 10, 18});
        if (rung.error.nrmse_noise > 0 && !in_noise(rung)) {
            const auto [top, bottom] = error_bar(rung);
            around.avoided.push_back({point.x - 4, top, 8, bottom - top});
        }
        if (has_prediction(rung)) {
            const PlotPoint p = at(rung.predicted_time_ms, rung.predicted_error);
            around.avoided.push_back({p.x - kMarker, p.y - kMarker, 2 * kMarker, 2 * kMarker});
            around.lines.emplace_back(point, p);
        }
        if (!rung.pareto) continue;
        if (begun) {
            around.lines.push_back({last, {point.x, last.y}});
            around.lines.push_back({{point.x, last.y}, point});
        }
        begun = true;
        last = point;
    }
    const auto boxes = place_labels(wishes, around);
    // All leaders first: where one passes behind a label, the label is read.
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i]) continue;  // it is in the strip
        const PlotPoint& point = wishes[i].point;
        const PlotPoint near{std::clamp(point.x, boxes[i]->x, boxes[i]->right()),
                             std::clamp(point.y, boxes[i]->y, boxes[i]->bottom())};
        if (exact::hypot(near.x - point.x, near.y - point.y) <= kMarker + 14) continue;
        canvas_.color(colors_.quiet, 0.7);
        canvas_.line(near, point, 0.75);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i]) continue;
        const PlotBox& box = *boxes[i];
        const RungCost& rung = report_.rungs[i];
        canvas_.color(colors_.panel, 0.85);
        canvas_.rectangle({box.x - 2, box.y, box.width + 4, box.height});
        // Flush with the side that its mark is on.
        const bool to_the_left = box.right() < wishes[i].point.x;
        const Align align = to_the_left ? Align::kRight : Align::kLeft;
        const double x = to_the_left ? box.right() - 1 : box.x + 1;
        canvas_.color(rung.pareto ? colors_.accent : colors_.ink);
        canvas_.text(rung.rung, x, box.y + 11.5, {kName.size, true, align});
        canvas_.color(rung.pareto ? colors_.ink : colors_.quiet);
        canvas_.text(time_text(rung.time_ms) + ", " + error_text(rung), x, box.y + 25.5,
                     {kSmall.size, false, align});
    }
}

// Full colour of the difference pictures: so that a middling rung shows what it gets wrong.
double Block::full_scale() const {
    std::vector<double> errors;
    for (const RungCost& rung : report_.rungs) errors.push_back(shown_error(rung));
    std::sort(errors.begin(), errors.end());
    const double wanted = errors.empty() ? 0 : 2 * errors[errors.size() / 2];
    for (const double nice : {0.02, 0.05, 0.1, 0.2, 0.5, 1.0})
        if (nice >= wanted) return nice;
    return 2;
}

// In the truth's column, where it has no difference to show.
void Block::scale_bar(const PlotBox& cell, double full_scale) const {
    const double width = std::min(cell.width, 130.0);
    const double left = cell.x + (cell.width - width) / 2;
    const double top = cell.y + std::max(0.0, (cell.height - 56) / 2) + 14;
    canvas_.color(colors_.quiet);
    canvas_.text("difference", cell.x + cell.width / 2, top - 5, {11.5, false, Align::kMiddle});
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
        canvas_.color(difference_color(2.0 * (i + 0.5) / kSteps - 1, colors_));
        const double step = width / kSteps;
        canvas_.rectangle({left + i * step, top, step + (i + 1 < kSteps ? 0.5 : 0), 10});
    }
    canvas_.color(colors_.quiet);
    canvas_.text(signed_percent_text(-full_scale), left, top + 24, {11, false, Align::kLeft});
    canvas_.text(signed_percent_text(full_scale), left + width, top + 24,
                 {11, false, Align::kRight});
    canvas_.text("of the mean", cell.x + cell.width / 2, top + 39, {11.5, false, Align::kMiddle});
}

void Block::strip(double top) const {
    const Strip strip = strip_of(report_);
    const double scale = full_scale();
    const std::size_t cells = report_.rungs.size() + 1;
    for (std::size_t i = 0; i < cells; ++i) {
        const auto column = static_cast<double>(i % static_cast<std::size_t>(strip.columns));
        const auto row = static_cast<double>(i / static_cast<std::size_t>(strip.columns));
        const double left = kMargin + column * (strip.cell_width + kCellGap);
        const double y = top + row * strip.row_height;
        const PlotBox picture{left + (strip.cell_width - strip.picture_width) / 2, y,
                              strip.picture_width, strip.picture_height};
        const bool is_truth = i == 0;
        const RungCost* const rung = is_truth ? nullptr : &report_.rungs[i - 1];
        const Image& image = is_truth ? report_.reference.picture : rung->picture;
        if (image.width > 0 && image.height > 0)
            canvas_.picture(screen_pixels(image, report_.film), image.width, image.height, picture);
        const double caption = picture.bottom() + 15;
        const auto line = [&](const std::string& text, double baseline, const TextStyle& style,
                              const PlotColor& color) {
            canvas_.color(color);
            TextStyle middle = style;
            middle.align = Align::kMiddle;
            canvas_.text(canvas_.cut(text, strip.cell_width + kCellGap - 2, style),
                         left + strip.cell_width / 2, baseline, middle);
        };
        line(is_truth ? "truth" : rung->rung, caption, kName,
             rung != nullptr && rung->pareto ? colors_.accent : colors_.ink);
        line(is_truth ? time_text(report_.reference.time_ms)
                      : time_text(rung->time_ms) + ", " + error_text(*rung),
             caption + 14, {11, false, Align::kMiddle}, colors_.quiet);
        const PlotBox below{picture.x, picture.bottom() + kCaptionHeight + 4, picture.width,
                            picture.height};
        if (is_truth) {
            scale_bar(
                {left, below.y, strip.cell_width, std::max(below.height, kLeastDifferenceHeight)},
                scale);
            continue;
        }
        if (rung->difference.size() == image.pixel_count() && !rung->difference.empty())
            canvas_.picture(difference_pixels(rung->difference, scale, colors_), image.width,
                            image.height, below);
        line("bias " + signed_percent_text(rung->error.bias), below.bottom() + 14, {11, false},
             colors_.quiet);
        line("FLIP " + std::to_string(rung->flip).substr(0, 5), below.bottom() + 28, {11, false},
             colors_.quiet);
    }
    if (report_.left_out.empty()) return;
    std::string left_out = "Left out for lack of time:";
    for (const AccuracyReport::LeftOut& rung : report_.left_out)
        left_out += (left_out.back() == ':' ? " " : ", ") + rung.rung;
    canvas_.color(colors_.quiet);
    canvas_.text(canvas_.cut(left_out, kWidth - 2 * kMargin, kSmall), kMargin,
                 top + strip.rows * strip.row_height + 14, kSmall);
}

}  // namespace

Result<std::string> plot_accuracy(std::span<const AccuracyPlot> plots, PlotTheme theme,
                                  double scale) {
    constexpr double kMostPixels = 32'000;  // a side of Cairo's pictures
    const double chart_height = plots.size() > 1 ? kChartHeightOfMany : kChartHeight;
    double height = kMargin;
    for (const AccuracyPlot& plot : plots) height += Block::height(*plot.report, chart_height);
    if (height * scale > kMostPixels)
        return Error{ErrorCode::kTooLarge, "",
                     "so many plots do not fit into one picture; ask for fewer"};
    const PlotColors& colors = plot_colors(theme);
    const PlotCanvas canvas(static_cast<int>(kWidth), static_cast<int>(std::ceil(height)), scale);
    canvas.color(colors.ground);
    canvas.rectangle({0, 0, kWidth, std::ceil(height)});
    const Axes axes = axes_of(plots);
    double top = kMargin;
    for (const AccuracyPlot& plot : plots) {
        Block(canvas, plot, axes, colors, chart_height, &plot != plots.data()).draw(top);
        top += Block::height(*plot.report, chart_height);
    }
    return canvas.png();
}

}  // namespace awan
