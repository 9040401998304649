// What the clouds' particles do with light.
#pragma once

#include <memory>

#include "core/scene/droplets.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

enum class PhaseFunction { kHenyeyGreenstein, kCornetteShanks, kMie };
inline constexpr const char* kPhaseFunctionWords[] = {"henyey-greenstein", "cornette-shanks",
                                                      "mie"};

struct Medium {
    double albedo = 0.9999;
    double g = 0.85;
    PhaseFunction phase = PhaseFunction::kHenyeyGreenstein;
    // Of kMie; then g is unused. Micrometres.
    double droplet = 20;
    // What follows from it; validate() fills it in. Null: not kMie.
    std::shared_ptr<const DropletPhase> droplets{};
};

// The mean cosine of the phase function.
inline double asymmetry(const Medium& medium) {
    return medium.droplets ? medium.droplets->moment[1] : medium.g;
}

inline constexpr auto kPhaseIsMie = [](const void* medium) {
    return static_cast<const Medium*>(medium)->phase == PhaseFunction::kMie;
};
inline constexpr auto kPhaseIsNotMie = [](const void* medium) { return !kPhaseIsMie(medium); };

inline constexpr Field kMediumFields[] = {
    field<&Medium::albedo>({.name = "albedo",
                            .wanted = "a number from 0 to 1",
                            .range = from_to(0, 1),
                            .says = "Single scattering."}),
    field<&Medium::g>({.name = "g",
                       .wanted = "a number (the mean cosine of the phase function)",
                       .range = within(limits::kMaxAnisotropy),
                       .says = "Mean cosine of the phase function; an error where that is mie.",
                       .idle = kPhaseIsMie}),
    field<&Medium::phase>(
        {.name = "phase",
         .words = kPhaseFunctionWords,
         .says = "The phase function. mie: of droplets of water, with fogbow and glory, by "
                 "`droplet` instead of `g`."}),
    field<&Medium::droplet>(
        {.name = "droplet",
         .wanted = "a number from 2 to 50 (micrometres)",
         .range = from_to(limits::kMinDroplet, limits::kMaxDroplet),
         .unit = "micrometres",
         .says = "The droplets' effective diameter: fog 5 to 20, cumulus 10 to 30. Of phase mie; "
                 "an error with another.",
         .idle = kPhaseIsNotMie}),
    outside_document<&Medium::droplets>("follows from the droplets' diameter"),
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
