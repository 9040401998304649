#include "core/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/scene/outside.h"

namespace awan {
namespace {

// Below these the effect changes no pixel by more than 1% (measured against exact solutions at
// optical depths .03 to 40; the larger of front- and back-lit).
constexpr double kShadowDepth = 0.03;
constexpr double kViewDepth = 0.03;
constexpr double kScatterDepthIsotropic = 0.04;  // g = 0
constexpr double kScatterDepthForward = 0.02;    // |g| >= .5; linear in between

// Of the haze, likewise: what it takes from a pixel or adds to it goes with its depth.
constexpr double kHazeDepth = 0.01;
constexpr double kShafts = 0.01;

constexpr double kPatience_ms = 20e3;  // longer paths than these are not chosen, only taken by name
constexpr double kTruthNoise = 0.05;   // of a pixel, when rung truth is asked for by name

std::string sentence(const char* format, double a, double b) {
    std::array<char, 200> text{};
    const int length = std::snprintf(text.data(), text.size(), format, a, b);
    return {text.data(), static_cast<std::size_t>(length)};
}

struct Criterion {
    bool wanted;
    std::string reason;
};

Criterion above(const char* what, double figure, double threshold) {
    const bool wanted = figure > threshold;
    return {
        wanted,
        sentence(
            (std::string(what) + (wanted ? " %.3g is over %.3g" : " %.3g is within %.3g")).c_str(),
            figure, threshold)};
}

double scatter_threshold(double g) {
    const double t = std::min(1.0, std::abs(g) / 0.5);
    return kScatterDepthIsotropic + t * (kScatterDepthForward - kScatterDepthIsotropic);
}

// Whether the scene calls for an effect, by its own figures.
Criterion criterion(Effect effect, const Scene& scene, const Survey& survey) {
    if (effect == Effect::kAerialPerspective || effect == Effect::kLightShafts) {
        if (!scene->haze || !(scene->haze->extinction > 0)) return {false, "the scene has no haze"};
        const HazeFigures& haze = survey.haze;
        if (effect == Effect::kLightShafts)
            return above("the clouds' shadows in the haze, over a typical pixel,", haze.shaded,
                         kShafts);
        return above("the haze's largest optical depth in view,",
                     std::max(haze.depth_to_clouds, haze.depth_behind), kHazeDepth);
    }
    if (survey.particles == 0 || !(survey.total_mass > 0))
        return {false, "there is no matter in the scene"};
    const bool sun = scene->sun.intensity > 0;
    const bool sky = outside_of(scene).sky.shines;
    const double towards_lights =
        std::max(sun ? survey.optical_depth_sun : 0.0, sky ? survey.optical_depth_zenith : 0.0);
    switch (effect) {
        case Effect::kSelfShadow:
            if (!sun && !sky) return {false, "no light reaches the cloud"};
            return above("the largest optical depth towards the lights,", towards_lights,
                         kShadowDepth);
        case Effect::kMultipleScattering:
            if (!sun && !sky) return {false, "no light reaches the cloud"};
            if (scene->medium.albedo == 0) return {false, "the albedo is 0: nothing is scattered"};
            return above("the largest optical depth towards the lights,", towards_lights,
                         scatter_threshold(scene->medium.g));
        case Effect::kViewExtinction:
            return above("the largest optical depth towards the eye,", survey.optical_depth_eye,
                         kViewDepth);
        case Effect::kSkyLight:
            if (scene->sky.none) return {false, "the scene has no sky"};
            if (!sky) return {false, "the sky is black"};
            return {true, "the sky shines on the cloud from all sides"};
        case Effect::kInterior:
            return survey.eye_inside
                       ? Criterion{true, "the eye is within 4 s of a particle"}
                       : Criterion{false, "the eye is more than 4 s away from every particle"};
        case Effect::kDetail:
            if (!scene->detail) return {false, "the scene asks for none"};
            return {true, "asked for"};
        default:
            return {false, ""};
    }
}

const char* missing_reason(Effect effect) {
    switch (effect) {
        case Effect::kGroundLight:
        case Effect::kGroundShadow:
            return "the scene has no ground; a ground is not in this version";
        case Effect::kSunColor:
            return "the sun's colour is given; colour from its elevation is not in this version";
        case Effect::kDetail:
            return "procedural detail is not in this version";
        default:
            return "textures are not in this version";
    }
}

// Forward-scattered light travels with the light pass of self_shadow: one does not run without the
// other.
void join_scattering_to_shadow(Plan& plan, const Scene& scene) {
    EffectDecision& shadow = plan.effects[static_cast<std::size_t>(Effect::kSelfShadow)];
    EffectDecision& scattering =
        plan.effects[static_cast<std::size_t>(Effect::kMultipleScattering)];
    if (!scattering.on || shadow.on) return;
    if (scene->effects[static_cast<int>(Effect::kSelfShadow)] == Switch::kOff) {
        scattering.on = false;
        scattering.reason = "self_shadow is switched off, and scattered light travels with it";
    } else {
        shadow.on = true;
        shadow.reason = "multiple_scattering travels with it (" + shadow.reason + ")";
    }
}

// Shadows are seen in haze that is drawn.
void join_shafts_to_haze(Plan& plan) {
    EffectDecision& shafts = plan.effects[static_cast<std::size_t>(Effect::kLightShafts)];
    if (!shafts.on || plan.on(Effect::kAerialPerspective)) return;
    shafts.on = false;
    shafts.reason =
        "aerial_perspective is off, and shadows are seen in the haze (" + shafts.reason + ")";
}

}  // namespace

namespace {

std::string percent(double error) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g%%", 100 * error);
    return text.data();
}

std::string milliseconds(double ms) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), ms < 10000 ? "%.3g ms" : "%.0f ms", ms);
    return text.data();
}

// An effect that is switched off can only be left out by the splats: the other rungs follow all light there is.
bool wants_splats(const Scene& scene) {
    for (const Effect effect :
         {Effect::kSelfShadow, Effect::kMultipleScattering, Effect::kViewExtinction})
        if (scene->effects[static_cast<int>(effect)] == Switch::kOff) return true;
    return false;
}

struct Choice {
    RungForecast forecast;
    std::string reason;
};

Choice cheapest_within(double error, const std::vector<RungForecast>& candidates) {
    const RungForecast* cheapest = nullptr;
    const RungForecast* best = nullptr;  // of the grids and splats
    for (const RungForecast& candidate : candidates) {
        if (candidate.rung->method != Method::kPaths && (!best || candidate.error < best->error))
            best = &candidate;
        if (candidate.error <= error && (!cheapest || candidate.time_ms < cheapest->time_ms))
            cheapest = &candidate;
    }
    const bool patient =
        cheapest && (cheapest->rung->method != Method::kPaths || cheapest->time_ms <= kPatience_ms);
    if (patient)
        return {*cheapest, "the cheapest with a predicted error of at most " + percent(error)};
    std::string reason = "none is predicted to stay under " + percent(error);
    if (cheapest)
        reason += " but truth, which would take " + milliseconds(cheapest->time_ms) +
                  ": ask for it by name";
    return {*best, reason + "; this comes closest"};
}

Choice best_in_time(double time_ms, const std::vector<RungForecast>& candidates) {
    const RungForecast* best = nullptr;
    const RungForecast* fastest = nullptr;
    for (const RungForecast& candidate : candidates) {
        if (!fastest || candidate.time_ms < fastest->time_ms) fastest = &candidate;
        if (candidate.time_ms <= time_ms && (!best || candidate.error < best->error))
            best = &candidate;
    }
    if (best)
        return {*best,
                "the most accurate that is predicted to take at most " + milliseconds(time_ms)};
    return {*fastest,
            "none is predicted to take at most " + milliseconds(time_ms) + "; this is the fastest"};
}

void choose_rung(const Scene& scene, const Survey& survey, int threads, const MachineSpeed& speed,
                 Plan& plan) {
    const Accuracy& accuracy = scene->accuracy;
    const double wanted_error = accuracy.error.value_or(kDefaultError);
    plan.samples =
        samples_for(accuracy.rung || accuracy.time_ms ? kTruthNoise : wanted_error, scene, survey);
    if (accuracy.time_ms) {  // as many paths as fit
        const Rung& truth = *find_rung("truth");
        const double one = forecast(truth, scene, survey, 2, threads, speed).time_ms;
        const double two = forecast(truth, scene, survey, 4, threads, speed).time_ms;
        const double pairs = two > one ? (*accuracy.time_ms - one) / (two - one) : 1;
        plan.samples =
            2 * static_cast<std::uint32_t>(std::clamp(pairs, 1.0, double{kMaxTruthSamples} / 2));
    }
    std::vector<RungForecast> candidates;
    // Paths are for what is finer than the default: a scene that asks for nothing is not made to wait for them, nor one
    // that asks for the same in words.
    const bool paths = accuracy.rung || accuracy.time_ms || wanted_error < kDefaultError;
    for (const Rung& rung : ladder()) {
        plan.forecasts.push_back(forecast(rung, scene, survey, plan.samples, threads, speed));
        if (rung.method == Method::kSplats ||
            (!wants_splats(scene) && (paths || rung.method != Method::kPaths)))
            candidates.push_back(plan.forecasts.back());
    }
    Choice choice;
    if (accuracy.rung) {
        const Rung* named = find_rung(*accuracy.rung);
        for (const RungForecast& candidate : plan.forecasts)
            if (candidate.rung == named) choice.forecast = candidate;
        choice.reason = "asked for by name";
    } else if (accuracy.time_ms) {
        choice = best_in_time(*accuracy.time_ms, candidates);
    } else {
        choice = cheapest_within(wanted_error, candidates);
    }
    if (!accuracy.rung && wants_splats(scene))
        choice.reason += "; only the splats can leave out an effect that is switched off";
    plan.predicted = choice.forecast;
    plan.rung = choice.forecast.rung->name;
    plan.rung_reason = choice.reason;
    if (choice.forecast.rung->method == Method::kMarch) {
        plan.transport = transport_settings(*choice.forecast.rung);
        plan.transport.sky = scene->effects[static_cast<int>(Effect::kSkyLight)] != Switch::kOff;
    }
}

// Rungs simulate a fixed set of these whatever the scene calls for.
void fit_effects_to_rung(Plan& plan) {
    const Rung& rung = *plan.predicted.rung;
    const auto set = [&](Effect effect, bool on) {
        EffectDecision& decision = plan.effects[static_cast<std::size_t>(effect)];
        if (decision.on == on) return;
        decision.on = on;
        decision.reason = "rung " + plan.rung + (on ? " always has it (" : " goes without (") +
                          decision.reason + ")";
    };
    const bool additive = &rung == find_rung("additive"), harris = &rung == find_rung("harris");
    if (harris) return;
    set(Effect::kSelfShadow, !additive);
    set(Effect::kMultipleScattering,
        !additive && (rung.cells > 0 || rung.method == Method::kPaths));
    set(Effect::kViewExtinction, !additive);
    if (rung.method == Method::kMarch && rung.cells == 0) set(Effect::kSkyLight, false);
}

}  // namespace

Plan plan(const Scene& scene, const Survey& survey, int threads, const MachineSpeed& speed) {
    Plan plan;
    for (int i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        EffectDecision& decision = plan.effects[static_cast<std::size_t>(i)];
        decision.effect = effect;
        decision.available = in_this_version(effect);
        if (!decision.available) {
            decision.reason = missing_reason(effect);
            continue;
        }
        const Criterion own = criterion(effect, scene, survey);
        switch (scene->effects[i]) {
            case Switch::kAuto:
                decision.on = own.wanted;
                decision.reason = own.reason;
                break;
            case Switch::kOn:
                decision.on = true;
                decision.reason = "asked for (" + own.reason + ")";
                break;
            case Switch::kOff:
                decision.on = false;
                decision.reason = "switched off (" + own.reason + ")";
                break;
        }
    }
    join_scattering_to_shadow(plan, scene);
    join_shafts_to_haze(plan);
    choose_rung(scene, survey, threads, speed, plan);
    fit_effects_to_rung(plan);
    return plan;
}

}  // namespace awan
