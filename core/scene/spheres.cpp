#include "core/scene/spheres.h"

namespace awan {

std::vector<double> figures_of(const SpheresCloud&) {
    return {};
}

Status check_spheres(const SpheresCloud&, const std::string&) {
    return std::nullopt;
}

std::uint64_t most_particles(const SpheresCloud&) {
    return 0;
}

}  // namespace awan
