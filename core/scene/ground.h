// The ground of a scene: a level, matt plane without end, seen from above only.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

struct Ground {
    double height = 0;
    glm::dvec3 albedo{0.2};
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
};
static_assert(covers<Ground>(kGroundFields));

inline constexpr Table kGroundTable{
    .name = "Ground",
    .says = "A level, matt plane without end, seen from above only.",
    .fields = kGroundFields,
    .standard = standard_of<Ground>};
template <>
inline const Table& table_of<Ground>() {
    return kGroundTable;
}

}  // namespace awan
