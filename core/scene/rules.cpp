// The rules of a scene that concern several fields at once.
#include "core/scene/rules.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <string>

#include "core/base/exact_math.h"
#include "core/scene/automaton.h"
#include "core/scene/checks.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/layers.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "core/scene/spheres.h"

namespace awan {
namespace {

// --- clouds

// Running totals of a scene, to find the element that goes over a limit.
struct Totals {
    std::uint64_t particles = 0;
    std::uint64_t cubes = 0;
};

Status add_particles(Totals& totals, std::uint64_t count, const std::string& pointer) {
    if (count > limits::kMaxParticles - totals.particles)
        return invalid(pointer, "a scene may have at most " +
                                    std::to_string(limits::kMaxParticles) +
                                    " particles in all, this makes it more");
    totals.particles += count;
    return std::nullopt;
}

// A cloud's transform (scene.h), for checking where things come to stand.
struct Placement {
    explicit Placement(const Cloud& cloud)
        : translate(cloud.translate),
          scale(cloud.scale),
          sine(exact::sin(glm::radians(cloud.rotate_y))),
          cosine(exact::cos(glm::radians(cloud.rotate_y))) {}

    bool within_limits(const glm::dvec3& p) const {
        const glm::dvec3 q = scale * p;
        const double x = translate.x + q.x * cosine + q.z * sine;
        const double y = translate.y + q.y;
        const double z = translate.z + q.z * cosine - q.x * sine;
        return std::max({std::abs(x), std::abs(y), std::abs(z)}) <= limits::kMaxCoordinate;
    }

    glm::dvec3 translate;
    double scale, sine, cosine;
};

Error too_far(std::string pointer) {
    return invalid(std::move(pointer),
                   "stands farther than " + to_text(limits::kMaxCoordinate) +
                       " from the origin after the cloud's scale, rotate_y and translate");
}

// `pointer` is called only to report, so that a million checks build no strings.
template <typename Pointer>
Status scaled_radius(double radius, double scale, Pointer pointer) {
    const double scaled = radius * scale;
    if (scaled >= limits::kMinRadius && scaled <= limits::kMaxRadius) return std::nullopt;
    return invalid(pointer(), "times the cloud's scale must be from " +
                                  to_text(limits::kMinRadius) + " to " +
                                  to_text(limits::kMaxRadius) + ", not " + to_text(scaled));
}

template <typename Pointer>
Status multiplied_density(double density, double cloud_density, Pointer pointer) {
    if (density * cloud_density <= limits::kMaxDensity) return std::nullopt;
    return invalid(pointer(), "times the cloud's density must be at most " +
                                  to_text(limits::kMaxDensity) + ", not " +
                                  to_text(density * cloud_density));
}

// That there is a texture of that name.
Error no_texture(const SceneDraft& draft, const std::string& pointer, const std::string& wanted,
                 const char* last = "") {
    std::string known;
    for (const OwnTexture& own : kOwnTextures)
        known += (known.empty() ? "" : ", ") + std::string(own.name);
    for (const auto& given : draft.textures) known += ", " + given->name;
    return invalid(pointer, wanted + " (" + known + last + "), or that of one that is uploaded");
}

Status check_texture(const SceneDraft& draft, const std::optional<std::string>& name,
                     const std::string& at) {
    if (!name || *name == kNoTexture || !find_texture(draft, *name).empty()) return std::nullopt;
    return no_texture(draft, at + "/texture", "must be the name or the hash of a texture",
                      ", none");
}

Status check_cube(const SceneDraft& draft, const Cloud& cloud, const Cube& cube,
                  const Placement& placement, double cloud_density, Totals& totals,
                  const std::string& at) {
    if (++totals.cubes > limits::kMaxCubes)
        return invalid(
            at, "a scene may have at most " + std::to_string(limits::kMaxCubes) + " cubes in all");
    if (Status wrong = check_texture(draft, cube.texture, at)) return wrong;
    if (Status wrong = add_particles(totals, particles_of(draft, cloud, cube),
                                     at + (cube.billboards ? "/billboards" : "/particles")))
        return wrong;
    if (!placement.within_limits(cube.center)) return too_far(at + "/center");
    if (Status wrong = scaled_radius(cube.radius, placement.scale, [&] { return at + "/radius"; }))
        return wrong;
    if (Status wrong =
            multiplied_density(cube.density, cloud_density, [&] { return at + "/density"; }))
        return wrong;
    return std::nullopt;
}

Status check_length(std::size_t length, std::size_t positions, bool may_be_absent,
                    const std::string& pointer) {
    if (length == positions || (may_be_absent && length == 0)) return std::nullopt;
    return invalid(pointer, "must have as many elements as `positions`, " +
                                std::to_string(positions) + ", not " + std::to_string(length));
}

// Ready radii are float32, and the smallest one allowed rounds to just below itself.
double as_written(float radius) {
    return radius == static_cast<float>(limits::kMinRadius) ? limits::kMinRadius
                                                            : static_cast<double>(radius);
}

Status check_ready(const ReadyParticles& ready, const Placement& placement, double cloud_density,
                   Totals& totals, const std::string& at) {
    const std::size_t n = ready.positions.size();
    if (Status wrong = add_particles(totals, n, at + "/positions")) return wrong;
    if (Status wrong = check_length(ready.radii.size(), n, false, at + "/radii")) return wrong;
    if (Status wrong = check_length(ready.densities.size(), n, true, at + "/densities"))
        return wrong;
    if (Status wrong = check_length(ready.colors.size(), n, true, at + "/colors")) return wrong;
    const auto element = [&](const char* list, std::size_t i) {
        return at + list + std::to_string(i);
    };
    for (std::size_t i = 0; i < n; ++i)
        if (!placement.within_limits(ready.positions[i])) return too_far(element("/positions/", i));
    for (std::size_t i = 0; i < n; ++i)
        if (Status wrong = scaled_radius(as_written(ready.radii[i]), placement.scale,
                                         [&] { return element("/radii/", i); }))
            return wrong;
    for (std::size_t i = 0; i < ready.densities.size(); ++i)
        if (Status wrong = multiplied_density(ready.densities[i], cloud_density,
                                              [&] { return element("/densities/", i); }))
            return wrong;
    return std::nullopt;
}

// At which something may stand.
std::vector<double> times_of(const SceneDraft& draft) {
    if (!draft.sequence) return {draft.time};
    const Sequence& sequence = *draft.sequence;
    if (sequence.clouds_stand) return {sequence.from};
    return {draft.time, sequence.from, sequence.to};
}

bool within_limits(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= limits::kMaxCoordinate;
}

Status check_cloud(const SceneDraft& draft, std::size_t k, Totals& totals) {
    const Cloud& cloud = draft.clouds[k];
    const std::string at = draft.top_level_cubes ? "" : "/clouds/" + std::to_string(k);
    for (const double time : times_of(draft))
        if (!within_limits(cloud.translate + time * cloud.velocity))
            return too_far(at + "/velocity");
    if (Status wrong = check_texture(draft, cloud.texture, at)) return wrong;
    const bool described[] = {cloud.automaton != nullptr, cloud.spheres != nullptr,
                              cloud.implicit != nullptr, cloud.ellipsoids != nullptr};
    constexpr CloudModel kOf[] = {CloudModel::kAutomaton, CloudModel::kSpheres,
                                  CloudModel::kImplicit, CloudModel::kEllipsoids};
    for (std::size_t i = 0; i < std::size(kOf); ++i)
        if (described[i] != (cloud.model == kOf[i]))
            return invalid(at, "must have the description of its model and no other");
    if (cloud.automaton) {
        for (const std::string_view name : names_in(cloud.automaton->drawing.textures))
            if (name == kNoTexture || find_texture(draft, name).empty())
                return no_texture(draft, at + "/automaton/drawing/textures",
                                  "must name textures, with commas between");
        return check_rules(*cloud.automaton, at + "/automaton");
    }
    if (cloud.spheres) {
        if (const auto& bump = cloud.spheres->bump)
            if (Status wrong = check_texture(draft, bump->texture, at + "/spheres/bump"))
                return wrong;
        return check_rules(*cloud.spheres, at + "/spheres");
    }
    if (cloud.implicit) return check_rules(*cloud.implicit, at + "/implicit");
    if (cloud.ellipsoids) return check_rules(*cloud.ellipsoids, at + "/ellipsoids");
    const double density = density_of(draft, cloud).value_or(kDefaultDensity);
    const Placement placement(cloud);
    if (cloud.model == CloudModel::kParticles)
        return check_ready(cloud.ready, placement, density, totals, at);
    for (std::size_t i = 0; i < cloud.cubes.size(); ++i)
        if (Status wrong = check_cube(draft, cloud, cloud.cubes[i], placement, density, totals,
                                      at + "/cubes/" + std::to_string(i)))
            return wrong;
    return std::nullopt;
}

// A look belongs to one model, and has no rungs.
Status check_look(const SceneDraft& draft) {
    if (draft.look == Look::kPhysical) return std::nullopt;
    // In the order of the looks, of those behind kPhysical.
    constexpr CloudModel kOf[] = {CloudModel::kSpheres, CloudModel::kEllipsoids,
                                  CloudModel::kAutomaton};
    const CloudModel model = kOf[static_cast<int>(draft.look) - 1];
    for (std::size_t k = 0; k < draft.clouds.size(); ++k)
        if (draft.clouds[k].model != model)
            return invalid("/look", std::string("belongs to clouds of model \"") +
                                        kCloudModelWords[static_cast<int>(model)] +
                                        "\", and cloud " + std::to_string(k) + " is not");
    const Accuracy& accuracy = draft.accuracy;
    if (accuracy.error || accuracy.time_ms || accuracy.rung)
        return invalid("/accuracy",
                       "a look follows its own rules and has no rungs; leave `accuracy` out or "
                       "give the look \"physical\"");
    return std::nullopt;
}

Status check_clouds(const SceneDraft& draft) {
    if (draft.top_level_cubes &&
        (draft.clouds.size() != 1 || draft.clouds[0].model != CloudModel::kCubes))
        return invalid("", "a scene needs `cubes` or `clouds`");
    if (Status wrong = check_texture(draft, draft.texture, "")) return wrong;
    Totals totals;
    for (std::size_t k = 0; k < draft.clouds.size(); ++k)
        if (Status wrong = check_cloud(draft, k, totals)) return wrong;
    if (const std::size_t used = textures_of(draft).size(); used > limits::kMaxTextures)
        return invalid("", "a scene may be painted with at most " +
                               std::to_string(limits::kMaxTextures) + " textures, not " +
                               std::to_string(used));
    return std::nullopt;
}

Status check_terrain(const SceneDraft& draft) {
    if (!draft.ground || !draft.ground->terrain || !draft.ground->terrain->map || !map_hash(draft).empty())
        return std::nullopt;
    std::string known;
    for (const auto& given : draft.textures) known += given->name + ", ";
    for (const OwnTexture& own : kOwnTextures) known += std::string(own.name) + ", ";
    return invalid("/ground/terrain/map", "must be the name or the hash of a picture (" + known +
                                              "or one that is uploaded)");
}

Status check_sun(const Sun& sun) {
    if (sun.direction && *sun.direction == glm::dvec3(0))
        return invalid("/sun/direction", "must point somewhere: it is [0, 0, 0]");
    return std::nullopt;
}

Status check_camera(const Camera& camera) {
    if (camera.automatic) return std::nullopt;
    const glm::dvec3 view = camera.target - camera.eye;
    // Longer than the smallest double whose square is a number, else nothing can be normalised.
    if (!(glm::length(view) > 0))
        return invalid("/camera/target", "must differ from `eye`: there is no direction to look");
    if (!(glm::length(camera.up) > 0))
        return invalid("/camera/up", "must have a length: it is [0, 0, 0]");
    if (!(glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) >
          limits::kMinUpSine))
        return invalid("/camera/up", "must not be parallel to the view direction, eye to target");
    return std::nullopt;
}

Status check_camera_keys(const std::vector<CameraKey>& keys) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const std::string at = "/sequence/camera/" + std::to_string(i);
        if (i > 0 && !(keys[i].time > keys[i - 1].time))
            return invalid(at + "/time", "must be later than that of the key before, " +
                                             to_text(keys[i - 1].time));
        if (!(glm::length(keys[i].target - keys[i].eye) > 0))
            return invalid(at + "/target", "must differ from `eye`: there is no direction to look");
    }
    return std::nullopt;
}

Status check_image(const ImageSettings& image) {
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    if (pixels > limits::kMaxPixels)
        return invalid("/image", "width times height must be at most " +
                                     std::to_string(limits::kMaxPixels) + " pixels, not " +
                                     std::to_string(pixels));
    return std::nullopt;
}

// Whether what is asked for can be told apart: only the march can.
Status check_layers(const SceneDraft& draft) {
    const auto layers = read_layers(draft.image.layers);
    if (!layers) return invalid("/image/layers", "must be " + std::string(kLayersWanted));
    if (!layers->any()) return std::nullopt;
    constexpr const char* kWho =
        "; leave `layers` out, or ask for one of the rungs single and transport-*";
    if (draft.look != Look::kPhysical)
        return invalid("/image/layers",
                       std::string("the look ") + kLookWords[static_cast<int>(draft.look)] +
                           " is not made of light, and cannot be taken apart into layers");
    const Rung* const rung = draft.accuracy.rung ? find_rung(*draft.accuracy.rung) : nullptr;
    if (rung != nullptr && rung->method != Method::kMarch)
        return invalid("/image/layers", std::string("rung ") + rung->name +
                                            " cannot take its light apart into layers" + kWho);
    for (const Effect effect :
         {Effect::kSelfShadow, Effect::kMultipleScattering, Effect::kViewExtinction})
        if (draft.effects[static_cast<int>(effect)] == Switch::kOff && rung == nullptr)
            return invalid("/image/layers", std::string("without the effect ") +
                                                effect_name(effect) +
                                                " the picture is of splats, which cannot take "
                                                "their light apart into layers" +
                                                kWho);
    return std::nullopt;
}

Status check_accuracy(const Accuracy& accuracy) {
    const int given =
        accuracy.error.has_value() + accuracy.time_ms.has_value() + accuracy.rung.has_value();
    if (given > 1) return invalid("/accuracy", "give exactly one of `error`, `time_ms` and `rung`");
    if (accuracy.rung && !find_rung(*accuracy.rung)) {
        std::string names;
        for (const Rung& rung : ladder())
            names += (names.empty() ? "\"" : ", \"") + std::string(rung.name) + '"';
        return invalid("/accuracy/rung", "must be one of " + names);
    }
    return std::nullopt;
}

}  // namespace

Status check_rules(const SceneDraft& draft) {
    if (Status wrong = check_clouds(draft)) return wrong;
    if (Status wrong = check_terrain(draft)) return wrong;
    if (Status wrong = check_sun(draft.sun)) return wrong;
    if (Status wrong = check_camera(draft.camera)) return wrong;
    if (Status wrong = check_image(draft.image)) return wrong;
    if (draft.sequence)
        if (Status wrong = check_camera_keys(draft.sequence->camera)) return wrong;
    if (Status wrong = check_look(draft)) return wrong;
    if (Status wrong = check_accuracy(draft.accuracy)) return wrong;
    return check_layers(draft);
}

}  // namespace awan
