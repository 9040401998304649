#include "core/light/ground_band.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace awan {
namespace {

constexpr int kMostCells = 32;         // along a side of the cloud that light is gathered from
constexpr double kLeastBounce = 2e-3;  // of the ground's irradiance: a weaker one is not followed
constexpr double kMostRatio = 0.95;    // of one bounce to the one before

// What a band of the ground's light takes of a colour: its luminance, or one channel of it.
struct Part {
    int channel = -1;  // -1: all, with `color`
    glm::dvec3 color{1};

    double of(const glm::dvec3& rgb) const { return channel < 0 ? luminance(rgb) : rgb[channel]; }
};

InflowFromBelow inflow_from(const GroundLight& ground, const Part& part, const glm::dvec3& origin,
                            double cell) {
    return [&ground, part, origin, cell](const glm::dvec3& direction, const glm::dvec3& place) {
        const glm::dvec3 p = origin + cell * place;
        const double t = std::max(p.y - ground.height, 0.0) / direction.y;
        return part.of(radiance_at(ground, p.x - t * direction.x, p.z - t * direction.z));
    };
}

// The most that radiance_at may be, by its parts.
double most_of(const GroundLight& ground, const Part& part) {
    glm::dvec3 change(0);
    for (const std::array<float, 3>& one : ground.change.irradiance)
        for (std::size_t c = 0; c < 3; ++c)
            change[static_cast<int>(c)] =
                std::max(change[static_cast<int>(c)], static_cast<double>(one[c]));
    return part.of(ground.albedo * (ground.sun + ground.sky + change)) / std::numbers::pi;
}

glm::dvec3 sum_of(const GroundChange& change) {
    glm::dvec3 sum(0);
    for (const std::array<float, 3>& one : change.irradiance)
        sum += glm::dvec3(static_cast<double>(one[0]), static_cast<double>(one[1]),
                          static_cast<double>(one[2]));
    return sum;
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

// All light of one pass through the ground: how the cloud is lit by `ground`, and what it sends back to it.
struct Bounce {
    std::vector<LightBand> bands;  // as many as parts
    GroundLight back;              // only `change`
};

}  // namespace

CloudAbove cloud_above(const TransportLight& light, const std::vector<float>& depth, double scaled,
                       std::size_t first_band, const BeamSource& beam) {
    CloudAbove cloud{light.origin, light.cell, light.cells, depth, scaled, {}};
    cloud.source.assign(depth.size(), {});
    const std::array<double, kHarmonics> y = harmonics(beam.direction);
    for (std::size_t i = 0; i < depth.size(); ++i) {
        if (!(depth[i] > 0)) continue;
        std::array<float, 48>& to = cloud.source[i];
        for (std::size_t b = first_band; b < light.bands.size(); ++b)
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t m = 0; m < kHarmonics; ++m)
                    to[c * kHarmonics + m] +=
                        light.bands[b].color[static_cast<int>(c)] * light.bands[b].moments[i][m];
        if (beam.left == nullptr) continue;
        const double left = static_cast<double>((*beam.left)[i]) / static_cast<double>(depth[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double albedo = light.albedo.empty()
                                      ? beam.albedo
                                      : static_cast<double>(light.albedo[i][static_cast<int>(c)]);
            for (std::size_t l = 0, m = 0; l < 4; ++l)
                for (; m < (l + 1) * (l + 1); ++m)
                    to[c * kHarmonics + m] += static_cast<float>(
                        left * albedo * beam.sun[static_cast<int>(c)] * beam.moment[l] * y[m]);
        }
    }
    return cloud;
}

Status ground_and_cloud(const SkyDome& sky, const std::vector<float>& depth, double scaled,
                        const BeamSource& beam, bool colored, const TransportSettings& settings,
                        const SolveFromBelow& solve, int threads, TransportLight& light) {
    GroundLight& ground = light.ground;
    if (settings.ground_shadow) {
        const CloudAbove cloud = coarser(cloud_above(light, depth, scaled, 0, beam), kMostCells);
        ground.change = nodes_under(cloud, ground.height);
        gather(cloud, &sky, ground.height, threads, ground.change);
    }
    if (!settings.ground || ground.albedo == glm::dvec3(0)) return std::nullopt;

    std::vector<Part> parts;
    if (colored) {
        for (int c = 0; c < 3; ++c) {
            parts.push_back({c, glm::dvec3(0)});
            parts.back().color[c] = 1;
        }
    } else {
        // The colour that the middle of the cloud sees.
        const glm::dvec3 middle = light.origin + 0.5 * light.cell * glm::dvec3(light.cells);
        const glm::dvec3 seen = mean_radiance_below(
            ground, {middle.x, std::max(middle.y, ground.height + 0.5 * light.cell), middle.z});
        if (!(luminance(seen) > 0)) return std::nullopt;
        parts.push_back({-1, seen / luminance(seen)});
    }

    const double kept = beam.albedo * beam.moment[0];
    const std::size_t first_band = light.bands.size();
    const auto bounce = [&](const GroundLight& from, Bounce& made) -> Status {
        TransportLight own;  // only the bands
        own.origin = light.origin;
        own.cell = light.cell;
        own.cells = light.cells;
        for (const Part& part : parts) {
            auto band =
                solve(inflow_from(from, part, light.origin, light.cell), std::max(part.channel, 0));
            if (!band.ok()) return band.error();
            band->color = glm::vec3(part.color);
            own.bands.push_back(*std::move(band));
        }
        if (settings.ground_shadow) {
            const CloudAbove cloud =
                coarser(cloud_above(own, depth, scaled, 0, BeamSource{}), kMostCells);
            made.back.present = true;
            made.back.height = ground.height;
            made.back.albedo = ground.albedo;
            made.back.change = nodes_under(cloud, ground.height);
            gather(cloud, nullptr, ground.height, threads, made.back.change);
        }
        made.bands = std::move(own.bands);
        return std::nullopt;
    };

    Bounce first;
    if (Status failed = bounce(ground, first)) return failed;
    for (LightBand& band : first.bands) light.bands.push_back(std::move(band));
    if (settings.ground_shadow) {
        add(ground.change, first.back.change, glm::dvec3(1));
        double most = 0;
        for (const std::array<float, 3>& one : first.back.change.irradiance)
            most = std::max({most, static_cast<double>(one[0]), static_cast<double>(one[1]),
                             static_cast<double>(one[2])});
        const glm::dvec3 open = ground.sun + ground.sky;
        if (most * std::max({ground.albedo.x, ground.albedo.y, ground.albedo.z}) >
            kLeastBounce * std::max({open.x, open.y, open.z})) {
            Bounce second;
            if (Status failed = bounce(first.back, second)) return failed;
            const glm::dvec3 one = sum_of(first.back.change), two = sum_of(second.back.change);
            glm::dvec3 series(1);
            for (int c = 0; c < 3; ++c)
                if (one[c] > 0) series[c] = 1 / (1 - std::clamp(two[c] / one[c], 0.0, kMostRatio));
            add(ground.change, second.back.change, series);
            for (std::size_t p = 0; p < parts.size(); ++p)
                add(light.bands[first_band + p], second.bands[p],
                    parts[p].channel < 0 ? luminance(series * parts[p].color)
                                         : series[parts[p].channel]);
        }
    }
    for (std::size_t p = 0; p < parts.size(); ++p)
        light.bands[first_band + p].most = static_cast<float>(kept * most_of(ground, parts[p]));
    return std::nullopt;
}

}  // namespace awan
