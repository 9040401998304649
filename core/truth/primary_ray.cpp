#include "core/truth/primary_ray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/truth/brick_walk.h"

namespace awan::truth {
namespace {

constexpr double kStep = 0.7;       // cells
constexpr double kStepDepth = 0.1;  // optical depth a step
// Of the largest bumps; the smallest are four times that.
constexpr double kDetailStep = 0.05;
// Optical depth: e^-30 of the light comes from behind it.
constexpr double kDark = 30;

// A listed particle that the ray meets, and where.
struct Met {
    const Matter::Listed* one;
    double from, to;
};

std::vector<Met> listed_along(const Matter& m, const glm::dvec3& o, const glm::dvec3& d,
                              double from, double to) {
    std::vector<Met> met;
    if (m.listed.empty()) return met;
    std::vector<std::uint32_t> near;
    for (BrickWalk walk(m, o, d, from, to); walk.inside(); walk.advance()) {
        const auto list = m.brick_begin.begin() + static_cast<std::ptrdiff_t>(walk.brick());
        near.insert(near.end(), m.brick_items.begin() + list[0], m.brick_items.begin() + list[1]);
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::uint32_t i : near) {
        const Matter::Listed& one = m.listed[i];
        const glm::dvec3 v = one.center - o;
        const double along = glm::dot(v, d);
        const glm::dvec3 aside = v - along * d;
        const double b2 = glm::dot(aside, aside);
        if (b2 >= one.reach2) continue;
        const double half = std::sqrt(one.reach2 - b2);
        met.push_back({&one, along - half, along + half});
    }
    return met;
}

}  // namespace

PrimaryRay::PrimaryRay(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double end) {
    if (m.empty) return;
    const BrickWalk inside(m, o, d, 0, end);
    if (!inside.inside()) return;
    double t = inside.enter();
    end = inside.end();
    const std::vector<Met> met = listed_along(m, o, d, t, end);
    const auto on_lattice = [&](double at) {
        if (m.extinction.empty()) return 0.0;
        const glm::dvec3 p = o + at * d;
        return with_detail(m, interpolated(m.extinction.data(), m.nodes, p.x, p.y, p.z), p);
    };
    const double longest =
        m.detail ? std::min(kStep, kDetailStep * m.detail->bump / m.cell) : kStep;
    double depth = 0, here = on_lattice(t), step = longest;
    t_.push_back(t);
    depth_.push_back(0);
    while (t < end && depth < kDark) {
        double next, there, more;
        for (;;) {
            next = std::min(t + step, end);
            there = on_lattice(next);
            more = 0.5 * (here + there) * (next - t);
            for (const Met& one : met)
                if (one.from < next && one.to > t) more += listed_depth(*one.one, o, d, t, next);
            // A step below rounding cannot be split any more.
            if (more <= kStepDepth || !(t + 0.25 * (next - t) > t) || step < 1e-9) break;
            step *= 0.5;
        }
        t = next;
        here = there;
        depth += more;
        step = std::min(2 * step, longest);
        if (more > 0 || t_.size() > 1) {
            t_.push_back(t);
            depth_.push_back(depth);
        } else {
            t_.back() = t;
        }
    }
}

double PrimaryRay::first_meeting(double share) const {
    // share = (1 - e^-depth) / (1 - e^-all)
    const double depth = -std::log1p(share * std::expm1(-depth_.back()));
    const auto above = std::upper_bound(depth_.begin(), depth_.end() - 1, depth);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - depth_.begin(), 1));
    const double rise = depth_[i] - depth_[i - 1];
    const double part = rise > 0 ? std::clamp((depth - depth_[i - 1]) / rise, 0.0, 1.0) : 0.5;
    return t_[i - 1] + part * (t_[i] - t_[i - 1]);
}

ParticleSet particles_near(const ParticleSet& particles, const glm::dvec3& eye,
                           const std::array<glm::dvec3, 4>& corners) {
    // The smallest cone about their middle: it holds all that is between them.
    const glm::dvec3 axis = glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]);
    double half = 0;
    for (const glm::dvec3& corner : corners)
        half = std::max(half,
                        std::atan2(glm::length(glm::cross(axis, corner)), glm::dot(axis, corner)));
    half += 1e-6;
    ParticleSet near;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 v = particles.center[i] - eye;
        const double distance = glm::length(v);
        const double reach = 9 * 0.5 * static_cast<double>(particles.radius[i]);
        if (distance > reach) {
            const double angle = std::atan2(glm::length(glm::cross(axis, v)), glm::dot(axis, v));
            if (angle > half + std::asin(reach / distance)) continue;
        }
        near.center.push_back(particles.center[i]);
        near.radius.push_back(particles.radius[i]);
        near.density.push_back(particles.density[i]);
    }
    return near;
}

}  // namespace awan::truth
