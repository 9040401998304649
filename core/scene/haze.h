// Air that is seen: extinction (1/unit) `extinction * exp(-(y - height) / scale_height)` above `height`, `extinction`
// below it. It dims and veils what lies behind it and shows where the clouds shade it; the light on its way to the
// clouds, to the ground and to itself it leaves alone: sun and sky are given as they arrive there. Light it scatters,
// it scatters once.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

struct Haze {
    double extinction = 0;
    double height = 0;
    double scale_height = 1;
    glm::dvec3 albedo{1};
    double g = 0.6;
};

inline constexpr Field kHazeFields[] = {
    field<&Haze::extinction>({.name = "extinction",
                              .wanted = "a number >= 0 (1/unit, at `height`)",
                              .range = from_to(0, limits::kMaxDensity),
                              .required = true,
                              .unit = "1/unit",
                              .says = "1/unit, at height and below it."}),
    field<&Haze::height>({.name = "height",
                          .wanted = "a number",
                          .range = within(limits::kMaxCoordinate),
                          .unit = "units",
                          .says = "From here upward it thins."}),
    field<&Haze::scale_height>({.name = "scale_height",
                                .wanted = "a number > 0: over so many units upward it thins to 37%",
                                .range = from_to(limits::kMinLength, limits::kMaxLength),
                                .required = true,
                                .unit = "units",
                                .says = "Over so many units upward it thins to 37%."}),
    field<&Haze::albedo>({.name = "albedo",
                          .wanted = "a number or [r, g, b], from 0 to 1",
                          .range = from_to(0, 1),
                          .one_for_all = true,
                          .says = "Single scattering."}),
    field<&Haze::g>({.name = "g",
                     .wanted = "a number between -1 and 1",
                     .range = within(limits::kMaxAnisotropy),
                     .says = "Mean cosine, Henyey & Greenstein 1941."}),
};
static_assert(covers<Haze>(kHazeFields));

inline constexpr Table kHazeTable{.name = "Haze",
                                  .says =
                                      "Air that is seen. It dims and veils what lies behind it; "
                                      "the light on its way to clouds and ground it "
                                      "leaves alone.",
                                  .fields = kHazeFields,
                                  .standard = standard_of<Haze>};
template <>
inline const Table& table_of<Haze>() {
    return kHazeTable;
}

}  // namespace awan
