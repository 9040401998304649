#include "core/truth/flight.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/truth/brick_sample.h"
#include "core/truth/brick_walk.h"

namespace awan::truth {
namespace {

// Optical depth: e^-60 of the sun is none.
constexpr double kNoSun = 60;

// A place within the matter's box; the fourth lane is 0. In float: 1e-5 cells are below all that is asked of it.
Four four(const glm::dvec3& v) {
    return Four{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
glm::dvec3 place(const Four& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

float exponential(PathRandom& random) {
    return -std::log(random.unit_float());
}

// t in [a, b] at which the listed particles of a brick have given optical depth `left` from a on.
double where_listed(const Matter& m, std::size_t brick, const glm::dvec3& o, const glm::dvec3& d,
                    double a, double b, double left) {
    double low = a, high = b;
    for (int i = 0; i < 100; ++i) {
        const double t = 0.5 * (low + high);
        if (t <= low || t >= high) break;
        double depth = 0;
        for (std::uint32_t k = m.brick_begin[brick]; k < m.brick_begin[brick + 1]; ++k)
            depth += listed_depth(m.listed[m.brick_items[k]], o, d, a, t);
        (depth < left ? low : high) = t;
    }
    return 0.5 * (low + high);
}

// A flight and what it still has ahead of it, in optical depth: of the lattice's matter as its majorants have it, and
// of listed particles. The two race.
struct Race {
    const Matter& m;
    const glm::dvec3& o;
    const glm::dvec3& d;
    // In float 1e-5 cells are lost at most: below all that is asked of the lattice.
    Four from, along;
    PathRandom& random;
    Meeting& meeting;
    float ahead;
    double listed_ahead = 0;
    std::uint32_t tentative = 0;

    enum class Look { kNothing, kMatter, kEnough };

    // Whether there is matter at t, in a brick of which this is the first node.
    template <bool kDetailed>
    Look look(const Brick& brick, const Four& first, float t) {
        const Four q = from + t * along, local = q - first;
        const Sampled found = sampled(m, in_cell(brick.nodes, local[0], local[1], local[2]));
        const float matter = kDetailed
                                 ? static_cast<float>(with_detail(m, found.extinction, place(q)))
                                 : found.extinction;
        if (random.unit_float() * brick.most < matter) {
            meeting = {place(q), static_cast<double>(found.depth)};
            if (!m.listed.empty()) meeting.depth += listed_depth_to_sun(m, meeting.at);
            return Look::kMatter;
        }
        if (++tentative > kMaxTentative) return Look::kEnough;
        ahead = exponential(random);
        return Look::kNothing;
    }

    // Whether a listed particle of the brick is met between t and `leave`; then that is where `leave` is.
    bool listed_before(std::size_t brick, float t, double& leave) {
        const auto start = static_cast<double>(t);
        double depth = 0;
        for (std::uint32_t k = m.brick_begin[brick]; k < m.brick_begin[brick + 1]; ++k)
            depth += listed_depth(m.listed[m.brick_items[k]], o, d, start, leave);
        if (depth > listed_ahead) {
            leave = where_listed(m, brick, o, d, start, leave, listed_ahead);
            return true;
        }
        listed_ahead -= depth;
        return false;
    }

    void meet_listed(double t) {
        meeting.at = o + t * d;
        meeting.depth = depth_to_sun_at(m, meeting.at);
    }
};

// Within a brick and as far as `to`.
bool still_in(const Four& local, float t, float to) {
    constexpr auto kSide = static_cast<float>(kBrick);
    return t < to && local[0] >= 0 && local[1] >= 0 && local[2] >= 0 && local[0] <= kSide &&
           local[1] <= kSide && local[2] <= kSide;
}

template <bool kDetailed>
bool run(Race& race, float to) {
    constexpr auto kSide = static_cast<float>(kBrick);
    using Look = Race::Look;
    const Matter& m = race.m;
    const Four &o = race.from, &d = race.along;
    int at[3];
    for (int a = 0; a < 3; ++a)
        at[a] = std::clamp(static_cast<int>(o[a] * (1.0f / kSide)), 0, m.bricks[a] - 1);
    const std::ptrdiff_t strides[3] = {static_cast<std::ptrdiff_t>(m.bricks.y) * m.bricks.z,
                                       m.bricks.z, 1};
    std::ptrdiff_t brick = at[0] * strides[0] + at[1] * strides[1] + at[2];
    float t = 0;
    const auto corner = [&] {
        return Four{static_cast<float>(at[0] * kBrick), static_cast<float>(at[1] * kBrick),
                    static_cast<float>(at[2] * kBrick), 0};
    };
    // In dense matter most flights end in the brick they begin in; this needs no borders.
    if (const Brick here = m.brick[static_cast<std::size_t>(brick)];
        here.most > 0 && !here.listed) {
        const float per_most = 1 / here.most;
        const Four first = corner();
        for (;;) {
            const float further = t + race.ahead * per_most;
            if (!still_in(o + further * d - first, further, to)) break;
            t = further;
            const Look seen = race.look<kDetailed>(here, first, t);
            if (seen != Look::kNothing) return seen == Look::kMatter;
        }
    }
    // By axis: t of the brick's far side, t from side to side, and how many bricks are left.
    float next[3], side[3];
    int left[3], way[3];
    for (int a = 0; a < 3; ++a) {
        const bool up = d[a] >= 0;
        const float per = 1 / (std::abs(d[a]) < 1e-20f ? 1e-20f : std::abs(d[a]));
        way[a] = up ? 1 : -1;
        left[a] = up ? m.bricks[a] - 1 - at[a] : at[a];
        const float ahead = static_cast<float>(at[a] + (up ? 1 : 0)) * kSide - o[a];
        next[a] = (up ? ahead : -ahead) * per;
        side[a] = kSide * per;
    }
    for (;;) {
        const int axis =
            next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
        float leave = std::min(next[axis], to);
        const Brick here = m.brick[static_cast<std::size_t>(brick)];
        bool listed = false;
        double meets = 0;
        if (here.listed && t < leave) {
            meets = static_cast<double>(leave);
            listed = race.listed_before(static_cast<std::size_t>(brick), t, meets);
            leave = static_cast<float>(meets);
        }
        if (here.most > 0) {
            const float per_most = 1 / here.most;
            const Four first = corner();
            for (;;) {
                const float further = t + race.ahead * per_most;
                if (!(further < leave)) break;
                t = further;
                const Look seen = race.look<kDetailed>(here, first, t);
                if (seen != Look::kNothing) return seen == Look::kMatter;
            }
            race.ahead -= std::max(leave - t, 0.0f) * here.most;
        }
        if (listed) {
            race.meet_listed(meets);
            return true;
        }
        t = std::max(t, leave);
        if (!(t < to) || left[axis]-- == 0) return false;
        brick += way[axis] * strides[axis];
        at[axis] += way[axis];
        next[axis] += side[axis];
    }
}

}  // namespace

bool fly(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double to, PathRandom& random,
         Meeting& meeting) {
    if (m.empty) return false;
    const glm::dvec3 start = o;
    Race race{m, start, d, four(start), four(d), random, meeting, exponential(random)};
    if (!m.listed.empty()) race.listed_ahead = static_cast<double>(exponential(random));
    const auto end = static_cast<float>(to);
    return m.detail ? run<true>(race, end) : run<false>(race, end);
}

bool fly_from(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double from, double to,
              PathRandom& random, Meeting& meeting, double& t) {
    if (m.empty) return false;
    const BrickWalk walk(m, o, d, from, to);
    if (!walk.inside()) return false;
    const glm::dvec3 enters = o + walk.enter() * d;
    if (!fly(m, enters, d, walk.end() - walk.enter(), random, meeting)) return false;
    t = walk.enter() + glm::dot(meeting.at - enters, d);
    return true;
}

double sun_through(const Matter& m, const Meeting& meeting, const glm::dvec3& to_sun,
                   PathRandom& random) {
    if (m.detail) {
        Meeting unused;
        return fly(m, meeting.at, to_sun, INFINITY, random, unused) ? 0 : 1;
    }
    return meeting.depth < kNoSun
               ? static_cast<double>(std::exp(-static_cast<float>(meeting.depth)))
               : 0;
}

}  // namespace awan::truth
