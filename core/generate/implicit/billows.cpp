// Kelvin-Helmholtz billows, and the particles of a table.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/implicit/procedures.h"
#include "core/generate/keyed_random.h"

namespace awan::implicit {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// No sheet that is smoothed comes this far from the middle; points that would are held.
constexpr double kSheetReach = 0.6;

// How fast the points of a sheet move (Krasny 1986, equations 2): periodic, each a vortex smoothed over d,
//   dx_i/dt = -1/2N sum_j sinh 2 pi (y_i - y_j) / D,    dy_i/dt = 1/2N sum_j sin 2 pi (x_i - x_j) / D,
//   D = cosh 2 pi (y_i - y_j) - cos 2 pi (x_i - x_j) + d^2.
// The functions of differences come from those of each point.
void sheet_velocity(const SheetLine& at, double d2, SheetLine& velocity) {
    struct Point {
        double sin, cos, sinh, cosh;
    };
    std::array<Point, kSheetPoints> of;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double x = kTurn * at[i].x, up = exact::exp(kTurn * at[i].y);
        of[i] = {exact::sin(x), exact::cos(x), 0.5 * (up - 1 / up), 0.5 * (up + 1 / up)};
    }
    const double share = 0.5 / static_cast<double>(at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
        glm::dvec2 sum(0);
        const Point& a = of[i];
        for (std::size_t j = 0; j < at.size(); ++j) {
            if (i == j) continue;
            const Point& b = of[j];
            const double under =
                1 / (a.cosh * b.cosh - a.sinh * b.sinh - (a.cos * b.cos + a.sin * b.sin) + d2);
            sum.x -= (a.sinh * b.cosh - a.cosh * b.sinh) * under;
            sum.y += (a.sin * b.cos - a.cos * b.sin) * under;
        }
        velocity[i] = share * sum;
    }
}

}  // namespace

std::vector<SheetLine> rolled_sheet(double amplitude, double smoothing, int steps) {
    SheetLine line(kSheetPoints);
    for (int i = 0; i < kSheetPoints; ++i) {
        const double along = static_cast<double>(i) / kSheetPoints;
        const double wave = amplitude * exact::sin(kTurn * along);
        line[static_cast<std::size_t>(i)] = {along + wave, -wave};
    }
    std::vector<SheetLine> all{line};
    const double d2 = smoothing * smoothing, dt = kSheetStep;
    SheetLine v[4];
    for (SheetLine& one : v) one.resize(kSheetPoints);
    const auto moved = [&](const SheetLine& by, double time) {
        SheetLine to = line;
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] += time * by[i];
            to[i].y = std::clamp(to[i].y, -kSheetReach, kSheetReach);
        }
        return to;
    };
    for (int step = 0; step < steps; ++step) {
        // Runge's and Kutta's fourth order.
        sheet_velocity(line, d2, v[0]);
        sheet_velocity(moved(v[0], dt / 2), d2, v[1]);
        sheet_velocity(moved(v[1], dt / 2), d2, v[2]);
        sheet_velocity(moved(v[2], dt), d2, v[3]);
        for (std::size_t i = 0; i < line.size(); ++i)
            v[0][i] = (v[0][i] + 2.0 * v[1][i] + 2.0 * v[2][i] + v[3][i]) / 6.0;
        line = moved(v[0], dt);
        all.push_back(line);
    }
    return all;
}

namespace {

// So many pieces stand for a wave.
constexpr int kPieces = 64;

// The sheet after `slide` wavelengths of sliding, closed by the next wave's first point.
SheetLine sheet_after(const std::vector<SheetLine>& sheet, double slide) {
    const double last = static_cast<double>(sheet.size() - 1);
    const double at = std::clamp(slide / kSheetStep, 0.0, last);
    const auto low = static_cast<std::size_t>(std::min(at, last - 1));
    const double part = at - static_cast<double>(low);
    SheetLine line;
    for (std::size_t i = 0; i < sheet[low].size(); ++i)
        line.push_back(sheet[low][i] + part * (sheet[low + 1][i] - sheet[low][i]));
    line.push_back(line[0] + glm::dvec2(1, 0));
    return line;
}

// A piece of the sheet: its middle, wavelengths, and how much longer the sheet is there than it was.
struct Piece {
    glm::dvec2 at;
    double longer;
};

// The line in pieces of one length.
std::vector<Piece> pieces_of(const SheetLine& line, double& length) {
    std::vector<double> along{0};
    for (std::size_t i = 1; i < line.size(); ++i)
        along.push_back(along.back() + glm::length(line[i] - line[i - 1]));
    length = along.back();
    const double usual = 1.0 / static_cast<double>(line.size() - 1);
    std::vector<Piece> pieces;
    std::size_t i = 1;
    for (int piece = 0; piece < kPieces; ++piece) {
        const double at = (piece + 0.5) * length / kPieces;
        while (i + 1 < along.size() && along[i] < at) ++i;
        const double own = std::max(along[i] - along[i - 1], 1e-9);
        const double part = (at - along[i - 1]) / own;
        pieces.push_back({line[i - 1] + part * (line[i] - line[i - 1]), own / usual});
    }
    return pieces;
}

}  // namespace

void add_billows(const ImplicitBillows& b, const std::vector<SheetLine>& sheet, std::uint64_t key,
                 double time, const Frame& frame, std::vector<Element>& elements) {
    const double slide = std::max(time - b.began, 0.0) * b.shear / b.wavelength;
    ImplicitPrimitive piece;
    piece.shape = ImplicitShape::kSegment;
    piece.radius = b.radius;
    piece.points = {{0, 0, -b.length / 2}, {0, 0, b.length / 2}};
    for (std::uint64_t wave = 0; wave < b.waves; ++wave) {
        const double chance = unit_open(static_cast<std::uint32_t>(keyed(key, wave) >> 32));
        double length = 1;
        const auto pieces =
            pieces_of(sheet_after(sheet, slide * (1 - b.variation * chance)), length);
        const double place = static_cast<double>(wave) - 0.5 * static_cast<double>(b.waves);
        // Pieces that overlap add up to about the weight: the cubic's mean over its diameter is 1/2.
        const double lies = length * b.wavelength / (kPieces * b.radius);
        for (const Piece& one : pieces) {
            piece.center = b.center + b.wavelength * glm::dvec3(place + one.at.x, one.at.y, 0);
            // What is drawn out is thinner, though not by all of it: the air around is moist too.
            piece.weight = b.weight * lies / std::sqrt(std::clamp(one.longer, 0.5, 8.0));
            add_elements(piece, false, 0, frame, elements);
        }
    }
}

Box billows_box(const ImplicitBillows& b, const std::vector<SheetLine>& sheet) {
    double high = 0;
    for (const SheetLine& line : sheet)
        for (const glm::dvec2& p : line) high = std::max(high, std::abs(p.y));
    Box box;
    // A wave that rolls up reaches hardly into the next.
    box.add(b.center, glm::dvec3((0.5 * static_cast<double>(b.waves) + 0.25) * b.wavelength,
                                 high * b.wavelength, 0.5 * b.length) +
                          b.radius);
    return box;
}

std::vector<ImplicitPrimitive> primitives_of(const std::vector<ImplicitParticle>& table) {
    std::vector<const ImplicitParticle*> rows;
    std::vector<double> times;
    for (const ImplicitParticle& row : table) rows.push_back(&row), times.push_back(row.time);
    std::sort(times.begin(), times.end());
    std::sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) {
        return a->id != b->id ? a->id < b->id : a->time < b->time;
    });
    std::vector<ImplicitPrimitive> all;
    const ImplicitParticle* before = nullptr;
    for (const ImplicitParticle* row : rows) {
        if (before == nullptr || before->id != row->id) {
            ImplicitPrimitive& born = all.emplace_back();
            const auto at = std::lower_bound(times.begin(), times.end(), row->time);
            if (at != times.begin()) {
                ImplicitKey& none = born.keys.emplace_back();
                none.time = *(at - 1);
                none.weight = 0;
            }
        }
        ImplicitKey& key = all.back().keys.emplace_back();
        key.time = row->time;
        key.center = row->center;
        key.radius = row->radius;
        key.weight = row->weight;
        before = row;
    }
    return all;
}

}  // namespace awan::implicit
