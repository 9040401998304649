#include "tests/fuzz/targets.h"

#include <cstdio>
#include <cstdlib>

namespace awan::fuzz {

void require(bool holds, const char* law) {
    if (holds) return;
    std::fprintf(stderr, "broken law: %s\n", law);
    std::abort();
}

}  // namespace awan::fuzz
