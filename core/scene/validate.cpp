#include "core/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>

#include "core/scene/automaton.h"
#include "core/scene/checks.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/limits.h"
#include "core/scene/rungs.h"
#include "core/scene/spheres.h"

namespace awan {
namespace {

Error unsupported(std::string pointer, std::string message) {
    return {ErrorCode::kUnsupported, std::move(pointer), std::move(message)};
}

// Every check below is written so that NaN fails it: a draft may come from C++.

// `pointer` is called only to report, so that a million checks build no strings.
template <typename Pointer>
Status in_range(double value, double lowest, double highest, Pointer pointer) {
    if (value >= lowest && value <= highest) return std::nullopt;
    return out_of_range(pointer(), value, lowest, highest);
}

Status in_range(double value, double lowest, double highest, const char* pointer) {
    return in_range(value, lowest, highest, [=] { return std::string(pointer); });
}

template <typename Pointer>
Status all_in_range(const glm::dvec3& v, double lowest, double highest, Pointer pointer) {
    for (int i = 0; i < 3; ++i)
        if (Status wrong = in_range(v[i], lowest, highest,
                                    [&] { return pointer() + "/" + std::to_string(i); }))
            return wrong;
    return std::nullopt;
}

Status all_in_range(const glm::dvec3& v, double lowest, double highest, const char* pointer) {
    return all_in_range(v, lowest, highest, [=] { return std::string(pointer); });
}

template <typename Pointer>
Status coordinates(const glm::dvec3& v, Pointer pointer) {
    return all_in_range(v, -limits::kMaxCoordinate, limits::kMaxCoordinate, pointer);
}

Status coordinates(const glm::dvec3& v, const char* pointer) {
    return coordinates(v, [=] { return std::string(pointer); });
}

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
          sine(std::sin(glm::radians(cloud.rotate_y))),
          cosine(std::cos(glm::radians(cloud.rotate_y))) {}

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

// Ready radii are float32, and the smallest one allowed rounds to just below itself.
double as_written(float radius) {
    return radius == static_cast<float>(limits::kMinRadius) ? limits::kMinRadius
                                                            : static_cast<double>(radius);
}

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

Status check_cube(const Cube& cube, const Placement& placement, double cloud_density,
                  Totals& totals, const std::string& at) {
    if (++totals.cubes > limits::kMaxCubes)
        return invalid(
            at, "a scene may have at most " + std::to_string(limits::kMaxCubes) + " cubes in all");
    if (Status wrong = add_particles(totals, cube.particles, at + "/particles")) return wrong;
    if (Status wrong = all_in_range(cube.size, limits::kMinLength, limits::kMaxLength,
                                    [&] { return at + "/size"; }))
        return wrong;
    if (Status wrong = coordinates(cube.center, [&] { return at + "/center"; })) return wrong;
    if (!placement.within_limits(cube.center)) return too_far(at + "/center");
    const auto radius_pointer = [&] { return at + "/radius"; };
    if (Status wrong =
            in_range(cube.radius, limits::kMinRadius, limits::kMaxRadius, radius_pointer))
        return wrong;
    if (Status wrong = scaled_radius(cube.radius, placement.scale, radius_pointer)) return wrong;
    const auto density_pointer = [&] { return at + "/density"; };
    if (Status wrong = in_range(cube.density, 0, limits::kMaxDensity, density_pointer))
        return wrong;
    if (Status wrong = multiplied_density(cube.density, cloud_density, density_pointer))
        return wrong;
    if (cube.texture)
        return unsupported(at + "/texture",
                           "the texture system is not in this version; leave `texture` out");
    return std::nullopt;
}

Status check_length(std::size_t length, std::size_t positions, bool may_be_absent,
                    const std::string& pointer) {
    if (length == positions || (may_be_absent && length == 0)) return std::nullopt;
    return invalid(pointer, "must have as many elements as `positions`, " +
                                std::to_string(positions) + ", not " + std::to_string(length));
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
    for (std::size_t i = 0; i < n; ++i) {
        const auto pointer = [&] { return element("/positions/", i); };
        if (Status wrong = coordinates(ready.positions[i], pointer)) return wrong;
        if (!placement.within_limits(ready.positions[i])) return too_far(pointer());
    }
    for (std::size_t i = 0; i < n; ++i) {
        const auto pointer = [&] { return element("/radii/", i); };
        const double radius = as_written(ready.radii[i]);
        if (Status wrong = in_range(radius, limits::kMinRadius, limits::kMaxRadius, pointer))
            return wrong;
        if (Status wrong = scaled_radius(radius, placement.scale, pointer)) return wrong;
    }
    for (std::size_t i = 0; i < ready.densities.size(); ++i) {
        const auto pointer = [&] { return element("/densities/", i); };
        if (Status wrong = in_range(ready.densities[i], 0, limits::kMaxDensity, pointer))
            return wrong;
        if (Status wrong = multiplied_density(ready.densities[i], cloud_density, pointer))
            return wrong;
    }
    for (std::size_t i = 0; i < ready.colors.size(); ++i)
        if (Status wrong =
                all_in_range(ready.colors[i], 0, 1, [&] { return element("/colors/", i); }))
            return wrong;
    return std::nullopt;
}

// At which something may stand.
std::vector<double> times_of(const SceneDraft& draft) {
    if (!draft.sequence) return {draft.time};
    return {draft.time, draft.sequence->from, draft.sequence->to};
}

Status check_cloud(const SceneDraft& draft, std::size_t k, Totals& totals) {
    const Cloud& cloud = draft.clouds[k];
    const std::string at = draft.top_level_cubes ? "" : "/clouds/" + std::to_string(k);
    if (Status wrong = coordinates(cloud.translate, [&] { return at + "/translate"; }))
        return wrong;
    if (Status wrong = in_range(cloud.scale, limits::kMinScale, limits::kMaxScale,
                                [&] { return at + "/scale"; }))
        return wrong;
    if (Status wrong = in_range(cloud.rotate_y, -limits::kMaxAngle, limits::kMaxAngle,
                                [&] { return at + "/rotate_y"; }))
        return wrong;
    if (cloud.density)
        if (Status wrong =
                in_range(*cloud.density, 0, limits::kMaxDensity, [&] { return at + "/density"; }))
            return wrong;
    const double density = cloud.density.value_or(draft.density.value_or(kDefaultDensity));
    const auto velocity_pointer = [&] { return at + "/velocity"; };
    if (Status wrong = all_in_range(cloud.velocity, -limits::kMaxVelocity, limits::kMaxVelocity,
                                    velocity_pointer))
        return wrong;
    for (const double time : times_of(draft))
        if (Status wrong = coordinates(cloud.translate + time * cloud.velocity, velocity_pointer))
            return too_far(velocity_pointer());
    const Placement placement(cloud);
    const bool described[] = {cloud.automaton != nullptr, cloud.spheres != nullptr,
                              cloud.implicit != nullptr, cloud.ellipsoids != nullptr};
    constexpr CloudModel kOf[] = {CloudModel::kAutomaton, CloudModel::kSpheres,
                                  CloudModel::kImplicit, CloudModel::kEllipsoids};
    for (std::size_t i = 0; i < std::size(kOf); ++i)
        if (described[i] != (cloud.model == kOf[i]))
            return invalid(at, "must have the description of its model and no other");
    if (cloud.automaton) return check_automaton(*cloud.automaton, at + "/automaton");
    if (cloud.spheres) return check_spheres(*cloud.spheres, at + "/spheres");
    if (cloud.implicit) return check_implicit(*cloud.implicit, at + "/implicit");
    if (cloud.ellipsoids) return check_ellipsoids(*cloud.ellipsoids, at + "/ellipsoids");
    if (cloud.model == CloudModel::kParticles)
        return check_ready(cloud.ready, placement, density, totals, at);
    for (std::size_t i = 0; i < cloud.cubes.size(); ++i)
        if (Status wrong = check_cube(cloud.cubes[i], placement, density, totals,
                                      at + "/cubes/" + std::to_string(i)))
            return wrong;
    return std::nullopt;
}

Status check_times(const SceneDraft& draft) {
    if (Status wrong = in_range(draft.time, -limits::kMaxTime, limits::kMaxTime, "/time"))
        return wrong;
    if (!draft.sequence) return std::nullopt;
    const Sequence& sequence = *draft.sequence;
    if (Status wrong =
            in_range(sequence.from, -limits::kMaxTime, limits::kMaxTime, "/sequence/from"))
        return wrong;
    if (Status wrong = in_range(sequence.to, -limits::kMaxTime, limits::kMaxTime, "/sequence/to"))
        return wrong;
    if (sequence.frames < 1 || sequence.frames > limits::kMaxFrames)
        return invalid("/sequence/frames", "must be from 1 to " +
                                               std::to_string(limits::kMaxFrames) + ", not " +
                                               std::to_string(sequence.frames));
    return std::nullopt;
}

// The model whose look it is.
Status check_look(const SceneDraft& draft) {
    if (draft.look == Look::kPhysical) return std::nullopt;
    const bool gardner = draft.look == Look::kGardner;
    for (std::size_t k = 0; k < draft.clouds.size(); ++k)
        if (draft.clouds[k].model != (gardner ? CloudModel::kEllipsoids : CloudModel::kSpheres))
            return invalid("/look", std::string("belongs to clouds of model \"") +
                                        (gardner ? "ellipsoids" : "spheres") + "\", and cloud " +
                                        std::to_string(k) + " is not");
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
    if (draft.clouds.size() > limits::kMaxClouds)
        return invalid(
            "/clouds/" + std::to_string(limits::kMaxClouds),
            "a scene may have at most " + std::to_string(limits::kMaxClouds) + " clouds");
    if (draft.density)
        if (Status wrong = in_range(*draft.density, 0, limits::kMaxDensity, "/density"))
            return wrong;
    if (Status wrong = check_times(draft)) return wrong;
    Totals totals;
    for (std::size_t k = 0; k < draft.clouds.size(); ++k)
        if (Status wrong = check_cloud(draft, k, totals)) return wrong;
    return std::nullopt;
}

// --- light

Status check_medium(const Medium& medium) {
    if (Status wrong = in_range(medium.albedo, 0, 1, "/medium/albedo")) return wrong;
    return in_range(medium.g, -limits::kMaxAnisotropy, limits::kMaxAnisotropy, "/medium/g");
}

Status check_sun(const Sun& sun) {
    if (sun.direction) {
        if (Status wrong = coordinates(*sun.direction, "/sun/direction")) return wrong;
        if (*sun.direction == glm::dvec3(0))
            return invalid("/sun/direction", "must point somewhere: it is [0, 0, 0]");
    } else {
        if (Status wrong = in_range(sun.elevation, -90, 90, "/sun/elevation")) return wrong;
        if (Status wrong =
                in_range(sun.azimuth, -limits::kMaxAngle, limits::kMaxAngle, "/sun/azimuth"))
            return wrong;
    }
    if (Status wrong = all_in_range(sun.color, 0, limits::kMaxColor, "/sun/color")) return wrong;
    if (Status wrong = in_range(sun.intensity, 0, limits::kMaxIntensity, "/sun/intensity"))
        return wrong;
    return std::nullopt;
}

Status check_sky(const Sky& sky) {
    if (Status wrong =
            in_range(sky.turbidity, limits::kMinTurbidity, limits::kMaxTurbidity, "/sky/turbidity"))
        return wrong;
    if (sky.none) return std::nullopt;
    if (Status wrong = all_in_range(sky.zenith, 0, limits::kMaxColor, "/sky/zenith")) return wrong;
    if (Status wrong = all_in_range(sky.horizon, 0, limits::kMaxColor, "/sky/horizon"))
        return wrong;
    return in_range(sky.intensity, 0, limits::kMaxIntensity, "/sky/intensity");
}

Status check_ground(const Ground& ground) {
    if (Status wrong = in_range(ground.height, -limits::kMaxCoordinate, limits::kMaxCoordinate,
                                "/ground/height"))
        return wrong;
    return all_in_range(ground.albedo, 0, 1, "/ground/albedo");
}

Status check_haze(const Haze& haze) {
    if (Status wrong = in_range(haze.extinction, 0, limits::kMaxDensity, "/haze/extinction"))
        return wrong;
    if (Status wrong =
            in_range(haze.height, -limits::kMaxCoordinate, limits::kMaxCoordinate, "/haze/height"))
        return wrong;
    if (Status wrong = in_range(haze.scale_height, limits::kMinLength, limits::kMaxLength,
                                "/haze/scale_height"))
        return wrong;
    if (Status wrong = all_in_range(haze.albedo, 0, 1, "/haze/albedo")) return wrong;
    return in_range(haze.g, -limits::kMaxAnisotropy, limits::kMaxAnisotropy, "/haze/g");
}

Status check_detail(const Detail& detail) {
    if (Status wrong = in_range(detail.amount, 0, 1, "/detail/amount")) return wrong;
    return in_range(detail.size, limits::kMinDetailSize, limits::kMaxDetailSize, "/detail/size");
}

// --- picture

Status check_camera(const Camera& camera) {
    if (camera.automatic) return std::nullopt;
    if (Status wrong = coordinates(camera.eye, "/camera/eye")) return wrong;
    if (Status wrong = coordinates(camera.target, "/camera/target")) return wrong;
    if (Status wrong = coordinates(camera.up, "/camera/up")) return wrong;
    if (Status wrong = in_range(camera.fov, limits::kMinFov, limits::kMaxFov, "/camera/fov"))
        return wrong;
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

Status check_image(const ImageSettings& image) {
    if (Status wrong = in_range(image.width, 1, limits::kMaxImageSide, "/image/width"))
        return wrong;
    if (Status wrong = in_range(image.height, 1, limits::kMaxImageSide, "/image/height"))
        return wrong;
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
    if (pixels > limits::kMaxPixels)
        return invalid("/image", "width times height must be at most " +
                                     std::to_string(limits::kMaxPixels) + " pixels, not " +
                                     std::to_string(pixels));
    if (image.exposure)
        return in_range(*image.exposure, -limits::kMaxExposure, limits::kMaxExposure,
                        "/image/exposure");
    return std::nullopt;
}

// --- what to simulate

Status check_effects(const SceneDraft& draft) {
    for (int i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        if (draft.effects[i] == Switch::kOn && !in_this_version(effect))
            return unsupported(std::string("/effects/") + effect_name(effect),
                               "is not in this version; give false or \"auto\"");
    }
    return std::nullopt;
}

Status check_accuracy(const Accuracy& accuracy) {
    const int given =
        accuracy.error.has_value() + accuracy.time_ms.has_value() + accuracy.rung.has_value();
    if (given > 1) return invalid("/accuracy", "give exactly one of `error`, `time_ms` and `rung`");
    constexpr double kLargest = std::numeric_limits<double>::max();
    constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
    if (accuracy.error && !(*accuracy.error >= kSmallest && *accuracy.error <= kLargest))
        return invalid("/accuracy/error",
                       "must be a relative error > 0, not " + to_text(*accuracy.error));
    if (accuracy.time_ms && !(*accuracy.time_ms >= kSmallest && *accuracy.time_ms <= kLargest))
        return invalid("/accuracy/time_ms",
                       "must be milliseconds > 0, not " + to_text(*accuracy.time_ms));
    if (accuracy.rung && !find_rung(*accuracy.rung)) {
        std::string names;
        for (const Rung& rung : ladder())
            names += (names.empty() ? "\"" : ", \"") + std::string(rung.name) + '"';
        return invalid("/accuracy/rung", "must be one of " + names);
    }
    return std::nullopt;
}

}  // namespace

Result<Scene> validate(SceneDraft draft) {
    if (Status wrong = check_clouds(draft)) return *wrong;
    if (Status wrong = check_medium(draft.medium)) return *wrong;
    if (Status wrong = check_sun(draft.sun)) return *wrong;
    if (Status wrong = check_sky(draft.sky)) return *wrong;
    if (draft.ground)
        if (Status wrong = check_ground(*draft.ground)) return *wrong;
    if (draft.haze)
        if (Status wrong = check_haze(*draft.haze)) return *wrong;
    if (draft.detail)
        if (Status wrong = check_detail(*draft.detail)) return *wrong;
    if (Status wrong = check_camera(draft.camera)) return *wrong;
    if (Status wrong = check_image(draft.image)) return *wrong;
    if (Status wrong = check_look(draft)) return *wrong;
    if (Status wrong = check_effects(draft)) return *wrong;
    if (Status wrong = check_accuracy(draft.accuracy)) return *wrong;
    return Scene(std::move(draft));
}

}  // namespace awan
