// What the clouds' particles do with light.
#pragma once

#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

enum class PhaseFunction { kHenyeyGreenstein, kCornetteShanks };
inline constexpr const char* kPhaseFunctionWords[] = {"henyey-greenstein", "cornette-shanks"};

struct Medium {
    double albedo = 0.9999;
    double g = 0.85;
    PhaseFunction phase = PhaseFunction::kHenyeyGreenstein;
};

inline constexpr Field kMediumFields[] = {
    field<&Medium::albedo>({.name = "albedo",
                            .wanted = "a number from 0 to 1",
                            .range = from_to(0, 1),
                            .says = "Single scattering."}),
    field<&Medium::g>({.name = "g",
                       .wanted = "a number (the mean cosine of the phase function)",
                       .range = within(limits::kMaxAnisotropy),
                       .says = "Mean cosine of the phase function."}),
    field<&Medium::phase>(
        {.name = "phase", .words = kPhaseFunctionWords, .says = "The phase function."}),
};
static_assert(covers<Medium>(kMediumFields));

inline constexpr Table kMediumTable{.name = "Medium",
                                    .says = "What the particles do with light.",
                                    .fields = kMediumFields,
                                    .standard = standard_of<Medium>};
template <>
inline const Table& table_of<Medium>() {
    return kMediumTable;
}

}  // namespace awan
