// Structure finer than the particles (core/generate/detail.h), as a scene asks for it.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

struct Detail {
    double amount = 0.7;
    double size = 1.5;
    // "auto": with these figures, where the bumps take more than a few pixels.
    bool automatic = false;
};

inline constexpr Detail kAutomaticDetail{.automatic = true};

inline constexpr Field kDetailFields[] = {
    absence<&Detail::automatic>("auto"),
    field<&Detail::amount>({.name = "amount",
                            .wanted = "a number from 0 to 1",
                            .range = from_to(0, 1),
                            .says = "0: none."}),
    field<&Detail::size>({.name = "size",
                          .wanted = "a number > 0 (mean particle radii)",
                          .range = from_to(limits::kMinDetailSize, limits::kMaxDetailSize),
                          .unit = "mean particle radii",
                          .says = "Of the largest bumps, in mean particle radii."}),
};
static_assert(covers<Detail>(kDetailFields));

inline constexpr Table kDetailTable{.name = "Detail",
                                    .says = "Structure finer than the particles.",
                                    .fields = kDetailFields,
                                    .standard = standard_of<Detail>};
template <>
inline const Table& table_of<Detail>() {
    return kDetailTable;
}

}  // namespace awan
