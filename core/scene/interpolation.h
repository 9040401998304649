// How what a document gives at keys goes on between them.
#pragma once

namespace awan {

inline constexpr const char* kInterpolationWords[] = {"smooth", "linear"};

}  // namespace awan
