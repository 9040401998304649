// What was asked for, as plain values. A SceneDraft is as read (types right, ranges unchecked);
// a Scene is a draft that validate() (validate.h) has found possible. Nothing else can make a
// Scene.
//
// Axes: right-handed, y up; the unit of length is the scene's own. Angles in degrees here, as in
// the document; they become radians where they are used. Colours are linear, Rec. 709 primaries.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace awan {

// How a cube is filled (core/generate/cubes.h).
enum class Fill { kUniform, kGardner, kPrinted };

struct Cube {
    std::uint64_t particles = 0;
    glm::dvec3 size{0};
    glm::dvec3 center{0};
    double radius = 0;   // the largest particle radius in it; a particle's s is half its radius
    double density = 1;  // multiplies the cloud's
    std::optional<std::string> texture;  // of the texture system; not in this version
};

// Particles that come ready-made. All lists are as long as `positions`, or empty for the default.
struct ReadyParticles {
    std::vector<glm::dvec3> positions;
    std::vector<float> radii;
    std::vector<float> densities;   // each multiplies the cloud's density; default 1
    std::vector<glm::vec3> colors;  // 0..1, multiply the albedo; default white
};

enum class CloudModel { kCubes, kParticles, kAutomaton, kSpheres, kImplicit, kEllipsoids };

// The other models, each in a header of its own (automaton.h, ...).
struct AutomatonCloud;
struct SpheresCloud;
struct ImplicitCloud;
struct EllipsoidsCloud;

// A point p of the model stands at translate + rotate_y(scale * p) in the scene; radii scale too,
// extinction (1/unit) does not: a cloud made twice as large is twice as deep.
struct Cloud {
    CloudModel model = CloudModel::kCubes;
    std::vector<Cube> cubes;  // model kCubes
    ReadyParticles ready;     // model kParticles
    // Of the model that it is, the others null.
    std::shared_ptr<const AutomatonCloud> automaton;
    std::shared_ptr<const SpheresCloud> spheres;
    std::shared_ptr<const ImplicitCloud> implicit;
    std::shared_ptr<const EllipsoidsCloud> ellipsoids;
    glm::dvec3 velocity{0};  // scene units a second: at scene.time it stands so much farther
    glm::dvec3 translate{0};
    double scale = 1;
    double rotate_y = 0;                // degrees, from +z towards +x
    std::optional<Fill> fill;           // else the scene's
    std::optional<double> density;      // else the scene's
    std::optional<std::uint64_t> seed;  // else the scene's
};

enum class PhaseFunction { kHenyeyGreenstein, kCornetteShanks };

struct Medium {
    double albedo = 0.9999;  // single scattering, 0..1
    double g = 0.85;         // mean cosine of the phase function
    PhaseFunction phase = PhaseFunction::kHenyeyGreenstein;
};

struct Sun {
    double elevation = 40;  // degrees above the horizon, -90..90
    double azimuth = 60;    // degrees; 0 = +z, 90 = +x
    std::optional<glm::dvec3>
        direction;  // towards the sun, any length > 0; instead of the two angles
    glm::dvec3 color{1.0, 0.97, 0.92};
    bool auto_color =
        false;  // "auto": from the elevation (core/scene/daylight.h); `color` is unused then
    double intensity = 40;  // irradiance at normal incidence
};

// A gradient, radiance `intensity * mix(horizon, zenith, f(sine of elevation))` (core/shaders/sky.glsl), or the clear
// sky that belongs to the sun (core/scene/daylight.h), times `intensity`.
// The default where `physical`: Preetham et al.'s clear skies are 1.8 times as bright as measured ones (IES: 14 klx on the
// ground at 45 degrees, the model 25).
inline constexpr double kPhysicalSkyIntensity = 0.55;
struct Sky {
    bool none = false;      // "none": black, no light
    bool physical = false;  // then `zenith` and `horizon` are unused
    glm::dvec3 zenith{0.09, 0.25, 0.72};
    glm::dvec3 horizon{0.44, 0.67, 0.95};
    double intensity = 1.7;
    // Of the air, as Preetham et al. mean it: 2 is very clear, 3 clear, 6 hazy. For a physical sky and a sun of
    // colour "auto".
    double turbidity = 3;
};

struct Ground {
    double height = 0;
    glm::dvec3 albedo{0.2};
};

// Air that is seen: extinction (1/unit) `extinction * exp(-(y - height) / scale_height)` above `height`, `extinction`
// below it. It dims and veils what lies behind it and shows where the clouds shade it; the light on its way to the clouds,
// to the ground and to itself it leaves alone: sun and sky are given as they arrive there. Light it scatters, it
// scatters once.
struct Haze {
    double extinction = 0;
    double height = 0;
    double scale_height = 1;
    glm::dvec3 albedo{1};
    double g = 0.6;  // mean cosine, Henyey & Greenstein
};

// Structure finer than the particles (core/generate/detail.h).
struct Detail {
    double amount = 0.7;  // 0: none .. 1
    double size = 1.5;    // of the largest bumps, in mean particle radii
};

inline constexpr double kAutomaticFov = 40;  // degrees
struct Camera {
    bool automatic = true;  // "auto": the whole cloud, three-quarter view; then the rest is unused
    glm::dvec3 eye{0};
    glm::dvec3 target{0};
    glm::dvec3 up{0, 1, 0};
    double fov = 40;  // vertical, degrees
};

enum class ImageFormat { kPng, kExr };
enum class Background { kSky, kTransparent };
enum class Precision { kHalf, kFloat };  // of EXR's samples

struct ImageSettings {
    int width = 800;
    int height = 600;
    ImageFormat format = ImageFormat::kPng;
    Background background = Background::kSky;
    Precision precision = Precision::kHalf;
    std::optional<double>
        exposure;  // stops: radiance is multiplied by 2^exposure; none = auto (core/formats/tone.h)
};

// Every effect of the contract, in the order in which plans list them.
enum class Effect {
    kSelfShadow,
    kMultipleScattering,
    kViewExtinction,
    kSkyLight,
    kGroundLight,
    kGroundShadow,
    kSunColor,
    kAerialPerspective,
    kLightShafts,
    kDetail,
    kInterior,
    kTexture,
};
inline constexpr int kEffectCount = static_cast<int>(Effect::kTexture) + 1;
enum class Switch { kAuto, kOn, kOff };

// The name of an effect in documents, e.g. "self_shadow".
const char* effect_name(Effect effect);
std::optional<Effect> effect_from_name(std::string_view name);
// Whether this version can run it; the others are never on, and forcing them is refused.
bool in_this_version(Effect effect);

// At most one is set; none = error kDefaultError.
inline constexpr double kDefaultError = 0.1;
struct Accuracy {
    std::optional<double> error;      // relative, > 0
    std::optional<double> time_ms;    // > 0
    std::optional<std::string> rung;  // by name (core/scene/rungs.h)
};

// How a picture is made: by light as it is, or by the rules of a published system, which are a look and have no error
// against the truth (core/looks).
enum class Look { kPhysical, kOstroushko, kGardner };

// Frames 0 .. frames-1 of a scene, the first at `from`, the last at `to`, evenly between.
struct Sequence {
    double from = 0, to = 1;  // seconds
    std::uint64_t frames = 1;
};

struct SceneDraft {
    // True when the document has `cubes` at its top instead of `clouds`: then there is exactly one
    // cloud and pointers to its cubes read /cubes/i, else /clouds/k/cubes/i.
    bool top_level_cubes = true;
    std::vector<Cloud> clouds;
    Fill fill = Fill::kUniform;
    std::uint64_t seed = 1;
    std::optional<double> density;  // peak extinction of a particle, 1/unit; else kDefaultDensity
    Medium medium;
    Sun sun;
    Sky sky;
    std::optional<Ground> ground;
    std::optional<Haze> haze;
    std::optional<Detail> detail;
    Camera camera;
    ImageSettings image;
    Switch effects[kEffectCount] = {};
    Accuracy accuracy;
    Look look = Look::kPhysical;
    double time = 0;  // seconds
    std::optional<Sequence> sequence;
};

// Makes table 4.4 a thick cumulus: optical depth about 30 through its middle (measured by
// survey_test).
inline constexpr double kDefaultDensity = 0.2;

// A scene that can be made: every value in range, every request within what this version does.
class Scene {
  public:
    const SceneDraft* operator->() const { return &draft_; }
    const SceneDraft& operator*() const { return draft_; }

  private:
    explicit Scene(SceneDraft draft) : draft_(std::move(draft)) {}
    friend Result<Scene> validate(SceneDraft draft);
    SceneDraft draft_;
};

// Unit vector towards the sun. Elevation 90 is exactly (0, 1, 0).
glm::dvec3 sun_direction(const Sun& sun);

// Of the models automaton, spheres, implicit and ellipsoids.
bool is_procedural(const Cloud& cloud);

// No more particles are made of a cloud that is_procedural(). 0 for others.
std::uint64_t most_particles(const Cloud& cloud);

// Particles asked for in all clouds, of models that make their own as many as they may. Saturates.
std::uint64_t particle_count(const SceneDraft& scene);

// 128 bits over every value of the scene, as 32 hex digits. Equal scenes, however written, have
// equal fingerprints; it is no protection against someone who wants a collision (XXH3).
std::string fingerprint(const Scene& scene);

// The same over what the light in a cloud depends on: neither camera, picture, effects nor accuracy.
std::string light_fingerprint(const Scene& scene);

}  // namespace awan
