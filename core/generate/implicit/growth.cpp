#include "core/generate/implicit/growth.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "core/generate/implicit/keys.h"
#include "core/generate/implicit/noise.h"
#include "core/generate/keyed_random.h"

namespace awan::implicit {
namespace {

// Random, uniform in -1 .. 1.
double uniform(std::uint64_t key, std::uint64_t number) {
    return 2 * unit_open(static_cast<std::uint32_t>(keyed(key, number) >> 32)) - 1;
}

glm::dvec3 uniform_vector(std::uint64_t key, std::uint64_t number) {
    const double x = uniform(key, number), y = uniform(key, number + 1),
                 z = uniform(key, number + 2);
    return {x, y, z};
}

// How strong the turbulence is where a particle is, and the force with which it pushes.
struct Air {
    double strength;
    glm::dvec3 force;
};

// The air at up to sixteen particles. Bumps of the turbulence are twice a particle's radius wide.
AWAN_INLINE void air_around_body(const Octaves& octaves, const GrownParticle* particles, int count,
                                 Air* air) {
    lanes::Vec at{};
    for (int i = 0; i < count; ++i) {
        const glm::dvec3& p = particles[i].position;
        at.x[i] = static_cast<float>(p.x / 2);
        at.y[i] = static_cast<float>(p.y / 2);
        at.z[i] = static_cast<float>(p.z / 2);
    }
    const lanes::Vec push = brownian3(octaves, at);
    const lanes::Floats strength = turbulence(octaves, at);
    for (int i = 0; i < count; ++i) {
        air[i].strength = static_cast<double>(strength[i]);
        air[i].force.x = static_cast<double>(push.x[i]);
        air[i].force.y = static_cast<double>(push.y[i]);
        air[i].force.z = static_cast<double>(push.z[i]);
    }
}
AWAN_KERNEL(void, air_around,
            (const Octaves& octaves, const GrownParticle* particles, int count, Air* air),
            (octaves, particles, count, air))

// One member of a growth at a time.
template <typename T>
T member_at(const ImplicitGrowth& growth, T ImplicitGrowth::*own,
            std::optional<T> ImplicitGrowthKey::*keyed, bool smooth, double time) {
    return at_time(
        growth.keys, growth.*own, smooth,
        time, [=](const ImplicitGrowthKey& key) -> const auto& { return key.*keyed; });
}

// What acts on the particles at a time.
struct Acting {
    glm::dvec3 force;
    double turbulence, drag, rate;
};

class Colony {
  public:
    Colony(const ImplicitGrowth& growth, bool smooth, std::uint64_t key)
        : growth_(growth),
          smooth_(smooth),
          octaves_(octaves_of(keyed(key, 1), 3, 0.5, 0, 0, 0, 0)) {
        for (std::uint64_t i = 0; i < growth.seeds; ++i) {
            GrownParticle& seed = particles.emplace_back();
            seed.key = keyed(keyed(key, 0), i);
            seed.position = growth.spread * uniform_vector(seed.key, 0);
            seed.velocity = growth.velocity;
            seed.size = 0.85 + 0.15 * uniform(seed.key, 3);
            seed.birth = -growth.lifetime / 5;
        }
        grow_to(0);
    }

    std::vector<GrownParticle> particles;

    // One step of the simulation, from `time` over dt seconds.
    void step(double time, double dt) {
        // Children born in this step move from the next one on.
        const std::size_t count = particles.size();
        const Acting acting = acting_at(time);
        Air air[lanes::kCount];
        for (std::size_t first = 0; first < count; first += lanes::kCount) {
            const std::size_t last = std::min(count, first + lanes::kCount);
            air_around(octaves_, &particles[first], static_cast<int>(last - first), air);
            for (std::size_t i = first; i < last; ++i) {
                if (time - particles[i].birth >= growth_.lifetime) particles[i].dormant = true;
                if (!particles[i].dormant) move(i, acting, air[i - first], time, dt);
            }
        }
        grow_to(time + dt);
    }

  private:
    Acting acting_at(double time) const {
        using Of = ImplicitGrowth;
        using Key = ImplicitGrowthKey;
        return {member_at(growth_, &Of::force, &Key::force, smooth_, time),
                member_at(growth_, &Of::turbulence, &Key::turbulence, smooth_, time),
                member_at(growth_, &Of::drag, &Key::drag, smooth_, time),
                member_at(growth_, &Of::rate, &Key::rate, smooth_, time)};
    }

    void move(std::size_t i, const Acting& acting, const Air& air, double time, double dt) {
        GrownParticle& p = particles[i];
        // The drag is taken at the step's end (implicit Euler), which is stable for steps of any length.
        p.velocity += dt * (acting.force + acting.turbulence * air.force);
        p.velocity /= 1 + acting.drag * dt;
        p.position = glm::clamp(p.position + dt * p.velocity, -kGrowthReach, kGrowthReach);
        p.fertility += dt * acting.rate * air.strength;
        if (p.fertility < 1) return;
        // At most one child a step.
        p.fertility = std::min(p.fertility - 1, 1.0);
        if (particles.size() < growth_.most) bear(i, time + dt);
    }

    void bear(std::size_t parent, double time) {
        GrownParticle child;
        const GrownParticle& p = particles[parent];
        child.key = keyed(p.key, 100 + static_cast<std::uint64_t>(particles.size()));
        child.size = p.size * growth_.shrink;
        // At the parent's side, above rather than below.
        glm::dvec3 away = uniform_vector(child.key, 0);
        away.y = 0.6 * away.y + 0.35;
        child.position = glm::clamp(p.position + 0.8 * p.size * away, -kGrowthReach, kGrowthReach);
        child.velocity = p.velocity + 0.5 * growth_.velocity;
        child.birth = time;
        particles.push_back(child);
    }

    void grow_to(double time) {
        for (GrownParticle& p : particles)
            p.share = smoothstep((time - p.birth) / (growth_.lifetime / 2));
    }

    const ImplicitGrowth& growth_;
    bool smooth_;
    Octaves octaves_;
};

}  // namespace

std::vector<GrownParticle> grown(const ImplicitGrowth& growth, std::uint64_t key, double time,
                                 bool smooth) {
    Colony colony(growth, smooth, key);
    const double dt = growth.duration / kGrowthSteps;
    const double at = std::clamp(time, 0.0, growth.duration) / dt;
    const int whole = std::min(static_cast<int>(at), kGrowthSteps);
    for (int i = 0; i < whole; ++i) colony.step(i * dt, dt);
    const double part = std::min(at - whole, 1.0);
    if (whole == kGrowthSteps || part <= 0) return colony.particles;
    // Where the particles are between two steps. Whoever is born in this one is not there yet.
    std::vector<GrownParticle> now = colony.particles;
    colony.step(whole * dt, dt);
    for (std::size_t i = 0; i < now.size(); ++i) {
        const GrownParticle& next = colony.particles[i];
        now[i].position += part * (next.position - now[i].position);
        now[i].velocity += part * (next.velocity - now[i].velocity);
        now[i].share += part * (next.share - now[i].share);
        now[i].dormant = next.dormant;
    }
    return now;
}

ColonySeen colony_seen(const ImplicitGrowth& growth, bool smooth, double time) {
    using Of = ImplicitGrowth;
    using Key = ImplicitGrowthKey;
    return {member_at(growth, &Of::center, &Key::center, smooth, time),
            member_at(growth, &Of::radius, &Key::radius, smooth, time),
            member_at(growth, &Of::weight, &Key::weight, smooth, time)};
}

Element element_of(const GrownParticle& particle, const ColonySeen& seen, const Frame& frame) {
    const double radius = seen.radius * particle.size * (0.4 + 0.6 * particle.share);
    return sphere_element(seen.center + seen.radius * particle.position, radius,
                          seen.weight * particle.share, frame);
}

// Wherever the colony's middle is and whatever its measure, a particle is at middle + measure * position: in the box of
// what the ends of both make.
Box growth_box(const ImplicitGrowth& growth, std::uint64_t key, bool smooth) {
    Box middles;
    middles.add(growth.center);
    double least = growth.radius, most = growth.radius;
    for (const ImplicitGrowthKey& one : growth.keys) {
        if (one.center) middles.add(*one.center);
        least = std::min(least, one.radius.value_or(least));
        most = std::max(most, one.radius.value_or(most));
    }
    Box box;
    const auto add_seen = [&](const Colony& colony, const glm::dvec3& middle, double measure) {
        for (const GrownParticle& p : colony.particles)
            box.add(middle + measure * p.position, glm::dvec3(most * p.size));
    };
    const auto add = [&](const Colony& colony) {
        add_seen(colony, middles.min, most);
        if (growth.keys.empty()) return;
        add_seen(colony, middles.max, most);
        add_seen(colony, middles.min, least);
        add_seen(colony, middles.max, least);
    };
    Colony colony(growth, smooth, key);
    add(colony);
    const double dt = growth.duration / kGrowthSteps;
    for (int i = 0; i < kGrowthSteps; ++i) {
        colony.step(i * dt, dt);
        add(colony);
    }
    return box;
}

}  // namespace awan::implicit
