// What an object of a document must give, and what it may not give together.
#include "core/scene/checks.h"
#include "core/scene/rules.h"

namespace awan {
namespace {

std::string quoted(std::string_view name) {
    return '"' + std::string(name) + '"';
}

Status needs_required(const Given& given) {
    for (const Field& field : given.table.fields)
        if (field.required && !field.of_model && !given.has(field.name))
            return invalid("", "needs " + quoted(field.name) + ", " + wanted_of(field));
    return std::nullopt;
}

Status check_scene(const Given& given) {
    if (!given.has("cubes") && !given.has("clouds"))
        return invalid("", "a scene needs \"cubes\" or \"clouds\"");
    if (given.has("cubes") && given.has("clouds"))
        return invalid("", "a scene has either \"cubes\" or \"clouds\", not both");
    return std::nullopt;
}

// The fields of a model belong to clouds of that model, and those of them that it needs are there.
Status check_cloud(const Given& given, const Cloud& cloud) {
    const int model = static_cast<int>(cloud.model);
    const std::string own = quoted(kCloudModelWords[model]);
    for (const Field& field : given.table.fields)
        if (field.of_model && *field.of_model != model && given.has(field.name))
            return invalid("/" + std::string(field.name),
                           "does not belong to a cloud of model " + own);
    for (const Field& field : given.table.fields)
        if (field.required && field.of_model == model && !given.has(field.name))
            return invalid("", "a cloud of model " + own + " needs " + quoted(field.name));
    return std::nullopt;
}

Status check_sun(const Given& given) {
    if (given.has("direction") && (given.has("elevation") || given.has("azimuth")))
        return invalid("/direction", "give either a direction or an elevation and an azimuth");
    return std::nullopt;
}

Status check_sky(const Given& given, const Sky& sky) {
    if (!sky.physical) return std::nullopt;
    for (const char* const name : {"zenith", "horizon"})
        if (given.has(name))
            return invalid("/" + std::string(name),
                           "belongs to a sky of model \"gradient\"; the colours of a physical sky "
                           "follow from the sun");
    return std::nullopt;
}

Status check_medium(const Given& given, const Medium& medium) {
    const bool mie = medium.phase == PhaseFunction::kMie;
    if (mie && given.has("g"))
        return invalid("/g",
                       "must be left out with the phase function \"mie\", which follows "
                       "from \"droplet\"");
    if (!mie && given.has("droplet"))
        return invalid("/droplet", "must be left out but with the phase function \"mie\"");
    return std::nullopt;
}

Status check_accuracy(const Given& given) {
    const bool one = given.bits != 0 && (given.bits & (given.bits - 1)) == 0;
    if (one) return std::nullopt;
    return invalid("", "give exactly one of \"error\", \"time_ms\" and \"rung\"");
}

}  // namespace

Status check_written(const Given& given, const void* object) {
    if (Status wrong = needs_required(given)) return wrong;
    const Table* const table = &given.table;
    if (table == &table_of<SceneDraft>()) return check_scene(given);
    if (table == &table_of<Cloud>()) return check_cloud(given, *static_cast<const Cloud*>(object));
    if (table == &table_of<Sun>()) return check_sun(given);
    if (table == &table_of<Sky>()) return check_sky(given, *static_cast<const Sky*>(object));
    if (table == &table_of<Medium>())
        return check_medium(given, *static_cast<const Medium*>(object));
    if (table == &table_of<Accuracy>()) return check_accuracy(given);
    return std::nullopt;
}

}  // namespace awan
