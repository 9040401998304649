#include "core/scene/automaton.h"

namespace awan {

std::vector<double> figures_of(const AutomatonCloud&) {
    return {};
}

Status check_automaton(const AutomatonCloud&, const std::string&) {
    return std::nullopt;
}

std::uint64_t most_particles(const AutomatonCloud&) {
    return 0;
}

}  // namespace awan
