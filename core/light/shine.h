// What shines on a cloud, taken apart into lights of one shape in space and one colour: each is one solve, one band.
#pragma once

#include <vector>

#include "core/light/sky_inflow.h"
#include "core/light/sweep.h"
#include "core/light/transport_light.h"
#include "core/scene/outside.h"

namespace awan {

// The light of one solve, in units of `color`. Its parts add up.
struct Shine {
    bool beam = false;               // the sun, irradiance 1
    double zenith = 0, horizon = 0;  // radiance of a sky that is a gradient
    glm::vec3 color{1};
    // A physical sky: `share` times its radiance in one channel. Null: none.
    const SkyInflow* physical = nullptr;
    int channel = 0;
    double share = 0;
    // Light that the ground sends up into the cloud, by place and direction; empty: none.
    InflowFromBelow from_below{};
    // A part of a scene has the ground's light from the solve of the whole scene: that solve's band. Null: none.
    const LightBand* from_ground = nullptr;

    bool has_sky() const { return physical != nullptr || zenith > 0 || horizon > 0; }
};

// The lights from outside. Grey matter: the sun, the zenith's share of the sky and the horizon's (or both as one, where
// their colours are proportional). Coloured matter differs from channel to channel, so it needs one solve a channel,
// which then does the sun and the sky together. A physical sky has a shape of its own in each channel. `physical` must
// outlive the result; it is only looked at where outside.sky is physical. with_sky: whether the sky's light is wanted.
std::vector<Shine> shines_of(const Outside& outside, const SkyInflow& physical, bool colored,
                             bool with_sky);

// Radiance of the sky from a direction (unit, towards the sky).
double sky_from(const Shine& shine, const glm::dvec3& direction);

// The most radiance that the sky has in any direction.
double brightest_sky(const Shine& shine);

// The colour channel (0, 1, 2) that a band in coloured matter is of.
int channel_of(const Shine& shine);

}  // namespace awan
