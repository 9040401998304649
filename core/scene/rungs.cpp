#include "core/scene/rungs.h"

#include <array>
#include <cstddef>

namespace awan {
namespace {

constexpr std::array kLadder = {
    Rung{RungId::kAdditive, "additive",
         "light scattered once, nothing in its way: for haze and thin veils", Method::kSplats, 0},
    Rung{RungId::kHarris, "harris",
         "the classic two passes: shadow and forward scattering along the light, splats",
         Method::kSplats, 0},
    Rung{RungId::kSingle, "single",
         "sunlight scattered once, exactly: no light from the sky, no further orders",
         Method::kMarch, 0},
    Rung{RungId::kTransport16, "transport-16",
         "all orders by discrete ordinates on 16 cells, exact rays from the eye", Method::kMarch,
         16},
    Rung{RungId::kTransport24, "transport-24",
         "all orders by discrete ordinates on 24 cells, exact rays from the eye", Method::kMarch,
         24},
    Rung{RungId::kTransport32, "transport-32",
         "all orders by discrete ordinates on 32 cells, exact rays from the eye", Method::kMarch,
         32},
    Rung{RungId::kTransport48, "transport-48",
         "all orders by discrete ordinates on 48 cells, exact rays from the eye", Method::kMarch,
         48},
    Rung{RungId::kTransport64, "transport-64",
         "all orders by discrete ordinates on 64 cells, exact rays from the eye", Method::kMarch,
         64},
    Rung{RungId::kTruth, "truth", "every path of light, by chance: no error but noise",
         Method::kPaths, 0},
};

constexpr Rung kLook{RungId::kLook, "look", "what a published system drew, by its own rules",
                     Method::kLook, 0};
constexpr Rung kDisplay{RungId::kDisplay, "display", "what the clouds are made of, drawn flat",
                        Method::kDisplay, 0};

constexpr bool each_stands_at_its_id() {
    for (std::size_t i = 0; i < kLadder.size(); ++i)
        if (static_cast<std::size_t>(kLadder[i].id) != i) return false;
    return kLadder.size() == static_cast<std::size_t>(RungId::kLook);
}
static_assert(each_stands_at_its_id());

}  // namespace

std::span<const Rung> ladder() {
    return kLadder;
}

const Rung& rung_of(RungId id) {
    if (id == RungId::kDisplay) return kDisplay;
    return id == RungId::kLook ? kLook : kLadder[static_cast<std::size_t>(id)];
}

const Rung* find_rung(std::string_view name) {
    for (const Rung& rung : kLadder)
        if (name == rung.name) return &rung;
    return nullptr;
}

}  // namespace awan
