// From a cloud's description to its field at one time.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/implicit/field.h"
#include "core/generate/implicit/growth.h"
#include "core/generate/implicit/keys.h"
#include "core/generate/implicit/procedures.h"
#include "core/generate/implicit/squash.h"
#include "core/generate/keyed_random.h"

namespace awan::implicit {
namespace {

// What is random in a cloud, each with a key of its own.
enum Purpose : std::uint64_t {
    kGrowthKey,
    kTurbulenceKey,
    kMovingKey,
    kPathKey,
    kFormulaKey,
    kBubblesKey,
    kBillowsKey,
    kCellsKey
};

// An upper bound, and hardly more, of u f(h(u)) over 0 <= u <= 1, where f rises.
template <typename F>
double most_over_ball(const F& f) {
    double most = 0;
    constexpr int kSteps = 64;
    for (int i = 0; i < kSteps; ++i) {
        const double u0 = static_cast<double>(i) / kSteps, u1 = u0 + 1.0 / kSteps, s = u0 * u0;
        most = std::max(most, u1 * f((1 - s) * (1 - s) * (1 - s * 4 / 9)));
    }
    return most;
}

Box within(const Frame& frame, const Box& box) {
    return {(box.min - frame.middle) / frame.unit, (box.max - frame.middle) / frame.unit};
}

// In the frame.
Box ball_of(const WarpReach& most, const Frame& frame) {
    const Box places = within(frame, most.places);
    Box ball;
    for (const glm::dvec3& place : {places.min, places.max})
        ball.add(place, glm::dvec3(most.reach / frame.unit));
    return ball;
}

Box widened(const Box& box, const glm::dvec3& low, const glm::dvec3& high) {
    return {box.min + low, box.max + high};
}

// The box, and what lies within `ball` and at most `most` away from it. It says where matter of the box is seen after
// a warp that moves nothing outside the ball, and where a vortex, which leaves within all that is within, takes
// points of the box.
Box warped_within(const Box& box, const Box& ball, double most) {
    Box result = box;
    const Box wide = widened(box, glm::dvec3(-most), glm::dvec3(most));
    if (!touch(wide, ball)) return result;
    result.add(Box{glm::max(wide.min, ball.min), glm::min(wide.max, ball.max)});
    return result;
}

void prepare_noise(const ImplicitCloud& cloud, const ImplicitSettings& s, std::uint64_t key,
                   double time, ImplicitField& f) {
    f.noise_scale = static_cast<float>(1 / s.noise_size);
    const double length = glm::length(s.jet);
    f.stretch_axis = length > 0 ? glm::vec3(s.jet / length) : glm::vec3(1, 0, 0);
    f.stretch_less = static_cast<float>(1 / s.stretch - 1);
    f.path_scale = glm::vec3(swirl_path(time * cloud.swirl, cloud.printed_swirl).scale);
    f.path_noise = octaves_of(keyed(key, kPathKey), 1, 1, 0, 0, 0, 0).lattice[0];
    limit_octaves(cloud, key, time, 0, f);
}

void prepare_flow(const ImplicitFlow& flow, double share, const Frame& frame, PreparedFlow& to) {
    to.any = true;
    to.min = glm::vec3((flow.min - frame.middle) / frame.unit);
    for (int i = 0; i < 3; ++i) {
        to.size[i] = static_cast<int>(flow.size[i]);
        to.steps[i] =
            static_cast<float>((flow.size[i] - 1) / ((flow.max[i] - flow.min[i]) / frame.unit));
    }
    for (const glm::dvec3& v : flow.vectors) {
        const glm::dvec3 full = v / frame.unit;
        to.low = glm::min(to.low, full);
        to.high = glm::max(to.high, full);
        to.vectors.emplace_back(full * share);
    }
}

void prepare_warps(const ImplicitCloud& cloud, const ImplicitSettings& s, double time,
                   const Box& macro, ImplicitField& f) {
    const double share =
        cloud.warp_to > cloud.warp_from
            ? s.warp * smoothstep((time - cloud.warp_from) / (cloud.warp_to - cloud.warp_from))
            : s.warp;
    const Frame& frame = f.frame;
    f.jet = glm::vec3(s.jet * share);
    f.jet_turbulence = static_cast<float>(s.jet_turbulence * share);
    f.jet_floor = static_cast<float>(macro.min.y);
    f.jet_slope = static_cast<float>(1 / std::max(macro.max.y - macro.min.y, 1e-6));
    if (cloud.flow) prepare_flow(*cloud.flow, share, frame, f.flow);
    for (const ImplicitAttractor& described : cloud.attractors) {
        const ImplicitAttractor a = attractor_at(described, !cloud.linear_keys, time);
        const WarpReach most = reach_at_all_times(described);
        const double strength = most.strength;
        f.attractors.push_back(
            {glm::vec3((a.at - frame.middle) / frame.unit), static_cast<float>(a.strength * share),
             static_cast<float>(1 / (a.reach / frame.unit)), ball_of(most, frame),
             most.reach / frame.unit * most_over_ball([=](double h) { return strength * h; })});
    }
    for (const ImplicitVortex& described : cloud.vortices) {
        const ImplicitVortex v = vortex_at(described, !cloud.linear_keys, time);
        const WarpReach most = reach_at_all_times(described);
        const double radians = most.strength * std::numbers::pi / 180;
        f.vortices.push_back(
            {glm::vec3((v.at - frame.middle) / frame.unit), glm::vec3(glm::normalize(v.axis)),
             static_cast<float>(v.angle / 360 * share),
             static_cast<float>(1 / (v.reach / frame.unit)), ball_of(most, frame),
             most.reach / frame.unit *
                 most_over_ball([=](double h) { return std::min(2.0, radians * h); })});
    }
    f.warped = s.jet != glm::dvec3(0) || s.jet_turbulence > 0 || cloud.flow ||
               !cloud.attractors.empty() || !cloud.vortices.empty();
}

// How far back along the jet stream a point is taken now: from `low` to `high`, along each axis.
void jet_range(const ImplicitSettings& s, glm::dvec3& low, glm::dvec3& high) {
    const glm::dvec3 most = s.jet + s.jet_turbulence * glm::dvec3(0.2, 0.3, 0.25);
    low = glm::min(glm::min(s.jet, most), glm::dvec3(0));
    high = glm::max(glm::max(s.jet, most), glm::dvec3(0));
}

// Where matter of the macrostructure is seen: the steps of density() (field.cpp) backwards.
Box seen_box(const ImplicitCloud& cloud, const Box& macro, const ImplicitField& f) {
    const SettingsReach reach = reach_at_all_times(cloud);
    Box box = macro;
    if (box.empty()) return box;
    for (std::size_t i = f.vortices.size(); i-- > 0;)
        box = warped_within(box, f.vortices[i].ball, f.vortices[i].most);
    for (std::size_t i = f.attractors.size(); i-- > 0;)
        box = warped_within(box, f.attractors[i].ball, f.attractors[i].most);
    box = widened(box, f.flow.low, f.flow.high);
    box = widened(box, reach.jet_low, reach.jet_high);
    box = widened(box, glm::dvec3(-reach.displacement), glm::dvec3(reach.displacement));
    if (f.has_base) {
        const double base = (reach.base - f.frame.middle.y) / f.frame.unit;
        box.min.y = std::max(
            box.min.y, static_cast<double>(static_cast<float>(base)) - 0.25 * reach.displacement);
    }
    if (cloud.squash) box = squashed_at_all_times(*cloud.squash, f.squash_at, box);
    return box;
}

}  // namespace

// The path of the noise. As Ebert 2002 prints it: theta = 2 pi frame / 600, path = (.005 sin theta frame, .01215
// frame, .0035 sin theta frame), scale = (.5 + .01 frame, .5, .0073 frame); the noise is taken at n - (path.x,
// path.y, -path.z) + peach (scale.x, .5, -scale.z), where peach is a noise of its own. Both x and z swing with the
// sine (the cosine is computed and never used), so that the "swirl" is a line that grows for ever, and the scales
// tear the noise to pieces after some hundred frames. The steady path, not printed, is an ellipse that rises; its
// scales stay those of frame 0.
SwirlPath swirl_path(double frame, bool printed) {
    const double degrees = 0.6 * frame;
    const double sine = exact::sincos_degrees(degrees).sin,
                 cosine = exact::sincos_degrees(degrees).cos;
    SwirlPath path;
    const double rise = 0.01215 * frame;
    if (printed) {
        path.offset = {-0.005 * sine * frame, -rise, 0.0035 * sine * frame};
        path.scale = {0.5 + 0.01 * frame, 0.5, -0.0073 * frame};
    } else {
        path.offset = {-0.5 * sine, -rise, 0.35 * (1 - cosine)};
        path.scale = {0.5, 0.5, 0};
    }
    return path;
}

void limit_octaves(const ImplicitCloud& cloud, std::uint64_t key, double time, double cell,
                   ImplicitField& field) {
    const ImplicitSettings s = settings_at(cloud, time);
    const SwirlPath path = swirl_path(time * cloud.swirl, cloud.printed_swirl);
    const double cells = cell / (s.mean_radius * s.noise_size);
    const auto octaves = [&](Purpose purpose) {
        return octaves_of(keyed(key, purpose), static_cast<int>(s.octaves), s.gain, cells,
                          path.offset.x, path.offset.y, path.offset.z);
    };
    field.octaves = octaves(kTurbulenceKey);
    field.moving = octaves(kMovingKey);
}

namespace {

// All that primitives are made of, at one time and in a box around all times.
class Macrostructure {
  public:
    Macrostructure(const ImplicitCloud& cloud, const ImplicitSettings& s, std::uint64_t key)
        : cloud_(cloud), key_(key), primitives_(s.primitives) {
        const std::vector<ImplicitPrimitive> driven = primitives_of(cloud.particles);
        primitives_.insert(primitives_.end(), driven.begin(), driven.end());
        for (const ImplicitPrimitive& primitive : primitives_) box.add(box_at_all_times(primitive));
        if (cloud.growth)
            box.add(growth_box(*cloud.growth, keyed(key, kGrowthKey), !cloud.linear_keys));
        if (cloud.bubbles) box.add(bubbles_box(*cloud.bubbles));
        if (cloud.billows) {
            sheet_ = rolled_sheet(cloud.billows->amplitude, cloud.billows->smoothing);
            box.add(billows_box(*cloud.billows, sheet_));
        }
        if (cloud.cells) box.add(cells_box(*cloud.cells));
    }

    // Units.
    Box box;

    void add_at(double time, const Frame& frame, std::vector<Element>& elements) const {
        for (const ImplicitPrimitive& primitive : primitives_)
            add_elements(primitive, !cloud_.linear_keys, time, frame, elements);
        if (cloud_.growth) {
            const bool smooth = !cloud_.linear_keys;
            const ColonySeen seen = colony_seen(*cloud_.growth, smooth, time);
            for (const GrownParticle& particle :
                 grown(*cloud_.growth, keyed(key_, kGrowthKey), time, smooth))
                elements.push_back(element_of(particle, seen, frame));
        }
        const auto add = [&](const std::vector<Puff>& puffs) {
            for (const Puff& puff : puffs)
                elements.push_back(sphere_element(puff.center, puff.radius, puff.weight, frame));
        };
        if (cloud_.bubbles) add(bubbles_at(*cloud_.bubbles, keyed(key_, kBubblesKey), time));
        if (cloud_.billows)
            add_billows(*cloud_.billows, sheet_, keyed(key_, kBillowsKey), time, frame, elements);
        if (cloud_.cells) add(cells_at(*cloud_.cells, keyed(key_, kCellsKey), time));
    }

  private:
    const ImplicitCloud& cloud_;
    std::uint64_t key_;
    std::vector<ImplicitPrimitive> primitives_;
    std::vector<SheetLine> sheet_;
};

void prepare_squash(const ImplicitCloud& cloud, double time, ImplicitField& f) {
    f.unsquash = glm::dmat3(1);
    if (!cloud.squash) return;
    const double amount = squash_amount(*cloud.squash, !cloud.linear_keys, time);
    f.squashed = true;
    f.squash_at = (cloud.squash->at - f.frame.middle) / f.frame.unit;
    f.unsquash = stretched_along(cloud.squash->axis, 1 / amount);
}

// A formula that does not read has been refused by validate().
void prepare_formula(const ImplicitCloud& cloud, std::uint64_t key, double time, ImplicitField& f) {
    if (!cloud.formula) return;
    auto read = parse_formula(*cloud.formula, "");
    if (!read) return;
    auto made = std::make_shared<PreparedFormula>();
    made->formula = *std::move(read);
    const std::uint64_t own = keyed(key, kFormulaKey);
    made->octaves = octaves_of(own, kMostOctaves, 0.5, 0, 0, 0, 0);
    made->time = static_cast<float>(time);
    made->seed = static_cast<float>(unit_open(static_cast<std::uint32_t>(own >> 32)));
    made->floor = f.jet_floor;
    made->slope = f.jet_slope;
    made->unit = static_cast<float>(f.frame.unit);
    made->middle = glm::vec3(f.frame.middle);
    for (std::uint32_t i = 0; i < f.elements.size(); ++i) made->every.push_back(i);
    f.formula = std::move(made);
}

}  // namespace

ImplicitField prepare_field(const ImplicitCloud& cloud, std::uint64_t key, double time) {
    const ImplicitSettings s = settings_at(cloud, time);
    ImplicitField f{};
    const Macrostructure macrostructure(cloud, s, key);
    const Box& all = macrostructure.box;
    f.frame.unit = s.mean_radius;
    if (!all.empty()) f.frame.middle = (all.min + all.max) / 2.0;
    macrostructure.add_at(time, f.frame, f.elements);

    f.amount = static_cast<float>(s.amount);
    f.exponent = static_cast<float>(s.exponent);
    f.blend = static_cast<float>(s.blend);
    f.displacement = static_cast<float>(s.displacement);
    f.diagonal = cloud.diagonal;
    prepare_noise(cloud, s, key, time, f);
    Box macro;
    if (!all.empty()) macro = within(f.frame, all);
    prepare_warps(cloud, s, time, macro, f);
    for (int i = 0; i < 3; ++i)
        f.ripple[i] = s.ripple[i] > 0 ? static_cast<float>(1 / s.ripple[i]) : 0;
    const bool rippled = s.ripple != glm::dvec3(0);
    f.ripple_depth = rippled ? static_cast<float>(s.ripple_depth) : 0;
    f.ripple_turns = static_cast<float>(s.ripple_turbulence / (2 * std::numbers::pi));
    f.has_base = s.base.has_value();
    f.base_inverse = 5;
    if (s.base) f.base = static_cast<float>((*s.base - f.frame.middle.y) / f.frame.unit);
    prepare_squash(cloud, time, f);
    prepare_formula(cloud, key, time, f);
    f.box = seen_box(cloud, macro, f);
    return f;
}

Box box_of(const ImplicitField& field) {
    const Frame& frame = field.frame;
    if (field.box.empty()) return {};
    return {frame.middle + frame.unit * field.box.min, frame.middle + frame.unit * field.box.max};
}

std::vector<std::uint32_t> elements_near(const ImplicitField& field, const Box& box) {
    const Frame& frame = field.frame;
    Box at = within(frame, box);
    if (field.squashed) at = mapped(field.unsquash, field.squash_at, at);
    const auto most = static_cast<double>(field.displacement);
    at = widened(at, glm::dvec3(-most), glm::dvec3(most));
    if (field.warped) {
        ImplicitSettings jet;
        jet.jet = glm::dvec3(field.jet);
        jet.jet_turbulence = static_cast<double>(field.jet_turbulence);
        glm::dvec3 low, high;
        jet_range(jet, low, high);
        at = widened(at, -high, -low);
        at = widened(at, -field.flow.high, -field.flow.low);
        // Inside its ball, an attractor shows what lies outside.
        for (const PreparedAttractor& a : field.attractors)
            if (touch(at, a.ball)) at = widened(at, glm::dvec3(-a.most), glm::dvec3(a.most));
        for (const PreparedVortex& v : field.vortices) at = warped_within(at, v.ball, v.most);
    }
    // Boxes are in double, points in float.
    at = widened(at, glm::dvec3(-1e-4), glm::dvec3(1e-4));
    std::vector<std::uint32_t> list;
    // Whether the list has pieces of a skeleton whose last is yet to come.
    bool open = false;
    for (std::uint32_t i = 0; i < field.elements.size(); ++i) {
        const Element& e = field.elements[i];
        const bool near = e.weight != 0 && touch(e.box, at);
        if (near || (open && e.last)) list.push_back(i);
        open = (open || near) && !e.last;
    }
    return list;
}

}  // namespace awan::implicit
