// Random walks of light through matter, from the eye backwards.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>

#include "core/scene/outside.h"
#include "core/truth/matter.h"
#include "core/truth/path_random.h"
#include "core/truth/path_tracer.h"
#include "core/truth/phase_law.h"
#include "core/truth/relief_walk.h"

namespace awan::truth {

// Everything that a walk needs to know of a scene. Positions in cells, scene axes (p in matter.h).
struct Setting {
    const Matter* matter = nullptr;
    PhaseLaw phase;
    double albedo = 1;
    glm::dvec3 to_sun{0, 1, 0};
    glm::dvec3 sun_u{1, 0, 0}, sun_v{0, 0, 1};  // unit, at right angles to it
    glm::dvec3 sun_irradiance{0};
    SkyDome dome;
    SkySampling sky = SkySampling::kEscape;
    bool has_ground = false;
    double ground_height = 0;  // cells
    glm::dvec3 ground_albedo{0};
    // Of a ground with hills; else none.
    std::optional<ReliefWalk> relief;
    std::uint32_t max_orders = kMaxOrders;  // 1..kMaxOrders
    // Directions drawn from the sun's side, at most (walk.cpp); 0..kMaxFromSun. Changes the noise only.
    int from_sun = 0;
};
inline constexpr int kMaxFromSun = 12;

// Fills all but `matter`'s own; cells and axes are the matter's.
Setting setting_of(const Scene& scene, const Matter& matter, const TruthOptions& options);

// How many directions from the sun's side are worth their time.
int worthwhile_from_sun(double g);

// What became of paths, for laws that tests hold them to. Weights, mean over r g b.
struct Tally {
    double scatterings = 0;
    // Cut off: by max_orders or kMaxOrders.
    double absorbed = 0, escaped = 0, cut_off = 0;
};

// The sky's radiance from a direction (unit). A gradient, by a second opinion on core/shaders/sky.glsl: zenith and
// horizon mixed by 1.09 u^2 / (u^2 + .09), u the sine of its elevation; the horizon's colour below it.
glm::dvec3 sky_radiance(const Setting& setting, const glm::dvec3& direction);

// t of the ground ahead, infinite when there is none: it is there from above only.
inline double ground_ahead(const Setting& setting, const glm::dvec3& o, const glm::dvec3& d) {
    if (setting.relief) {
        const Matter& m = *setting.matter;
        return ground_ahead(*setting.relief, m.origin + m.cell * o, d) / m.cell;
    }
    if (!setting.has_ground || !(d.y < 0) || o.y <= setting.ground_height)
        return std::numeric_limits<double>::infinity();
    return (setting.ground_height - o.y) / d.y;
}

// Where a path begins: it has met matter at p, or the ground, coming along d (the way the path goes, away from the eye;
// of no account on the ground). key: of its random numbers.
struct Start {
    glm::dvec3 p, d{0, -1, 0};
    std::uint64_t key = 0;
    bool on_ground = false;
};

// What a path brings back.
struct Brought {
    glm::dvec3 radiance{0};
    std::uint32_t scatterings = 0;
};

// Walks a path from every start; brought: as many. A path's light depends on its start and key alone. over: asked now
// and then, ends everything when true. False: it was.
bool walk(const Setting& setting, std::span<const Start> starts, std::span<Brought> brought,
          Tally& tally, const std::function<bool()>& over);

}  // namespace awan::truth
