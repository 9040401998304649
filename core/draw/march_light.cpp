#include "core/draw/march_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/light/harmonics.h"
#include "core/survey/lattice.h"

namespace awan {
namespace {

// An eye this near to the grid, in cells, is close to it.
constexpr double kCloseCells = 2;

Rgb4 rgb4(const glm::vec3& c) {
    return Rgb4{c.x, c.y, c.z, 0.0f};
}

using Int4 = int __attribute__((vector_size(16)));

// The eight neighbours of a point of a lattice: the index of the lowest and the offsets to the others, and how far the
// point is between them (0..1).
struct Corners {
    std::size_t at, dx, dy, dz;
    float x, y, z;
};

// A lattice's sizes, ready for finding the neighbours of points on all three axes at once.
class Neighbours {
  public:
    explicit Neighbours(const glm::ivec3& n)
        : most_(rgb4(glm::vec3(n - 1))),
          last_{std::max(n.x - 2, 0), std::max(n.y - 2, 0), std::max(n.z - 2, 0), 0},
          row_(static_cast<std::size_t>(n.x)),
          layer_(row_ * static_cast<std::size_t>(n.y)),
          dx_(n.x > 1 ? 1 : 0),
          dy_(n.y > 1 ? row_ : 0),
          dz_(n.z > 1 ? layer_ : 0) {}

    Corners of(const Rgb4& place) const {
        const Rgb4 above = place > Rgb4{} ? place : Rgb4{};
        const Rgb4 clamped = above < most_ ? above : most_;
        Int4 whole = __builtin_convertvector(clamped, Int4);
        whole = whole < last_ ? whole : last_;
        const Rgb4 part = clamped - __builtin_convertvector(whole, Rgb4);
        const auto at = [&](int axis) { return static_cast<std::size_t>(whole[axis]); };
        return {at(2) * layer_ + at(1) * row_ + at(0), dx_, dy_, dz_, part[0], part[1], part[2]};
    }

  private:
    Rgb4 most_;
    Int4 last_;
    std::size_t row_, layer_, dx_, dy_, dz_;
};

// Trilinear between the neighbours; value(i): that of lattice point i.
template <typename Value>
auto between(const Corners& c, const Value& value) {
    const auto along = [&](std::size_t i) {
        const auto a = value(i);
        return a + (value(i + c.dx) - a) * c.x;
    };
    const auto across = [&](std::size_t i) {
        const auto a = along(i);
        return a + (along(i + c.dy) - a) * c.y;
    };
    const auto a = across(c.at);
    return a + (across(c.at + c.dz) - a) * c.z;
}

float dot(const std::array<float, kHarmonics>& a, const std::array<float, kHarmonics>& b) {
    float sum = 0;
    for (std::size_t i = 0; i < kHarmonics; ++i) sum += a[i] * b[i];
    return sum;
}

// Whether a band is on finer cells.
bool is_fine(const FineLight& fine, std::size_t index) {
    return std::any_of(fine.bands.begin(), fine.bands.end(),
                       [&](const FineLight::Band& one) { return one.index == index; });
}

std::array<float, kHarmonics> harmonics_f(const glm::dvec3& d) {
    const auto exact = harmonics(d);
    std::array<float, kHarmonics> y{};
    for (std::size_t i = 0; i < kHarmonics; ++i) y[i] = static_cast<float>(exact[i]);
    return y;
}

// A band's source function from its moments, for the ray's own direction.
Rgb4 of_band(const LightBand& band, const Corners& c, const LightRay& ray) {
    const float s = between(c, [&](std::size_t i) { return dot(band.moments[i], ray.harmonics); });
    return std::clamp(s, 0.0f, band.most) * rgb4(band.color);
}

// That of all bands; `fine`: the neighbours in FineLight, where there is one.
Rgb4 along_ray(const TransportLight& light, const Corners& c, const Corners& fine,
               const LightRay& ray) {
    Rgb4 sum{};
    for (std::size_t b = 0; b < light.bands.size(); ++b)
        if (!is_fine(light.fine, b)) sum += of_band(light.bands[b], c, ray);
    for (const FineLight::Band& one : light.fine.bands) sum += of_band(one.band, fine, ray);
    return sum;
}

// Adds bands to the source functions of a lattice's cells, towards an eye at `place` (cells from the lattice's corner).
// cell: sides, scene units.
void add_source(const std::vector<const LightBand*>& bands, const glm::ivec3& cells,
                const glm::dvec3& place, const glm::dvec3& cell, int threads,
                std::vector<Rgb4>& source) {
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y);
    parallel_for(threads, ny * static_cast<std::size_t>(cells.z), [&](std::size_t row) {
        for (std::size_t i = 0; i < nx; ++i) {
            const glm::dvec3 center =
                glm::dvec3(static_cast<double>(i), static_cast<double>(row % ny),
                           static_cast<double>(row / ny)) +
                0.5;
            const auto y = harmonics_f(glm::normalize((place - center) * cell));
            glm::vec3 sum(0);
            for (const LightBand* const band : bands)
                sum +=
                    band->color * std::clamp(dot(band->moments[row * nx + i], y), 0.0f, band->most);
            source[row * nx + i] += rgb4(sum);
        }
    });
}

// From the grid's cells to those of FineLight.
std::vector<Rgb4> on_fine_cells(const TransportLight& light, const std::vector<Rgb4>& source,
                                int threads) {
    const FineLight& fine = light.fine;
    const auto nx = static_cast<std::size_t>(fine.cells.x),
               ny = static_cast<std::size_t>(fine.cells.y);
    std::vector<Rgb4> to(nx * ny * static_cast<std::size_t>(fine.cells.z));
    const Neighbours cells(light.cells);
    const glm::dvec3 ratio = fine.cell / light.cell;
    const glm::dvec3 corner = (fine.origin - light.origin) / light.cell - 0.5;
    parallel_for(threads, ny * static_cast<std::size_t>(fine.cells.z), [&](std::size_t row) {
        for (std::size_t i = 0; i < nx; ++i) {
            const glm::dvec3 middle =
                glm::dvec3(static_cast<double>(i), static_cast<double>(row % ny),
                           static_cast<double>(row / ny)) +
                0.5;
            const Corners c = cells.of(rgb4(glm::vec3(corner + ratio * middle)));
            to[row * nx + i] = between(c, [&](std::size_t at) { return source[at]; });
        }
    });
    return to;
}

}  // namespace

EyeLight source_towards(const TransportLight& light, const glm::dvec3& eye, int threads,
                        std::span<const std::uint8_t> islands) {
    EyeLight result{&light, {}, false, {}};
    result.islands.resize(light.islands.size());
    parallel_for(threads, light.islands.size(), [&](std::size_t i) {
        if (light.islands[i].lit && (islands.empty() || islands[i] != 0))
            result.islands[i] = source_towards(light.islands[i].light, eye, 1);
    });
    if (!light.has_grid() || light.bands.empty()) return result;
    // Of some islands little is in the light of the whole: that is found ray by ray.
    result.close = !islands.empty();
    if (result.close) return result;
    const glm::dvec3 place = (eye - light.origin) / light.cell;
    const glm::dvec3 beyond =
        glm::max(glm::max(-place, place - glm::dvec3(light.cells)), glm::dvec3(0));
    result.close = glm::length(beyond * light.cell) < kCloseCells * longest(light.cell);
    if (result.close) return result;
    std::vector<const LightBand*> bands, fine;
    for (std::size_t b = 0; b < light.bands.size(); ++b)
        if (!is_fine(light.fine, b)) bands.push_back(&light.bands[b]);
    for (const FineLight::Band& one : light.fine.bands) fine.push_back(&one.band);
    result.source.resize(static_cast<std::size_t>(light.cells.x) *
                         static_cast<std::size_t>(light.cells.y) *
                         static_cast<std::size_t>(light.cells.z));
    add_source(bands, light.cells, place, light.cell, threads, result.source);
    if (fine.empty()) return result;
    result.source = on_fine_cells(light, result.source, threads);
    add_source(fine, light.fine.cells, (eye - light.fine.origin) / light.fine.cell, light.fine.cell,
               threads, result.source);
    return result;
}

LightRay light_ray(const EyeLight& eye_light, const glm::dvec3& start,
                   const glm::dvec3& direction) {
    const TransportLight& light = *eye_light.light;
    LightRay ray;
    ray.start = start;
    ray.direction = direction;
    if (light.has_grid()) {
        ray.grid = glm::vec3((start - light.origin) / light.cell - 0.5);
        ray.grid_step = glm::vec3(direction / light.cell);
        if (eye_light.close) ray.harmonics = harmonics_f(-direction);
        if (!light.fine.bands.empty()) {
            ray.fine = glm::vec3((start - light.fine.origin) / light.fine.cell - 0.5);
            ray.fine_step = glm::vec3(direction / light.fine.cell);
        }
    }
    const SunDepth& sun = light.sun;
    if (!sun.depth.empty()) {
        const glm::dmat3 nodes = to_nodes(sun);
        ray.sun = glm::vec3(nodes * (start - sun.origin));
        ray.sun_step = glm::vec3(nodes * direction);
    }
    return ray;
}

namespace {

void along_one(const EyeLight& eye_light, const LightRay& ray, float first, float step, int count,
               LightAt* out) {
    const TransportLight& light = *eye_light.light;
    const bool grid = light.has_grid();
    const bool sun = !light.sun.depth.empty();
    const bool fine = !light.fine.bands.empty();
    const Neighbours cells(light.cells), nodes(light.sun.nodes), fine_cells(light.fine.cells);
    const Rgb4 grid_from = rgb4(ray.grid), grid_step = rgb4(ray.grid_step),
               fine_from = rgb4(ray.fine), fine_step = rgb4(ray.fine_step),
               sun_from = rgb4(ray.sun), sun_step = rgb4(ray.sun_step);
    for (int k = 0; k < count; ++k) {
        const float t = first + static_cast<float>(k) * step;
        LightAt at{};
        if (grid) {
            const Corners c = cells.of(grid_from + t * grid_step);
            const Corners f = fine ? fine_cells.of(fine_from + t * fine_step) : c;
            if (!eye_light.source.empty())
                at.source = between(f, [&](std::size_t i) { return eye_light.source[i]; });
            else if (eye_light.close)
                at.source = along_ray(light, c, f, ray);
            if (!light.albedo.empty())
                at.albedo = between(c, [&](std::size_t i) { return rgb4(light.albedo[i]); });
        }
        if (sun) {
            const Corners c = nodes.of(sun_from + t * sun_step);
            at.depth =
                std::max(0.0f, between(c, [&](std::size_t i) { return light.sun.depth[i]; }));
        }
        out[k] = at;
    }
}

}  // namespace

void light_along(const EyeLight& eye_light, const LightRay& ray, float first, float step, int count,
                 LightAt* out) {
    if (eye_light.islands.empty()) {
        along_one(eye_light, ray, first, step, count, out);
        return;
    }
    const Islands& regions = eye_light.light->regions;
    const auto at = [&](int k) {
        return static_cast<double>(first + static_cast<float>(k) * step);
    };
    for (int k = 0; k < count;) {
        const IslandOnRay here = island_on_ray(regions, ray.start, ray.direction, at(k));
        int end = k + 1;
        while (end < count && at(end) < here.until) ++end;
        const EyeLight& island = eye_light.islands[static_cast<std::size_t>(here.island)];
        if (island.light == nullptr)
            along_one(eye_light, ray, static_cast<float>(at(k)), step, end - k, out + k);
        else
            along_one(island, light_ray(island, ray.start, ray.direction),
                      static_cast<float>(at(k)), step, end - k, out + k);
        k = end;
    }
}

}  // namespace awan
