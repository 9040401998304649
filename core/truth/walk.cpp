// Free flights (flight.h), next-event estimation of the sun, and, against the noise of a narrow phase function,
// directions drawn from the sun's side.
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
#include <numbers>

namespace awan::truth {
namespace {

using std::numbers::pi;

constexpr double kFar = std::numeric_limits<double>::infinity();
// Weight below which paths are absorbed at random.
constexpr double kLight = 0.3;
constexpr double kSunDisc = 0.2665 * pi / 180;  // angular radius

}  // namespace

Flight free_flight(const Matter& m, const glm::dvec3& o, const glm::dvec3& d, double from,
                   double to, PathRandom& random) {
    Flight flight;
    Meeting unused;
    flight.collided = !m.empty && fly_from(m, m.axes * o + m.shift, m.axes * d, from, to, random,
                                           unused, flight.t);
    return flight;
}

namespace {

struct Walk {
    const Setting& s;
    const Matter& matter;
    PathRandom& random;
    Tally& tally;
    // As the lattice has them.
    glm::dvec3 to_sun, up;
    double ground_height;
    bool sun_shines, sun_is_below;
    glm::dvec3 radiance{0};
    // Of scattering k since the start or the ground, at k mod kRing: its phase value, and the chance that each number
    // of directions was tried from it.
    static constexpr std::uint32_t kRing = 32;
    std::array<double, kRing> phase{}, tried{};

    Walk(const Setting& setting, PathRandom& numbers, Tally& all)
        : s(setting),
          matter(*setting.matter),
          random(numbers),
          tally(all),
          to_sun(matter.axes * s.to_sun),
          up(matter.axes * glm::dvec3(0, 1, 0)),
          ground_height(s.ground_height + glm::dot(up, matter.shift)),
          sun_shines(s.sun_irradiance != glm::dvec3(0)),
          sun_is_below(s.has_ground && s.to_sun.y < 0) {}

    // t of the ground ahead, as ground_ahead.
    double ground_from(const glm::dvec3& q, const glm::dvec3& d) const {
        if (!s.has_ground) return kFar;
        const double down = -glm::dot(up, d), above = glm::dot(up, q) - ground_height;
        return down > 0 && above > 0 ? above / down : kFar;
    }

    bool sun_up(const glm::dvec3& q) const {
        return !(sun_is_below && glm::dot(up, q) > ground_height);
    }

    // Chance of drawing directions from the sun at a place of that depth: there is little use of them where it does not
    // shine. Measured on table 4.4 of Sunar et al. 2005: wider costs more time than it saves noise.
    static double worth(double depth) {
        return depth < 6 ? 1.0 : depth > 40 ? 0.0 : std::exp(0.2 * (6 - depth));
    }

    static double mean(const glm::dvec3& weight) { return (weight.x + weight.y + weight.z) / 3; }

    // Absorption: first by weight, which costs no noise. From kLight on at random, with the chance that matter or
    // ground take, so that weights stay where they are: a rarer and heavier path would bring noise in single bright
    // pixels. False: it was absorbed.
    bool survives(const glm::dvec3& before, glm::dvec3& after) {
        if (after == before) return true;
        const double most = std::max({after.x, after.y, after.z});
        if (most < kLight) {
            const double chance = std::min(most / std::max({before.x, before.y, before.z}), 1.0);
            if (!(random.unit() < chance)) {
                tally.absorbed += mean(before);
                return false;
            }
            after /= chance;
        }
        tally.absorbed += mean(before) - mean(after);
        return true;
    }

    // Directions from the sun's side, from scattering k (ring entry `k`, order `order`) at q, reached along d.
    void from_sun_side(std::uint32_t k, std::uint32_t order, const glm::dvec3& q,
                       const glm::dvec3& d, glm::dvec3 weight, double worth_here, int m) {
        if (order + static_cast<std::uint32_t>(m) > s.max_orders) return;
        std::array<glm::dvec3, kMaxFromSun + 1> e;
        // The phase functions are even in the angle: drawn backwards, a direction has the same density.
        e[0] = to_sun;
        for (int i = 1; i <= m; ++i)
            e[static_cast<std::size_t>(i)] =
                scattered(s.phase, e[static_cast<std::size_t>(i - 1)], random);
        const auto at = [&](std::uint32_t i) { return i % kRing; };
        phase[at(k)] = phase_value(s.phase, glm::dot(d, e[static_cast<std::size_t>(m)]));
        tried[at(k)] = worth_here;
        Meeting here;
        here.at = q;
        for (int i = m; i >= 1; --i) {
            const glm::dvec3& along = e[static_cast<std::size_t>(i)];
            if (!fly(matter, here.at, along, ground_from(here.at, along), random, here)) return;
            weight *= s.albedo;
            if (matter.colored) weight *= color_in_lattice(matter, here.at);
            ++k;
            phase[at(k)] =
                phase_value(s.phase, glm::dot(along, e[static_cast<std::size_t>(i - 1)]));
            tried[at(k)] = worth(here.depth);
        }
        if (sun_up(here.at)) add_sun(k, weight, here);
    }

    // The path's last scattering is number k, of which phase[k] is the value towards the sun.
    void add_sun(std::uint32_t k, const glm::dvec3& weight, const Meeting& met) {
        const double through = sun_through(matter, met, to_sun, random);
        if (!(through > 0)) return;
        if (s.from_sun == 0) {
            radiance += weight * (through * phase[k % kRing] / (4 * pi)) * s.sun_irradiance;
            return;
        }
        double sum = 1 / phase[k % kRing];
        const auto most = std::min(static_cast<std::uint32_t>(s.from_sun), k);
        for (std::uint32_t m = 1; m <= most; ++m)
            sum += tried[(k - m) % kRing] / (s.from_sun * phase[(k - m) % kRing]);
        radiance += weight * (through / (4 * pi * sum)) * s.sun_irradiance;
    }

    // From the ground, which may lie outside the box, or from matter.
    bool flies(const glm::dvec3& q, const glm::dvec3& d, bool on_ground, double to, Meeting& met) {
        double unused;
        return on_ground ? fly_from(matter, q, d, 0, to, random, met, unused)
                         : fly(matter, q, d, to, random, met);
    }

    glm::dvec3 sky_from(const glm::dvec3& d) const { return sky_radiance(s, d * matter.axes); }

    void sky_by_next_event(const glm::dvec3& q, bool on_ground, const glm::dvec3& along,
                           const glm::dvec3& weight) {
        Meeting unused;
        if (std::isinf(ground_from(q, along)) && !flies(q, along, on_ground, kFar, unused))
            radiance += weight * sky_from(along);
    }

    // A direction within the sun's disc, even over it; to the sun where those below the ground would be tried for ever.
    glm::dvec3 in_sun_disc() {
        for (int draw = 0; draw < 128; ++draw) {
            const PathRandom::Pair q = random.signed_pair();
            if (!(q.a * q.a + q.b * q.b < 1)) continue;
            const glm::dvec3 d =
                glm::normalize(s.to_sun + kSunDisc * (q.a * s.sun_u + q.b * s.sun_v));
            if (d.y > 0) return matter.axes * d;
        }
        return to_sun;
    }

    glm::dvec3 off_ground() {
        // Lambert's cosine: uniform in the disc, raised to the hemisphere (Malley).
        for (int draw = 0; draw < 128; ++draw) {
            const PathRandom::Pair q = random.signed_pair();
            const double r2 = q.a * q.a + q.b * q.b;
            if (r2 < 1) return matter.axes * glm::dvec3(q.a, std::sqrt(1 - r2), q.b);
        }
        return up;
    }

    void sun_on_ground(const glm::dvec3& q, const glm::dvec3& weight) {
        Meeting unused;
        if (sun_shines && s.to_sun.y > 0 && !flies(q, in_sun_disc(), true, kFar, unused))
            radiance += weight * (s.to_sun.y / pi) * s.sun_irradiance;
    }

    // Sunlight at scattering k of the path.
    void sun_on_matter(std::uint32_t k, std::uint32_t orders, const Meeting& here,
                       const glm::dvec3& d, const glm::dvec3& weight) {
        if (sun_up(here.at)) {
            phase[k % kRing] = phase_value(s.phase, glm::dot(d, to_sun));
            add_sun(k, weight, here);
        }
        if (s.from_sun == 0) return;
        const double chance = worth(here.depth);
        if (chance > 0 && random.unit() < chance)
            from_sun_side(k, orders, here.at, d, weight, chance,
                          std::min(static_cast<int>(random.unit() * s.from_sun) + 1, s.from_sun));
        tried[k % kRing] = chance;
    }

    // here, d: in the lattice.
    void run(bool on_ground, Meeting here, glm::dvec3 d) {
        glm::dvec3 weight(1);
        const bool sky = s.dome.shines;
        std::uint32_t orders = 0, since_start = 0;
        for (std::uint32_t event = 0;; ++event) {
            const glm::dvec3 before = weight;
            glm::dvec3 on;
            if (on_ground) {
                weight *= s.ground_albedo;
                sun_on_ground(here.at, weight);
                since_start = 0;
                if (sky && s.sky == SkySampling::kNextEvent)
                    sky_by_next_event(here.at, true, off_ground(), weight);
                if (!survives(before, weight)) return;
                on = off_ground();
            } else {
                ++orders;
                tally.scatterings += 1;
                weight *= s.albedo;
                if (matter.colored) weight *= color_in_lattice(matter, here.at);
                const std::uint32_t k = since_start++;
                if (sun_shines) sun_on_matter(k, orders, here, d, weight);
                if (sky && s.sky == SkySampling::kNextEvent)
                    sky_by_next_event(here.at, false, scattered(s.phase, d, random), weight);
                if (!survives(before, weight)) return;
                on = scattered(s.phase, d, random);
                if (s.from_sun > 0) phase[k % kRing] = phase_value(s.phase, glm::dot(d, on));
            }
            d = on;
            const double ground = ground_from(here.at, d);
            if (flies(here.at, d, on_ground, ground, here)) {
                on_ground = false;
            } else if (std::isinf(ground)) {
                tally.escaped += mean(weight);
                if (sky && s.sky == SkySampling::kEscape) radiance += weight * sky_from(d);
                return;
            } else {
                here.at += ground * d;
                here.at += (ground_height - glm::dot(up, here.at)) * up;
                on_ground = true;
            }
            if ((!on_ground && orders == s.max_orders) || event == kMaxOrders) {
                tally.cut_off += mean(weight);
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
    Walk walk(setting, random, tally);
    const Matter& m = *setting.matter;
    Meeting here;
    here.at = m.axes * p + m.shift;
    here.depth = depth_to_sun_at(m, here.at);
    walk.run(false, here, m.axes * d);
    return walk.radiance;
}

glm::dvec3 walk_from_ground(const Setting& setting, const glm::dvec3& p, PathRandom& random,
                            Tally& tally) {
    Walk walk(setting, random, tally);
    const Matter& m = *setting.matter;
    Meeting here;
    here.at = m.axes * p + m.shift;
    walk.run(true, here, -(m.axes * glm::dvec3(0, 1, 0)));
    return walk.radiance;
}

}  // namespace awan::truth
