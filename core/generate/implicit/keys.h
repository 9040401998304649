// Values between key frames.
#pragma once

#include <vector>

#include "core/generate/implicit/elements.h"
#include "core/generate/implicit/lanes.h"
#include "core/scene/implicit.h"

namespace awan::implicit {

// `t` of the way from a to b.
template <typename T>
T between(const T& a, const T& b, double t) {
    return a * (1 - t) + b * t;
}
template <typename T>
std::vector<T> between(const std::vector<T>& a, const std::vector<T>& b, double t) {
    std::vector<T> all(a.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = between(a[i], b[i], t);
    return all;
}

// A value at a time. of(key) gives the value of a key frame, or none where the key does not say; `standard` holds
// where no key says.
template <typename Key, typename T, typename Of>
T at_time(const std::vector<Key>& keys, const T& standard, bool smooth, double time, const Of& of) {
    const Key *before = nullptr, *after = nullptr;
    for (const Key& key : keys) {
        if (!of(key)) continue;
        if (key.time <= time) before = &key;
        if (key.time > time && after == nullptr) after = &key;
    }
    if (before == nullptr) return after == nullptr ? standard : *of(*after);
    if (after == nullptr) return *of(*before);
    double t = (time - before->time) / (after->time - before->time);
    if (smooth) t = smoothstep(t);
    return between(*of(*before), *of(*after), t);
}

// The settings at a time: resolved() and the cloud's keys.
ImplicitSettings settings_at(const ImplicitCloud& cloud, double time);

// The farthest that settings go at any time, for boxes.
struct SettingsReach {
    double displacement = 0;
    // How far back along the jet stream a point is taken, along each axis, mean radii.
    glm::dvec3 jet_low{0}, jet_high{0};
    // The lowest of the flat bases, units; of no meaning where there is none.
    double base = 0;
};
SettingsReach reach_at_all_times(const ImplicitCloud& cloud);

// A warp at a time, its keys followed.
ImplicitAttractor attractor_at(const ImplicitAttractor& attractor, bool smooth, double time);
ImplicitVortex vortex_at(const ImplicitVortex& vortex, bool smooth, double time);

// The most that a warp does at any time: the box of all its places, units; its largest reach, units; the largest size
// of its strength, or of its angle in degrees.
struct WarpReach {
    Box places;
    double reach = 0, strength = 0;
};
WarpReach reach_at_all_times(const ImplicitAttractor& attractor);
WarpReach reach_at_all_times(const ImplicitVortex& vortex);

}  // namespace awan::implicit
