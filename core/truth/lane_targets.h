// Which instruction set runs a piece of code that was compiled for each (for_each_target.h).
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <type_traits>
#include <vector>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/base/instruction_sets.h"
#include "core/truth/phase_law.h"

// Vectors are only ever passed between inlined functions: no ABI to worry about.
#pragma GCC diagnostic ignored "-Wpsabi"

// Runs `call` of the widest set's namespace, and returns. Clang (the fuzzers) does not know GCC's pragmas for targets.
#if defined(__x86_64__) && !defined(__clang__)
#define AWAN_ON_TARGET(call)          \
    switch (instruction_set()) {      \
        case InstructionSet::kAvx512: \
            avx512::call;             \
            return;                   \
        case InstructionSet::kAvx2:   \
            avx2::call;               \
            return;                   \
        case InstructionSet::kPlain:  \
            break;                    \
    }                                 \
    plain::call;
#else
#define AWAN_ON_TARGET(call) plain::call;
#endif
