#include "core/truth/matter.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/truth/brick_sample.h"

namespace awan::truth {
namespace {

// Of a place in a brick that has nodes.
InCell in_cell_at(const glm::dvec3& q, const glm::ivec3& b, const Brick& brick) {
    const glm::dvec3 local = q - glm::dvec3(b * kBrick);
    return in_cell(brick.nodes, static_cast<float>(local.x), static_cast<float>(local.y),
                   static_cast<float>(local.z));
}

bool inside(const Matter& m, const glm::dvec3& q) {
    return !m.empty && glm::all(glm::greaterThanEqual(q, glm::dvec3(0))) &&
           glm::all(glm::lessThanEqual(q, m.lattice_top()));
}

// Extinction of the listed particles at q, per cell; visit(particle, its part).
template <typename Visit>
double listed_extinction(const Matter& m, std::size_t brick, const glm::dvec3& q,
                         const Visit& visit) {
    if (m.listed.empty()) return 0;
    double sum = 0;
    for (std::uint32_t i = m.brick_begin[brick]; i < m.brick_begin[brick + 1]; ++i) {
        const Matter::Listed& one = m.listed[m.brick_items[i]];
        const glm::dvec3 v = q - one.center;
        const double d2 = glm::dot(v, v);
        if (d2 >= one.reach2) continue;
        const double part = one.peak * exact::exp(-d2 / (2 * one.s * one.s));
        visit(one, part);
        sum += part;
    }
    return sum;
}

}  // namespace

glm::ivec3 brick_of(const Matter& m, const glm::dvec3& q) {
    // Cut first: a place far outside has no integer.
    return glm::min(glm::ivec3(glm::clamp(q, glm::dvec3(0), m.lattice_top()) / double{kBrick}),
                    m.bricks - 1);
}

double listed_depth(const Matter::Listed& one, const glm::dvec3& o, const glm::dvec3& d,
                    double from, double to) {
    const glm::dvec3 v = one.center - o;
    const double along = glm::dot(v, d);
    const glm::dvec3 aside = v - along * d;
    const double b2 = glm::dot(aside, aside);
    if (b2 >= one.reach2) return 0;
    const double half = std::sqrt(one.reach2 - b2);
    const double a = std::max(from, along - half) - along, b = std::min(to, along + half) - along;
    if (!(a < b)) return 0;
    const double per = 1 / (std::sqrt(2.0) * one.s);
    // Arguments of one sign: no difference of two numbers near 1.
    double part;
    if (a > 0)
        part = exact::erfc(a * per) - exact::erfc(b * per);
    else if (b < 0)
        part = exact::erfc(-b * per) - exact::erfc(-a * per);
    else
        part = exact::erf(b * per) - exact::erf(a * per);
    return std::max(
        one.peak * one.s * std::sqrt(std::numbers::pi / 2) * exact::exp(-b2 * per * per) * part,
        0.0);
}

float smooth_extinction_at(const Matter& m, const glm::dvec3& q) {
    if (!inside(m, q)) return 0;
    const glm::ivec3 b = brick_of(m, q);
    const Brick& brick = m.brick[m.brick_at(b)];
    return brick.nodes == kNoNodes ? 0 : sampled(m, in_cell_at(q, b, brick)).extinction;
}

double extinction(const Matter& m, const glm::dvec3& p) {
    const glm::dvec3 q = m.axes * p + m.shift;
    if (!inside(m, q)) return 0;
    return with_detail(m, smooth_extinction_at(m, q), q) +
           listed_extinction(m, m.brick_at(brick_of(m, q)), q,
                             [](const Matter::Listed&, double) {});
}

double listed_depth_to_sun(const Matter& m, const glm::dvec3& q) {
    if (m.listed.empty()) return 0;
    const glm::dvec3 top = m.lattice_top();
    if (q.x < 0 || q.y < 0 || q.x > top.x || q.y > top.y) return 0;
    const glm::ivec3 b = brick_of(m, q);
    const std::size_t column = m.column(b.x, b.y);
    double depth = 0;
    for (std::uint32_t i = m.column_begin[column]; i < m.column_begin[column + 1]; ++i) {
        const Matter::Listed& one = m.listed[m.column_items[i]];
        const double x = q.x - one.center.x, y = q.y - one.center.y, b2 = x * x + y * y;
        if (b2 >= one.reach2) continue;
        const double past = (q.z - one.center.z) / one.s;
        if (past < -9) continue;
        const double whole = one.peak * one.s * std::sqrt(2 * std::numbers::pi) *
                             exact::exp(-b2 / (2 * one.s * one.s));
        depth += past > 6 ? whole : whole * 0.5 * exact::erfc(-past * std::sqrt(0.5));
    }
    return depth;
}

double depth_to_sun_at(const Matter& m, const glm::dvec3& q) {
    if (m.empty) return 0;
    const glm::dvec3 top = m.lattice_top();
    if (q.x < 0 || q.y < 0 || q.z < 0 || q.x > top.x || q.y > top.y) return 0;
    glm::dvec3 at = q;
    glm::ivec3 b = brick_of(m, q);
    // Where there is no matter, the depth is that of where it ended.
    while (b.z >= 0 && m.brick[m.brick_at(b)].nodes == kNoNodes) --b.z;
    double depth = 0;
    if (b.z >= 0) {
        at.z = std::min(at.z, double{kBrick} * (b.z + 1));
        depth = static_cast<double>(sampled(m, in_cell_at(at, b, m.brick[m.brick_at(b)])).depth);
    }
    return depth + listed_depth_to_sun(m, q);
}

double depth_to_sun(const Matter& m, const glm::dvec3& p) {
    return m.empty ? 0 : depth_to_sun_at(m, m.axes * p + m.shift);
}

glm::dvec3 color_in_lattice(const Matter& m, const glm::dvec3& q) {
    if (!m.colored || !inside(m, q)) return glm::dvec3(1);
    const glm::ivec3 b = brick_of(m, q);
    const Brick& brick = m.brick[m.brick_at(b)];
    double whole = 0;
    glm::dvec3 sum(0);
    if (brick.nodes != kNoNodes) {
        const InCell at = in_cell_at(q, b, brick);
        whole = static_cast<double>(sampled(m, at).extinction);
        const glm::vec3* first = m.tints.data() + at.node;
        const auto row = [&](int i, int j) {
            const glm::vec3* v = first + (i * kBrickNodes + j) * kBrickNodes;
            return v[0] + at.z * (v[1] - v[0]);
        };
        const glm::vec3 near = row(0, 0) + at.y * (row(0, 1) - row(0, 0));
        const glm::vec3 far = row(1, 0) + at.y * (row(1, 1) - row(1, 0));
        sum = glm::dvec3(near + at.x * (far - near));
    }
    whole += listed_extinction(m, m.brick_at(b), q, [&](const Matter::Listed& one, double part) {
        sum += part * glm::dvec3(one.color);
    });
    // Of sums in float, each rounded by itself.
    return whole > 0 ? glm::clamp(sum / whole, 0.0, 1.0) : glm::dvec3(1);
}

glm::dvec3 color_at(const Matter& m, const glm::dvec3& p) {
    return m.colored ? color_in_lattice(m, m.axes * p + m.shift) : glm::dvec3(1);
}

}  // namespace awan::truth
