#include "tests/calibration/scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/generate/keyed_random.h"
#include "core/pipeline.h"
#include "core/scene/validate.h"

namespace awan::calibration {
namespace {

// Numbers by what they are for, so that adding one leaves the others as they were.
class Dice {
  public:
    explicit Dice(std::uint64_t key) : key_(key) {}
    double unit() { return unit_open(static_cast<std::uint32_t>(keyed(key_, count_++) >> 32)); }
    double between(double low, double high) { return low + (high - low) * unit(); }
    double log_between(double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    }
    int pick(int count) { return std::min(static_cast<int>(unit() * count), count - 1); }
    glm::dvec3 in_box(const glm::dvec3& size) {
        return {between(-.5, .5) * size.x, between(-.5, .5) * size.y, between(-.5, .5) * size.z};
    }

  private:
    std::uint64_t key_, count_ = 0;
};

std::uint64_t key_of(const std::string& set, int index) {
    std::uint64_t key = 0x6177616e;
    for (const char c : set) key = keyed(key, static_cast<unsigned char>(c));
    return keyed(key, static_cast<std::uint64_t>(index));
}

Cube cube_of(Dice& dice, double particles, const glm::dvec3& size, const glm::dvec3& center) {
    Cube cube;
    cube.particles = static_cast<std::uint32_t>(std::max(particles, 1.0));
    cube.size = size;
    cube.center = center;
    // So large that neighbours overlap a little, at most three times that.
    const double room = std::cbrt(size.x * size.y * size.z / std::max(particles, 1.0));
    cube.radius = room * dice.between(1.2, 3.5);
    return cube;
}

std::string fill_clouds(Dice& dice, SceneDraft& draft) {
    const double particles = std::floor(dice.log_between(20, 20000));
    draft.seed = 1 + static_cast<std::uint64_t>(dice.unit() * 1e6);
    draft.clouds.push_back({});
    Cloud& cloud = draft.clouds.back();
    switch (dice.pick(8)) {
        case 0: {  // one or a few balls
            draft.top_level_cubes = false;
            cloud.model = CloudModel::kParticles;
            const int count = 1 + dice.pick(6);
            for (int i = 0; i < count; ++i) {
                cloud.ready.positions.push_back(dice.in_box({8, 4, 8}) * (count > 1 ? 1.0 : 0.0));
                cloud.ready.radii.push_back(static_cast<float>(dice.log_between(.6, 4)));
                cloud.ready.densities.push_back(static_cast<float>(dice.between(.3, 1)));
            }
            return "balls";
        }
        case 1: {
            const glm::dvec3 size(dice.between(10, 30), dice.log_between(.05, 1),
                                  dice.between(10, 30));
            cloud.cubes = {cube_of(dice, particles, size, {0, 0, 0})};
            // A slab is as thick as its particles are.
            cloud.cubes[0].radius =
                std::max(size.y * dice.between(.8, 3), .7 * std::sqrt(size.x * size.z / particles));
            return "slab";
        }
        case 2: {
            draft.top_level_cubes = false;
            const int count = 2 + dice.pick(5);
            draft.clouds.resize(static_cast<std::size_t>(count));
            for (Cloud& one : draft.clouds) {
                const glm::dvec3 size(dice.between(2, 5), dice.between(1, 3), dice.between(2, 5));
                one.cubes = {cube_of(dice, particles / count, size, {0, 0, 0})};
                one.translate = dice.in_box({24, 3, 24});
                one.scale = dice.between(.6, 1.6);
                one.rotate_y = dice.between(0, 360);
            }
            return "field";
        }
        default: {
            const int count = 1 + dice.pick(5);
            for (int i = 0; i < count; ++i) {
                const glm::dvec3 size(dice.between(2, 8), dice.between(1, 4), dice.between(2, 6));
                cloud.cubes.push_back(cube_of(dice, particles / count, size,
                                              count > 1 ? dice.in_box({9, 5, 6}) : glm::dvec3(0)));
            }
            draft.fill = dice.pick(3) == 0 ? Fill::kGardner : Fill::kUniform;
            return "cubes";
        }
    }
}

void place_lights(Dice& dice, SceneDraft& draft) {
    const double bands[] = {0, .5, .85};
    draft.medium.g = dice.pick(2) == 0 ? bands[dice.pick(3)] : dice.between(0, .9);
    if (dice.pick(6) == 0) draft.medium.phase = PhaseFunction::kCornetteShanks;
    const double albedos[] = {1, .9999, .9999, .9999, .999, .97};
    draft.medium.albedo = dice.pick(8) == 0 ? dice.between(.4, .95) : albedos[dice.pick(6)];
    draft.sun.elevation = dice.between(-10, 90);
    draft.sun.azimuth = dice.between(0, 360);
    draft.sky.none = dice.pick(4) == 0;
}

// What sets named "effects..." have beside the others: daylight, ground, haze and detail.
void add_effects(Dice& dice, SceneDraft& draft, const Bounds& bounds, double mean_radius) {
    const double height = bounds.max.y - bounds.min.y + mean_radius;
    if (dice.pick(3) > 0) {
        draft.sky.none = false;
        draft.sky.physical = true;
        draft.sky.intensity = kPhysicalSkyIntensity;
        draft.sky.turbidity = dice.between(2, 6);
        draft.sun.elevation = dice.between(2, 80);
    }
    if (dice.pick(2) == 0) draft.sun.auto_color = draft.sun.elevation > 1;
    if (dice.pick(5) < 2)
        draft.ground =
            Ground{bounds.min.y - height * dice.between(.2, 2), glm::dvec3(dice.between(.05, .8))};
    if (dice.pick(2) == 0) draft.detail = Detail{dice.between(.3, 1), dice.between(.8, 2.5)};
    if (dice.pick(4) == 0)
        draft.haze = Haze{dice.log_between(.002, .1) / height, bounds.min.y - height,
                          height * dice.between(.5, 3), glm::dvec3(1), dice.between(0, .8)};
}

bool place_camera(Dice& dice, SceneDraft& draft, const Bounds& bounds) {
    const glm::dvec3 middle = 0.5 * (bounds.min + bounds.max), size = bounds.max - bounds.min;
    const int kind = dice.pick(8);
    if (kind < 3) return false;
    draft.camera.automatic = false;
    const double turn = dice.between(0, 2 * std::numbers::pi), rise = dice.between(-.6, 1.2);
    const glm::dvec3 way(std::cos(rise) * std::sin(turn), std::sin(rise),
                         std::cos(rise) * std::cos(turn));
    if (kind == 3) {  // inside
        draft.camera.eye = middle + dice.in_box(.5 * size);
        draft.camera.target = draft.camera.eye + way;
        draft.camera.fov = dice.between(40, 90);
        return true;
    }
    draft.camera.eye = middle + way * glm::length(size) * dice.between(.8, 1.6);
    draft.camera.target = middle + dice.in_box(.2 * size);
    draft.camera.fov = dice.between(25, 50);
    return false;
}

[[noreturn]] void give_up(const Error& error) {
    std::fprintf(stderr, "%s: %s\n", error.pointer.c_str(), error.message.c_str());
    std::abort();
}

Planned planned(const SceneDraft& draft) {
    auto scene = validate(draft);
    if (!scene.ok()) give_up(scene.error());
    auto result = plan_only(*scene, 2, {}, {});
    if (!result.ok()) give_up(result.error());
    return *std::move(result);
}

// Layouts that leave most of the rest to the service, as scripts post them.
std::string fill_plainly(Dice& dice, SceneDraft& draft) {
    draft.seed = 1 + static_cast<std::uint64_t>(dice.unit() * 1e6);
    draft.clouds.push_back({});
    Cloud& cloud = draft.clouds.back();
    const int count = 1 + dice.pick(5);
    glm::dvec3 size(dice.between(2, 10), dice.between(1, 4), dice.between(2, 7));
    glm::dvec3 base(0);
    for (int i = 0; i < count; ++i) {
        const double particles = std::floor(dice.log_between(50, 4000));
        const glm::dvec3 center(base.x, base.y + size.y / 2, base.z);
        cloud.cubes.push_back(cube_of(dice, particles, size, center));
        // On it or beside it.
        if (dice.pick(2) == 0) base.y += size.y * dice.between(.6, .95);
        base += dice.in_box({size.x, 0, size.z});
        size *= dice.between(.45, .9);
    }
    if (dice.pick(3) == 0) draft.fill = dice.pick(2) == 0 ? Fill::kStratus : Fill::kUniform;
    if (dice.pick(2) == 0) {
        draft.sun.elevation = dice.between(2, 85);
        draft.sun.azimuth = dice.between(0, 360);
    }
    if (dice.pick(3) == 0) draft.sky.turbidity = dice.between(2, 6);
    if (dice.pick(4) == 0) draft.density = dice.log_between(.1, 10) / size.y;
    if (dice.pick(4) == 0) draft.medium.g = dice.between(0, .87);
    if (dice.pick(3) == 0) draft.ground = Ground{-dice.between(.2, 8), glm::dvec3(.15)};
    return "plain";
}

// As wide as pictures are that people look at.
constexpr int kShownWidth = 640;

// A plain scene's small picture here has the lumps that its large one has.
void settle_detail(SceneDraft& draft) {
    SceneDraft shown = draft;
    shown.image.height = shown.image.height * kShownWidth / shown.image.width;
    shown.image.width = kShownWidth;
    shown.accuracy.rung = rung_of(RungId::kTruth).name;
    draft.effects[static_cast<int>(Effect::kDetail)] =
        planned(shown).plan.on(Effect::kDetail) ? Switch::kOn : Switch::kOff;
}

// What a scene that names all of it has by default is of no concern to it.
void name_all(SceneDraft& draft) {
    draft.fill = Fill::kUniform;
    draft.detail = std::nullopt;
    draft.sun.auto_color = false;
    draft.sky.physical = false;
    draft.sky.intensity = kGradientSkyIntensity;
}

}  // namespace

NumberedScene numbered_scene(const std::string& set, int index, int width, int height) {
    Dice dice(key_of(set, index));
    NumberedScene scene;
    SceneDraft& draft = scene.draft;
    draft.image.width = width;
    draft.image.height = height;
    draft.image.background = Background::kTransparent;
    if (set.rfind("plain", 0) == 0) {
        scene.kind = fill_plainly(dice, draft);
        settle_detail(draft);
        return scene;
    }
    name_all(draft);
    scene.kind = fill_clouds(dice, draft);
    place_lights(dice, draft);
    draft.density = 1;
    const Planned first = planned(draft);
    if (place_camera(dice, draft, first.survey.bounds)) scene.kind += " inside";
    const bool effects = set.rfind("effects", 0) == 0;
    if (effects)
        add_effects(dice, draft, first.survey.bounds, std::max(first.survey.detail.radius, 1e-3));
    // The depth that is wanted, from some side.
    const double depth = effects ? dice.log_between(.1, 1000) : dice.log_between(.02, 100);
    const Survey& survey = first.survey;
    const double at_one = std::max(survey.optical_depth_sun, survey.optical_depth_zenith);
    draft.density = std::clamp(depth / at_one, 1e-6, 1e5);
    return scene;
}

}  // namespace awan::calibration
