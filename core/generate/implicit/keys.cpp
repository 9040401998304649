#include "core/generate/implicit/keys.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace awan::implicit {
namespace {

// As jet_turbulence moves the jet stream (Ebert 2002, procedure Cirrus()).
const glm::dvec3 kTurbulentJet(0.2, 0.3, 0.25);

void add_jet(const glm::dvec3& jet, double turbulence, SettingsReach& reach) {
    const glm::dvec3 most = jet + turbulence * kTurbulentJet;
    reach.jet_low = glm::min(reach.jet_low, glm::min(jet, most));
    reach.jet_high = glm::max(reach.jet_high, glm::max(jet, most));
}

// Of a warp whose keys may say its place, its reach and, by `strength_of`, its strength. What lies between two keys is
// not beyond both.
template <typename Warp, typename Strength>
WarpReach most_of(const Warp& warp, const Strength& strength_of) {
    WarpReach most;
    most.reach = warp.reach;
    most.strength = std::abs(strength_of(warp));
    for (const auto& key : warp.keys) {
        most.reach = std::max(most.reach, key.reach.value_or(0));
        most.strength = std::max(most.strength, std::abs(strength_of(key)));
    }
    most.places.add(warp.at);
    for (const auto& key : warp.keys)
        if (key.at) most.places.add(*key.at);
    return most;
}

double value_of(const std::optional<double>& value) {
    return value.value_or(0);
}

}  // namespace

ImplicitSettings settings_at(const ImplicitCloud& cloud, double time) {
    ImplicitSettings s = resolved(cloud);
    if (cloud.keys.empty()) return s;
    const auto put = [&](auto& value, auto ImplicitCloudKey::*member) {
        value = at_time(
            cloud.keys, value, !cloud.linear_keys,
            time, [=](const ImplicitCloudKey& key) -> const auto& { return key.*member; });
    };
    put(s.amount, &ImplicitCloudKey::amount);
    put(s.exponent, &ImplicitCloudKey::exponent);
    put(s.blend, &ImplicitCloudKey::blend);
    put(s.displacement, &ImplicitCloudKey::displacement);
    put(s.noise_size, &ImplicitCloudKey::noise_size);
    put(s.gain, &ImplicitCloudKey::gain);
    put(s.stretch, &ImplicitCloudKey::stretch);
    put(s.jet, &ImplicitCloudKey::jet);
    put(s.jet_turbulence, &ImplicitCloudKey::jet_turbulence);
    put(s.warp, &ImplicitCloudKey::warp);
    put(s.ripple_depth, &ImplicitCloudKey::ripple_depth);
    put(s.ripple_turbulence, &ImplicitCloudKey::ripple_turbulence);
    const bool keyed_base = std::any_of(cloud.keys.begin(), cloud.keys.end(),
                                        [](const auto& key) { return key.base.has_value(); });
    if (keyed_base) {
        double base = 0;
        put(base, &ImplicitCloudKey::base);
        s.base = base;
    }
    return s;
}

SettingsReach reach_at_all_times(const ImplicitCloud& cloud) {
    const ImplicitSettings s = resolved(cloud);
    SettingsReach reach;
    reach.displacement = s.displacement;
    double turbulence = s.jet_turbulence;
    reach.base = s.base.value_or(limits::kMaxImplicitCoordinate);
    for (const ImplicitCloudKey& key : cloud.keys) {
        reach.displacement = std::max(reach.displacement, key.displacement.value_or(0));
        turbulence = std::max(turbulence, key.jet_turbulence.value_or(0));
        reach.base = std::min(reach.base, key.base.value_or(reach.base));
    }
    add_jet(s.jet, turbulence, reach);
    for (const ImplicitCloudKey& key : cloud.keys)
        if (key.jet) add_jet(*key.jet, turbulence, reach);
    return reach;
}

ImplicitAttractor attractor_at(const ImplicitAttractor& attractor, bool smooth, double time) {
    ImplicitAttractor now{attractor.at, attractor.strength, attractor.reach};
    const auto put = [&](auto& value, auto ImplicitAttractorKey::*member) {
        value = at_time(
            attractor.keys, value, smooth,
            time, [=](const ImplicitAttractorKey& key) -> const auto& { return key.*member; });
    };
    put(now.at, &ImplicitAttractorKey::at);
    put(now.strength, &ImplicitAttractorKey::strength);
    put(now.reach, &ImplicitAttractorKey::reach);
    return now;
}

ImplicitVortex vortex_at(const ImplicitVortex& vortex, bool smooth, double time) {
    ImplicitVortex now{vortex.at, vortex.axis, vortex.angle, vortex.reach};
    const auto put = [&](auto& value, auto ImplicitVortexKey::*member) {
        value = at_time(
            vortex.keys, value, smooth,
            time, [=](const ImplicitVortexKey& key) -> const auto& { return key.*member; });
    };
    put(now.at, &ImplicitVortexKey::at);
    put(now.axis, &ImplicitVortexKey::axis);
    put(now.angle, &ImplicitVortexKey::angle);
    put(now.reach, &ImplicitVortexKey::reach);
    // Halfway between opposite ones.
    if (!(glm::length(now.axis) >= 1e-6)) now.axis = vortex.axis;
    return now;
}

WarpReach reach_at_all_times(const ImplicitAttractor& attractor) {
    return most_of(attractor, [](const auto& one) { return value_of(one.strength); });
}

WarpReach reach_at_all_times(const ImplicitVortex& vortex) {
    return most_of(vortex, [](const auto& one) { return value_of(one.angle); });
}

}  // namespace awan::implicit
