#include "core/light/ground_band.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

namespace awan {
namespace {

constexpr int kMostCells = 32;  // along a side of the cloud that light is gathered from
// Of the ground's irradiance: a weaker bounce is not followed.
constexpr double kLeastBounce = 2e-3;
// Of the highest hills: where, besides the level ground, the cloud's light on them is gathered.
constexpr double kHeights[] = {0.33, 0.67, 1};
constexpr double kMostRatio = 0.95;  // of one bounce to the one before

// What a band of the ground's light takes of a colour: its luminance, or one channel of it.
struct Part {
    int channel = -1;  // -1: all, with `color`
    glm::dvec3 color{1};

    double of(const glm::dvec3& rgb) const { return channel < 0 ? luminance(rgb) : rgb[channel]; }
};

glm::dvec3 rgb_of(const std::array<float, 3>& color) {
    return {static_cast<double>(color[0]), static_cast<double>(color[1]),
            static_cast<double>(color[2])};
}

InflowFromBelow inflow_from(const GroundLight& ground, const Part& part, const CloudGrid& grid) {
    return [&ground, part, origin = grid.origin, cell = grid.cell](const glm::dvec3& direction,
                                                                   const glm::dvec3& place) {
        const glm::dvec3 p = origin + cell * place;
        const double t = std::max(p.y - ground.height, 0.0) / direction.y;
        return part.of(radiance_at(ground, p.x - t * direction.x, p.z - t * direction.z));
    };
}

// The most that radiance_at may be anywhere.
double most_of(const GroundLight& ground, const Part& part) {
    glm::dvec3 change(0);
    for (const std::array<float, 3>& one : ground.change.irradiance)
        change = glm::max(change, rgb_of(one));
    return part.of(ground.albedo * (ground.sun + ground.sky + change)) / std::numbers::pi;
}

glm::dvec3 sum_of(const GroundChange& change) {
    glm::dvec3 sum(0);
    for (const std::array<float, 3>& one : change.irradiance) sum += rgb_of(one);
    return sum;
}

// The largest channel of any node, 0 if none is above it.
double largest_of(const GroundChange& change) {
    double most = 0;
    for (const std::array<float, 3>& one : change.irradiance) {
        const glm::dvec3 rgb = rgb_of(one);
        most = std::max({most, rgb.x, rgb.y, rgb.z});
    }
    return most;
}

void add(GroundChange& to, const GroundChange& from, const glm::dvec3& times) {
    for (std::size_t i = 0; i < to.irradiance.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            to.irradiance[i][c] +=
                static_cast<float>(times[static_cast<int>(c)]) * from.irradiance[i][c];
}

void add(LightBand& to, const LightBand& from, double times) {
    for (std::size_t i = 0; i < to.moments.size(); ++i)
        for (std::size_t m = 0; m < kHarmonics; ++m)
            to.moments[i][m] += static_cast<float>(times) * from.moments[i][m];
}

// What a cloud sends down to the ground, less what it hides of `sky` (null: nothing). With hills on it, `above` is that
// at the heights of these.
GroundChange sent_down(const GroundExchange& exchange, std::span<const LightBand> bands,
                       const BeamSource& beam, const SkyDome* sky, int rays,
                       std::vector<GroundLight::ChangeAbove>* above = nullptr) {
    const CloudAbove cloud = coarser(cloud_above(exchange.cloud, bands, beam), kMostCells);
    GroundChange change = nodes_under(cloud, exchange.ground.height);
    if (above != nullptr && exchange.ground.relief)
        for (const double share : kHeights) {
            const double y = exchange.ground.height + share * exchange.ground.relief->highest;
            above->push_back({y, change});
            gather(cloud, sky, y, rays, exchange.threads, above->back().change);
        }
    gather(cloud, sky, exchange.ground.height, rays, exchange.threads, change);
    return change;
}

// The bands that the ground's light is solved in. None: the cloud's middle sees a black ground.
std::vector<Part> parts_of(const GroundLight& ground, const CloudGrid& grid, bool colored) {
    if (colored) return {{0, {1, 0, 0}}, {1, {0, 1, 0}}, {2, {0, 0, 1}}};
    const glm::dvec3 middle = grid.origin + 0.5 * (grid.cell * glm::dvec3(grid.cells));
    const glm::dvec3 seen = mean_radiance_below(
        ground, {middle.x, std::max(middle.y, ground.height + 0.5 * grid.cell.y), middle.z});
    if (!(luminance(seen) > 0)) return {};
    return {{-1, seen / luminance(seen)}};
}

// One way up and back down: how the cloud is lit by a ground, and what of that it sends back.
struct Bounce {
    std::vector<LightBand> bands;  // one for each part
    GroundLight back;              // a ground lit by that alone; only with exchange.shadow
};

Result<Bounce> bounce(const GroundExchange& exchange, const GroundLight& from,
                      const std::vector<Part>& parts, const SolveFromBelow& solve) {
    Bounce made;
    for (const Part& part : parts) {
        auto band = solve(inflow_from(from, part, exchange.cloud), std::max(part.channel, 0));
        if (!band.ok()) return band.error();
        band->color = glm::vec3(part.color);
        made.bands.push_back(*std::move(band));
    }
    if (exchange.shadow) {
        made.back.present = true;
        made.back.height = exchange.ground.height;
        made.back.albedo = exchange.ground.albedo;
        made.back.change = sent_down(exchange, made.bands, BeamSource{}, nullptr, kFewGatherRays);
    }
    return made;
}

// Whether the ground shines on by what a bounce sent back to it.
bool goes_on(const GroundLight& ground, const Bounce& bounce) {
    const glm::dvec3 open = ground.sun + ground.sky, albedo = ground.albedo;
    return largest_of(bounce.back.change) * std::max({albedo.x, albedo.y, albedo.z}) >
           kLeastBounce * std::max({open.x, open.y, open.z});
}

// With r the ratio of the second bounce to the first, 1 + r + r^2 + ... = 1 / (1 - r), in each channel: by this the
// second bounce stands for itself and all after it.
glm::dvec3 series_of(const Bounce& first, const Bounce& second) {
    const glm::dvec3 one = sum_of(first.back.change), two = sum_of(second.back.change);
    glm::dvec3 series(1);
    for (int c = 0; c < 3; ++c)
        if (one[c] > 0) series[c] = 1 / (1 - std::clamp(two[c] / one[c], 0.0, kMostRatio));
    return series;
}

}  // namespace

CloudAbove cloud_above(const CloudGrid& grid, std::span<const LightBand> bands,
                       const BeamSource& beam) {
    CloudAbove cloud{grid.origin, grid.cell, grid.cells, {grid.depth.begin(), grid.depth.end()},
                     grid.scaled, {}};
    cloud.source.assign(grid.depth.size(), {});
    const std::array<double, kHarmonics> y = harmonics(beam.direction);
    for (std::size_t i = 0; i < grid.depth.size(); ++i) {
        if (!(grid.depth[i] > 0)) continue;
        std::array<float, 3 * kHarmonics>& to = cloud.source[i];
        for (const LightBand& band : bands)
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t m = 0; m < kHarmonics; ++m)
                    to[c * kHarmonics + m] += band.color[static_cast<int>(c)] * band.moments[i][m];
        if (beam.left.empty()) continue;
        const double left = static_cast<double>(beam.left[i]) / static_cast<double>(grid.depth[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            const auto channel = static_cast<int>(c);
            const double albedo = beam.cell_albedo.empty()
                                      ? beam.albedo
                                      : static_cast<double>(beam.cell_albedo[i][channel]);
            for (std::size_t m = 0; m < kHarmonics; ++m)
                to[c * kHarmonics + m] += static_cast<float>(left * albedo * beam.sun[channel] *
                                                             beam.moment[kOrderOf[m]] * y[m]);
        }
    }
    return cloud;
}

Result<GroundAndCloud> ground_and_cloud(const GroundExchange& exchange,
                                        const SolveFromBelow& solve) {
    GroundAndCloud result;
    GroundLight ground = exchange.ground;
    const auto finished = [&] {
        result.change = std::move(ground.change);
        result.above = std::move(ground.above);
        return std::move(result);
    };
    if (exchange.shadow)
        ground.change = sent_down(exchange, exchange.bands, exchange.beam, &exchange.sky,
                                  exchange.rays, &ground.above);
    if (!exchange.into_cloud || ground.albedo == glm::dvec3(0)) return finished();
    const std::vector<Part> parts = parts_of(ground, exchange.cloud, exchange.colored);
    if (parts.empty()) return finished();

    auto first = bounce(exchange, ground, parts, solve);
    if (!first.ok()) return first.error();
    result.into_cloud = std::move(first->bands);
    // What comes back down is weak, and hills at any height have it alike.
    const auto add_down = [&](const GroundChange& from, const glm::dvec3& times) {
        add(ground.change, from, times);
        for (GroundLight::ChangeAbove& one : ground.above) add(one.change, from, times);
    };
    if (exchange.shadow) add_down(first->back.change, glm::dvec3(1));
    if (exchange.shadow && goes_on(ground, *first)) {
        auto second = bounce(exchange, first->back, parts, solve);
        if (!second.ok()) return second.error();
        const glm::dvec3 series = series_of(*first, *second);
        add_down(second->back.change, series);
        for (std::size_t p = 0; p < parts.size(); ++p)
            add(result.into_cloud[p], second->bands[p],
                parts[p].channel < 0 ? luminance(series * parts[p].color)
                                     : series[parts[p].channel]);
    }
    const double scattered = exchange.beam.albedo * exchange.beam.moment[0];
    for (std::size_t p = 0; p < parts.size(); ++p)
        result.into_cloud[p].most = static_cast<float>(scattered * most_of(ground, parts[p]));
    return finished();
}

}  // namespace awan
