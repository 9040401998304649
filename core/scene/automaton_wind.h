// The wind over an automaton (automaton.h): what it moves, how fast and where to, by height.
#pragma once

#include <optional>
#include <vector>

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Of a height or a place, cells.
inline constexpr Range kAutomatonPlace = within(limits::kMaxAutomatonPlace);

// Of height y (cells): constant + linear y + quadratic y^2 cells a step, towards direction + turn y.
struct AutomatonSpeed {
    double constant = 0;
    double linear = 0;
    double quadratic = 0;
    // Degrees, as the sun's azimuth: 0 blows towards +z, 90 towards +x. None: the wind's.
    std::optional<double> direction{};
    // Degrees a cell of height.
    double turn = 0;
    bool operator==(const AutomatonSpeed&) const = default;
    // Whether it is 0 at every height.
    bool still() const { return constant == 0 && linear == 0 && quadratic == 0; }
};

inline constexpr Row kSpeedConstant{.name = "constant",
                                    .wanted = "a number (cells a step)",
                                    .range = within(limits::kMaxAutomatonSpeed),
                                    .unit = "cells a step",
                                    .says = "Cells a step."};
inline constexpr Row kSpeedLinear{.name = "linear",
                                  .wanted = "a number (cells a step, a cell of height)",
                                  .range = within(limits::kMaxAutomatonSpeed),
                                  .says = "Times the height in cells."};
inline constexpr Row kSpeedQuadratic{.name = "quadratic",
                                     .wanted = "a number (cells a step, a cell of height squared)",
                                     .range = within(limits::kMaxAutomatonSpeed),
                                     .says = "Times the height squared."};
inline constexpr Row kSpeedDirection{.name = "direction",
                                     .wanted = "a number (degrees)",
                                     .range = within(limits::kMaxAngle),
                                     .unit = "degrees",
                                     .says = "Where it blows to: 0 is +z, 90 is +x.",
                                     .otherwise = "the wind's"};
inline constexpr Row kSpeedTurn{.name = "turn",
                                .wanted = "a number (degrees a cell of height)",
                                .range = within(limits::kMaxAutomatonTurn),
                                .says = "Added to the direction for each cell of height, degrees."};

inline constexpr Field kAutomatonSpeedFields[] = {
    field<&AutomatonSpeed::constant>(kSpeedConstant),
    field<&AutomatonSpeed::linear>(kSpeedLinear),
    field<&AutomatonSpeed::quadratic>(kSpeedQuadratic),
    field<&AutomatonSpeed::direction>(kSpeedDirection),
    field<&AutomatonSpeed::turn>(kSpeedTurn),
};
static_assert(covers<AutomatonSpeed>(kAutomatonSpeedFields));
inline constexpr Table kAutomatonSpeedTable{
    .name = "AutomatonLayers",
    .says = "Whole layers of cells shift, constant + linear y + quadratic y^2.",
    .fields = kAutomatonSpeedFields,
    .standard = standard_of<AutomatonSpeed>};
template <>
inline const Table& table_of<AutomatonSpeed>() {
    return kAutomatonSpeedTable;
}

// Moves the ellipsoids whose centre's y is from `from` to `to`; those in several bands by the sum (Upchurch 2009,
// "Cloud Advection by Wind"). In documents the speed's parts stand beside `from` and `to`. The same for layers of
// cells, by the height of their middle.
struct AutomatonWindBand {
    double from = 0;
    double to = 1024;
    AutomatonSpeed speed;
};

constexpr Row part_of_speed(Row row) {
    row.part_of = "speed";
    return row;
}

inline constexpr Field kAutomatonWindBandFields[] = {
    field<&AutomatonWindBand::from>({.name = "from",
                                     .wanted = "a number (cells)",
                                     .range = kAutomatonPlace,
                                     .unit = "cells",
                                     .says = "Lowest height, in cells."}),
    field<&AutomatonWindBand::to>({.name = "to",
                                   .wanted = "a number (cells)",
                                   .range = kAutomatonPlace,
                                   .unit = "cells",
                                   .says = "Greatest height."}),
    field_within<&AutomatonWindBand::speed, &AutomatonSpeed::constant>(
        part_of_speed(kSpeedConstant)),
    field_within<&AutomatonWindBand::speed, &AutomatonSpeed::linear>(part_of_speed(kSpeedLinear)),
    field_within<&AutomatonWindBand::speed, &AutomatonSpeed::quadratic>(
        part_of_speed(kSpeedQuadratic)),
    field_within<&AutomatonWindBand::speed, &AutomatonSpeed::direction>(
        part_of_speed(kSpeedDirection)),
    field_within<&AutomatonWindBand::speed, &AutomatonSpeed::turn>(part_of_speed(kSpeedTurn)),
};
static_assert(covers<AutomatonWindBand>(kAutomatonWindBandFields));
static_assert(covers_part<AutomatonSpeed>(kAutomatonWindBandFields, "speed"));
inline constexpr Table kAutomatonWindBandTable{
    .name = "AutomatonWindBand",
    .says = "Moves what is at those heights by constant + linear y + quadratic y^2 a step.",
    .fields = kAutomatonWindBandFields,
    .standard = standard_of<AutomatonWindBand>};
template <>
inline const Table& table_of<AutomatonWindBand>() {
    return kAutomatonWindBandTable;
}

struct AutomatonWind {
    // As AutomatonSpeed::direction, of all that say none. Dobashi et al. 2000 and Upchurch 2009 blow along x alone, and
    // turn the simulation instead.
    double direction = 90;
    // All three bits of a layer of cells shift by v(j + 1/2) a step, Dobashi et al. 2000 (8)-(10): whole cells along x
    // and z, the fractions of slow winds saved up. Nothing comes in at the border.
    AutomatonSpeed layers;
    // Added to `layers`.
    std::vector<AutomatonWindBand> layer_bands;
    std::vector<AutomatonWindBand> ellipsoids;
    // An ellipsoid that has left the grid comes back at the side opposite to that by which it left, elsewhere at
    // random, its radii those of the beginning times 1 - mutation .. 1 + mutation.
    double mutation = 0.25;
};

inline constexpr Field kAutomatonWindFields[] = {
    field<&AutomatonWind::direction>(
        {.name = "direction",
         .wanted = "a number (degrees)",
         .range = within(limits::kMaxAngle),
         .unit = "degrees",
         .says = "Where the wind blows to, as the sun's azimuth: 0 is +z, 90 is +x. Layers and "
                 "bands may have their own."}),
    field<&AutomatonWind::layers>(
        {.name = "layers", .wanted = "an object", .says = "Moves the cells, bits and all."}),
    field<&AutomatonWind::layer_bands>(
        {.name = "layer_bands",
         .wanted = "a list of bands",
         .counts = at_most(limits::kMaxAutomatonBands),
         .says = "Each moves the layers of cells whose middle is in its range of heights, in "
                 "addition to `layers`."}),
    field<&AutomatonWind::ellipsoids>(
        {.name = "ellipsoids",
         .wanted = "a list of bands",
         .counts = at_most(limits::kMaxAutomatonBands),
         .says = "Each moves the ellipsoids whose centre is in its range of heights."}),
    field<&AutomatonWind::mutation>({.name = "mutation",
                                     .wanted = "a number from 0 to 1",
                                     .range = from_to(0, 1),
                                     .says = "How much the radii of an ellipsoid change that has "
                                             "left and comes back upwind, relative."}),
};
static_assert(covers<AutomatonWind>(kAutomatonWindFields));
inline constexpr Table kAutomatonWindTable{
    .name = "AutomatonWind",
    .says = "Wind in any horizontal direction, of two kinds.",
    .fields = kAutomatonWindFields,
    .standard = standard_of<AutomatonWind>};
template <>
inline const Table& table_of<AutomatonWind>() {
    return kAutomatonWindTable;
}

// The same wind, every part with a direction of its own.
AutomatonWind spelled_out(const AutomatonWind& wind);

}  // namespace awan
