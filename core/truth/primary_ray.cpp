#include "core/truth/primary_ray.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/truth/brick_sample.h"
#include "core/truth/brick_walk.h"

namespace awan::truth {
namespace {

constexpr double kStepDepth = 0.1;    // optical depth a step
constexpr double kAimedDepth = 0.09;  // of a step that is tried first, if extinction stays as it is
constexpr double kShortest = 1e-9;    // cells
// Of the largest bumps; the smallest are four times that.
constexpr double kDetailStep = 0.05;
// Optical depth: e^-24 of the light, 4e-11, comes from behind it.
constexpr double kDark = 24;

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

// A ray's way through the tile that detail repeats.
class InTile {
  public:
    // o, d: q, of the lattice.
    InTile(const Matter& m, const glm::dvec3& o, const glm::dvec3& d) : m_(m) {
        if (!m.detail) return;
        const DetailField& field = *m.detail;
        from_ = field.to_tile * (m.origin + m.cell * ((o - m.shift) * m.axes) - field.origin);
        along_ = field.to_tile * (m.cell * (d * m.axes));
    }
    // At o + t d.
    double extinction(float smooth, double t) const {
        return with_bumps(m_, smooth, [&](const DetailField& field) {
            return bumps_in_tile(field, from_ + t * along_);
        });
    }

  private:
    const Matter& m_;
    glm::dvec3 from_{0}, along_{0};
};

// Where a ray leaves the cells of the lattice, one after the other.
class CellBorders {
  public:
    CellBorders(const glm::dvec3& o, const glm::dvec3& d) : o_(o), d_(d) {}

    // From t on.
    void start(double t) {
        for (int a = 0; a < 3; ++a) {
            side_[a] = 1 / std::max(std::abs(d_[a]), 1e-12);
            const double at = o_[a] + t * d_[a];
            next_[a] =
                t + (d_[a] > 0 ? std::floor(at) + 1 - at : at - std::ceil(at) + 1) * side_[a];
        }
    }
    // The first after t; t rises from call to call.
    double after(double t) {
        for (int a = 0; a < 3; ++a)
            while (next_[a] <= t) next_[a] += side_[a];
        return std::min({next_[0], next_[1], next_[2]});
    }

  private:
    const glm::dvec3 o_, d_;
    double next_[3]{}, side_[3]{};
};

}  // namespace

PrimaryRay::PrimaryRay(const Matter& m, const glm::dvec3& from, const glm::dvec3& along,
                       double end) {
    if (m.empty || !(end > 0)) return;
    const glm::dvec3 o = m.axes * from + m.shift, d = m.axes * along;
    BrickWalk walk(m, o, d, 0, end);
    if (!walk.inside()) return;
    const std::vector<Met> met = listed_along(m, o, d, walk.enter(), walk.end());
    CellBorders borders(o, d);
    const InTile in_tile(m, o, d);
    const double longest = m.detail ? kDetailStep * m.detail->bump / m.cell : INFINITY;
    double depth = 0;
    const auto add = [&](double t, double extinction) {
        t_.push_back(t);
        depth_.push_back(depth);
        extinction_.push_back(extinction);
    };
    for (; walk.inside() && depth < kDark; walk.advance()) {
        const Brick& brick = m.brick[walk.brick()];
        if (brick.nodes == kNoNodes && brick.listed == 0) continue;
        const glm::dvec3 corner(walk.at() * kBrick);
        const auto extinction_at = [&](double at) {
            if (brick.nodes == kNoNodes) return 0.0;
            const glm::dvec3 local = o + at * d - corner;
            const InCell in = in_cell(brick.nodes, static_cast<float>(local.x),
                                      static_cast<float>(local.y), static_cast<float>(local.z));
            return in_tile.extinction(sampled(m, in).extinction, at);
        };
        double t = walk.enter(), here = extinction_at(t);
        borders.start(t);
        const double leave = walk.leave();
        if (t_.empty() || t_.back() < t) add(t, here);
        while (t < leave && depth < kDark) {
            const double aimed = here > 0 ? kAimedDepth / here : INFINITY;
            double next = std::min({borders.after(t), leave, t + std::min(longest, aimed)});
            if (!(next > t + kShortest)) next = std::min(leave, t + kShortest);
            double there, more;
            for (;;) {
                // Simpson's rule: trilinear along a ray is a cubic within a cell.
                there = extinction_at(next);
                more = (here + 4 * extinction_at(0.5 * (t + next)) + there) * (next - t) / 6;
                for (const Met& one : met)
                    if (one.from < next && one.to > t)
                        more += listed_depth(*one.one, o, d, t, next);
                // A step below rounding cannot be split any more.
                if (more <= kStepDepth || next - t < kShortest || !(0.5 * (t + next) > t)) break;
                next = 0.5 * (t + next);
            }
            t = next;
            here = there;
            depth += more;
            add(t, here);
        }
    }
}

double PrimaryRay::first_meeting(double share) const {
    // share = (1 - e^-depth) / (1 - e^-all)
    const double depth = -exact::log1p(share * exact::expm1(-depth_.back()));
    const auto above = std::upper_bound(depth_.begin(), depth_.end() - 1, depth);
    const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - depth_.begin(), 1));
    const double rise = depth_[i] - depth_[i - 1];
    const double part = rise > 0 ? std::clamp((depth - depth_[i - 1]) / rise, 0.0, 1.0) : 0.5;
    // Where extinction a + (b - a) x has gathered that part of what it has up to x = 1.
    const double a = extinction_[i - 1], b = extinction_[i];
    const double x =
        a + b > 0 ? part * (a + b) / (a + std::sqrt(a * a + part * (b * b - a * a))) : part;
    return t_[i - 1] + std::clamp(x, 0.0, 1.0) * (t_[i] - t_[i - 1]);
}

ParticleSet particles_near(const ParticleSet& particles, const glm::dvec3& eye,
                           const std::array<glm::dvec3, 4>& corners) {
    // The smallest cone about their middle: it holds all that is between them.
    const glm::dvec3 axis = glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]);
    double half = 0;
    for (const glm::dvec3& corner : corners)
        half = std::max(
            half, exact::atan2(glm::length(glm::cross(axis, corner)), glm::dot(axis, corner)));
    half += 1e-6;
    const double sine = exact::sin(half), cosine = exact::cos(half);
    ParticleSet near;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 v = particles.center[i] - eye;
        const double reach = 9 * 0.5 * static_cast<double>(particles.radius[i]);
        const double along = glm::dot(v, axis), aside = glm::length(v - along * axis);
        // From the cone's side, or, behind its tip, from that.
        const double outside =
            along * cosine + aside * sine > 0 ? aside * cosine - along * sine : glm::length(v);
        if (outside > reach) continue;
        near.center.push_back(particles.center[i]);
        near.radius.push_back(particles.radius[i]);
        near.density.push_back(particles.density[i]);
    }
    return near;
}

}  // namespace awan::truth
