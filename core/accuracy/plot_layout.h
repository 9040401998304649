// Where things stand in a plot: axes on logarithmic scales, and labels that never overlap. Pure
// geometry in pixels, y downwards; plot.cpp draws it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace awan {

struct PlotPoint {
    double x = 0, y = 0;
};

struct PlotBox {
    double x = 0, y = 0, width = 0, height = 0;

    double right() const { return x + width; }
    double bottom() const { return y + height; }
    bool overlaps(const PlotBox& other) const {
        return x < other.right() && other.x < right() && y < other.bottom() && other.y < bottom();
    }
    bool holds(const PlotBox& other) const {
        return other.x >= x && other.right() <= right() && other.y >= y &&
               other.bottom() <= bottom();
    }
};

// A logarithmic axis over [low, high], both > 0.
struct LogAxis {
    double low = 1, high = 10;
    // 0 at low, 1 at high; may leave both.
    double share(double value) const;
};

// Holds every finite value > 0, with room at both ends, and at least a decade. 1..10 of nothing.
LogAxis axis_of(std::span<const double> values);

struct Tick {
    double value = 0;
    bool labelled = true;  // others are lines only
};
// 1, 10, 100...; where they would be fewer than three, 2 and 5 times these are labelled as well.
std::vector<Tick> ticks_of(const LogAxis& axis);

// A label and what it belongs to.
struct LabelWish {
    PlotPoint point;
    double width = 0, height = 0;  // of the label
};
struct LabelSurroundings {
    PlotBox area;  // labels stay in it
    // No label covers the square of this half side around any point.
    double marker = 6;
    std::vector<PlotBox> avoided;                        // better not covered
    std::vector<std::pair<PlotPoint, PlotPoint>> lines;  // better not crossed
};
// One box a wish, as near to its point as there is room; nothing where there is none at all. Boxes
// are in the area, and overlap neither one another nor a marker.
std::vector<std::optional<PlotBox>> place_labels(std::span<const LabelWish> wishes,
                                                 const LabelSurroundings& around);

// Milliseconds as people say them: "0.42 ms", "12 ms", "1.3 s", "95 s".
std::string time_text(double ms);
// A relative figure as a percentage of two digits: "0.23%", "4.1%", "34%", "170%".
std::string percent_text(double relative);
// The same with its sign, a true minus.
std::string signed_percent_text(double relative);

// Of a tick, without digits that say nothing: "1 s", "0.5%".
std::string time_tick_text(double ms);
std::string percent_tick_text(double relative);

}  // namespace awan
