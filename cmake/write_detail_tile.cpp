// write_detail_tile FILE: the detail tile of scenes without a seed, which the program is shipped with
// (core/generate/shipped_tile.cpp). Run while that is built.
#include <cstdio>

#include "core/generate/detail.h"

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto bytes = awan::detail_tile_bytes(awan::kShippedTileSeed, 1);
    std::FILE* const out = std::fopen(argv[1], "wb");
    if (out == nullptr) return 1;
    const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
    return std::fclose(out) == 0 && whole ? 0 : 1;
}
