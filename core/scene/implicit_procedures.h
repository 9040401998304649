// The procedures of an implicit cloud (implicit.h) whose particles are primitives: what Ebert 2002 ("Simple interactive
// cloud models", after Neyret 1997) names as the processes that shape clouds, each as plain a simulation as shows it.
// Bubbles rise and grow until the air carries them no more; Kelvin-Helmholtz billows roll up where two layers slide
// over each other; Benard cells turn over between a warm floor and a cold ceiling. Vortices are warps, in
// implicit_warps.h.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "core/scene/implicit_growth.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

inline constexpr Range kProcedureRadius =
    from_to(limits::kMinImplicitRadius, limits::kMaxImplicitRadius / 10);

// Bubbles of warm air. Number i leaves the base (i + chance) / rate seconds after `began`. Its height h above the base
// follows dh/dt = rise (1 - h / ceiling): the lapse of temperature takes its buoyancy; its radius is r + entrainment h:
// it takes in the air around, as thermals do. At rest it stays. Smaller ones roll over its crown, from the top outward,
// as its ring of vortices turns. Lengths are in `radius`.
struct ImplicitBubbles {
    std::uint64_t most = 40;
    std::uint64_t knobs = 4;
    double radius = 24;
    double weight = 1;
    glm::dvec3 center{0};
    glm::dvec3 spread{4, 0, 3};
    double rise = 0.25;
    double ceiling = 5;
    double entrainment = 0.15;
    double rate = 1;
    double began = -60;
};

inline constexpr Field kImplicitBubblesFields[] = {
    field<&ImplicitBubbles::most>({.name = "most",
                                   .wanted = "an integer from 1 to 200",
                                   .counts = count_from_to(1, limits::kMaxBubbles),
                                   .says = "Bubbles in all."}),
    field<&ImplicitBubbles::knobs>({.name = "knobs",
                                    .wanted = "an integer from 0 to 8",
                                    .counts = count_from_to(0, limits::kMaxKnobs),
                                    .says = "Smaller ones that roll over each."}),
    field<&ImplicitBubbles::radius>(
        {.name = "radius",
         .wanted = "a number > 0",
         .range = kProcedureRadius,
         .unit = "units",
         .says = "Of a bubble as it leaves the base, units. Lengths below are in it."}),
    field<&ImplicitBubbles::weight>(
        {.name = "weight", .wanted = "a number", .range = kImplicitWeight, .says = "Of each."}),
    field<&ImplicitBubbles::center>({.name = "center",
                                     .wanted = kPointWanted,
                                     .range = kImplicitPlace,
                                     .unit = "units",
                                     .says = "Middle of the base, units."}),
    field<&ImplicitBubbles::spread>(
        {.name = "spread",
         .wanted = "[x, y, z]: three numbers >= 0 (radii)",
         .range = from_to(0, limits::kMaxGrowthSpread),
         .unit = "radii",
         .says = "They leave it within so much of its middle, either way."}),
    field<&ImplicitBubbles::rise>({.name = "rise",
                                   .wanted = "a number >= 0 (radii a second)",
                                   .range = from_to(0, limits::kMaxGrowthMotion),
                                   .unit = "radii a second",
                                   .says = "How fast they leave it, radii a second."}),
    field<&ImplicitBubbles::ceiling>(
        {.name = "ceiling",
         .wanted = "a number > 0 (radii)",
         .range = from_to(limits::kMinBubbleCeiling, limits::kMaxBubbleCeiling),
         .unit = "radii",
         .says = "How high they come above the middle of the base; towards its edge less."}),
    field<&ImplicitBubbles::entrainment>({.name = "entrainment",
                                          .wanted = "a number from 0 to 1",
                                          .range = from_to(0, 1),
                                          .says = "Radius won for height."}),
    field<&ImplicitBubbles::rate>({.name = "rate",
                                   .wanted = "a number > 0 (bubbles a second)",
                                   .range = from_to(limits::kMinBubbleRate, 1000),
                                   .unit = "1/second",
                                   .says = "Bubbles a second."}),
    field<&ImplicitBubbles::began>({.name = "began",
                                    .wanted = "a number (seconds)",
                                    .range = within(limits::kMaxTime),
                                    .unit = "seconds",
                                    .says = "When the first left."}),
};
static_assert(covers<ImplicitBubbles>(kImplicitBubblesFields));
inline constexpr Table kImplicitBubblesTable{
    .name = "ImplicitBubbles",
    .says =
        "Bubbles of warm air that rise, grow and come to rest. Without `primitives` of its own a "
        "cloud has only these.",
    .fields = kImplicitBubblesFields,
    .standard = standard_of<ImplicitBubbles>};
template <>
inline const Table& table_of<ImplicitBubbles>() {
    return kImplicitBubblesTable;
}

// Kelvin-Helmholtz billows: the sheet between two layers of air that slide over each other along x by `shear`, drawn
// rolled up by itself (Krasny 1986: a sheet of vortices, each smoothed over `smoothing` wavelengths, that starts as a
// wave of `amplitude` wavelengths), and as thick as `radius`. Its crests lie along z.
struct ImplicitBillows {
    std::uint64_t waves = 5;
    double wavelength = 160;
    double length = 240;
    double radius = 16;
    double weight = 1;
    glm::dvec3 center{0};
    double shear = 8;
    double amplitude = 0.04;
    double smoothing = 0.2;
    // Of the billows' ages.
    double variation = 0.3;
    double began = -30;
};

inline constexpr Field kImplicitBillowsFields[] = {
    field<&ImplicitBillows::waves>({.name = "waves",
                                    .wanted = "an integer from 1 to 12",
                                    .counts = count_from_to(1, limits::kMaxBillows),
                                    .says = "How many stand in a row."}),
    field<&ImplicitBillows::wavelength>({.name = "wavelength",
                                         .wanted = "a number > 0",
                                         .range = kProcedureRadius,
                                         .unit = "units",
                                         .says = "From crest to crest, units."}),
    field<&ImplicitBillows::length>({.name = "length",
                                     .wanted = "a number > 0",
                                     .range = kProcedureRadius,
                                     .unit = "units",
                                     .says = "Of the crests, units."}),
    field<&ImplicitBillows::radius>({.name = "radius",
                                     .wanted = "a number > 0",
                                     .range = kProcedureRadius,
                                     .unit = "units",
                                     .says = "How far the sheet's cloud reaches from it, units."}),
    field<&ImplicitBillows::weight>({.name = "weight",
                                     .wanted = "a number",
                                     .range = kImplicitWeight,
                                     .says = "Of the sheet."}),
    field<&ImplicitBillows::center>({.name = "center",
                                     .wanted = kPointWanted,
                                     .range = kImplicitPlace,
                                     .unit = "units",
                                     .says = "Middle of the row, units."}),
    field<&ImplicitBillows::shear>({.name = "shear",
                                    .wanted = "a number >= 0 (units a second)",
                                    .range = from_to(0, limits::kMaxImplicitRadius),
                                    .unit = "units a second",
                                    .says = "How much faster the upper layer is, units a second."}),
    field<&ImplicitBillows::amplitude>({.name = "amplitude",
                                        .wanted = "a number from 0 to 0.2 (wavelengths)",
                                        .range = from_to(0, limits::kMaxBillowAmplitude),
                                        .unit = "wavelengths",
                                        .says = "Of the wave they grow from, wavelengths."}),
    field<&ImplicitBillows::smoothing>(
        {.name = "smoothing",
         .wanted = "a number from 0.02 to 1 (wavelengths)",
         .range = from_to(limits::kMinBillowSmoothing, 1),
         .unit = "wavelengths",
         .says = "How softly they roll: small, many turns of a thin sheet."}),
    field<&ImplicitBillows::variation>(
        {.name = "variation",
         .wanted = "a number from 0 to 1",
         .range = from_to(0, 1),
         .says = "By what part of their age billows may be younger."}),
    field<&ImplicitBillows::began>(
        {.name = "began",
         .wanted = "a number (seconds)",
         .range = within(limits::kMaxTime),
         .unit = "seconds",
         .says = "When they began. They stand still from four wavelengths of sliding on."}),
};
static_assert(covers<ImplicitBillows>(kImplicitBillowsFields));
inline constexpr Table kImplicitBillowsTable{
    .name = "ImplicitBillows",
    .says = "Kelvin-Helmholtz billows. Without `primitives` of its own a cloud has only these.",
    .fields = kImplicitBillowsFields,
    .standard = standard_of<ImplicitBillows>};
template <>
inline const Table& table_of<ImplicitBillows>() {
    return kImplicitBillowsTable;
}

// Benard cells, hexagons `spacing` apart. In a closed one the air rises in the middle and sinks along the walls, in an
// open one the other way. Parcels go around within their cell; what rises condenses, what sinks clears.
struct ImplicitCells {
    bool open = false;
    std::uint64_t rings = 3;
    std::uint64_t parcels = 10;
    double spacing = 90;
    double depth = 26;
    double radius = 24;
    double weight = 1;
    glm::dvec3 center{0};
    // Of a cell's middle, in spacings, and of the parcels' radii.
    double irregular = 0.12;
    double turnover = 60;
};
inline constexpr const char* kCellWords[] = {"closed", "open"};

inline constexpr Field kImplicitCellsFields[] = {
    field<&ImplicitCells::open>({.name = "kind",
                                 .words = kCellWords,
                                 .says = "closed: cloud in the middles; open: along the walls."}),
    field<&ImplicitCells::rings>({.name = "rings",
                                  .wanted = "an integer from 0 to 6",
                                  .counts = count_from_to(0, limits::kMaxCellRings),
                                  .says = "Rings of cells around the one in the middle."}),
    field<&ImplicitCells::parcels>({.name = "parcels",
                                    .wanted = "an integer from 1 to 24",
                                    .counts = count_from_to(1, limits::kMaxCellParcels),
                                    .says = "Of air in each cell."}),
    field<&ImplicitCells::spacing>({.name = "spacing",
                                    .wanted = "a number > 0",
                                    .range = kProcedureRadius,
                                    .unit = "units",
                                    .says = "From middle to middle, units."}),
    field<&ImplicitCells::depth>({.name = "depth",
                                  .wanted = "a number > 0",
                                  .range = kProcedureRadius,
                                  .unit = "units",
                                  .says = "Of the layer that turns over, units."}),
    field<&ImplicitCells::radius>({.name = "radius",
                                   .wanted = "a number > 0",
                                   .range = kProcedureRadius,
                                   .unit = "units",
                                   .says = "Of a parcel's cloud, units."}),
    field<&ImplicitCells::weight>({.name = "weight",
                                   .wanted = "a number",
                                   .range = kImplicitWeight,
                                   .says = "Of each parcel at its cloudiest."}),
    field<&ImplicitCells::center>({.name = "center",
                                   .wanted = kPointWanted,
                                   .range = kImplicitPlace,
                                   .unit = "units",
                                   .says = "Middle of the floor, units."}),
    field<&ImplicitCells::irregular>({.name = "irregular",
                                      .wanted = "a number from 0 to 0.5",
                                      .range = from_to(0, 0.5),
                                      .says = "How far cells are out of order, spacings."}),
    field<&ImplicitCells::turnover>({.name = "turnover",
                                     .wanted = "a number > 0 (seconds)",
                                     .range = kGrowthSeconds,
                                     .unit = "seconds",
                                     .says = "Seconds in which a parcel goes around."}),
};
static_assert(covers<ImplicitCells>(kImplicitCellsFields));
inline constexpr Table kImplicitCellsTable{
    .name = "ImplicitCells",
    .says = "Benard cells. Without `primitives` of its own a cloud has only these.",
    .fields = kImplicitCellsFields,
    .standard = standard_of<ImplicitCells>};
template <>
inline const Table& table_of<ImplicitCells>() {
    return kImplicitCellsTable;
}

}  // namespace awan
