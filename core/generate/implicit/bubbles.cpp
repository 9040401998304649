// Bubbles of warm air, and Benard cells.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/implicit/procedures.h"
#include "core/generate/keyed_random.h"

namespace awan::implicit {
namespace {

// Random, uniform in 0 .. 1.
double share(std::uint64_t key, std::uint64_t number) {
    return unit_open(static_cast<std::uint32_t>(keyed(key, number) >> 32));
}

double part_of(double x) {
    return x - std::floor(x);
}

// The smaller ones of a bubble stand so far from its middle, and are so large, in its radii.
constexpr double kKnobPlace = 0.75, kLeastKnob = 0.4, kMostKnob = 0.65;
// The largest of the bubbles as they leave the base, in radii; the smallest is as much below 1.
constexpr double kLargestBubble = 1.25;

// A bubble and what rolls over it, in radii from the base's middle.
void add_bubble(const ImplicitBubbles& b, std::uint64_t key, double age, std::vector<Puff>& puffs) {
    constexpr double kTurn = 2 * std::numbers::pi;
    const double out = std::sqrt(share(key, 1)), turn = kTurn * share(key, 2);
    const double up = 2 * share(key, 3) - 1;
    // Lower towards the edge, so that the cloud is a heap.
    const double ceiling = b.ceiling * (1 - 0.6 * out * out) * (0.75 + 0.25 * share(key, 4));
    const double height = ceiling * (1 - exact::exp(-b.rise * age / ceiling));
    const double first = 2 - kLargestBubble + 2 * (kLargestBubble - 1) * share(key, 5);
    const double radius = first + b.entrainment * height;
    // It shows as it rises.
    const double shown = smoothstep(height / (0.5 * std::min(first, ceiling)));
    const glm::dvec3 place(b.spread.x * out * exact::cos(turn), b.spread.y * up + height,
                           b.spread.z * out * exact::sin(turn));
    const auto add = [&](const glm::dvec3& at, double size, double weight) {
        puffs.push_back({b.center + b.radius * at, b.radius * size, b.weight * weight});
    };
    add(place, radius, shown);
    for (std::uint64_t i = 0; i < b.knobs; ++i) {
        const std::uint64_t own = keyed(key, 100 + i);
        // From the top (0) outward and under (1), where it is gone, and another is at the top.
        const double rolled = part_of(
            (static_cast<double>(i) + share(own, 0)) / static_cast<double>(b.knobs) + 0.4 * height);
        const double down = 2.2 * rolled, around = kTurn * share(own, 1);
        const glm::dvec3 way(exact::sin(down) * exact::cos(around), exact::cos(down),
                             exact::sin(down) * exact::sin(around));
        const double size = radius * (kLeastKnob + (kMostKnob - kLeastKnob) * share(own, 2));
        add(place + kKnobPlace * radius * way, size, shown * 4 * rolled * (1 - rolled));
    }
}

}  // namespace

std::vector<Puff> bubbles_at(const ImplicitBubbles& b, std::uint64_t key, double time) {
    std::vector<Puff> puffs;
    for (std::uint64_t i = 0; i < b.most; ++i) {
        const std::uint64_t own = keyed(key, i);
        const double born = b.began + (static_cast<double>(i) + share(own, 0)) / b.rate;
        if (time > born) add_bubble(b, own, time - born, puffs);
    }
    return puffs;
}

Box bubbles_box(const ImplicitBubbles& b) {
    const double widest = kLargestBubble + b.entrainment * b.ceiling;
    const double reach = widest * (kKnobPlace + kMostKnob);
    Box box;
    box.add(b.center, b.radius * (b.spread + reach));
    box.max.y += b.radius * b.ceiling;
    return box;
}

namespace {

// Of a hexagon whose neighbours' middles are one away at multiples of 60 degrees: how far its wall is at an angle,
// turns.
double wall_at(double turns) {
    const double off = turns * 6 - std::floor(turns * 6 + 0.5);
    return 0.5 / exact::cos(off * std::numbers::pi / 3);
}

// A parcel: how far it has gone around its cell (0 and 1: where the air rises fastest), its place from the cell's
// middle, spacings (y: of the depth), and how much of it is cloud.
struct Parcel {
    glm::dvec3 place;
    double cloud;
};
Parcel parcel_at(const ImplicitCells& cells, const glm::dvec2& middle, double around,
                 double turns) {
    constexpr double kTurn = 2 * std::numbers::pi;
    const double cosine = exact::cos(kTurn * around);
    // Up in the middle and out along the top, or up along the wall and in.
    const double out = 0.5 + (cells.open ? 0.42 : -0.42) * cosine;
    const double angle = kTurn * turns;
    const glm::dvec2 wall = wall_at(turns) * glm::dvec2(exact::cos(angle), exact::sin(angle));
    const glm::dvec2 at = middle + out * (wall - middle);
    const double cloud = smoothstep(0.5 + 0.5 * exact::cos(kTurn * (around - 0.12)));
    return {{at.x, 0.5 + 0.5 * exact::sin(kTurn * around), at.y}, cloud};
}

void add_cell(const ImplicitCells& cells, const glm::dvec2& middle, std::uint64_t key, double time,
              std::vector<Puff>& puffs) {
    const glm::dvec2 off =
        cells.irregular * 0.8 * glm::dvec2(2 * share(key, 0) - 1, 2 * share(key, 1) - 1);
    const double first = share(key, 2), start = share(key, 3);
    for (std::uint64_t i = 0; i < cells.parcels; ++i) {
        const std::uint64_t own = keyed(key, 100 + i);
        const double number = static_cast<double>(i);
        const double around =
            part_of(time / cells.turnover + start +
                    (number + share(own, 0)) / static_cast<double>(cells.parcels));
        // By the golden ratio, so that they go all ways.
        const double turns = part_of(first + 0.6180339887498949 * number);
        const Parcel parcel = parcel_at(cells, off, around, turns);
        const glm::dvec3 at = glm::dvec3(middle.x, 0, middle.y) + parcel.place;
        const double radius = cells.radius * (1 + cells.irregular * (2 * share(own, 1) - 1));
        puffs.push_back({cells.center + at * glm::dvec3(cells.spacing, cells.depth, cells.spacing),
                         radius, cells.weight * parcel.cloud});
    }
}

}  // namespace

std::vector<Puff> cells_at(const ImplicitCells& cells, std::uint64_t key, double time) {
    std::vector<Puff> puffs;
    const int rings = static_cast<int>(cells.rings);
    const double row = std::sqrt(0.75);
    std::uint64_t number = 0;
    for (int r = -rings; r <= rings; ++r)
        for (int q = -rings; q <= rings; ++q) {
            if (std::abs(q + r) > rings) continue;
            add_cell(cells, {q + 0.5 * r, row * r}, keyed(key, number++), time, puffs);
        }
    return puffs;
}

Box cells_box(const ImplicitCells& cells) {
    // A hexagon's corners are farther out than its walls.
    const double out = (static_cast<double>(cells.rings) + 0.58) * cells.spacing;
    const double reach = cells.radius * (1 + cells.irregular);
    Box box;
    box.add(cells.center + glm::dvec3(0, 0.5 * cells.depth, 0),
            glm::dvec3(out, 0.5 * cells.depth, out) + reach);
    return box;
}

}  // namespace awan::implicit
