#include "core/scene/implicit.h"

namespace awan {

std::vector<double> figures_of(const ImplicitCloud&) {
    return {};
}

Status check_implicit(const ImplicitCloud&, const std::string&) {
    return std::nullopt;
}

std::uint64_t most_particles(const ImplicitCloud&) {
    return 0;
}

}  // namespace awan
