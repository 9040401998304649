// Paths from scattering to scattering, as many side by side as a wave holds: whenever one ends, the next begins in its
// place. What happens at scatterings is in wave.cpp, flights are in flight.cpp; the ground is here.
#include "core/truth/walk.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "core/truth/brick_walk.h"
#include "core/truth/wave.h"

namespace awan::truth {
namespace {

using std::numbers::pi;

constexpr double kFar = std::numeric_limits<double>::infinity();
// An optical depth that nothing comes through.
constexpr float kDark = 1e4F;
constexpr double kSunDisc = 0.2665 * pi / 180;  // angular radius
// Scatterings of a wave between two looks at the time.
constexpr std::uint32_t kLook = 32;

WaveSetting wave_setting(const Setting& s, const glm::dvec3& to_sun, const glm::dvec3& up,
                         double ground) {
    WaveSetting w;
    w.phase = s.phase;
    w.albedo = static_cast<float>(s.albedo);
    w.from_sun = std::clamp(s.from_sun, 0, kMaxFromSun);
    w.max_orders = s.max_orders;
    w.colored = s.matter->colored;
    w.sun_shines = s.sun_irradiance != glm::dvec3(0);
    w.detail = s.matter->detail != nullptr;
    w.sun_is_below = s.has_ground && s.to_sun.y < 0;
    w.ground = static_cast<float>(ground);
    for (int a = 0; a < 3; ++a) {
        w.to_sun[a] = static_cast<float>(to_sun[a]);
        w.up[a] = static_cast<float>(up[a]);
    }
    return w;
}

class Walks {
  public:
    Walks(const Setting& setting, std::span<const Start> starts, std::span<Brought> brought,
          Tally& tally)
        : s_(setting),
          m_(*setting.matter),
          starts_(starts),
          brought_(brought),
          tally_(tally),
          to_sun_(m_.axes * s_.to_sun),
          up_(m_.axes * glm::dvec3(0, 1, 0)),
          ground_height_(s_.ground_height + glm::dot(up_, m_.shift)),
          lanes_(wave_setting(s_, to_sun_, up_, ground_height_)) {}

    bool run(const std::function<bool()>& over) {
        while (w_.count < kWave && begun_ < starts_.size()) begin(w_.count++);
        for (std::uint32_t step = 0; w_.count > 0; ++step) {
            if (over && step % kLook == 0 && over()) return false;
            if (lanes_.colored) tint(w_.path);
            scatter_waves(lanes_, w_);
            if (lanes_.sun_shines) sun();
            if (s_.dome.shines && s_.sky == SkySampling::kNextEvent) sky_by_next_event();
            turn_waves(lanes_, w_);
            fly_on();
            settle();
        }
        return true;
    }

  private:
    static double mean(const glm::dvec3& weight) { return (weight.x + weight.y + weight.z) / 3; }
    glm::dvec3 three(const OfWave<float> (&from)[3], std::size_t i) const {
        return {static_cast<double>(from[0][i]), static_cast<double>(from[1][i]),
                static_cast<double>(from[2][i])};
    }
    void set_weight(std::size_t i, const glm::dvec3& weight) {
        for (int a = 0; a < 3; ++a) w_.weight[a][i] = static_cast<float>(weight[a]);
    }
    // Numbers for what paths do one by one.
    PathRandom random_of(std::size_t i) {
        const std::uint64_t key =
            std::uint64_t{w_.random[0][i]} << 32 | (w_.random[3][i] ^ w_.random[1][i]);
        PathRandom random(key);
        seed(random.key(), randoms(), i);
        return random;
    }
    using Randoms = std::uint32_t* [4];
    const Randoms& randoms() const { return randoms_; }

    // In matter, or anywhere else the flights begin.
    Flights flights(WaveFlights& of, const OfWave<float> (&direction)[3], const float* to) {
        return {of.places(),
                {direction[0].data(), direction[1].data(), direction[2].data()},
                to,
                {randoms_[0], randoms_[1], randoms_[2], randoms_[3]},
                of.depth.data(),
                of.met.data()};
    }

    void begin(std::size_t i) {
        const Start& start = starts_[begun_];
        w_.start[i] = begun_++;
        seed(start.key, randoms_, i);
        for (int a = 0; a < 3; ++a) {
            w_.weight[a][i] = 1;
            w_.sunlight[a][i] = 0;
        }
        w_.absorbed[i] = 0;
        w_.orders[i] = w_.events[i] = 0;
        w_.other_light[i] = glm::dvec3(0);
        const glm::dvec3 q = m_.axes * start.p + m_.shift;
        w_.path.turn_to(i, m_.axes * start.d);
        if (start.on_ground)
            stand_on_ground(i, q);
        else {
            for (auto& share : w_.shares) share[i] = 0;
            w_.in_matter[i] = -1;
            w_.path.places().set(i, m_, q);
            w_.path.depth[i] = static_cast<float>(depth_to_sun_at(m_, w_.path.places().at(i)));
            if (is_in_hills_shadow(w_.path.places().at(i))) w_.path.depth[i] += kDark;
        }
    }

    // The places before that it has no directions from the sun's side any more: the ground scatters otherwise.
    void stand_on_ground(std::size_t i, const glm::dvec3& q) {
        for (auto& share : w_.shares) share[i] = 0;
        w_.in_matter[i] = 0;
        w_.on_ground[i] = q;
    }

    // In scene units and axes.
    glm::dvec3 scene_place(const glm::dvec3& q) const {
        return m_.origin + m_.cell * ((q - m_.shift) * m_.axes);
    }

    // Whether hills keep the sun from there.
    bool is_in_hills_shadow(const glm::dvec3& q) const {
        return s_.relief && hills_before(*s_.relief, scene_place(q), s_.to_sun);
    }

    // Matter in the shadow of hills is as good as behind much of it.
    void shade_by_hills(WaveFlights& of, std::span<const std::uint32_t> which) {
        if (!s_.relief || !lanes_.sun_shines) return;
        for (const std::uint32_t i : which)
            if (of.met[i] != 0 && is_in_hills_shadow(of.places().at(i))) of.depth[i] += kDark;
    }

    // Cells to the ground ahead, as ground_ahead.
    double ground_from(const glm::dvec3& q, const glm::dvec3& d) const {
        if (!s_.has_ground) return kFar;
        if (s_.relief) return ground_ahead(*s_.relief, scene_place(q), d * m_.axes) / m_.cell;
        const double down = -glm::dot(up_, d), above = glm::dot(up_, q) - ground_height_;
        return down > 0 && above > 0 ? above / down : kFar;
    }

    // The colours of matter where those flights have ended.
    void tint(WaveFlights& of) {
        for (std::size_t i = 0; i < w_.count; ++i) {
            const glm::dvec3 color = color_in_lattice(m_, of.places().at(i));
            for (int a = 0; a < 3; ++a) w_.tint[a][i] = static_cast<float>(color[a]);
        }
    }

    template <typename Wanted>
    std::span<const std::uint32_t> those(const Wanted& wanted) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < w_.count; ++i) {
            which_[count] = static_cast<std::uint32_t>(i);
            count += wanted(i) ? 1 : 0;
        }
        return {which_.data(), count};
    }

    // Branches towards the sun, and, with detail, whether sunlight reaches what it would light.
    void sun() {
        if (lanes_.detail) {
            shine(w_.path, w_.lit, those([&](std::size_t i) {
                      return w_.in_matter[i] != 0 && w_.lit[0][i] + w_.lit[1][i] + w_.lit[2][i] > 0;
                  }));
        }
        for (int left = lanes_.from_sun; left > 0; --left) {
            const auto which = those([&](std::size_t i) { return w_.branch_left[i] >= left; });
            if (which.empty()) continue;
            const auto& direction = w_.from_sun[left];
            if (s_.has_ground)
                for (const std::uint32_t i : which) {
                    glm::dvec3 d = three(direction, i);
                    w_.ground[i] = static_cast<float>(ground_from(w_.branch.places().at(i), d));
                }
            fly_all(m_, flights(w_.branch, direction, s_.has_ground ? w_.ground.data() : nullptr),
                    which);
            shade_by_hills(w_.branch, which);
            if (lanes_.colored) tint(w_.branch);
            follow_branches(lanes_, left, w_);
        }
        if (lanes_.detail && lanes_.from_sun > 0)
            shine(w_.branch, w_.branch_weight,
                  those([&](std::size_t i) { return w_.branch_left[i] > 0; }));
    }

    // Adds that light of paths whose way from there to the sun is free.
    void shine(WaveFlights& from, const OfWave<float> (&light)[3],
               std::span<const std::uint32_t> which) {
        for (const std::uint32_t i : which) {
            apart_.places().copy(i, from.places(), i);
            apart_.turn_to(i, to_sun_);
        }
        fly_all(m_, flights(apart_, apart_.direction, nullptr), which);
        for (const std::uint32_t i : which)
            if (apart_.met[i] == 0 && !is_in_hills_shadow(from.places().at(i)))
                for (int a = 0; a < 3; ++a) w_.sunlight[a][i] += light[a][i];
    }

    glm::dvec3 sky_from(const glm::dvec3& d) const { return sky_radiance(s_, d * m_.axes); }

    void sky_by_next_event() {
        const auto which =
            those([&](std::size_t i) { return w_.in_matter[i] != 0 && w_.gone[i] == 0; });
        for (const std::uint32_t i : which) {
            PathRandom random = random_of(i);
            const glm::dvec3 d = scattered(s_.phase, w_.path.along(i), random);
            apart_.places().copy(i, w_.path.places(), i);
            apart_.turn_to(i, d);
        }
        fly_all(m_, flights(apart_, apart_.direction, nullptr), which);
        for (const std::uint32_t i : which) {
            const glm::dvec3 d = apart_.along(i);
            if (apart_.met[i] == 0 && std::isinf(ground_from(w_.path.places().at(i), d)))
                w_.other_light[i] += three(w_.weight, i) * sky_from(d);
        }
    }

    // Puts a flight from the ground to where it comes into the matter's box, not farther than `until`. False: it does
    // not.
    bool enters(std::size_t i, const glm::dvec3& d, WaveFlights& of, double until = kFar) {
        if (m_.empty) return false;
        const glm::dvec3& q = w_.on_ground[i];
        const BrickWalk box(m_, q, d, 0, kFar);
        if (!box.inside() || box.enter() > until) return false;
        of.places().set(i, m_, q + box.enter() * d);
        of.turn_to(i, d);
        return true;
    }

    // A direction within the sun's disc, even over it; to the sun where those below the ground would be tried for ever.
    glm::dvec3 in_sun_disc(PathRandom& random) const {
        for (int draw = 0; draw < 128; ++draw) {
            const PathRandom::Pair q = random.signed_pair();
            if (!(q.a * q.a + q.b * q.b < 1)) continue;
            const glm::dvec3 d =
                glm::normalize(s_.to_sun + kSunDisc * (q.a * s_.sun_u + q.b * s_.sun_v));
            if (d.y > 0) return m_.axes * d;
        }
        return to_sun_;
    }

    // Of the ground where path i stands: albedo, and unit normal in the lattice's axes.
    glm::dvec3 normal_here(std::size_t i) const {
        if (!s_.relief) return up_;
        const glm::dvec3 p = scene_place(w_.on_ground[i]);
        return m_.axes * normal_at(*s_.relief->relief, p.x, p.z);
    }
    glm::dvec3 albedo_here(std::size_t i) const {
        if (!s_.relief) return s_.ground_albedo;
        const glm::dvec3 p = scene_place(w_.on_ground[i]);
        return albedo_at(*s_.relief->relief, p.x, p.z, normal_at(*s_.relief->relief, p.x, p.z));
    }

    glm::dvec3 off_ground(std::size_t i, PathRandom& random) const {
        return s_.relief ? scattered_off(normal_here(i), random) : off_ground(random);
    }

    glm::dvec3 off_ground(PathRandom& random) const {
        // Lambert's cosine: uniform in the disc, raised to the hemisphere (Malley).
        for (int draw = 0; draw < 128; ++draw) {
            const PathRandom::Pair q = random.signed_pair();
            const double r2 = q.a * q.a + q.b * q.b;
            if (r2 < 1) return m_.axes * glm::dvec3(q.a, std::sqrt(1 - r2), q.b);
        }
        return up_;
    }

    // As matter absorbs (wave.cpp).
    bool survives(std::size_t i, const glm::dvec3& before, glm::dvec3& after, PathRandom& random) {
        constexpr double kLight = 0.3;
        if (after == before) return true;
        const double most = std::max({after.x, after.y, after.z});
        if (most < kLight) {
            const double chance = std::min(most / std::max({before.x, before.y, before.z}), 1.0);
            if (!(random.unit() < chance)) {
                w_.absorbed[i] += static_cast<float>(mean(before));
                return false;
            }
            after /= chance;
        }
        w_.absorbed[i] += static_cast<float>(mean(before) - mean(after));
        return true;
    }

    // Light that paths on the ground see in a direction, if no matter stands there.
    template <typename Contribution>
    void look_up(const std::vector<std::uint32_t>& from, const Contribution& light) {
        std::size_t count = 0;
        for (const std::uint32_t i : from) {
            const glm::dvec3 d = light.direction(i);
            apart_.met[i] = 0;
            apart_.turn_to(i, d);
            if (s_.relief && std::isfinite(ground_from(w_.on_ground[i], d)))
                apart_.met[i] = 1;
            else if (enters(i, d, apart_))
                which_[count++] = i;
        }
        fly_all(m_, flights(apart_, apart_.direction, nullptr), {which_.data(), count});
        for (const std::uint32_t i : from)
            if (apart_.met[i] == 0) w_.other_light[i] += light.value(i);
    }

    struct SunOnGround {
        Walks& w;
        glm::dvec3 direction(std::size_t i) const {
            PathRandom random = w.random_of(i);
            return w.in_sun_disc(random);
        }
        glm::dvec3 value(std::size_t i) const {
            const glm::dvec3 weight = w.three(w.w_.weight, i);
            const Setting& s = w.s_;
            if (s.relief) {
                const double cosine = glm::dot(w.normal_here(i), w.apart_.along(i));
                return weight * (std::max(cosine, 0.0) / pi) * s.sun_irradiance;
            }
            return weight * (s.to_sun.y / pi) * s.sun_irradiance;
        }
    };
    struct SkyOnGround {
        Walks& w;
        glm::dvec3 direction(std::size_t i) const {
            PathRandom random = w.random_of(i);
            return w.off_ground(i, random);
        }
        glm::dvec3 value(std::size_t i) const {
            return w.three(w.w_.weight, i) * w.sky_from(w.apart_.along(i));
        }
    };

    // Paths on the ground: those that are left have a new direction.
    void scatter_on_ground() {
        standing_.clear();
        for (std::size_t i = 0; i < w_.count; ++i)
            if (w_.in_matter[i] == 0) standing_.push_back(static_cast<std::uint32_t>(i));
        if (standing_.empty()) return;
        for (const std::uint32_t i : standing_) {
            before_[i] = three(w_.weight, i);
            set_weight(i, before_[i] * albedo_here(i));
        }
        if (lanes_.sun_shines && s_.to_sun.y > 0) look_up(standing_, SunOnGround{*this});
        if (s_.dome.shines && s_.sky == SkySampling::kNextEvent)
            look_up(standing_, SkyOnGround{*this});
        for (const std::uint32_t i : standing_) {
            PathRandom random = random_of(i);
            glm::dvec3 weight = three(w_.weight, i);
            w_.gone[i] = survives(i, before_[i], weight, random) ? 0 : -1;
            set_weight(i, weight);
            w_.path.turn_to(i, off_ground(i, random));
        }
    }

    void fly_on() {
        scatter_on_ground();
        std::size_t count = 0;
        for (std::size_t i = 0; i < w_.count; ++i) {
            if (w_.gone[i] != 0) continue;
            const glm::dvec3 d = w_.path.along(i);
            w_.path.met[i] = 0;
            w_.ground[i] = std::numeric_limits<float>::infinity();
            if (w_.in_matter[i] == 0) {
                double until = kFar;
                if (s_.relief) {
                    until = ground_from(w_.on_ground[i], d);
                    w_.ground[i] = static_cast<float>(until);
                    stands_next_[i] = w_.on_ground[i] + (std::isinf(until) ? 0 : until) * d;
                }
                const bool flies = enters(i, d, w_.path, until);
                if (!flies) continue;
                // From where it comes into the box.
                if (s_.relief && std::isfinite(until))
                    w_.ground[i] =
                        static_cast<float>(glm::length(stands_next_[i] - w_.path.places().at(i)));
            } else if (s_.has_ground) {
                const double until = ground_from(w_.path.places().at(i), d);
                w_.ground[i] = static_cast<float>(until);
                if (s_.relief)
                    stands_next_[i] = w_.path.places().at(i) + (std::isinf(until) ? 0 : until) * d;
            }
            which_[count++] = static_cast<std::uint32_t>(i);
        }
        fly_all(m_, flights(w_.path, w_.path.direction, s_.has_ground ? w_.ground.data() : nullptr),
                {which_.data(), count});
        shade_by_hills(w_.path, {which_.data(), count});
    }

    // After its flight: whether the path is over.
    bool ends(std::size_t i) {
        if (w_.gone[i] != 0) return true;
        const glm::dvec3 weight = three(w_.weight, i);
        if (w_.path.met[i] != 0) {
            w_.in_matter[i] = -1;
        } else if (std::isinf(w_.ground[i])) {
            tally_.escaped += mean(weight);
            if (s_.dome.shines && s_.sky == SkySampling::kEscape)
                w_.other_light[i] += weight * sky_from(w_.path.along(i));
            return true;
        } else if (s_.relief) {
            const glm::dvec3 p = above_ground(*s_.relief, scene_place(stands_next_[i]));
            stand_on_ground(i, m_.axes * ((p - m_.origin) / m_.cell) + m_.shift);
        } else {
            glm::dvec3 q =
                w_.path.places().at(i) + static_cast<double>(w_.ground[i]) * w_.path.along(i);
            stand_on_ground(i, q + (ground_height_ - glm::dot(up_, q)) * up_);
        }
        if ((w_.in_matter[i] != 0 && w_.orders[i] == s_.max_orders) ||
            w_.events[i]++ == kMaxOrders) {
            tally_.cut_off += mean(weight);
            return true;
        }
        return false;
    }

    void settle() {
        for (std::size_t i = 0; i < w_.count;) {
            if (!ends(i)) {
                ++i;
                continue;
            }
            tally_.absorbed += static_cast<double>(w_.absorbed[i]);
            tally_.scatterings += w_.orders[i];
            brought_[w_.start[i]] = {
                w_.other_light[i] + three(w_.sunlight, i) * s_.sun_irradiance / (4 * pi),
                w_.orders[i]};
            if (begun_ < starts_.size())
                begin(i++);
            else
                replace(i);
        }
    }

    // By the last of the wave.
    void replace(std::size_t i) {
        const std::size_t last = --w_.count;
        const auto move = [&](auto& of) { of[i] = of[last]; };
        w_.path.places().copy(i, w_.path.places(), last);
        for (int a = 0; a < 3; ++a) {
            move(w_.path.direction[a]);
            move(w_.weight[a]);
            move(w_.sunlight[a]);
        }
        for (auto& word : w_.random) move(word);
        for (auto& share : w_.shares) move(share);
        move(w_.path.depth);
        move(w_.path.met);
        move(w_.ground);
        move(w_.absorbed);
        move(w_.orders);
        move(w_.in_matter);
        move(w_.gone);
        move(w_.other_light);
        move(w_.on_ground);
        move(stands_next_);
        move(w_.events);
        move(w_.start);
    }

    const Setting& s_;
    const Matter& m_;
    std::span<const Start> starts_;
    std::span<Brought> brought_;
    Tally& tally_;
    // As the lattice has them.
    glm::dvec3 to_sun_, up_;
    double ground_height_;
    WaveSetting lanes_;
    std::size_t begun_ = 0;
    Wave w_;
    Randoms randoms_{w_.random[0].data(), w_.random[1].data(), w_.random[2].data(),
                     w_.random[3].data()};
    // For flights beside the path's.
    WaveFlights apart_{};
    OfWave<std::uint32_t> which_{};
    std::vector<std::uint32_t> standing_;
    OfWave<glm::dvec3> before_{};
    // With hills: where on the ground paths end that do not meet matter before.
    OfWave<glm::dvec3> stands_next_{};
};

}  // namespace

bool walk(const Setting& setting, std::span<const Start> starts, std::span<Brought> brought,
          Tally& tally, const std::function<bool()>& over) {
    // Too large for a stack.
    const auto walks = std::make_unique<Walks>(setting, starts, brought, tally);
    return walks->run(over);
}

}  // namespace awan::truth
