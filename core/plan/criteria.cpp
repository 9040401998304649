#include "core/plan/criteria.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/survey/outside_light.h"

namespace awan {
namespace {

// Below these the effect changes no pixel by more than 1% (measured against exact solutions at
// optical depths .03 to 40; the larger of front- and back-lit).
constexpr double kShadowDepth = 0.03;
constexpr double kViewDepth = 0.03;
constexpr double kScatterDepthIsotropic = 0.04;  // g = 0
constexpr double kScatterDepthForward = 0.02;    // |g| >= .5; linear in between

constexpr double kShare = 0.01;  // of the light, of a pixel
constexpr double kTint = 0.01;   // of a channel from grey

// What the picture loses without an effect, measured by the largest optical depth (the error of exact solutions
// that go without self-shadow, view extinction, and scattering at its worst).
struct Measured {
    double depth, shadow, view, scattering;
};
constexpr std::array kMeasured = {
    Measured{0.03, 0.008, 0.008, 0.015}, Measured{0.1, 0.028, 0.026, 0.048},
    Measured{0.3, 0.087, 0.08, 0.14},    Measured{1, 0.32, 0.29, 0.37},
    Measured{3, 1.14, 1.03, 0.66},       Measured{10, 4.48, 3.92, 0.88},
    Measured{40, 18, 16, 0.96},
};

// Between the measured depths by logarithms; in proportion below, the last beyond.
double without(double Measured::*loss, double depth) {
    const Measured& thinnest = kMeasured.front();
    if (!(depth > thinnest.depth)) return thinnest.*loss * std::max(depth, 0.0) / thinnest.depth;
    for (std::size_t i = 1; i < kMeasured.size(); ++i) {
        const Measured &a = kMeasured[i - 1], &b = kMeasured[i];
        if (depth > b.depth) continue;
        const double t = exact::log(depth / a.depth) / exact::log(b.depth / a.depth);
        return a.*loss * exact::pow(b.*loss / (a.*loss), t);
    }
    return kMeasured.back().*loss;
}

Criterion above(const char* what, double figure, double threshold, double left_out) {
    const bool wanted = figure > threshold;
    std::array<char, 200> text{};
    const int length = std::snprintf(text.data(), text.size(),
                                     wanted ? "%s %.3g is over %.3g" : "%s %.3g is within %.3g",
                                     what, figure, threshold);
    return {wanted, left_out, {text.data(), static_cast<std::size_t>(length)}};
}

double scatter_threshold(double g) {
    const double t = std::min(1.0, std::abs(g) / 0.5);
    return kScatterDepthIsotropic + t * (kScatterDepthForward - kScatterDepthIsotropic);
}

// A figure to a percent; the finest would take longer than all else of a plan.
constexpr int kSkySteps = 12;

// What shines on the cloud, and how deep the cloud is for it.
struct Lights : OutsideLight {
    bool sun_shines = false, sky_shines = false;
    // The largest optical depth of the cloud towards those that shine.
    double depth = 0;
};

Lights lights_of(const Scene& scene, const Survey& survey) {
    Lights lights{outside_light(scene, kSkySteps)};
    lights.sun_shines = lights.outside.sun != glm::dvec3(0);
    lights.sky_shines = lights.outside.sky.shines;
    lights.depth = std::max(lights.sun_shines ? survey.optical_depth_sun : 0.0,
                            lights.sky_shines ? survey.optical_depth_zenith : 0.0);
    return lights;
}

// For shares of all the light: not 0.
double all_light(const Lights& lights) {
    return std::max(lights.all(), 1e-300);
}

Criterion sky_light(const Scene& scene, const Lights& lights) {
    if (scene->sky.none) return {false, 0, "the scene has no sky"};
    if (!lights.sky_shines) return {false, 0, "the sky is black"};
    const double share = lights.sky / (lights.sky + lights.sun);
    return above("the sky's share of the light,", share, kShare, share);
}

Criterion ground_light(const Scene& scene, const Survey& survey) {
    if (!scene->ground) return {false, 0, "the scene has no ground"};
    return above("light from the ground over that of sun and sky,", survey.ground.light, kShare,
                 survey.ground.light / (1 + survey.ground.light));
}

Criterion ground_shadow(const Scene& scene, const Survey& survey, const Lights& lights) {
    if (!scene->ground) return {false, 0, "the scene has no ground"};
    if (!(survey.ground.seen > 0)) return {false, 0, "the ground is not in view"};
    // A black ground has none to lose.
    const double up = std::max(lights.outside.to_sun.y, 0.0);
    const double shines = luminance(scene->ground->albedo) *
                          (up * luminance(lights.outside.sun) / std::numbers::pi + lights.sky);
    const double share = survey.ground.shade * std::min(1.0, shines / all_light(lights));
    return above("what the clouds take of the ground's light in view, over a typical pixel,", share,
                 kShare, share * survey.ground.seen);
}

Criterion sun_color(const Scene& scene, const Lights& lights) {
    if (!scene->sun.auto_color) return {false, 0, "the sun's colour is given"};
    if (!lights.sun_shines) return {false, 0, "the sun does not shine"};
    const double angle = exact::asin(std::clamp(lights.outside.to_sun.y, -1.0, 1.0));
    const glm::dvec3 color = sunlight(angle, scene->sky.turbidity);
    const double grey = luminance(color);
    if (!(grey > 0)) return {false, 0, "the sun is below the horizon"};
    const glm::dvec3 off = glm::abs(color / grey - 1.0);
    const double tint = std::max({off.x, off.y, off.z});
    std::array<char, 100> what{};
    std::snprintf(what.data(), what.size(), "at %.3g degrees the sun's farthest channel from grey,",
                  angle * 180 / std::numbers::pi);
    return above(what.data(), tint, kTint, std::sqrt(glm::dot(off, off) / 3));
}

// Largest of the haze's phase function, mean 1, that the picture sees.
double phase_in_view(const Haze& haze, const Lights& lights, const View& view) {
    const double corner = exact::atan(view.tan_half_fov * exact::hypot(1.0, view.aspect));
    const double off =
        exact::acos(std::clamp(glm::dot(view.forward, lights.outside.to_sun), -1.0, 1.0));
    const double nearest = std::max(off - corner, 0.0),
                 farthest = std::min(off + corner, std::numbers::pi);
    const double cosine = exact::cos(haze.g >= 0 ? nearest : farthest);
    const double base = std::max(1 + haze.g * haze.g - 2 * haze.g * cosine, 1e-9);
    return (1 - haze.g * haze.g) / (base * std::sqrt(base));
}

Criterion haze(Effect effect, const Scene& scene, const Survey& survey, const Lights& lights) {
    if (!scene->haze || !(scene->haze->extinction > 0)) return {false, 0, "the scene has no haze"};
    // What shafts' absence costs is measured over the whole picture.
    if (effect == Effect::kLightShafts)
        return above("the clouds' shadows in the haze, over a typical pixel,", survey.haze.shaded,
                     kShare, 0.4 * survey.haze.shaded);
    // Thin haze shows where it glows: towards the sun, over a typical pixel.
    const double depth = std::max(survey.haze.depth_to_clouds, survey.haze.depth_behind);
    const double glow =
        luminance(scene->haze->albedo) *
        (lights.sun * phase_in_view(*scene->haze, lights, survey.view) + lights.sky) /
        all_light(lights);
    const double veil = -exact::expm1(-depth) * std::max(1.0, glow);
    return above("the haze's largest share of a pixel in view,", veil, kShare, std::min(veil, 1.0));
}

Criterion detail(const Scene& scene, const Survey& survey) {
    if (!scene->detail) return {false, 0, "the scene asks for none"};
    if (!(scene->detail->amount > 0)) return {false, 0, "the scene asks for an amount of 0"};
    // Where matter is gathered a pixel has it or has it not. Measured on table 4.4 of Sunar et al. 2005.
    const double left_out = 0.55 * scene->detail->amount;
    return above("its largest bumps in pixels,", detail_pixels(scene, survey),
                 scene->detail->automatic ? kLeastAutoBump : kLeastBump, left_out);
}

// What a picture loses without is not said: a painted square is no matter, and has no truth.
Criterion texture(const Scene& scene) {
    const std::size_t used = textures_of(*scene).size();
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    if (used == 0) return {false, 0, "nothing in the scene has a texture"};
    return {true, unknown,
            "the scene is painted with " + std::to_string(used) +
                (used == 1 ? " texture" : " textures")};
}

// With or without clouds. Hills may stand anywhere in the picture and light anything, so that they are always followed.
Criterion terrain(const Scene& scene, const Survey& survey) {
    if (!scene->ground || !scene->ground->terrain) return {false, 0, "the scene has no terrain"};
    if (!(scene->ground->terrain->height > 0)) return {false, 0, "the terrain has a height of 0"};
    std::array<char, 100> text{};
    const int length =
        std::snprintf(text.data(), text.size(), "the ground has hills, in %.2g of the picture",
                      survey.ground.hills);
    return {true, survey.ground.hills, {text.data(), static_cast<std::size_t>(length)}};
}

Criterion of_matter(Effect effect, const Scene& scene, const Survey& survey, const Lights& lights) {
    const bool lit = lights.sun_shines || lights.sky_shines;
    switch (effect) {
        case Effect::kSelfShadow:
            if (!lit) return {false, 0, "no light reaches the cloud"};
            return above("the largest optical depth towards the lights,", lights.depth,
                         kShadowDepth, without(&Measured::shadow, lights.depth));
        case Effect::kMultipleScattering:
            if (!lit) return {false, 0, "no light reaches the cloud"};
            if (scene->medium.albedo == 0)
                return {false, 0, "the albedo is 0: nothing is scattered"};
            return above("the largest optical depth towards the lights,", lights.depth,
                         scatter_threshold(asymmetry(scene->medium)),
                         scene->medium.albedo * without(&Measured::scattering, lights.depth));
        case Effect::kViewExtinction:
            return above("the largest optical depth towards the eye,", survey.optical_depth_eye,
                         kViewDepth, without(&Measured::view, survey.optical_depth_eye));
        case Effect::kSkyLight:
            return sky_light(scene, lights);
        case Effect::kGroundLight:
            return ground_light(scene, survey);
        case Effect::kGroundShadow:
            return ground_shadow(scene, survey, lights);
        case Effect::kSunColor:
            return sun_color(scene, lights);
        case Effect::kDetail:
            return detail(scene, survey);
        case Effect::kInterior:
            return survey.eye_inside
                       ? Criterion{true, 1, "the eye is within 4 s of a particle"}
                       : Criterion{false, 0, "the eye is more than 4 s away from every particle"};
        default:
            return texture(scene);
    }
}

}  // namespace

bool detail_counts(const Scene& scene, const Survey& survey) {
    const Switch asked = scene->effects[static_cast<int>(Effect::kDetail)];
    if (asked == Switch::kOff || !(scene->detail.value_or(Detail{}).amount > 0)) return false;
    if (asked == Switch::kOn) return true;
    return scene->detail &&
           (!scene->detail->automatic || detail_pixels(scene, survey) > kLeastAutoBump);
}

double detail_pixels(const Scene& scene, const Survey& survey) {
    const Detail asked = scene->detail.value_or(Detail{});
    const glm::dvec3 nearest = glm::clamp(survey.view.eye, survey.bounds.min, survey.bounds.max);
    const double distance = glm::length(nearest - survey.view.eye);
    const double bump = asked.size * survey.detail.radius;
    if (!(distance > bump)) return std::numeric_limits<double>::infinity();
    return bump / distance * scene->image.height / (2 * survey.view.tan_half_fov);
}

std::array<Criterion, kEffectCount> criteria(const Scene& scene, const Survey& survey) {
    std::array<Criterion, kEffectCount> all;
    const bool empty = survey.particles == 0 || !(survey.total_mass > 0);
    const Lights lights = lights_of(scene, survey);
    for (int i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        Criterion& one = all[static_cast<std::size_t>(i)];
        if (effect == Effect::kAerialPerspective || effect == Effect::kLightShafts)
            one = haze(effect, scene, survey, lights);  // seen with and without clouds
        else if (effect == Effect::kTerrain)
            one = terrain(scene, survey);
        else if (empty)
            one = {false, 0, "there is no matter in the scene"};
        else
            one = of_matter(effect, scene, survey, lights);
    }
    return all;
}

Criterion criterion(Effect effect, const Scene& scene, const Survey& survey) {
    return criteria(scene, survey)[static_cast<std::size_t>(effect)];
}

}  // namespace awan
