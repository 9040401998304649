// Inner loops that are compiled once an instruction set and chosen when they are called. The results are the same bit
// for bit: wider registers hold more elements at a time, and nothing is contracted or reordered (CMakeLists.txt).
//
// This is not left to GCC's target_clones: those are resolved while the program is being loaded, before a sanitizer's
// run time is ready, and cannot be told to take another set.
#pragma once

#include <string_view>

namespace awan {

// kPlain: any processor of this family.
enum class InstructionSet { kPlain, kAvx2, kAvx512 };

// The widest set that this processor has, or the narrower one that the environment asked for when the program began:
// AWAN_INSTRUCTIONS=plain or avx2, for comparing them.
InstructionSet instruction_set();

// What instruction_set() answers for a wish, on a processor that has `widest`. A wish for more than that, or one that
// is no set's name, is as good as none.
InstructionSet instruction_set_for(std::string_view wish, InstructionSet widest);

}  // namespace awan

#define AWAN_INLINE [[gnu::always_inline]] inline

// Defines the function NAME(PARAMETERS), which hands ARGUMENTS to NAME_body, an AWAN_INLINE function compiled for each
// set:
//   AWAN_INLINE void scale_body(float by, float* x, int count) { ... }
//   AWAN_KERNEL(void, scale, (float by, float* x, int count), (by, x, count))
// AWAN_KERNEL_BY_WIDTH: the same of a NAME_body<floats>, a template of how many floats a register of the set holds, for
// what is worth writing in two ways. Both must give the same figures.
#define AWAN_KERNEL(returned, name, parameters, arguments) \
    AWAN_KERNEL_OF(returned, name, parameters, arguments, name##_body, name##_body, name##_body)
#define AWAN_KERNEL_BY_WIDTH(returned, name, parameters, arguments)                       \
    AWAN_KERNEL_OF(returned, name, parameters, arguments, name##_body<4>, name##_body<8>, \
                   name##_body<16>)

#if defined(__x86_64__)
#define AWAN_KERNEL_OF(returned, name, parameters, arguments, plain_body, avx2_body, avx512_body) \
    static returned name##_plain parameters {                                                     \
        return plain_body arguments;                                                              \
    }                                                                                             \
    [[gnu::target("avx2")]] static returned name##_avx2 parameters {                              \
        return avx2_body arguments;                                                               \
    }                                                                                             \
    [[gnu::target("avx512f")]] static returned name##_avx512 parameters {                         \
        return avx512_body arguments;                                                             \
    }                                                                                             \
    returned name parameters {                                                                    \
        switch (instruction_set()) {                                                              \
            case InstructionSet::kAvx512:                                                         \
                return name##_avx512 arguments;                                                   \
            case InstructionSet::kAvx2:                                                           \
                return name##_avx2 arguments;                                                     \
            case InstructionSet::kPlain:                                                          \
                break;                                                                            \
        }                                                                                         \
        return name##_plain arguments;                                                            \
    }
#else
#define AWAN_KERNEL_OF(returned, name, parameters, arguments, plain_body, avx2_body, avx512_body) \
    returned name parameters {                                                                    \
        return plain_body arguments;                                                              \
    }
#endif
