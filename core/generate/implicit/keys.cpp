#include "core/generate/implicit/keys.h"

#include <algorithm>
#include <glm/common.hpp>

namespace awan::implicit {
namespace {

// As jet_turbulence moves the jet stream (Ebert 2002, procedure Cirrus()).
const glm::dvec3 kTurbulentJet(0.2, 0.3, 0.25);

void add_jet(const glm::dvec3& jet, double turbulence, SettingsReach& reach) {
    const glm::dvec3 most = jet + turbulence * kTurbulentJet;
    reach.jet_low = glm::min(reach.jet_low, glm::min(jet, most));
    reach.jet_high = glm::max(reach.jet_high, glm::max(jet, most));
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

}  // namespace awan::implicit
