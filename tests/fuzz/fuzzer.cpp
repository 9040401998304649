// One of the targets as libFuzzer wants it, named by AWAN_FUZZ_TARGET.
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    AWAN_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    return 0;
}
