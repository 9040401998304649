// Delta tracking (Woodcock et al. 1965) through bricks with majorants of their own, next-event estimation of the sun,
// and, against the noise of a narrow phase function, directions drawn from the sun's side.
//
// The last of these is bidirectional path tracing (Veach 1997) in directions only: since the sun's rays are parallel
// and the phase function is the same everywhere, a path's directions d_0 (from the eye), ..., d_(n-1), sun can be
// drawn from either end, while its free flights are always drawn from the eye's. Technique m draws the last m
// directions backwards from the sun, e_1 about it, e_2 about e_1, ...; the one scattering whose two directions were
// drawn from different ends, number n - m, is weighted by its phase value p_(n-m). Its density is the product of all
// p_i but that one, so the balance heuristic gives a path that any of the techniques drew, each tried with
// probability q, the weight
//     transmittance / sum_m (q_m / p_(n-m)).
// Plain next-event estimation (m = 0) alone weights it by p_n, whose relative variance in diffuse light is
// 2 g^2 / (1 - g)^2 or so; a sum over a few m has that of a phase function of mean cosine g^(m+1).
#include "core/truth/walk.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/truth/brick_walk.h"

namespace awan::truth {
namespace {

using std::numbers::pi;

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kSunDisc = 0.2665 * pi / 180;  // angular radius
// Optical depth: e^-60 of the sun is none.
constexpr double kNoSun = 60;

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

}  // namespace

Flight free_flight(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double from,
                   double to, PathRandom& random) {
    if (m.empty) return {};
    BrickWalk walk(m, o, d, from, to);
    if (!walk.inside()) return {};
    const float* values = m.extinction.data();
    const bool has_list = !m.listed.empty();
    double left = static_cast<double>(-std::log(random.unit_float()));
    double listed_left = has_list ? static_cast<double>(-std::log(random.unit_float())) : 0.0;
    std::uint32_t tentative = 0;
    for (; walk.inside(); walk.advance()) {
        const std::size_t brick = walk.brick();
        double t = walk.enter(), leave = walk.leave();
        bool listed = false;
        if (has_list && m.brick_begin[brick] != m.brick_begin[brick + 1] && t < leave) {
            double depth = 0;
            for (std::uint32_t k = m.brick_begin[brick]; k < m.brick_begin[brick + 1]; ++k)
                depth += listed_depth(m.listed[m.brick_items[k]], o, d, t, leave);
            if (depth > listed_left) {
                leave = where_listed(m, brick, o, d, t, leave, listed_left);
                listed = true;
            } else {
                listed_left -= depth;
            }
        }
        const double most = static_cast<double>(m.most[brick]);
        if (most > 0) {
            const double per_most = 1 / most;
            for (;;) {
                const double further = t + left * per_most;
                if (!(further < leave)) break;
                t = further;
                const float smooth =
                    interpolated(values, m.nodes, o.x + t * d.x, o.y + t * d.y, o.z + t * d.z);
                const float here =
                    m.detail ? static_cast<float>(with_detail(m, smooth, o + t * d)) : smooth;
                if (random.unit_float() * m.most[brick] < here) return {true, t};
                if (++tentative > kMaxTentative) return {};
                left = static_cast<double>(-std::log(random.unit_float()));
            }
            left -= std::max(leave - t, 0.0) * most;
        }
        if (listed) return {true, leave};
    }
    return {};
}

namespace {

struct Walk {
    const Setting& s;
    PathRandom& random;
    Tally& tally;
    glm::dvec3 radiance{0};
    // Of scattering k since the start or the ground, at k mod kRing: its phase value, and the chance that each number
    // of directions was tried from it.
    static constexpr std::uint32_t kRing = 32;
    std::array<double, kRing> phase{}, tried{};

    bool sun_up(const glm::dvec3& p) const {
        return !(s.has_ground && s.to_sun.y < 0 && p.y > s.ground_height);
    }

    // Chance of drawing directions from the sun at a place of that depth: there is little use of them where it does not
    // shine. Measured on table 4.4 of Sunar et al. 2005: wider costs more time than it saves noise.
    static double worth(double depth) {
        return depth < 6 ? 1.0 : depth > 40 ? 0.0 : std::exp(0.2 * (6 - depth));
    }

    void lose(const glm::dvec3& before, const glm::dvec3& after) {
        tally.absorbed += (before.x + before.y + before.z - after.x - after.y - after.z) / 3;
    }

    // Directions from the sun's side, from scattering k (ring entry `k`, order `order`) at p, reached along d.
    void from_sun_side(std::uint32_t k, std::uint32_t order, const glm::dvec3& p,
                       const glm::dvec3& d, glm::dvec3 weight, double worth_here, int m) {
        if (order + static_cast<std::uint32_t>(m) > s.max_orders) return;
        std::array<glm::dvec3, kMaxFromSun + 1> e;
        // The phase functions are even in the angle: drawn backwards, a direction has the same density.
        e[0] = s.to_sun;
        for (int i = 1; i <= m; ++i)
            e[static_cast<std::size_t>(i)] =
                scattered(s.phase, e[static_cast<std::size_t>(i - 1)], random);
        const auto at = [&](std::uint32_t i) { return i % kRing; };
        phase[at(k)] = phase_value(s.phase, glm::dot(d, e[static_cast<std::size_t>(m)]));
        tried[at(k)] = worth_here;
        glm::dvec3 here = p;
        double depth = 0;
        for (int i = m; i >= 1; --i) {
            const glm::dvec3& along = e[static_cast<std::size_t>(i)];
            const Flight flight =
                free_flight(*s.matter, here, along, 0, ground_ahead(s, here, along), random);
            if (!flight.collided) return;
            here += flight.t * along;
            depth = depth_to_sun(*s.matter, here);
            weight *= s.albedo;
            if (s.matter->colored) weight *= color_at(*s.matter, here);
            ++k;
            phase[at(k)] =
                phase_value(s.phase, glm::dot(along, e[static_cast<std::size_t>(i - 1)]));
            tried[at(k)] = worth(depth);
        }
        if (depth > kNoSun || !sun_up(here)) return;
        add_sun(k, weight, depth);
    }

    // The path's last scattering is number k, of which phase[k] is the value towards the sun.
    void add_sun(std::uint32_t k, const glm::dvec3& weight, double depth) {
        double sum = 1 / phase[k % kRing];
        const auto most = std::min(static_cast<std::uint32_t>(s.from_sun), k);
        for (std::uint32_t m = 1; m <= most; ++m)
            sum += tried[(k - m) % kRing] / (s.from_sun * phase[(k - m) % kRing]);
        radiance += weight * (std::exp(-depth) / (4 * pi * sum)) * s.sun_irradiance;
    }

    void sky_by_next_event(const glm::dvec3& p, const glm::dvec3& along, const glm::dvec3& weight) {
        const double ground = ground_ahead(s, p, along);
        if (std::isinf(ground) && !free_flight(*s.matter, p, along, 0, ground, random).collided)
            radiance += weight * sky_radiance(s, along);
    }

    // A direction within the sun's disc, even over it; s.to_sun where those below the ground would be tried for ever.
    glm::dvec3 in_sun_disc() {
        for (int draw = 0; draw < 128; ++draw) {
            const PathRandom::Pair q = random.signed_pair();
            if (!(q.a * q.a + q.b * q.b < 1)) continue;
            const glm::dvec3 d =
                glm::normalize(s.to_sun + kSunDisc * (q.a * s.sun_u + q.b * s.sun_v));
            if (d.y > 0) return d;
        }
        return s.to_sun;
    }

    glm::dvec3 off_ground() {
        // Lambert's cosine: uniform in the disc, raised to the hemisphere (Malley).
        for (int draw = 0; draw < 128; ++draw) {
            const PathRandom::Pair q = random.signed_pair();
            const double r2 = q.a * q.a + q.b * q.b;
            if (r2 < 1) return {q.a, std::sqrt(1 - r2), q.b};
        }
        return {0, 1, 0};
    }

    void run(bool on_ground, glm::dvec3 p, glm::dvec3 d) {
        const Matter& matter = *s.matter;
        glm::dvec3 weight(1);
        const bool sun = s.sun_irradiance != glm::dvec3(0);
        const bool sky = s.dome.shines;
        std::uint32_t orders = 0, since_start = 0;
        for (std::uint32_t event = 0;; ++event) {
            const glm::dvec3 before = weight;
            glm::dvec3 on;
            if (on_ground) {
                weight *= s.ground_albedo;
                lose(before, weight);
                if (weight == glm::dvec3(0)) return;
                if (sun && s.to_sun.y > 0 &&
                    !free_flight(matter, p, in_sun_disc(), 0, kFar, random).collided)
                    radiance += weight * (s.to_sun.y / pi) * s.sun_irradiance;
                since_start = 0;
                on = off_ground();
                if (sky && s.sky == SkySampling::kNextEvent) sky_by_next_event(p, on, weight);
                if (s.sky == SkySampling::kNextEvent) on = off_ground();
            } else {
                ++orders;
                tally.scatterings += 1;
                weight *= s.albedo;
                if (matter.colored) weight *= color_at(matter, p);
                lose(before, weight);
                if (weight == glm::dvec3(0)) return;
                const std::uint32_t k = since_start++;
                if (sun) {
                    const double depth = depth_to_sun(matter, p);
                    if (depth < kNoSun && sun_up(p)) {
                        phase[k % kRing] = phase_value(s.phase, glm::dot(d, s.to_sun));
                        add_sun(k, weight, depth);
                    }
                    if (s.from_sun > 0) {
                        const double chance = worth(depth);
                        if (chance > 0) {
                            if (random.unit() < chance)
                                from_sun_side(
                                    k, orders, p, d, weight, chance,
                                    std::min(static_cast<int>(random.unit() * s.from_sun) + 1,
                                             s.from_sun));
                        }
                        tried[k % kRing] = chance;
                    }
                }
                if (sky && s.sky == SkySampling::kNextEvent)
                    sky_by_next_event(p, scattered(s.phase, d, random), weight);
                on = scattered(s.phase, d, random);
                if (s.from_sun > 0) phase[k % kRing] = phase_value(s.phase, glm::dot(d, on));
            }
            // Russian roulette, once little is left to bring.
            const double most = std::max({weight.x, weight.y, weight.z});
            if (most < 0.1) {
                const double kept = most * 5;
                if (random.unit() >= kept) {
                    tally.absorbed += (weight.x + weight.y + weight.z) / 3;
                    return;
                }
                tally.absorbed +=
                    (weight.x + weight.y + weight.z) / 3 * (1 - 1 / kept);  // mean: unchanged
                weight /= kept;
            }
            d = on;
            const double ground = ground_ahead(s, p, d);
            const Flight flight = free_flight(matter, p, d, 0, ground, random);
            if (flight.collided) {
                p += flight.t * d;
                on_ground = false;
            } else if (std::isinf(ground)) {
                tally.escaped += (weight.x + weight.y + weight.z) / 3;
                if (sky && s.sky == SkySampling::kEscape) radiance += weight * sky_radiance(s, d);
                return;
            } else {
                p += ground * d;
                p.y = s.ground_height;
                on_ground = true;
            }
            if ((!on_ground && orders == s.max_orders) || event == kMaxOrders) {
                tally.cut_off += (weight.x + weight.y + weight.z) / 3;
                return;
            }
        }
    }
};

}  // namespace

glm::dvec3 sky_radiance(const Setting& setting, const glm::dvec3& direction) {
    const SkyDome& dome = setting.dome;
    if (!dome.shines) return glm::dvec3(0);
    if (dome.physical) return dome.intensity * radiance(dome.clear, direction);
    const double up = std::max(direction.y, 0.0);
    const double share = 1.09 * up * up / (up * up + 0.09);
    return (1 - share) * dome.horizon + share * dome.zenith;
}

int worthwhile_from_sun(double g) {
    const double size = std::abs(g);
    return size < 0.4 ? 0 : size < 0.6 ? 2 : size < 0.8 ? 4 : size < 0.9 ? 7 : 12;
}

Setting setting_of(const Scene& scene, const Matter& matter, const TruthOptions& options) {
    Setting s;
    s.matter = &matter;
    s.phase = phase_law(scene->medium);
    s.albedo = scene->medium.albedo;
    const Outside outside = outside_of(scene);
    s.to_sun = outside.to_sun;
    s.sun_irradiance = outside.sun;
    s.dome = outside.sky;
    const glm::dvec3 aside = std::abs(s.to_sun.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    s.sun_u = glm::normalize(glm::cross(s.to_sun, aside));
    s.sun_v = glm::cross(s.to_sun, s.sun_u);
    s.sky = options.sky;
    if (scene->ground) {
        s.has_ground = true;
        s.ground_height = (scene->ground->height - matter.origin.y) / matter.cell;
        s.ground_albedo = scene->ground->albedo;
    }
    s.max_orders = options.max_orders == 0 ? kMaxOrders : std::min(options.max_orders, kMaxOrders);
    s.from_sun = worthwhile_from_sun(s.phase.g);
    return s;
}

glm::dvec3 walk_from_matter(const Setting& setting, const glm::dvec3& p, const glm::dvec3& d,
                            PathRandom& random, Tally& tally) {
    Walk walk{setting, random, tally};
    walk.run(false, p, d);
    return walk.radiance;
}

glm::dvec3 walk_from_ground(const Setting& setting, const glm::dvec3& p, PathRandom& random,
                            Tally& tally) {
    Walk walk{setting, random, tally};
    walk.run(true, p, glm::dvec3(0, -1, 0));
    return walk.radiance;
}

}  // namespace awan::truth
