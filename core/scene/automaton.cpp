#include "core/scene/automaton.h"

#include <algorithm>
#include <cmath>

#include "core/scene/checks.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

Status all_in_range(const glm::dvec3& v, double lowest, double highest,
                    const std::string& pointer) {
    for (int i = 0; i < 3; ++i)
        if (Status wrong = in_range(v[i], lowest, highest, pointer + "/" + std::to_string(i)))
            return wrong;
    return std::nullopt;
}

Status whole_in_range(const glm::dvec3& v, double lowest, double highest,
                      const std::string& pointer) {
    if (Status wrong = all_in_range(v, lowest, highest, pointer)) return wrong;
    for (int i = 0; i < 3; ++i)
        if (v[i] != std::floor(v[i]))
            return invalid(pointer + "/" + std::to_string(i),
                           "must be a whole number, not " + to_text(v[i]));
    return std::nullopt;
}

Status check_radii(const glm::dvec3& radii, const std::string& pointer) {
    return all_in_range(radii, limits::kMinAutomatonRadius, limits::kMaxAutomatonRadius, pointer);
}

Status check_place(double place, const std::string& pointer) {
    return in_range(place, -limits::kMaxAutomatonPlace, limits::kMaxAutomatonPlace, pointer);
}

Status check_ellipsoids(const AutomatonCloud& cloud, const std::string& at) {
    if (Status wrong = count_in_range(cloud.ellipsoids.size(), 0, limits::kMaxAutomatonEllipsoids,
                                      at + "/ellipsoids"))
        return wrong;
    for (std::size_t i = 0; i < cloud.ellipsoids.size(); ++i) {
        const std::string one = at + "/ellipsoids/" + std::to_string(i);
        for (int axis = 0; axis < 3; ++axis)
            if (Status wrong = check_place(cloud.ellipsoids[i].center[axis],
                                           one + "/center/" + std::to_string(axis)))
                return wrong;
        if (Status wrong = check_radii(cloud.ellipsoids[i].radii, one + "/radii")) return wrong;
    }
    if (!cloud.random) return std::nullopt;
    const RandomEllipsoids& random = *cloud.random;
    if (Status wrong = count_in_range(random.count, 0,
                                      limits::kMaxAutomatonEllipsoids - cloud.ellipsoids.size(),
                                      at + "/random/count"))
        return wrong;
    if (Status wrong = check_radii(random.smallest, at + "/random/smallest")) return wrong;
    if (Status wrong = check_radii(random.largest, at + "/random/largest")) return wrong;
    for (int axis = 0; axis < 3; ++axis)
        if (!(random.largest[axis] >= random.smallest[axis]))
            return invalid(at + "/random/largest/" + std::to_string(axis),
                           "must be at least `smallest`, " + to_text(random.smallest[axis]) +
                               ", not " + to_text(random.largest[axis]));
    if (random.level) return check_place(*random.level, at + "/random/level");
    return std::nullopt;
}

Status check_speed(const AutomatonSpeed& speed, const std::string& at) {
    const double most = limits::kMaxAutomatonSpeed;
    if (Status wrong = in_range(speed.constant, -most, most, at + "/constant")) return wrong;
    if (Status wrong = in_range(speed.linear, -most, most, at + "/linear")) return wrong;
    return in_range(speed.quadratic, -most, most, at + "/quadratic");
}

Status check_wind(const AutomatonWind& wind, const std::string& at) {
    if (Status wrong = check_speed(wind.layers, at + "/layers")) return wrong;
    if (Status wrong = count_in_range(wind.ellipsoids.size(), 0, limits::kMaxAutomatonBands,
                                      at + "/ellipsoids"))
        return wrong;
    for (std::size_t i = 0; i < wind.ellipsoids.size(); ++i) {
        const AutomatonWindBand& band = wind.ellipsoids[i];
        const std::string one = at + "/ellipsoids/" + std::to_string(i);
        if (Status wrong = check_place(band.from, one + "/from")) return wrong;
        if (Status wrong = check_place(band.to, one + "/to")) return wrong;
        if (!(band.to >= band.from))
            return invalid(one + "/to", "must be at least `from`, " + to_text(band.from) +
                                            ", not " + to_text(band.to));
        if (Status wrong = check_speed(band.speed, one)) return wrong;
    }
    return in_range(wind.mutation, 0, 1, at + "/mutation");
}

// Cells within the boxes around all ellipsoids, at most.
double cells_of_ellipsoids(const AutomatonCloud& cloud) {
    const double wider = 1 + cloud.wind.mutation;
    const auto box = [&](const glm::dvec3& radii) {
        double cells = 1;
        for (int axis = 0; axis < 3; ++axis)
            cells *= std::min(cloud.cells[axis], 2 * wider * radii[axis] + 1);
        return cells;
    };
    double cells = 0;
    for (const AutomatonEllipsoid& ellipsoid : cloud.ellipsoids) cells += box(ellipsoid.radii);
    const RandomEllipsoids random = random_ellipsoids_of(cloud);
    return cells + static_cast<double>(random.count) * box(random.largest);
}

Status check_work(const AutomatonCloud& cloud, const std::string& at) {
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    const double own = cells_of_ellipsoids(cloud);
    const double a_step = cells + (cloud.wind.ellipsoids.empty() ? 0 : own);
    const double work = own + a_step * static_cast<double>(cloud.steps);
    if (work <= limits::kMaxAutomatonWork) return std::nullopt;
    const double left = std::floor((limits::kMaxAutomatonWork - own) / a_step);
    return invalid(at + "/steps", "is more than this grid may make: cells" +
                                      std::string(cloud.wind.ellipsoids.empty()
                                                      ? ""
                                                      : " (and those in ellipsoids, which move)") +
                                      " times steps may be " + to_text(limits::kMaxAutomatonWork) +
                                      ", here " + to_text(std::max(left, 0.0)) + " steps");
}

void add(std::vector<double>& figures, const glm::dvec3& v) {
    figures.insert(figures.end(), {v.x, v.y, v.z});
}

void add(std::vector<double>& figures, const AutomatonSpeed& speed) {
    figures.insert(figures.end(), {speed.constant, speed.linear, speed.quadratic});
}

}  // namespace

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

std::vector<double> automaton_rules_of(const AutomatonCloud& cloud) {
    std::vector<double> figures;
    add(figures, cloud.cells);
    figures.push_back(static_cast<double>(cloud.ellipsoids.size()));
    for (const AutomatonEllipsoid& ellipsoid : cloud.ellipsoids) {
        add(figures, ellipsoid.center);
        add(figures, ellipsoid.radii);
    }
    const RandomEllipsoids random = random_ellipsoids_of(cloud);
    figures.push_back(static_cast<double>(random.count));
    add(figures, random.smallest);
    add(figures, random.largest);
    figures.push_back(random.level ? 1 : 0);
    figures.push_back(random.level.value_or(0));
    figures.insert(figures.end(), {static_cast<double>(cloud.overlap), cloud.base, cloud.humidity,
                                   cloud.activation, cloud.extinction, cloud.outside_extinction});
    add(figures, cloud.wind.layers);
    figures.push_back(static_cast<double>(cloud.wind.ellipsoids.size()));
    for (const AutomatonWindBand& band : cloud.wind.ellipsoids) {
        figures.insert(figures.end(), {band.from, band.to});
        add(figures, band.speed);
    }
    figures.push_back(cloud.wind.mutation);
    figures.push_back(static_cast<double>(cloud.smooth_steps));  // so many skies are remembered
    return figures;
}

std::vector<double> figures_of(const AutomatonCloud& cloud) {
    std::vector<double> figures = automaton_rules_of(cloud);
    figures.insert(figures.end(), {cloud.cell, static_cast<double>(cloud.warm_up),
                                   cloud.steps_per_second, static_cast<double>(cloud.steps)});
    add(figures, cloud.smooth);
    figures.insert(figures.end(), {cloud.metaball_radius, cloud.threshold,
                                   static_cast<double>(cloud.most_particles)});
    for (double& figure : figures) figure += 0.0;  // -0 is 0
    return figures;
}

Status check_automaton(const AutomatonCloud& cloud, const std::string& at) {
    if (Status wrong = whole_in_range(cloud.cells, 1, limits::kMaxAutomatonSide, at + "/cells"))
        return wrong;
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    if (cells > limits::kMaxAutomatonCells)
        return invalid(at + "/cells", "must be at most " + to_text(limits::kMaxAutomatonCells) +
                                          " cells in all, not " + to_text(cells));
    if (Status wrong = in_range(cloud.cell, limits::kMinAutomatonCell, limits::kMaxAutomatonCell,
                                at + "/cell"))
        return wrong;
    if (Status wrong = check_ellipsoids(cloud, at)) return wrong;
    if (Status wrong = check_place(cloud.base, at + "/base")) return wrong;
    const std::pair<const char*, double> probabilities[] = {
        {"/humidity", cloud.humidity},
        {"/activation", cloud.activation},
        {"/extinction", cloud.extinction},
        {"/outside_extinction", cloud.outside_extinction},
        {"/threshold", cloud.threshold}};
    for (const auto& [name, value] : probabilities)
        if (Status wrong = in_range(value, 0, 1, at + name)) return wrong;
    if (Status wrong = check_wind(cloud.wind, at + "/wind")) return wrong;
    if (Status wrong = count_in_range(cloud.steps, 0, limits::kMaxAutomatonSteps, at + "/steps"))
        return wrong;
    if (Status wrong = count_in_range(cloud.warm_up, 0, cloud.steps, at + "/warm_up")) return wrong;
    if (Status wrong = in_range(cloud.steps_per_second, 0, limits::kMaxStepsPerSecond,
                                at + "/steps_per_second"))
        return wrong;
    if (Status wrong = check_work(cloud, at)) return wrong;
    if (Status wrong = whole_in_range(cloud.smooth, 0, limits::kMaxAutomatonSmooth, at + "/smooth"))
        return wrong;
    if (Status wrong = count_in_range(cloud.smooth_steps, 1, limits::kMaxAutomatonHistory,
                                      at + "/smooth_steps"))
        return wrong;
    if (Status wrong = in_range(cloud.metaball_radius, limits::kMinMetaballRadius,
                                limits::kMaxMetaballRadius, at + "/metaball_radius"))
        return wrong;
    return count_in_range(cloud.most_particles, 1, limits::kMaxParticles, at + "/most_particles");
}

std::uint64_t most_particles(const AutomatonCloud& cloud) {
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    return std::min(cloud.most_particles, static_cast<std::uint64_t>(cells));
}

}  // namespace awan
