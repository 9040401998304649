#include "core/scene/automaton.h"

#include <algorithm>

#include "core/scene/fingerprint.h"

namespace awan {

template <>
const Table& table_of<AutomatonCloud>() {
    return kAutomatonTable;
}

RandomEllipsoids random_ellipsoids_of(const AutomatonCloud& cloud) {
    if (cloud.random) return *cloud.random;
    RandomEllipsoids random;
    if (!cloud.ellipsoids.empty()) random.count = 0;
    return random;
}

double automaton_steps_at(const AutomatonCloud& cloud, double time) {
    return std::clamp(static_cast<double>(cloud.warm_up) + time * cloud.steps_per_second, 0.0,
                      static_cast<double>(cloud.steps));
}

std::vector<std::string_view> names_in(std::string_view list) {
    std::vector<std::string_view> names;
    for (std::string_view rest = list;;) {
        const std::size_t comma = rest.find(',');
        names.push_back(rest.substr(0, comma));
        if (comma == std::string_view::npos) return names;
        rest.remove_prefix(comma + 1);
    }
}

AutomatonWind spelled_out(const AutomatonWind& wind) {
    AutomatonWind all = wind;
    const auto spell = [&](AutomatonSpeed& speed) {
        if (!speed.direction) speed.direction = wind.direction;
    };
    spell(all.layers);
    for (AutomatonWindBand& band : all.layer_bands) spell(band.speed);
    for (AutomatonWindBand& band : all.ellipsoids) spell(band.speed);
    all.direction = AutomatonWind{}.direction;
    return all;
}

std::string automaton_rules_of(const AutomatonCloud& cloud) {
    const AutomatonCloud standard;
    AutomatonCloud bits = cloud;
    bits.random = random_ellipsoids_of(cloud);
    bits.wind = spelled_out(cloud.wind);
    // How long an automaton runs and how its bits are looked at.
    bits.cell = standard.cell;
    bits.warm_up = standard.warm_up;
    bits.steps_per_second = standard.steps_per_second;
    bits.steps = standard.steps;
    bits.smooth = standard.smooth;
    bits.smooth_weight = standard.smooth_weight;
    bits.smooth_weight_table = standard.smooth_weight_table;
    bits.metaball_radius = standard.metaball_radius;
    bits.threshold = standard.threshold;
    bits.most_particles = standard.most_particles;
    bits.drawing = standard.drawing;
    bits.chosen = standard.chosen;
    // smooth_steps stays: so many skies are remembered.
    return fingerprint_of(table_of<AutomatonCloud>(), &bits);
}

std::uint64_t most_particles(const AutomatonCloud& cloud) {
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    return std::min(cloud.most_particles, static_cast<std::uint64_t>(cells));
}

}  // namespace awan
