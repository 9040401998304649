#include "server/document/fields.h"

#include <climits>
#include <cmath>
#include <limits>

#include "core/scene/limits.h"
#include "server/document/models.h"

namespace awan {
namespace {

using State = DraftInProgress;

WordOutcome taken_if(bool known) {
    return known ? WordOutcome::kTaken : WordOutcome::kUnknown;
}

template <typename T>
struct Word {
    std::string_view name;
    T value;
};

template <typename T, std::size_t N>
WordOutcome choose(std::string_view name, const Word<T> (&words)[N], auto set) {
    for (const Word<T>& word : words)
        if (word.name == name) {
            set(word.value);
            return WordOutcome::kTaken;
        }
    return WordOutcome::kUnknown;
}

constexpr const char* kFillWanted = R"(one of "uniform", "gardner", "printed")";

WordOutcome choose_fill(std::string_view name, auto set) {
    static constexpr Word<Fill> kFills[] = {
        {"uniform", Fill::kUniform}, {"gardner", Fill::kGardner}, {"printed", Fill::kPrinted}};
    return choose(name, kFills, set);
}

WordOutcome choose_model(State& s, std::string_view name) {
    static constexpr Word<CloudModel> kModels[] = {
        {"cubes", CloudModel::kCubes},         {"particles", CloudModel::kParticles},
        {"automaton", CloudModel::kAutomaton}, {"spheres", CloudModel::kSpheres},
        {"implicit", CloudModel::kImplicit},   {"ellipsoids", CloudModel::kEllipsoids}};
    return choose(name, kModels, [&](CloudModel model) { s.cloud->model = model; });
}

constexpr const char* kSeedWanted = "an integer from 0 to 18446744073709551615";
constexpr const char* kVectorWanted = "[x, y, z]: three numbers";
constexpr const char* kColorWanted = "[r, g, b]: three numbers";
constexpr const char* kDensityWanted = "a number >= 0 (extinction, 1/unit)";

constexpr Field kSceneFields[] = {
    {.name = "cubes", .wanted = "a list of cubes", .list = ListKind::kCubes},
    {.name = "clouds", .wanted = "a list of clouds", .list = ListKind::kClouds},
    {.name = "fill",
     .wanted = kFillWanted,
     .word =
         [](State& s, std::string_view v) {
             return choose_fill(v, [&](Fill fill) { s.draft.fill = fill; });
         }},
    {.name = "seed",
     .wanted = kSeedWanted,
     .integer = [](State& s, std::uint64_t v) { s.draft.seed = v; }},
    {.name = "density",
     .wanted = kDensityWanted,
     .number = [](State& s, double v) { s.draft.density = v; }},
    {.name = "medium", .wanted = "an object", .object = ObjectKind::kMedium},
    {.name = "sun", .wanted = "an object", .object = ObjectKind::kSun},
    {.name = "sky",
     .wanted = R"(an object, "physical" or "none")",
     .word =
         [](State& s, std::string_view v) {
             Sky& sky = s.draft.sky;
             sky.none = v == "none";
             sky.physical = v == "physical";
             if (sky.physical) sky.intensity = kPhysicalSkyIntensity;
             return taken_if(sky.none || sky.physical);
         },
     .object = ObjectKind::kSky},
    {.name = "ground",
     .wanted = R"(an object or "none")",
     .word = [](State&, std::string_view v) { return taken_if(v == "none"); },
     .object = ObjectKind::kGround},
    {.name = "haze",
     .wanted = R"(an object or "none")",
     .word = [](State&, std::string_view v) { return taken_if(v == "none"); },
     .object = ObjectKind::kHaze},
    {.name = "detail",
     .wanted = R"(an object or "none")",
     .word = [](State&, std::string_view v) { return taken_if(v == "none"); },
     .object = ObjectKind::kDetail},
    {.name = "camera",
     .wanted = R"(an object or "auto")",
     .word = [](State&, std::string_view v) { return taken_if(v == "auto"); },
     .object = ObjectKind::kCamera},
    {.name = "image", .wanted = "an object", .object = ObjectKind::kImage},
    {.name = "effects",
     .wanted = R"(an object or "auto")",
     .word = [](State&, std::string_view v) { return taken_if(v == "auto"); },
     .object = ObjectKind::kEffects},
    {.name = "accuracy", .wanted = "an object", .object = ObjectKind::kAccuracy},
    {.name = "look",
     .wanted = R"(one of "physical", "ostroushko", "gardner")",
     .word =
         [](State& s, std::string_view v) {
             static constexpr Word<Look> kLooks[] = {{"physical", Look::kPhysical},
                                                     {"ostroushko", Look::kOstroushko},
                                                     {"gardner", Look::kGardner}};
             return choose(v, kLooks, [&](Look look) { s.draft.look = look; });
         }},
    {.name = "time",
     .wanted = "a number (seconds)",
     .number = [](State& s, double v) { s.draft.time = v; }},
    {.name = "sequence",
     .wanted = R"(an object or "none")",
     .word = [](State&, std::string_view v) { return taken_if(v == "none"); },
     .object = ObjectKind::kSequence},
};

constexpr Field kSequenceFields[] = {
    {.name = "from",
     .wanted = "a number (seconds)",
     .number = [](State& s, double v) { s.draft.sequence->from = v; }},
    {.name = "to",
     .wanted = "a number (seconds)",
     .required = true,
     .number = [](State& s, double v) { s.draft.sequence->to = v; }},
    {.name = "frames",
     .wanted = "an integer >= 1",
     .required = true,
     .integer = [](State& s, std::uint64_t v) { s.draft.sequence->frames = v; }},
};

constexpr Field kCubeFields[] = {
    {.name = "particles",
     .wanted = "an integer >= 0",
     .required = true,
     .integer = [](State& s, std::uint64_t v) { s.cube->particles = v; }},
    {.name = "size",
     .wanted = kVectorWanted,
     .required = true,
     .vector = [](State& s) { return &s.cube->size; }},
    {.name = "center",
     .wanted = kVectorWanted,
     .required = true,
     .vector = [](State& s) { return &s.cube->center; }},
    {.name = "radius",
     .wanted = "a number > 0",
     .required = true,
     .number = [](State& s, double v) { s.cube->radius = v; }},
    {.name = "density",
     .wanted = "a number >= 0 (multiplies the cloud's)",
     .number = [](State& s, double v) { s.cube->density = v; }},
    {.name = "texture",
     .wanted = "the name of a texture",
     .word =
         [](State& s, std::string_view v) {
             s.cube->texture = std::string(v);
             return WordOutcome::kTaken;
         }},
};

constexpr Field kCloudFields[] = {
    {.name = "model",
     .wanted = R"(one of "cubes", "particles", "automaton", "spheres", "implicit", "ellipsoids")",
     .word = choose_model},
    {.name = "cubes", .wanted = "a list of cubes", .list = ListKind::kCubes},
    {.name = "positions", .wanted = "a list of [x, y, z]", .list = ListKind::kPositions},
    {.name = "radii", .wanted = "a list of numbers > 0", .list = ListKind::kRadii},
    {.name = "densities", .wanted = "a list of numbers >= 0", .list = ListKind::kDensities},
    {.name = "colors", .wanted = "a list of [r, g, b]", .list = ListKind::kColors},
    {.name = "automaton", .wanted = "an object", .object = ObjectKind::kAutomaton},
    {.name = "spheres", .wanted = "an object", .object = ObjectKind::kSpheres},
    {.name = "implicit", .wanted = "an object", .object = ObjectKind::kImplicit},
    {.name = "ellipsoids", .wanted = "an object", .object = ObjectKind::kEllipsoids},
    {.name = "translate",
     .wanted = kVectorWanted,
     .vector = [](State& s) { return &s.cloud->translate; }},
    {.name = "velocity",
     .wanted = "[x, y, z]: three numbers (units a second)",
     .vector = [](State& s) { return &s.cloud->velocity; }},
    {.name = "scale",
     .wanted = "a number > 0",
     .number = [](State& s, double v) { s.cloud->scale = v; }},
    {.name = "rotate_y",
     .wanted = "a number (degrees)",
     .number = [](State& s, double v) { s.cloud->rotate_y = v; }},
    {.name = "fill",
     .wanted = kFillWanted,
     .word =
         [](State& s, std::string_view v) {
             return choose_fill(v, [&](Fill fill) { s.cloud->fill = fill; });
         }},
    {.name = "density",
     .wanted = kDensityWanted,
     .number = [](State& s, double v) { s.cloud->density = v; }},
    {.name = "seed",
     .wanted = kSeedWanted,
     .integer = [](State& s, std::uint64_t v) { s.cloud->seed = v; }},
};

constexpr Field kMediumFields[] = {
    {.name = "albedo",
     .wanted = "a number from 0 to 1",
     .number = [](State& s, double v) { s.draft.medium.albedo = v; }},
    {.name = "g",
     .wanted = "a number (the mean cosine of the phase function)",
     .number = [](State& s, double v) { s.draft.medium.g = v; }},
    {.name = "phase",
     .wanted = R"("henyey-greenstein" or "cornette-shanks")",
     .word =
         [](State& s, std::string_view v) {
             static constexpr Word<PhaseFunction> kPhases[] = {
                 {"henyey-greenstein", PhaseFunction::kHenyeyGreenstein},
                 {"cornette-shanks", PhaseFunction::kCornetteShanks}};
             return choose(v, kPhases, [&](PhaseFunction p) { s.draft.medium.phase = p; });
         }},
};

constexpr Field kSunFields[] = {
    {.name = "elevation",
     .wanted = "a number (degrees above the horizon)",
     .number = [](State& s, double v) { s.draft.sun.elevation = v; }},
    {.name = "azimuth",
     .wanted = "a number (degrees; 0 is +z, 90 is +x)",
     .number = [](State& s, double v) { s.draft.sun.azimuth = v; }},
    {.name = "direction",
     .wanted = "[x, y, z] towards the sun",
     .vector = [](State& s) { return &s.draft.sun.direction.emplace(); }},
    {.name = "color",
     .wanted = R"([r, g, b] or "auto")",
     .word = [](State& s,
                std::string_view v) { return taken_if(s.draft.sun.auto_color = v == "auto"); },
     .vector = [](State& s) { return &s.draft.sun.color; }},
    {.name = "intensity",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.draft.sun.intensity = v; }},
};

constexpr Field kSkyFields[] = {
    {.name = "model",
     .wanted = R"("gradient" or "physical")",
     .word =
         [](State& s, std::string_view v) {
             s.draft.sky.physical = v == "physical";
             return taken_if(s.draft.sky.physical || v == "gradient");
         }},
    {.name = "turbidity",
     .wanted = "a number from 2 (very clear) to 10 (hazy)",
     .number = [](State& s, double v) { s.draft.sky.turbidity = v; }},
    {.name = "zenith",
     .wanted = kColorWanted,
     .vector = [](State& s) { return &s.draft.sky.zenith; }},
    {.name = "horizon",
     .wanted = kColorWanted,
     .vector = [](State& s) { return &s.draft.sky.horizon; }},
    {.name = "intensity",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.draft.sky.intensity = v; }},
};

constexpr Field kGroundFields[] = {
    {.name = "height",
     .wanted = "a number",
     .number = [](State& s, double v) { s.draft.ground->height = v; }},
    {.name = "albedo",
     .wanted = "a number or [r, g, b], from 0 to 1",
     .number = [](State& s, double v) { s.draft.ground->albedo = glm::dvec3(v); },
     .vector = [](State& s) { return &s.draft.ground->albedo; }},
};

constexpr Field kHazeFields[] = {
    {.name = "extinction",
     .wanted = "a number >= 0 (1/unit, at `height`)",
     .required = true,
     .number = [](State& s, double v) { s.draft.haze->extinction = v; }},
    {.name = "height",
     .wanted = "a number",
     .number = [](State& s, double v) { s.draft.haze->height = v; }},
    {.name = "scale_height",
     .wanted = "a number > 0: over so many units upward it thins to 37%",
     .required = true,
     .number = [](State& s, double v) { s.draft.haze->scale_height = v; }},
    {.name = "albedo",
     .wanted = "a number or [r, g, b], from 0 to 1",
     .number = [](State& s, double v) { s.draft.haze->albedo = glm::dvec3(v); },
     .vector = [](State& s) { return &s.draft.haze->albedo; }},
    {.name = "g",
     .wanted = "a number between -1 and 1",
     .number = [](State& s, double v) { s.draft.haze->g = v; }},
};

constexpr Field kDetailFields[] = {
    {.name = "amount",
     .wanted = "a number from 0 to 1",
     .number = [](State& s, double v) { s.draft.detail->amount = v; }},
    {.name = "size",
     .wanted = "a number > 0 (mean particle radii)",
     .number = [](State& s, double v) { s.draft.detail->size = v; }},
};

constexpr Field kCameraFields[] = {
    {.name = "eye",
     .wanted = kVectorWanted,
     .required = true,
     .vector = [](State& s) { return &s.draft.camera.eye; }},
    {.name = "target",
     .wanted = kVectorWanted,
     .required = true,
     .vector = [](State& s) { return &s.draft.camera.target; }},
    {.name = "up", .wanted = kVectorWanted, .vector = [](State& s) { return &s.draft.camera.up; }},
    {.name = "fov",
     .wanted = "a number (degrees, vertical)",
     .number = [](State& s, double v) { s.draft.camera.fov = v; }},
};

constexpr Field kImageFields[] = {
    {.name = "width",
     .wanted = "an integer from 1 to 8192 (pixels)",
     .integer = [](State& s, std::uint64_t v) { s.draft.image.width = static_cast<int>(v); },
     .largest_integer = INT_MAX},
    {.name = "height",
     .wanted = "an integer from 1 to 8192 (pixels)",
     .integer = [](State& s, std::uint64_t v) { s.draft.image.height = static_cast<int>(v); },
     .largest_integer = INT_MAX},
    {.name = "format",
     .wanted = R"("png" or "exr")",
     .word =
         [](State& s, std::string_view v) {
             static constexpr Word<ImageFormat> kFormats[] = {{"png", ImageFormat::kPng},
                                                              {"exr", ImageFormat::kExr}};
             return choose(v, kFormats, [&](ImageFormat f) { s.draft.image.format = f; });
         }},
    {.name = "background",
     .wanted = R"("sky" or "transparent")",
     .word =
         [](State& s, std::string_view v) {
             static constexpr Word<Background> kBackgrounds[] = {
                 {"sky", Background::kSky}, {"transparent", Background::kTransparent}};
             return choose(v, kBackgrounds, [&](Background b) { s.draft.image.background = b; });
         }},
    {.name = "exposure",
     .wanted = R"(a number (stops) or "auto")",
     .number = [](State& s, double v) { s.draft.image.exposure = v; },
     .word = [](State&, std::string_view v) { return taken_if(v == "auto"); }},
    {.name = "precision",
     .wanted = R"("half" or "float")",
     .word =
         [](State& s, std::string_view v) {
             static constexpr Word<Precision> kPrecisions[] = {{"half", Precision::kHalf},
                                                               {"float", Precision::kFloat}};
             return choose(v, kPrecisions, [&](Precision p) { s.draft.image.precision = p; });
         }},
};

void set_effect(State& s, Switch value) {
    s.draft.effects[static_cast<int>(s.effect)] = value;
}

constexpr Field kEffectField = {
    .name = "",
    .wanted = R"(true, false or "auto")",
    .flag = [](State& s, bool v) { set_effect(s, v ? Switch::kOn : Switch::kOff); },
    .word = [](State&, std::string_view v) { return taken_if(v == "auto"); }};

constexpr Field kAccuracyFields[] = {
    {.name = "error",
     .wanted = "a number > 0 (relative error)",
     .number = [](State& s, double v) { s.draft.accuracy.error = v; }},
    {.name = "time_ms",
     .wanted = "a number > 0 (milliseconds)",
     .number = [](State& s, double v) { s.draft.accuracy.time_ms = v; }},
    {.name = "rung",
     .wanted = "the name of a rung",
     .word =
         [](State& s, std::string_view v) {
             s.draft.accuracy.rung = std::string(v);
             return WordOutcome::kTaken;
         }},
};

// Out of float32's range becomes infinite, which validate() refuses.
float to_float(double value) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    if (std::abs(value) <= kLargest) return static_cast<float>(value);
    return std::copysign(std::numeric_limits<float>::infinity(),
                         static_cast<float>(value > 0) - 0.5f);
}

}  // namespace

std::span<const Field> fields_of(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::kScene:
            return kSceneFields;
        case ObjectKind::kCube:
            return kCubeFields;
        case ObjectKind::kCloud:
            return kCloudFields;
        case ObjectKind::kMedium:
            return kMediumFields;
        case ObjectKind::kSun:
            return kSunFields;
        case ObjectKind::kSky:
            return kSkyFields;
        case ObjectKind::kGround:
            return kGroundFields;
        case ObjectKind::kHaze:
            return kHazeFields;
        case ObjectKind::kDetail:
            return kDetailFields;
        case ObjectKind::kCamera:
            return kCameraFields;
        case ObjectKind::kImage:
            return kImageFields;
        case ObjectKind::kAccuracy:
            return kAccuracyFields;
        case ObjectKind::kSequence:
            return kSequenceFields;
        case ObjectKind::kAutomaton:
        case ObjectKind::kAutomatonEllipsoid:
        case ObjectKind::kAutomatonRandom:
        case ObjectKind::kAutomatonWind:
        case ObjectKind::kAutomatonLayers:
        case ObjectKind::kAutomatonWindBand:
            return automaton_fields(kind);
        case ObjectKind::kSpheres:
            return spheres_fields();
        case ObjectKind::kSpheresMorph:
            return spheres_morph_fields();
        case ObjectKind::kImplicit:
        case ObjectKind::kImplicitPrimitive:
        case ObjectKind::kImplicitKey:
        case ObjectKind::kImplicitGrowth:
        case ObjectKind::kImplicitAttractor:
        case ObjectKind::kImplicitVortex:
        case ObjectKind::kImplicitFlow:
            return implicit_fields(kind);
        case ObjectKind::kEllipsoids:
            return ellipsoids_fields();
        case ObjectKind::kEllipsoidsTexture:
        case ObjectKind::kEllipsoidsShading:
        case ObjectKind::kSkyPlane:
        case ObjectKind::kPlaneTexture:
        case ObjectKind::kFormation:
        case ObjectKind::kEllipsoid:
            return ellipsoids_part_fields(kind);
        case ObjectKind::kEffects:  // named by effect_name()
        case ObjectKind::kNone:
            return {};
    }
    return {};
}

int find_field(ObjectKind kind, std::string_view name) {
    if (kind == ObjectKind::kEffects) {
        const std::optional<Effect> effect = effect_from_name(name);
        return effect ? static_cast<int>(*effect) : -1;
    }
    const std::span<const Field> fields = fields_of(kind);
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].name == name) return static_cast<int>(i);
    return -1;
}

const Field& field_at(ObjectKind kind, int index) {
    if (kind == ObjectKind::kEffects) return kEffectField;
    return fields_of(kind)[static_cast<std::size_t>(index)];
}

std::string_view field_name(ObjectKind kind, int index) {
    if (kind == ObjectKind::kEffects) return effect_name(static_cast<Effect>(index));
    return field_at(kind, index).name;
}

const List& list_at(ListKind kind) {
    constexpr const char* kWantedVector = kVectorWanted;
    static constexpr List kNoList{.wanted = "nothing", .most = 0};
    static constexpr List kCubes{
        .wanted = "an object", .most = limits::kMaxCubes, .object = ObjectKind::kCube};
    static constexpr List kClouds{
        .wanted = "an object", .most = limits::kMaxClouds, .object = ObjectKind::kCloud};
    static constexpr List kPositions{
        .wanted = kWantedVector,
        .most = limits::kMaxParticles,
        .row = [](State& s, const glm::dvec3& v) { s.cloud->ready.positions.push_back(v); }};
    static constexpr List kRadii{
        .wanted = "a number", .most = limits::kMaxParticles, .number = [](State& s, double v) {
            s.cloud->ready.radii.push_back(to_float(v));
        }};
    static constexpr List kDensities{
        .wanted = "a number", .most = limits::kMaxParticles, .number = [](State& s, double v) {
            s.cloud->ready.densities.push_back(to_float(v));
        }};
    static constexpr List kColors{.wanted = kColorWanted,
                                  .most = limits::kMaxParticles,
                                  .row = [](State& s, const glm::dvec3& v) {
                                      s.cloud->ready.colors.emplace_back(
                                          to_float(v.x), to_float(v.y), to_float(v.z));
                                  }};
    switch (kind) {
        case ListKind::kCubes:
            return kCubes;
        case ListKind::kClouds:
            return kClouds;
        case ListKind::kPositions:
            return kPositions;
        case ListKind::kRadii:
            return kRadii;
        case ListKind::kDensities:
            return kDensities;
        case ListKind::kColors:
            return kColors;
        case ListKind::kAutomatonEllipsoids:
        case ListKind::kAutomatonWindBands:
            return automaton_list(kind);
        case ListKind::kImplicitPrimitives:
        case ListKind::kImplicitPoints:
        case ListKind::kImplicitKeys:
        case ListKind::kImplicitAttractors:
        case ListKind::kImplicitVortices:
        case ListKind::kImplicitVectors:
            return implicit_list(kind);
        case ListKind::kFormations:
        case ListKind::kEllipsoids:
            return ellipsoids_list(kind);
        case ListKind::kNone:
            break;
    }
    return kNoList;
}

}  // namespace awan
