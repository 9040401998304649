#include "core/light/shine.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/shaders/shared.h"

namespace awan {
namespace {

double sky_gradient(double up, double zenith, double horizon) {
    const auto one = [](double v) { return shader::vec3(static_cast<float>(v)); };
    return static_cast<double>(
        shader::sky_radiance(static_cast<float>(up), one(zenith), one(horizon)).x);
}

bool proportional(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(a, b)) <= 1e-6 * glm::length(a) * glm::length(b);
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

Shine sunlight(const glm::vec3& color) {
    Shine shine;
    shine.beam = true;
    shine.color = color;
    return shine;
}

Shine gradient(double zenith, double horizon, const glm::vec3& color) {
    Shine shine;
    shine.zenith = zenith;
    shine.horizon = horizon;
    shine.color = color;
    return shine;
}

glm::vec3 in_channel(int channel, double value) {
    glm::vec3 color(0);
    color[channel] = static_cast<float>(value);
    return color;
}

void add_physical_sky(Shine& to, const SkyInflow& sky, int channel, double share) {
    to.physical = &sky;
    to.channel = channel;
    to.share = share;
}

// A band is measured by its brightest light: by the sun's irradiance where it has the sun, else by the sky's largest
// radiance. One solve does both where the sun is bright enough to measure the sky by.
std::vector<Shine> under_physical_sky(const glm::dvec3& sun, const SkyInflow& physical,
                                      bool colored) {
    std::vector<Shine> shines;
    if (!colored && largest(sun) > 0) shines.push_back(sunlight(glm::vec3(sun)));
    for (int c = 0; c < 3; ++c) {
        // Colours are floats: a sky that is 0 as a float is no sky.
        const double most = static_cast<double>(static_cast<float>(physical.most[c]));
        const bool one_solve = colored && sun[c] > 1e-30 && sun[c] > 1e-6 * most;
        if (colored && sun[c] > 0) {
            shines.push_back(sunlight(in_channel(c, sun[c])));
            if (one_solve) add_physical_sky(shines.back(), physical, c, 1 / sun[c]);
        }
        if (!one_solve && most > 0) {
            Shine sky;
            sky.color = in_channel(c, most);
            add_physical_sky(sky, physical, c, 1 / most);
            shines.push_back(sky);
        }
    }
    return shines;
}

std::vector<Shine> on_colored_matter(const glm::dvec3& sun, const glm::dvec3& zenith,
                                     const glm::dvec3& horizon) {
    std::vector<Shine> shines;
    for (int c = 0; c < 3; ++c) {
        if (sun[c] > 0) {
            // The sun has irradiance 1 in this solve, so the sky is measured in the sun's irradiance.
            shines.push_back(sunlight(in_channel(c, sun[c])));
            shines.back().zenith = zenith[c] / sun[c];
            shines.back().horizon = horizon[c] / sun[c];
        } else if (zenith[c] > 0 || horizon[c] > 0) {
            shines.push_back(gradient(zenith[c], horizon[c], in_channel(c, 1)));
        }
    }
    return shines;
}

std::vector<Shine> on_grey_matter(const glm::dvec3& sun, const glm::dvec3& zenith,
                                  const glm::dvec3& horizon) {
    std::vector<Shine> shines;
    if (largest(sun) > 0) shines.push_back(sunlight(glm::vec3(sun)));
    if (largest(zenith) > 0 && largest(horizon) > 0 && proportional(zenith, horizon)) {
        shines.push_back(gradient(largest(zenith) / largest(horizon), 1, glm::vec3(horizon)));
        return shines;
    }
    if (largest(zenith) > 0) shines.push_back(gradient(1, 0, glm::vec3(zenith)));
    if (largest(horizon) > 0) shines.push_back(gradient(0, 1, glm::vec3(horizon)));
    return shines;
}

}  // namespace

std::vector<Shine> shines_of(const Outside& outside, const SkyInflow& physical, bool colored,
                             bool with_sky) {
    if (with_sky && outside.sky.physical) return under_physical_sky(outside.sun, physical, colored);
    const glm::dvec3 zenith = with_sky ? outside.sky.zenith : glm::dvec3(0);
    const glm::dvec3 horizon = with_sky ? outside.sky.horizon : glm::dvec3(0);
    return colored ? on_colored_matter(outside.sun, zenith, horizon)
                   : on_grey_matter(outside.sun, zenith, horizon);
}

double sky_from(const Shine& shine, const glm::dvec3& direction) {
    if (shine.physical != nullptr)
        return shine.share * mean_from(*shine.physical, direction)[shine.channel];
    return sky_gradient(direction.y, shine.zenith, shine.horizon);
}

double brightest_sky(const Shine& shine) {
    if (shine.physical != nullptr) return shine.share * shine.physical->most[shine.channel];
    return std::max(shine.zenith, shine.horizon);
}

int channel_of(const Shine& shine) {
    return shine.color.x > 0 ? 0 : shine.color.y > 0 ? 1 : 2;
}

}  // namespace awan
