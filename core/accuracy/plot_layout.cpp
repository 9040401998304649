#include "core/accuracy/plot_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/base/exact_math.h"

namespace awan {
namespace {

constexpr double kGap = 3;  // between labels, pixels

PlotBox widened(const PlotBox& box, double by) {
    return {box.x - by, box.y - by, box.width + 2 * by, box.height + 2 * by};
}

// Liang and Barsky: does a segment touch a box?
bool crosses(const PlotPoint& a, const PlotPoint& b, const PlotBox& box) {
    double from = 0;
    double to = 1;
    const double dx = b.x - a.x;
    const double dy = b.y - a.y;
    const std::array<std::pair<double, double>, 4> edges = {{{-dx, a.x - box.x},
                                                             {dx, box.right() - a.x},
                                                             {-dy, a.y - box.y},
                                                             {dy, box.bottom() - a.y}}};
    for (const auto& [p, q] : edges) {
        if (p == 0) {
            if (q < 0) return false;
        } else if (p < 0) {
            from = std::max(from, q / p);
        } else {
            to = std::min(to, q / p);
        }
    }
    return from <= to;
}

PlotBox marker_box(const PlotPoint& point, double half) {
    return {point.x - half, point.y - half, 2 * half, 2 * half};
}

class Placing {
  public:
    Placing(std::span<const LabelWish> wishes, const LabelSurroundings& around)
        : wishes_(wishes), around_(around), placed_(wishes.size()) {}

    void place(std::size_t i) {
        std::optional<PlotBox> best;
        double best_cost = std::numeric_limits<double>::infinity();
        const auto consider = [&](const PlotBox& box, double cost) {
            if (cost >= best_cost || !free(box)) return;
            cost += crossing_cost(i, box);
            if (cost >= best_cost) return;
            best = box;
            best_cost = cost;
        };
        // Rings around the point, its sides before its corners.
        constexpr int kDirections = 16;
        for (const double distance : {3.0, 9.0, 18.0, 30.0, 45.0, 65.0, 90.0, 120.0, 160.0})
            for (int d = 0; d < kDirections; ++d) {
                const double angle = 2 * std::numbers::pi * d / kDirections;
                const double corner = d % 4 == 0 ? 0 : d % 2 == 0 ? 1.0 : 2.0;
                // To the right of a point reads best, below it worst.
                const double side = 1 - exact::cos(angle) + 0.5 * std::max(0.0, exact::sin(angle));
                consider(box_at(i, angle, distance), distance + corner + 2 * side);
            }
        // Crowded: the nearest free place there is.
        if (!best) {
            const LabelWish& wish = wishes_[i];
            constexpr double kStep = 4;
            for (double y = around_.area.y; y <= around_.area.bottom(); y += kStep)
                for (double x = around_.area.x; x <= around_.area.right(); x += kStep) {
                    const PlotBox box{x, y, wish.width, wish.height};
                    consider(box, 200 + exact::hypot(x + wish.width / 2 - wish.point.x,
                                                     y + wish.height / 2 - wish.point.y));
                }
        }
        placed_[i] = best;
    }

    std::vector<std::optional<PlotBox>> result() { return std::move(placed_); }

  private:
    // A label seen from its point in a direction, its nearest edge `distance` from the marker.
    PlotBox box_at(std::size_t i, double angle, double distance) const {
        const LabelWish& wish = wishes_[i];
        const double c = exact::cos(angle);
        const double s = exact::sin(angle);
        const double reach = around_.marker + distance;
        // The ellipse of directions, stretched so that the box clears the marker on every side.
        const double x = wish.point.x + c * (reach + wish.width / 2);
        const double y = wish.point.y + s * (reach + wish.height / 2);
        return {x - wish.width / 2, y - wish.height / 2, wish.width, wish.height};
    }

    bool free(const PlotBox& box) const {
        if (!around_.area.holds(box)) return false;
        for (const std::optional<PlotBox>& other : placed_)
            if (other && widened(*other, kGap).overlaps(box)) return false;
        return std::none_of(wishes_.begin(), wishes_.end(), [&](const LabelWish& wish) {
            return marker_box(wish.point, around_.marker).overlaps(box);
        });
    }

    double crossing_cost(std::size_t i, const PlotBox& box) const {
        double cost = 0;
        for (const PlotBox& other : around_.avoided)
            if (other.overlaps(box)) cost += 25;
        for (const auto& [a, b] : around_.lines)
            if (crosses(a, b, box)) cost += 22;
        // Nearer to another point than to its own, a label seems to be that one's.
        const auto distance_to = [&](const PlotPoint& p) {
            const double x = std::clamp(p.x, box.x, box.right());
            const double y = std::clamp(p.y, box.y, box.bottom());
            return exact::hypot(p.x - x, p.y - y);
        };
        const double own = distance_to(wishes_[i].point);
        for (std::size_t k = 0; k < wishes_.size(); ++k)
            if (k != i && distance_to(wishes_[k].point) < own + 4) cost += 12;
        // Its leader should not run through another label.
        const PlotPoint centre{box.x + box.width / 2, box.y + box.height / 2};
        for (const std::optional<PlotBox>& other : placed_)
            if (other && crosses(wishes_[i].point, centre, *other)) cost += 40;
        return cost;
    }

    std::span<const LabelWish> wishes_;
    const LabelSurroundings& around_;
    std::vector<std::optional<PlotBox>> placed_;
};

std::string formatted(const char* format, int digits, double value) {
    std::array<char, 48> text{};
    const int length = std::snprintf(text.data(), text.size(), format, digits, value);
    return {text.data(), static_cast<std::size_t>(length)};
}

// Two significant digits, never as an exponent; more before the point where there are more.
std::string two_digits(double value) {
    if (value == 0) return "0";
    const double rounded = std::stod(formatted("%.*e", 1, value));
    const int exponent = static_cast<int>(std::floor(exact::log10(std::abs(rounded)) + 1e-9));
    return formatted("%.*f", std::clamp(1 - exponent, 0, 12), rounded);
}

}  // namespace

double LogAxis::share(double value) const {
    return exact::log(value / low) / exact::log(high / low);
}

LogAxis axis_of(std::span<const double> values) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const double value : values) {
        if (!(value > 0) || !std::isfinite(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    if (high == 0) return {};
    const double middle = std::sqrt(low) * std::sqrt(high);
    const double half =
        std::max(std::sqrt(high / low) * exact::pow(high / low, 0.08), std::sqrt(10));
    return {middle / half / 1.1, middle * half * 1.1};
}

std::vector<Tick> ticks_of(const LogAxis& axis) {
    const int first = static_cast<int>(std::floor(exact::log10(axis.low)));
    const int last = static_cast<int>(std::ceil(exact::log10(axis.high)));
    const auto inside = [&](double value) { return value >= axis.low && value <= axis.high; };
    int decades = 0;
    for (int e = first; e <= last; ++e) decades += inside(exact::pow(10.0, e));
    const int labelled_step = last - first > 12 ? 3 : 1;  // no room for more
    std::vector<Tick> ticks;
    for (int e = first; e <= last; ++e)
        for (const int digit : {1, 2, 5}) {
            const double value = digit * exact::pow(10.0, e);
            if (!inside(value)) continue;
            const bool labelled = digit == 1 ? (e - first) % labelled_step == 0 : decades < 3;
            ticks.push_back({value, labelled});
        }
    return ticks;
}

std::vector<std::optional<PlotBox>> place_labels(std::span<const LabelWish> wishes,
                                                 const LabelSurroundings& around) {
    // Those with the most neighbours first: the others have room anyway.
    std::vector<double> crowding(wishes.size(), 0);
    for (std::size_t i = 0; i < wishes.size(); ++i)
        for (std::size_t k = 0; k < wishes.size(); ++k)
            if (k != i)
                crowding[i] += 1 / (20 + exact::hypot(wishes[i].point.x - wishes[k].point.x,
                                                      wishes[i].point.y - wishes[k].point.y));
    std::vector<std::size_t> order(wishes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return crowding[a] > crowding[b]; });
    Placing placing(wishes, around);
    for (const std::size_t i : order) placing.place(i);
    return placing.result();
}

std::string time_text(double ms) {
    if (!std::isfinite(ms)) return "?";
    return ms < 999.5 ? two_digits(ms) + " ms" : two_digits(ms / 1000) + " s";
}

std::string time_tick_text(double ms) {
    return ms < 999.5 ? formatted("%.*g ms", 6, ms) : formatted("%.*g s", 6, ms / 1000);
}

std::string percent_tick_text(double relative) {
    return formatted("%.*g%%", 6, 100 * relative);
}

std::string percent_text(double relative) {
    if (!std::isfinite(relative)) return "?";
    return two_digits(100 * relative) + "%";
}

std::string signed_percent_text(double relative) {
    if (!std::isfinite(relative)) return "?";
    const std::string text = percent_text(std::abs(relative));
    return (relative < 0 ? "\xE2\x88\x92" : "+") + text;
}

}  // namespace awan
