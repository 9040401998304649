// What may be simulated, and whether a scene asks for it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/scene/table.h"

namespace awan {

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
    kTerrain,
};
inline constexpr int kEffectCount = static_cast<int>(Effect::kTerrain) + 1;

enum class Switch { kAuto, kOn, kOff };
using Effects = std::array<Switch, kEffectCount>;

// A row a switch, in the order of Effect.
template <Effect effect>
constexpr Field effect_field(const char* name, const char* says) {
    constexpr auto kIndex = static_cast<std::size_t>(effect);
    Access a;
    a.holds = Holds::kSwitch;
    a.type = &kTypeTag<Switch>;
    a.member = [](const void* o) -> const void* {
        return &(*static_cast<const Effects*>(o))[kIndex];
    };
    a.get = a.member;
    a.put = [](void* o) -> void* { return &(*static_cast<Effects*>(o))[kIndex]; };
    return {{.name = name, .wanted = R"(true, false or "auto")", .absent = "auto", .says = says},
            a};
}

constexpr Field later(Field field) {
    field.traceless = true;
    return field;
}

inline constexpr Field kEffectFields[] = {
    effect_field<Effect::kSelfShadow>("self_shadow", "Matter before it dims the sun."),
    effect_field<Effect::kMultipleScattering>("multiple_scattering",
                                              "Light that was scattered more than once."),
    effect_field<Effect::kViewExtinction>("view_extinction", "Matter before it dims what is seen."),
    effect_field<Effect::kSkyLight>("sky_light", "Light from the sky on the clouds."),
    effect_field<Effect::kGroundLight>("ground_light", "Light from the ground on the clouds."),
    effect_field<Effect::kGroundShadow>("ground_shadow", "Shadow of the clouds on the ground."),
    effect_field<Effect::kSunColor>(
        "sun_color", "false: a sun of colour \"auto\" keeps its luminance without the hue."),
    effect_field<Effect::kAerialPerspective>("aerial_perspective",
                                             "The haze dims and veils what lies behind it."),
    effect_field<Effect::kLightShafts>("light_shafts", "The clouds shade the haze."),
    effect_field<Effect::kDetail>("detail", "Structure finer than the particles."),
    effect_field<Effect::kInterior>("interior", "The eye is within the cloud."),
    effect_field<Effect::kTexture>(
        "texture", "Particles of a texture are drawn as billboards that are painted with it."),
    later(effect_field<Effect::kTerrain>("terrain", "The ground has its hills.")),
};
static_assert(std::size(kEffectFields) == kEffectCount);

inline constexpr Table kEffectsTable{
    .name = "Effects",
    .says = "Each is on where the scene calls for it (auto), or as asked.",
    .fields = kEffectFields,
    .standard = standard_of<Effects>};
template <>
inline const Table& table_of<Effects>() {
    return kEffectsTable;
}

// The name of an effect in documents, e.g. "self_shadow".
constexpr const char* effect_name(Effect effect) {
    return kEffectFields[static_cast<std::size_t>(effect)].name;
}
std::optional<Effect> effect_from_name(std::string_view name);

}  // namespace awan
