// Rules between the fields of one object of a scene document, beyond the rows of fields.cpp.
#include "core/scene/automaton.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/spheres.h"
#include "server/document/fields.h"
#include "server/document/models.h"

namespace awan {
namespace {

Error invalid(std::string pointer, std::string message) {
    return {ErrorCode::kInvalidScene, std::move(pointer), std::move(message)};
}

bool has(ObjectKind kind, std::uint32_t seen, std::string_view name) {
    return (seen >> find_field(kind, name) & 1u) != 0;
}

// The fields of each model; the first is needed, for ready particles the first two.
struct OfModel {
    CloudModel model;
    const char* name;
    std::initializer_list<std::string_view> fields;
    std::size_t needed;
};

Status check_cloud(std::uint32_t seen, const Cloud& cloud) {
    static const OfModel kModels[] = {
        {CloudModel::kCubes, "cubes", {"cubes"}, 1},
        {CloudModel::kParticles, "particles", {"positions", "radii", "densities", "colors"}, 2},
        {CloudModel::kAutomaton, "automaton", {"automaton"}, 1},
        {CloudModel::kSpheres, "spheres", {"spheres"}, 1},
        {CloudModel::kImplicit, "implicit", {"implicit"}, 1},
        {CloudModel::kEllipsoids, "ellipsoids", {"ellipsoids"}, 1}};
    const std::string own = kModels[static_cast<std::size_t>(cloud.model)].name;
    for (const OfModel& one : kModels)
        if (one.model != cloud.model)
            for (const std::string_view name : one.fields)
                if (has(ObjectKind::kCloud, seen, name))
                    return invalid("/" + std::string(name),
                                   "does not belong to a cloud of model \"" + own + "\"");
    const OfModel& model = kModels[static_cast<std::size_t>(cloud.model)];
    for (std::size_t i = 0; i < model.needed; ++i)
        if (!has(ObjectKind::kCloud, seen, model.fields.begin()[i]))
            return invalid("", "a cloud of model \"" + own + "\" needs \"" +
                                   std::string(model.fields.begin()[i]) + "\"");
    return std::nullopt;
}

}  // namespace

void DraftInProgress::begin(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::kCloud:
            cloud = &draft.clouds.emplace_back();
            break;
        case ObjectKind::kCube:
            cube = &cloud->cubes.emplace_back();
            break;
        case ObjectKind::kGround:
            draft.ground.emplace();
            break;
        case ObjectKind::kHaze:
            draft.haze.emplace();
            break;
        case ObjectKind::kDetail:
            draft.detail.emplace();
            break;
        case ObjectKind::kCamera:
            draft.camera.automatic = false;
            break;
        case ObjectKind::kSequence:
            draft.sequence.emplace();
            break;
        case ObjectKind::kAutomaton:
            automaton = std::make_shared<AutomatonCloud>();
            break;
        case ObjectKind::kAutomatonEllipsoid:
            automaton->ellipsoids.emplace_back();
            break;
        case ObjectKind::kAutomatonRandom:
            automaton->random.emplace();
            break;
        case ObjectKind::kAutomatonWindBand:
            automaton->wind.ellipsoids.emplace_back();
            break;
        case ObjectKind::kSpheres:
            spheres = std::make_shared<SpheresCloud>();
            break;
        case ObjectKind::kSpheresMorph:
            spheres->morph.emplace();
            break;
        case ObjectKind::kImplicit:
            implicit = std::make_shared<ImplicitCloud>();
            break;
        case ObjectKind::kImplicitPrimitive:
        case ObjectKind::kImplicitKey:
        case ObjectKind::kImplicitGrowth:
        case ObjectKind::kImplicitAttractor:
        case ObjectKind::kImplicitVortex:
        case ObjectKind::kImplicitFlow:
            begin_implicit(kind, *implicit);
            break;
        case ObjectKind::kEllipsoids:
            ellipsoids = std::make_shared<EllipsoidsCloud>();
            break;
        case ObjectKind::kSkyPlane:
            ellipsoids->plane.emplace();
            break;
        case ObjectKind::kFormation:
            ellipsoids->formations.emplace_back();
            break;
        case ObjectKind::kEllipsoid:
            ellipsoids->ellipsoids.emplace_back();
            break;
        default:
            break;
    }
}

std::string allowed_names(ObjectKind kind) {
    const int count =
        kind == ObjectKind::kEffects ? kEffectCount : static_cast<int>(fields_of(kind).size());
    std::string names;
    for (int i = 0; i < count; ++i) {
        if (i > 0) names += ", ";
        names += '"';
        names += field_name(kind, i);
        names += '"';
    }
    return names;
}

void complete(ObjectKind kind, std::uint32_t seen, DraftInProgress& state) {
    Sky& sky = state.draft.sky;
    if (kind == ObjectKind::kSky && sky.physical && !has(kind, seen, "intensity"))
        sky.intensity = kPhysicalSkyIntensity;
    if (kind == ObjectKind::kAutomaton) state.cloud->automaton = std::move(state.automaton);
    if (kind == ObjectKind::kSpheres) state.cloud->spheres = std::move(state.spheres);
    // A list without elements is one too.
    if (kind == ObjectKind::kImplicit && has(kind, seen, "primitives") &&
        !state.implicit->primitives)
        state.implicit->primitives.emplace();
    if (kind == ObjectKind::kImplicit) state.cloud->implicit = std::move(state.implicit);
    if (kind == ObjectKind::kEllipsoids) state.cloud->ellipsoids = std::move(state.ellipsoids);
}

Status check_together(ObjectKind kind, std::uint32_t seen, const DraftInProgress& state) {
    const std::span<const Field> fields = fields_of(kind);
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (fields[i].required && (seen >> i & 1u) == 0)
            return invalid("",
                           "needs \"" + std::string(fields[i].name) + "\", " + fields[i].wanted);
    switch (kind) {
        case ObjectKind::kScene:
            if (!has(kind, seen, "cubes") && !has(kind, seen, "clouds"))
                return invalid("", "a scene needs \"cubes\" or \"clouds\"");
            if (has(kind, seen, "cubes") && has(kind, seen, "clouds"))
                return invalid("", "a scene has either \"cubes\" or \"clouds\", not both");
            return std::nullopt;
        case ObjectKind::kCloud:
            return check_cloud(seen, *state.cloud);
        case ObjectKind::kSun:
            if (has(kind, seen, "direction") &&
                (has(kind, seen, "elevation") || has(kind, seen, "azimuth")))
                return invalid("/direction",
                               "give either a direction or an elevation and an azimuth");
            return std::nullopt;
        case ObjectKind::kSky:
            if (!state.draft.sky.physical) return std::nullopt;
            for (const char* const name : {"zenith", "horizon"})
                if (has(kind, seen, name))
                    return invalid("/" + std::string(name),
                                   "belongs to a sky of model \"gradient\"; the colours of a "
                                   "physical sky follow from the sun");
            return std::nullopt;
        case ObjectKind::kAccuracy:
            if (seen == 0 || (seen & (seen - 1)) != 0)
                return invalid("", "give exactly one of \"error\", \"time_ms\" and \"rung\"");
            return std::nullopt;
        default:
            return std::nullopt;
    }
}

}  // namespace awan
