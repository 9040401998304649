#include "core/base/instruction_sets.h"

#include <algorithm>
#include <cstdlib>

namespace awan {
namespace {

InstructionSet widest_here() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f")) return InstructionSet::kAvx512;
    if (__builtin_cpu_supports("avx2")) return InstructionSet::kAvx2;
#endif
    return InstructionSet::kPlain;
}

}  // namespace

InstructionSet instruction_set_for(std::string_view wish, InstructionSet widest) {
    if (wish == "plain") return InstructionSet::kPlain;
    if (wish == "avx2") return std::min(widest, InstructionSet::kAvx2);
    return widest;
}

InstructionSet instruction_set() {
    static const InstructionSet chosen = [] {
        const char* const wish = std::getenv("AWAN_INSTRUCTIONS");
        return instruction_set_for(wish == nullptr ? "" : wish, widest_here());
    }();
    return chosen;
}

}  // namespace awan
