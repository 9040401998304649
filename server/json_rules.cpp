// Rules between the fields of one object of a scene document, beyond the rows of json_fields.cpp.
#include "server/json_fields.h"

namespace awan {
namespace {

Error invalid(std::string pointer, std::string message) {
    return {ErrorCode::kInvalidScene, std::move(pointer), std::move(message)};
}

bool has(ObjectKind kind, std::uint32_t seen, std::string_view name) {
    return (seen >> find_field(kind, name) & 1u) != 0;
}

Status check_cloud(std::uint32_t seen, const Cloud& cloud) {
    const bool is_cubes = cloud.model == CloudModel::kCubes;
    const char* const model = is_cubes ? "cubes" : "particles";
    for (const std::string_view name : {"cubes", "positions", "radii", "densities", "colors"})
        if (has(ObjectKind::kCloud, seen, name) && (name == "cubes") != is_cubes)
            return invalid("/" + std::string(name),
                           std::string("does not belong to a cloud of model \"") + model + "\"");
    const char* const needed[2][2] = {{"positions", "radii"}, {"cubes", "cubes"}};
    for (const char* const name : needed[is_cubes])
        if (!has(ObjectKind::kCloud, seen, name))
            return invalid(
                "", std::string("a cloud of model \"") + model + "\" needs \"" + name + "\"");
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
