// Random valid clouds of model "implicit": every field over its range, its ends more often than chance would have them.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/scene/implicit.h"
#include "tests/random_scenes.h"

namespace awan::test {

struct RandomImplicit {
    Dice& dice;
    double size;  // of the cloud in its own units

    double share(double low, double high) {  // the ends, the middle, anything
        return dice.chance(0.2) ? dice.either({low, high}) : dice.between(low, high);
    }
    double magnitude(double low, double high) {
        return dice.chance(0.2) ? dice.either({low, high}) : dice.log_between(low, high);
    }
    double length() {
        return std::clamp(size * dice.log_between(0.02, 1), limits::kMinImplicitRadius,
                          limits::kMaxImplicitRadius / 60);
    }
    glm::dvec3 place() {
        const double x = dice.between(-1, 1), y = dice.between(-1, 1), z = dice.between(-1, 1);
        return size * glm::dvec3(x, y, z);
    }
    double weight() {
        return dice.chance(0.7) ? dice.between(0.3, 2)
                                : share(-limits::kMaxImplicitWeight, limits::kMaxImplicitWeight);
    }
    double time() { return dice.chance(0.2) ? dice.any(limits::kMaxTime) : dice.between(-5, 60); }

    ImplicitKey key(double at, const ImplicitPrimitive& of) {
        ImplicitKey key;
        key.time = at;
        if (dice.chance(0.7)) key.center = place();
        if (dice.chance(0.5)) key.radius = length();
        if (dice.chance(0.5)) key.weight = weight();
        if (dice.chance(0.3)) key.rotate = dice.any_vector(limits::kMaxAngle);
        if (of.shape == ImplicitShape::kEllipsoid) {
            if (dice.chance(0.3)) {
                glm::dvec3& radii = key.radii.emplace();
                for (int i = 0; i < 3; ++i)
                    radii[i] = magnitude(limits::kMinImplicitRadii, limits::kMaxImplicitRadii);
            }
        } else if (dice.chance(0.3)) {
            key.core = length();
        }
        if (!of.points.empty() && dice.chance(0.3)) {
            key.points = of.points;
            for (glm::dvec3& point : *key.points) point = place();
        }
        return key;
    }

    ImplicitPrimitive primitive() {
        ImplicitPrimitive p;
        p.shape = static_cast<ImplicitShape>(dice.below(4));
        p.center = place();
        p.radius = length();
        p.weight = weight();
        const bool skeleton =
            p.shape == ImplicitShape::kCylinder || p.shape == ImplicitShape::kSegment;
        if (p.shape == ImplicitShape::kEllipsoid) {
            for (int i = 0; i < 3; ++i)
                p.radii[i] = magnitude(limits::kMinImplicitRadii, limits::kMaxImplicitRadii);
        } else if (dice.chance(0.4)) {
            p.core = dice.chance(0.3) ? 0 : length();
        }
        const int points = !skeleton                             ? 0
                           : p.shape == ImplicitShape::kCylinder ? 2
                                                                 : 2 + dice.below(6);
        for (int i = 0; i < points; ++i)
            p.points.push_back(dice.chance(0.1) ? glm::dvec3(0) : place());
        if (dice.chance(0.5)) p.rotate = dice.any_vector(limits::kMaxAngle);
        double at = time();
        for (int i = dice.chance(0.6) ? 0 : dice.below(6); i > 0 && at < limits::kMaxTime - 100;
             --i, at += dice.log_between(0.01, 10))
            p.keys.push_back(key(at, p));
        return p;
    }

    ImplicitGrowth growth() {
        ImplicitGrowth g;
        g.seeds = 1 + static_cast<std::uint64_t>(dice.below(20));
        g.most = g.seeds + static_cast<std::uint64_t>(dice.below(60));
        g.radius = length();
        g.shrink = share(0.1, 1);
        g.weight = weight();
        g.center = place();
        for (int i = 0; i < 3; ++i) {
            g.spread[i] = dice.chance(0.5) ? 2 : share(0, limits::kMaxGrowthSpread);
            if (dice.chance(0.3))
                g.velocity[i] = share(-limits::kMaxGrowthMotion, limits::kMaxGrowthMotion);
            if (dice.chance(0.3))
                g.force[i] = share(-limits::kMaxGrowthMotion, limits::kMaxGrowthMotion);
        }
        if (dice.chance(0.3)) g.turbulence = share(0, limits::kMaxGrowthMotion);
        if (dice.chance(0.3)) g.drag = share(0, limits::kMaxGrowthMotion);
        if (dice.chance(0.3))
            g.lifetime = magnitude(limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
        if (dice.chance(0.3)) g.rate = share(0, 1000);
        if (dice.chance(0.3))
            g.duration = magnitude(limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
        return g;
    }

    ImplicitBubbles bubbles() {
        ImplicitBubbles b;
        b.most = 1 + static_cast<std::uint64_t>(dice.below(30));
        b.knobs = static_cast<std::uint64_t>(dice.below(9));
        b.radius = length();
        b.weight = weight();
        b.center = place();
        b.rise = share(0, limits::kMaxGrowthMotion);
        b.ceiling = magnitude(limits::kMinBubbleCeiling, limits::kMaxBubbleCeiling);
        b.entrainment = share(0, 1);
        b.rate = magnitude(limits::kMinBubbleRate, 1000);
        b.began = time();
        return b;
    }

    ImplicitBillows billows() {
        ImplicitBillows b;
        b.waves = 1 + static_cast<std::uint64_t>(dice.below(4));
        b.wavelength = length();
        b.length = length();
        b.radius = length();
        b.weight = weight();
        b.center = place();
        b.shear = magnitude(1e-3, 1e3);
        b.amplitude = share(0, limits::kMaxBillowAmplitude);
        b.smoothing = magnitude(limits::kMinBillowSmoothing, 1);
        b.variation = share(0, 1);
        b.began = time();
        return b;
    }

    ImplicitCells cells() {
        ImplicitCells c;
        c.open = dice.chance(0.5);
        c.rings = static_cast<std::uint64_t>(dice.below(3));
        c.parcels = 1 + static_cast<std::uint64_t>(dice.below(12));
        c.spacing = length();
        c.depth = length();
        c.radius = length();
        c.weight = weight();
        c.center = place();
        c.irregular = share(0, 0.5);
        c.turnover = magnitude(limits::kMinGrowthSeconds, limits::kMaxGrowthSeconds);
        return c;
    }

    void makers(ImplicitCloud& c) {
        if (dice.chance(0.1)) c.bubbles = bubbles();
        if (dice.chance(0.1)) c.billows = billows();
        if (dice.chance(0.1)) c.cells = cells();
        for (int i = dice.chance(0.1) ? dice.below(20) : 0; i > 0; --i)
            c.particles.push_back({static_cast<double>(i),
                                   static_cast<std::uint64_t>(dice.below(4)), place(), length(),
                                   weight()});
    }

    // Keys of the cloud, a squash and a formula.
    void more(ImplicitCloud& c) {
        double at = dice.between(-5, 5);
        for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i, at += 1) {
            ImplicitCloudKey& key = c.keys.emplace_back();
            key.time = at;
            if (dice.chance(0.5)) key.amount = dice.between(0.1, 2);
            if (dice.chance(0.3))
                key.exponent =
                    magnitude(limits::kMinImplicitExponent, limits::kMaxImplicitExponent);
            if (dice.chance(0.3)) key.displacement = share(0, limits::kMaxDisplacement);
            if (dice.chance(0.3))
                key.noise_size = magnitude(limits::kMinNoiseSize, limits::kMaxNoiseSize);
            if (dice.chance(0.3)) key.jet = dice.any_vector(limits::kMaxJet);
            if (dice.chance(0.3)) key.warp = share(0, 1);
            if (dice.chance(0.2)) key.base = dice.between(-1, 1) * size;
        }
        if (dice.chance(0.2)) {
            ImplicitSquash& squash = c.squash.emplace();
            squash.axis = dice.on_sphere();
            squash.amount = magnitude(limits::kMinSquash, limits::kMaxSquash);
        }
        constexpr const char* kFormulas[] = {
            "density * (0.2 + height)", "max(0, fbm(x, y, z, 3)) + density / 0",
            "mdens * turb ^ time", "exp(density) * seed", "primitives(z, x, y) < 0.5 ? 0 : 2"};
        if (dice.chance(0.2)) c.formula = kFormulas[dice.below(5)];
    }

    void warps(ImplicitCloud& c) {
        if (dice.chance(0.4))
            c.jet = dice.chance(0.2) ? dice.any_vector(limits::kMaxJet)
                                     : glm::dvec3(dice.between(-2, 2), 0, dice.between(-2, 2));
        if (dice.chance(0.4)) c.jet_turbulence = share(0, 10);
        if (dice.chance(0.3)) c.warp_from = time(), c.warp_to = time();
        for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i)
            c.attractors.push_back(
                {place(), share(limits::kMinAttraction, limits::kMaxAttraction), length(), {}});
        for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i)
            c.vortices.push_back({place(),
                                  dice.on_sphere() * dice.log_between(1e-5, 1e5),
                                  share(-limits::kMaxVortexAngle, limits::kMaxVortexAngle),
                                  length(),
                                  {}});
        if (!dice.chance(0.25)) return;
        ImplicitFlow flow;
        flow.min = place();
        flow.max = flow.min + glm::dvec3(length(), length(), length());
        // Together they may round to less than the least side.
        flow.max += 2 * limits::kMinImplicitRadius;
        flow.size = {1 + dice.below(4), 1 + dice.below(4), 1 + dice.below(4)};
        for (int i = static_cast<int>(flow.size.x * flow.size.y * flow.size.z); i > 0; --i)
            flow.vectors.push_back(place() * 0.1);
        c.flow = flow;
    }

    // Keys of warps and of the growth; last of all, so that the rest of a seed's cloud is what it was without them.
    void moving(ImplicitCloud& c) {
        for (ImplicitAttractor& one : c.attractors) {
            double at = dice.between(-5, 60);
            for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i, at += 1) {
                ImplicitAttractorKey& key = one.keys.emplace_back();
                key.time = at;
                if (dice.chance(0.6)) key.at = place();
                if (dice.chance(0.6))
                    key.strength = share(limits::kMinAttraction, limits::kMaxAttraction);
                if (dice.chance(0.6)) key.reach = length();
            }
        }
        for (ImplicitVortex& one : c.vortices) {
            double at = dice.between(-5, 60);
            for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i, at += 1) {
                ImplicitVortexKey& key = one.keys.emplace_back();
                key.time = at;
                if (dice.chance(0.6)) key.at = place();
                if (dice.chance(0.6)) key.axis = dice.on_sphere() * dice.log_between(1e-5, 1e5);
                if (dice.chance(0.6))
                    key.angle = share(-limits::kMaxVortexAngle, limits::kMaxVortexAngle);
                if (dice.chance(0.6)) key.reach = length();
            }
        }
        if (!c.growth) return;
        double at = dice.between(-5, 60);
        for (int i = dice.chance(0.3) ? dice.below(4) : 0; i > 0; --i, at += 1) {
            ImplicitGrowthKey& key = c.growth->keys.emplace_back();
            key.time = at;
            if (dice.chance(0.5)) key.center = place();
            if (dice.chance(0.5)) key.radius = length();
            if (dice.chance(0.5)) key.weight = weight();
            if (dice.chance(0.5)) key.turbulence = share(0, limits::kMaxGrowthMotion);
            if (dice.chance(0.5)) key.drag = share(0, limits::kMaxGrowthMotion);
            if (dice.chance(0.5)) key.rate = share(0, 1000);
        }
    }

    void style(ImplicitCloud& c) {
        const auto maybe = [&](std::optional<double>& field, double value) {
            if (dice.chance(0.5)) field = value;
        };
        maybe(c.amount,
              dice.chance(0.7) ? dice.between(0.1, 2) : share(0, limits::kMaxImplicitAmount));
        maybe(c.exponent, magnitude(limits::kMinImplicitExponent, limits::kMaxImplicitExponent));
        maybe(c.blend, share(0, 1));
        maybe(c.displacement, share(0, limits::kMaxDisplacement));
        maybe(c.noise_size, magnitude(limits::kMinNoiseSize, limits::kMaxNoiseSize));
        maybe(c.gain, share(0, 1));
        maybe(c.stretch, magnitude(1, limits::kMaxStretch));
        if (dice.chance(0.5)) c.octaves = 1 + static_cast<std::uint64_t>(dice.below(10));
        if (dice.chance(0.3)) {
            glm::dvec3& ripple = c.ripple.emplace(0);
            for (int i = 0; i < 3; ++i)
                if (dice.chance(0.6)) ripple[i] = magnitude(limits::kMinRipple, limits::kMaxRipple);
            c.ripple_depth = share(0, 1);
            c.ripple_turbulence = share(0, 100);
        }
        c.diagonal = dice.chance(0.3);
        c.linear_keys = !dice.chance(0.5);
        if (dice.chance(0.2)) c.base = dice.between(-1, 1) * size;
        if (dice.chance(0.3)) c.swirl = share(-limits::kMaxSwirl, limits::kMaxSwirl);
        c.printed_swirl = dice.chance(0.3);
        c.resolution = limits::kMinImplicitResolution + static_cast<std::uint64_t>(dice.below(9));
        if (dice.chance(0.3)) c.threshold = share(0, 0.5);
    }
};

// Small enough to be made in some milliseconds. Its density may be multiplied by up to limits::kMaxImplicitDensity.
inline Cloud random_implicit(Dice& dice, const Whereabouts& where) {
    Cloud cloud;
    cloud.model = CloudModel::kImplicit;
    cloud.translate = where.middle;
    cloud.rotate_y = dice.chance(0.5) ? 0 : dice.any(limits::kMaxAngle);
    auto c = std::make_shared<ImplicitCloud>();
    c->preset = static_cast<ImplicitPreset>(dice.below(5));
    RandomImplicit random{dice, 250};
    if (dice.chance(0.8)) {
        random.size = dice.log_between(1, 1e4);
        c->primitives.emplace();
        for (int i = dice.chance(0.05) ? 0 : 1 + dice.below(12); i > 0; --i)
            c->primitives->push_back(random.primitive());
    }
    if (dice.chance(0.25)) {
        random.size = c->primitives ? random.size : 250;
        c->growth = random.growth();
    }
    random.makers(*c);
    random.more(*c);
    random.warps(*c);
    random.style(*c);
    cloud.implicit = c;
    cloud.scale = std::clamp(where.size / random.size, limits::kMinScale, limits::kMaxScale);
    const double depth = dice.chance(0.1) ? 0 : dice.log_between(1e-6, 1e6);
    cloud.density =
        std::min(depth / where.size, limits::kMaxDensity / limits::kMaxImplicitDensity / 2);
    random.moving(*c);
    return cloud;
}

}  // namespace awan::test
