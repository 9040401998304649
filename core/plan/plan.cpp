#include "core/plan/plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/base/exact_math.h"
#include "core/plan/criteria.h"
#include "core/scene/layers.h"

namespace awan {
namespace {

// Where no rung keeps to the error that is wanted: a cheaper rung than the closest is taken, if its error is at most
// so many times the closest's.
constexpr double kKnee = 2.5;
// Relative error above which a picture is far from the truth for anyone to see.
constexpr double kFarOff = 0.3;
// Factor of the error of paths, where they are compared with the even one of other rungs.
constexpr double kNoiseHandicap = 2;
// Of a pixel, when rung truth is asked for by name.
constexpr double kTruthNoise = 0.05;

// Forward-scattered light travels with the light pass of self_shadow: one does not run without the
// other.
void join_scattering_to_shadow(Plan& plan, const Scene& scene) {
    EffectDecision& shadow = plan.of(Effect::kSelfShadow);
    EffectDecision& scattering = plan.of(Effect::kMultipleScattering);
    if (!scattering.on || shadow.on) return;
    if (scene->effects[static_cast<int>(Effect::kSelfShadow)] == Switch::kOff) {
        scattering.on = false;
        scattering.reason = "self_shadow is switched off, and scattered light travels with it";
    } else {
        shadow.on = true;
        shadow.reason = "multiple_scattering travels with it (" + shadow.reason + ")";
    }
}

// Bumps below a pixel are no detail, even where it is asked for.
void leave_out_unseen_detail(Plan& plan, const Scene& scene, const Survey& survey) {
    EffectDecision& detail = plan.of(Effect::kDetail);
    if (!detail.on || detail_pixels(scene, survey) > kLeastBump) return;
    detail.on = false;
    detail.reason += ": nothing of it could be seen";
}

// Billboards are painted with something, even where they are asked for.
void leave_out_missing_textures(Plan& plan, const Scene& scene) {
    EffectDecision& texture = plan.of(Effect::kTexture);
    if (!texture.on || draws_textures(*scene)) return;
    texture.on = false;
    texture.reason += ": there is none to draw";
}

// There must be hills, even where they are asked for.
void leave_out_missing_terrain(Plan& plan, const Scene& scene) {
    EffectDecision& terrain = plan.of(Effect::kTerrain);
    if (!terrain.on || has_terrain(*scene)) return;
    terrain.on = false;
    terrain.reason += ": there is none to draw";
}

// Shadows are seen in haze that is drawn.
void join_shafts_to_haze(Plan& plan) {
    EffectDecision& shafts = plan.of(Effect::kLightShafts);
    if (!shafts.on || plan.on(Effect::kAerialPerspective)) return;
    shafts.on = false;
    shafts.reason =
        "aerial_perspective is off, and shadows are seen in the haze (" + shafts.reason + ")";
}

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
    // Where all rungs are far off, forecasts that differ by a little say nothing. A rung that leaves out most of the
    // light shows a dark cloud, which is the worst of the pictures: only rungs that follow all orders are left to
    // choose from.
    if (!cheapest && best && best->error > kFarOff) {
        const RungForecast* of_grids = nullptr;
        for (const RungForecast& candidate : candidates)
            if (candidate.rung->cells > 0 && (!of_grids || candidate.error < of_grids->error))
                of_grids = &candidate;
        if (of_grids) best = of_grids;
    }
    const bool patient =
        cheapest && (cheapest->rung->method != Method::kPaths || cheapest->time_ms <= kPatience_ms);
    if (patient)
        return {*cheapest, "the cheapest with a predicted error of at most " + percent(error)};
    std::string reason = "none is predicted to stay under " + percent(error);
    if (!cheapest && error >= kDefaultError) {
        // The scene asks for no particular error: it is not made to wait ten times as long for a slightly smaller one.
        const RungForecast* knee = best;
        for (const RungForecast& candidate : candidates)
            if (candidate.rung->method != Method::kPaths &&
                (best->rung->cells == 0 || candidate.rung->cells > 0) &&
                candidate.error <= kKnee * best->error && candidate.time_ms < knee->time_ms)
                knee = &candidate;
        if (knee != best)
            return {*knee, reason + "; this is the cheapest within 2.5 times of the closest, " +
                               best->rung->name};
    }
    if (cheapest)
        reason += " but truth, which would take " + milliseconds(cheapest->time_ms) +
                  ": ask for it by name";
    return {*best, reason + "; this comes closest"};
}

Choice best_in_time(double time_ms, const std::vector<RungForecast>& candidates) {
    const RungForecast* best = nullptr;
    const RungForecast* fastest = nullptr;
    for (const RungForecast& candidate : candidates) {
        // The error is measured only where there is time for it.
        if (!fastest || candidate.picture_ms() < fastest->picture_ms()) fastest = &candidate;
        // Noise is worse to look at than an even error: paths have to win by far. They are the last of the ladder.
        const double handicap = candidate.rung->method == Method::kPaths ? kNoiseHandicap : 1;
        if (candidate.picture_ms() <= time_ms &&
            (!best || handicap * candidate.error < best->error))
            best = &candidate;
    }
    if (best)
        return {*best,
                "the most accurate that is predicted to take at most " + milliseconds(time_ms)};
    return {*fastest,
            "none is predicted to take at most " + milliseconds(time_ms) + "; this is the fastest"};
}

// Error of splats in matter so thin that little is shaded or scattered twice: that little is what they leave out;
// besides, splats have the sky's light come evenly from above and below. Infinite where matter is deeper. Measured on
// table 4.4 of Sunar et al. 2005 at depths .03 to .3: 5 to 7% under a gradient, 25 to 27% under a physical sky, whose
// light about the sun is scattered forward.
double thin_error(const Plan& plan, const Scene& scene, const Survey& survey, bool additive) {
    const double deepest =
        std::max({survey.optical_depth_eye, survey.optical_depth_sun, survey.optical_depth_zenith});
    if (deepest > (additive ? 0.3 : 0.12)) return std::numeric_limits<double>::infinity();
    const auto left_out = [&](Effect effect) { return plan.of(effect).left_out; };
    const double sum =
        0.7 * (left_out(Effect::kSelfShadow) + left_out(Effect::kMultipleScattering) +
               left_out(Effect::kViewExtinction)) +
        (scene->sky.physical ? 0.6 : 0.2) * left_out(Effect::kSkyLight);
    return std::max(sum, 0.01);  // nothing smaller was measured
}

// Error of what the scene calls for and splats cannot show.
double lost_by_splats(const Plan& plan) {
    const EffectDecision& detail = plan.of(Effect::kDetail);
    return detail.on ? detail.left_out : 0;
}

void choose_rung(const Scene& scene, const Survey& survey, int threads, const MachineSpeed& speed,
                 Plan& plan) {
    const Accuracy& accuracy = scene->accuracy;
    const double wanted_error = accuracy.error.value_or(kDefaultError);
    plan.samples =
        samples_for(accuracy.rung || accuracy.time_ms ? kTruthNoise : wanted_error, scene, survey);
    if (accuracy.time_ms) {  // as many paths as fit
        const Rung& truth = rung_of(RungId::kTruth);
        const double one = forecast(truth, scene, survey, 2, threads, speed).time_ms;
        const double two = forecast(truth, scene, survey, 4, threads, speed).time_ms;
        const double pairs = two > one ? (*accuracy.time_ms - one) / (two - one) : 1;
        plan.samples =
            2 * static_cast<std::uint32_t>(std::clamp(pairs, 1.0, double{kMaxTruthSamples} / 2));
    }
    const bool painted = plan.on(Effect::kTexture);
    std::vector<RungForecast> candidates;
    // Paths are for what is finer than the default: a scene that asks for nothing is not made to wait for them, nor one
    // that asks for the same in words.
    const bool paths = accuracy.rung || accuracy.time_ms || wanted_error < kDefaultError;
    for (const Rung& rung : ladder()) {
        plan.forecasts.push_back(forecast(rung, scene, survey, plan.samples, threads, speed));
        if (rung.method == Method::kSplats) {
            double& error = plan.forecasts.back().error;
            const bool additive = rung.id == RungId::kAdditive;
            error = exact::hypot(std::min(error, thin_error(plan, scene, survey, additive)),
                                 lost_by_splats(plan));
        }
        double& whole = plan.forecasts.back().error;
        if (whole > 0) whole = exact::hypot(whole, survey.model_error);
        if (painted && rung.method == Method::kSplats)
            whole = std::numeric_limits<double>::quiet_NaN();
        if (wants_layers(scene)
                ? rung.method == Method::kMarch
                : rung.method == Method::kSplats ||
                      (!wants_splats(scene) && (paths || rung.method != Method::kPaths)))
            candidates.push_back(plan.forecasts.back());
    }
    Choice choice;
    if (accuracy.rung) {
        const Rung* named = find_rung(*accuracy.rung);
        for (const RungForecast& candidate : plan.forecasts)
            if (*candidate.rung == *named) choice.forecast = candidate;
        choice.reason = "asked for by name";
    } else if (painted) {
        choice.forecast = plan.forecasts[static_cast<std::size_t>(RungId::kHarris)];
        choice.reason =
            "the scene is painted with textures, which only splats show: there is no truth that "
            "the picture could be near to";
    } else if (accuracy.time_ms) {
        choice = best_in_time(*accuracy.time_ms, candidates);
    } else {
        choice = cheapest_within(wanted_error, candidates);
    }
    if (!accuracy.rung && !painted && wants_splats(scene))
        choice.reason += "; only the splats can leave out an effect that is switched off";
    plan.predicted = choice.forecast;
    plan.rung = choice.forecast.rung->name;
    plan.rung_reason = choice.reason;
    if (choice.forecast.rung->method == Method::kMarch) {
        plan.transport = transport_settings(*choice.forecast.rung);
        plan.transport.ground = plan.on(Effect::kGroundLight);
        plan.transport.ground_shadow = plan.on(Effect::kGroundShadow);
        plan.transport.sky = scene->effects[static_cast<int>(Effect::kSkyLight)] != Switch::kOff;
    }
}

// Rungs simulate a fixed set of these whatever the scene calls for.
void fit_effects_to_rung(Plan& plan) {
    const Rung& rung = *plan.predicted.rung;
    const auto set = [&](Effect effect, bool on) {
        EffectDecision& decision = plan.of(effect);
        if (decision.on == on) return;
        decision.on = on;
        decision.reason = "rung " + plan.rung + (on ? " always has it (" : " goes without (") +
                          decision.reason + ")";
    };
    const bool additive = rung.id == RungId::kAdditive;
    if (rung.method != Method::kSplats) set(Effect::kTexture, false);
    // Textures are the detail of billboards.
    if (plan.on(Effect::kTexture)) set(Effect::kDetail, false);
    if (rung.id == RungId::kHarris) return;
    set(Effect::kSelfShadow, !additive);
    set(Effect::kMultipleScattering,
        !additive && (rung.cells > 0 || rung.method == Method::kPaths));
    set(Effect::kViewExtinction, !additive);
    if (rung.method == Method::kMarch && rung.cells == 0) set(Effect::kSkyLight, false);
}

// What is not lit: nothing is simulated. `rung` takes the place of one of the ladder.
Plan plan_unlit(const Rung& rung, const char* why_no_effect, const char* why) {
    Plan plan;
    for (int i = 0; i < kEffectCount; ++i) {
        EffectDecision& decision = plan.of(static_cast<Effect>(i));
        decision.effect = static_cast<Effect>(i);
        decision.reason = why_no_effect;
    }
    plan.predicted.rung = &rung;
    plan.predicted.error = std::numeric_limits<double>::quiet_NaN();
    plan.rung = rung.name;
    plan.rung_reason = why;
    return plan;
}

// What it takes is added by who knows the looks (core/planning.cpp).
Plan plan_look() {
    return plan_unlit(rung_of(RungId::kLook),
                      "the scene asks for a look, which follows its own rules",
                      "the scene asks for a look: there is no truth to be near to");
}

// About what the renderer takes for a billboard or a cube, and for a pixel (Mesa's, on one processor).
constexpr double kDisplayedItem_ms = 2e-3, kDisplayedPixel_ms = 6e-5;

Plan plan_display(const Scene& scene, const Survey& survey) {
    Plan plan = plan_unlit(rung_of(RungId::kDisplay), "the scene is displayed, not lit",
                           "the scene asks to be displayed: there is no truth to be near to");
    plan.predicted.time_ms = kDisplayedItem_ms * static_cast<double>(survey.particles) +
                             kDisplayedPixel_ms * scene->image.width * scene->image.height;
    return plan;
}

}  // namespace

bool wants_splats(const Scene& scene) {
    for (const Effect effect :
         {Effect::kSelfShadow, Effect::kMultipleScattering, Effect::kViewExtinction})
        if (scene->effects[static_cast<int>(effect)] == Switch::kOff) return true;
    return draws_textures(*scene);
}

bool wants_layers(const Scene& scene) {
    return read_layers(scene->image.layers).value_or(Layers{}).any();
}

void plan_samples(Plan& plan, std::uint32_t samples, const Scene& scene, const Survey& survey,
                  int threads, const MachineSpeed& speed) {
    const Rung& truth = rung_of(RungId::kTruth);
    const auto with = [&](std::uint32_t count) {
        return forecast(truth, scene, survey, count, threads, speed);
    };
    const RungForecast before = with(plan.samples), now = with(samples);
    plan.samples = samples;
    const auto change = [&](RungForecast& of) {
        if (of.rung != &truth) return;
        // What was added to the time stays.
        of.time_ms += now.time_ms - before.time_ms;
        of.error = now.error > 0 ? exact::hypot(now.error, survey.model_error) : now.error;
        of.bytes = now.bytes;
    };
    for (RungForecast& of : plan.forecasts) change(of);
    change(plan.predicted);
}

Plan plan(const Scene& scene, const Survey& survey, int threads, const MachineSpeed& speed) {
    if (scene->display != Display::kLit) return plan_display(scene, survey);
    if (scene->look != Look::kPhysical) return plan_look();
    Plan plan;
    const std::array<Criterion, kEffectCount> own_of = criteria(scene, survey);
    for (int i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        EffectDecision& decision = plan.of(static_cast<Effect>(i));
        decision.effect = effect;
        const Criterion& own = own_of[static_cast<std::size_t>(i)];
        decision.left_out = own.left_out;
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
    leave_out_unseen_detail(plan, scene, survey);
    leave_out_missing_textures(plan, scene);
    leave_out_missing_terrain(plan, scene);
    join_scattering_to_shadow(plan, scene);
    join_shafts_to_haze(plan);
    choose_rung(scene, survey, threads, speed, plan);
    fit_effects_to_rung(plan);
    return plan;
}

}  // namespace awan
