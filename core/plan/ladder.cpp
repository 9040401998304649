#include "core/plan/ladder.h"

#include <array>

namespace awan {
namespace {

constexpr std::array kLadder = {
    Rung{"additive", "light scattered once, nothing in its way: for haze and thin veils",
         Method::kSplats, 0},
    Rung{"harris", "the classic two passes: shadow and forward scattering along the light, splats",
         Method::kSplats, 0},
    Rung{"single", "sunlight scattered once, exactly: no light from the sky, no further orders",
         Method::kMarch, 0},
    Rung{"transport-16", "all orders by discrete ordinates on 16 cells, exact rays from the eye",
         Method::kMarch, 16},
    Rung{"transport-24", "all orders by discrete ordinates on 24 cells, exact rays from the eye",
         Method::kMarch, 24},
    Rung{"transport-32", "all orders by discrete ordinates on 32 cells, exact rays from the eye",
         Method::kMarch, 32},
    Rung{"transport-48", "all orders by discrete ordinates on 48 cells, exact rays from the eye",
         Method::kMarch, 48},
    Rung{"transport-64", "all orders by discrete ordinates on 64 cells, exact rays from the eye",
         Method::kMarch, 64},
    Rung{"truth", "every path of light, by chance: no error but noise", Method::kPaths, 0},
};

}  // namespace

std::span<const Rung> ladder() {
    return kLadder;
}

const Rung& look_rung() {
    static constexpr Rung kLook{"look", "what a published system drew, by its own rules",
                                Method::kLook, 0};
    return kLook;
}

const Rung* find_rung(std::string_view name) {
    for (const Rung& rung : kLadder)
        if (name == rung.name) return &rung;
    return nullptr;
}

}  // namespace awan
