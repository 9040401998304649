// The ground of a scene: a level, matt plane without end, seen from above only, and the hills on it.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"
#include "core/scene/terrain.h"

namespace awan {

struct Ground {
    double height = 0;
    glm::dvec3 albedo{0.2};
    // None: it is level.
    std::optional<Terrain> terrain{};
};

inline constexpr Field kGroundFields[] = {
    field<&Ground::height>({.name = "height",
                            .wanted = "a number",
                            .range = within(limits::kMaxCoordinate),
                            .unit = "units",
                            .says = "Of the plane, scene units."}),
    field<&Ground::albedo>({.name = "albedo",
                            .wanted = "a number or [r, g, b], from 0 to 1",
                            .range = from_to(0, 1),
                            .one_for_all = true,
                            .says = "Share of light that it sends back."}),
    field<&Ground::terrain>({.name = "terrain",
                             .wanted = R"(an object or "none")",
                             .absent = "none",
                             .says = "Hills on it.",
                             .traceless = true}),
};
static_assert(covers<Ground>(kGroundFields));

inline constexpr Table kGroundTable{
    .name = "Ground",
    .says = "A level, matt plane without end, seen from above only, and hills on it.",
    .fields = kGroundFields,
    .standard = standard_of<Ground>};
template <>
inline const Table& table_of<Ground>() {
    return kGroundTable;
}

}  // namespace awan
