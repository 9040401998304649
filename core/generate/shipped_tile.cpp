#include <cstddef>

#include "core/generate/detail.h"

// The file AWAN_DETAIL_TILE, as the build wrote it, among the program's constants.
asm(R"(
    .pushsection .rodata
    .balign 16
    .globl awan_detail_tile
    .hidden awan_detail_tile
awan_detail_tile:
    .incbin ")" AWAN_DETAIL_TILE R"("
    .popsection
)");
extern "C" __attribute__((visibility("hidden"))) const std::uint8_t awan_detail_tile[];

namespace awan {

std::span<const std::uint8_t> shipped_tile_bytes() {
    constexpr auto side = static_cast<std::size_t>(kDetailSide);
    return {awan_detail_tile, side * side * side};
}

}  // namespace awan
