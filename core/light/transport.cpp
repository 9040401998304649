#include "core/light/transport.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/light/band_solve.h"
#include "core/light/fine_band.h"
#include "core/light/ground_band.h"
#include "core/light/islands.h"
#include "core/light/nested_grids.h"
#include "core/light/part_matter.h"
#include "core/light/relief_light.h"
#include "core/light/shine.h"
#include "core/light/transport_part.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// Of the clouds' shadows on hills, along their longest side: their edges are seen from near by.
constexpr int kCellsOverHills = 160;
// Of a solve without the sun, times the sun's: the sky's light is a fifth of all, and smooth.
constexpr double kSkyTolerance = 4;
// Of the grid that rung `single` has for colours: cells along its longest side, and the most work to fill it.
constexpr int kColorCells = 64;
constexpr double kMaxColorWork = 3e8;

// What all solves of a part share.
struct PartSolve {
    const Scene& scene;
    const LightPart& part;
    const TransportSettings& settings;
    // The light of the next coarser grid, from which this one's solves begin; null: there is none.
    const TransportLight* coarser;
    int threads;
    const Deadline& deadline;

    Outside outside = outside_of(scene);
    ScatteringSplit split =
        settings.sky_once ? whole_scattering(scene->medium) : split_scattering(scene->medium);
    bool over_ground = has_ground(*scene, bounds_of(part.own));
    bool colored = !part.all.color.empty();
    // A part of a scene has the ground's light from the solve of the whole.
    bool own_ground() const { return over_ground && part.whole == nullptr; }
    const SunDepth& clouds_alone() const { return part.open_sun ? *part.open_sun : part.sun; }
    bool shades_ground() const { return own_ground() && settings.ground_shadow; }

    PartGrid grid{};
    std::vector<glm::vec3> albedo{};  // of each cell; EMPTY: grey matter
    std::vector<float> beam{};        // as beam_source gives it; EMPTY: no sun
    Ordinates ordinates = make_ordinates();
};

// Rung `single` has no grid of light; but where particles have colours, the eye pass has them from a grid.
void take_colors(const PartSolve& solve, TransportLight& light) {
    const ParticleSet& particles = solve.part.all;
    const Lattice lattice = lattice_around_matter(solve.part.own, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                                  0, kColorCells, solve.threads, kMaxColorWork);
    light.origin = lattice.origin;
    light.cell = lattice.cell;
    light.cells = lattice.cells;
    light.albedo =
        colored_albedo(particles, lattice, extinction_in(particles, lattice, solve.threads),
                       solve.split.albedo, solve.threads);
}

// Radiance of the ground, in units of a band's colour, where the light that comes along `direction` to `to` left it.
double ground_from(const GroundLight& ground, const LightBand& band, bool colored,
                   const glm::dvec3& to, const glm::dvec3& direction) {
    if (!(direction.y > 0)) return 0;
    const glm::dvec3 place = to - direction * (std::max(to.y - ground.height, 0.0) / direction.y);
    const glm::dvec3 radiance = radiance_at(ground, place.x, place.z), color(band.color);
    return colored ? glm::dot(radiance, color) : luminance(radiance) / luminance(color);
}

// What comes in through the faces of the part's grid for the band of this index. It refers to `solve` and `shine`.
Inflow inflow_of(const PartSolve& solve, const Shine& shine, std::size_t index) {
    // Over a ground no sky is seen below.
    const auto open = [&](const glm::dvec3& direction) {
        return solve.over_ground && direction.y > 0 ? 0.0 : sky_from(shine, -direction);
    };
    if (!solve.part.surroundings) {
        if (!shine.has_sky()) return {};
        return open;
    }
    const Lattice& lattice = solve.grid.lattice;
    const glm::dvec3 middle = lattice.origin + 0.5 * (lattice.cell * glm::dvec3(lattice.cells));
    return [&, open, middle, index](const glm::dvec3& direction) {
        double behind = 0;
        if (shine.from_ground != nullptr)
            behind = ground_from(solve.part.whole->ground, *shine.from_ground, solve.colored,
                                 middle, direction);
        else if (shine.has_sky())
            behind = open(direction);
        return solve.part.surroundings(index, direction, behind);
    };
}

// The band of this index: how `shine` lights the part. guess: as in BandProblem.
Result<SolvedBand> band_of(const PartSolve& solve, const Shine& shine, std::size_t index,
                           std::vector<std::array<float, kHarmonics>> guess) {
    const Matter matter = matter_of(solve.grid, solve.split, solve.albedo, channel_of(shine));
    BandProblem problem{matter, solve.split};
    if (shine.beam) problem.beam = &solve.beam;
    problem.beam_direction = -sun_direction(solve.scene->sun);
    problem.inflow = inflow_of(solve, shine, index);
    problem.from_below = shine.from_below;
    problem.guess = std::move(guess);
    problem.tolerance = (shine.beam ? 1 : kSkyTolerance) * solve.settings.tolerance;
    problem.max_sweeps = solve.settings.max_sweeps;
    problem.once = solve.settings.sky_once;
    auto solved = solve_band(problem, solve.ordinates, solve.threads, solve.deadline);
    if (!solved.ok()) return solved;
    solved->band.color = shine.color;
    if (!shine.beam && !solve.part.surroundings)
        solved->band.most = static_cast<float>(solve.split.albedo * (1 - solve.split.peak_share) *
                                               brightest_sky(shine));
    return solved;
}

void count_sweeps(const SolvedBand& solved, TransportLight& light) {
    light.sweeps += solved.sweeps;
    light.residual = std::max(light.residual, solved.residual);
}

// Solves for the next band. Its time is counted as `effect`'s.
Status add_band(const PartSolve& solve, const Shine& shine, Effect effect, TransportLight& light) {
    const std::size_t index = light.bands.size();
    auto solved = timed_for(light.took, effect, [&] {
        std::vector<std::array<float, kHarmonics>> guess;
        if (solve.coarser != nullptr && index < solve.coarser->bands.size())
            guess = moments_between(*solve.coarser, index, light, solve.threads);
        return band_of(solve, shine, index, std::move(guess));
    });
    if (!solved.ok()) return solved.error();
    count_sweeps(*solved, light);
    light.bands.push_back(std::move(solved->band));
    return std::nullopt;
}

// A part of a scene has the ground's light from the bands that the whole has for it, after those of the sun and the
// sky.
Status add_bands_of_whole_ground(const PartSolve& solve, TransportLight& light) {
    const std::vector<LightBand>& bands = solve.part.whole->bands;
    for (std::size_t b = light.bands.size(); b < bands.size(); ++b) {
        Shine shine;
        shine.from_ground = &bands[b];
        shine.color = bands[b].color;
        if (Status failed = add_band(solve, shine, Effect::kGroundLight, light)) return failed;
    }
    return std::nullopt;
}

// Of grids that are only on the way to those of rungs, what goes down is a beginning.
int gather_rays(const TransportSettings& settings) {
    if (settings.cells == 0) return kGatherRays;
    for (const Rung& rung : ladder())
        if (rung.cells > 0 && rung.cells <= settings.cells) return kGatherRays;
    return kFewGatherRays;
}

// The light between the cloud and the ground below it. Its solves are timed as ground_light, the rest, which is what
// the cloud sends down, as ground_shadow.
Status add_own_ground(const PartSolve& solve, TransportLight& light) {
    const auto start = Deadline::Clock::now();
    const ScatteringSplit& split = solve.split;
    if (solve.shades_ground())
        cast_shadow(solve.clouds_alone(), split.albedo, split.peak_share,
                    peak_turning(solve.scene->medium), solve.threads, light.ground);
    const auto side = static_cast<float>(shortest(solve.grid.lattice.cell));
    std::vector<float> depth(solve.grid.extinction);
    for (float& one : depth) one *= side;
    const CloudGrid cloud{light.origin, light.cell, light.cells, depth, split.scaled()};
    BeamSource beam;
    beam.left = solve.beam;
    beam.sun = solve.outside.sun;
    beam.direction = -sun_direction(solve.scene->sun);
    for (std::size_t l = 0; l < kOrders; ++l) beam.moment[l] = split.outside_peak(l);
    beam.albedo = split.albedo;
    beam.cell_albedo = solve.albedo;
    const auto lit_from_below = [&](const InflowFromBelow& inflow, int channel) {
        Shine shine;
        shine.color = glm::vec3(0);
        shine.color[channel] = 1;
        shine.from_below = inflow;
        auto solved = timed_for(light.took, Effect::kGroundLight,
                                [&] { return band_of(solve, shine, light.bands.size(), {}); });
        if (!solved.ok()) return Result<LightBand>(solved.error());
        count_sweeps(*solved, light);
        return Result<LightBand>(std::move(solved->band));
    };
    const GroundExchange exchange{.cloud = cloud,
                                  .bands = light.bands,
                                  .beam = beam,
                                  .ground = light.ground,
                                  .sky = solve.outside.sky,
                                  .colored = solve.colored,
                                  .into_cloud = solve.settings.ground,
                                  .shadow = solve.settings.ground_shadow,
                                  .rays = gather_rays(solve.settings),
                                  .threads = solve.threads};
    auto exchanged = ground_and_cloud(exchange, lit_from_below);
    if (!exchanged.ok()) return exchanged.error();
    light.ground.change = std::move(exchanged->change);
    light.ground.above = std::move(exchanged->above);
    for (LightBand& band : exchanged->into_cloud) light.bands.push_back(std::move(band));
    if (solve.shades_ground())
        light.took.of(Effect::kGroundShadow) +=
            ms_since(start) - light.took.of(Effect::kGroundLight);
    return std::nullopt;
}

// Rung `single`: the sun's depth only.
TransportLight without_grid(const PartSolve& solve, TransportLight light) {
    const Medium& medium = solve.scene->medium;
    if (solve.shades_ground()) {
        const auto start = Deadline::Clock::now();
        cast_shadow(solve.clouds_alone(), medium.albedo, 0, 0, solve.threads, light.ground);
        light.took.of(Effect::kGroundShadow) = ms_since(start);
    }
    if (solve.colored) take_colors(solve, light);
    return light;
}

// Cuts the part into cells, and takes what the bands share from them.
Status prepare_grid(PartSolve& solve, TransportLight& light) {
    const double floor =
        solve.over_ground ? solve.scene->ground->height : -std::numeric_limits<double>::infinity();
    solve.grid = grid_of_part(solve.part, solve.settings.cells, floor, solve.threads);
    const Lattice& lattice = solve.grid.lattice;
    light.took.of(Effect::kDetail) += solve.grid.detail_ms;
    light.origin = lattice.origin;
    light.cell = lattice.cell;
    light.cells = lattice.cells;
    light.peak_share = solve.split.peak_share;
    light.peak_from = kOrders;
    if (solve.colored)
        solve.albedo = colored_albedo(solve.part.all, lattice, solve.grid.extinction,
                                      solve.split.albedo, solve.threads);
    return solve.deadline.over();
}

// The bands of the light from outside.
Status add_bands_from_outside(PartSolve& solve, TransportLight& light) {
    const SkyDome& sky = solve.outside.sky;
    SkyInflow physical;
    if (solve.settings.sky && sky.physical) physical = sky_inflow(sky);
    const std::vector<Shine> shines =
        shines_of(solve.outside, physical, solve.colored, solve.settings.sky);
    if (std::any_of(shines.begin(), shines.end(), [](const Shine& shine) { return shine.beam; }))
        solve.beam = timed_for(light.took, Effect::kMultipleScattering, [&] {
            return beam_source(solve.grid, solve.part.sun, solve.split.scaled(), solve.threads,
                               solve.deadline);
        });
    // A beam that was cut short must not pass for a dark one.
    if (Status failed = solve.deadline.over()) return failed;
    for (const Shine& shine : shines) {
        const Effect effect = shine.beam ? Effect::kMultipleScattering : Effect::kSkyLight;
        if (Status failed = add_band(solve, shine, effect, light)) return failed;
    }
    return std::nullopt;
}

// The sun's bands once more, on the grid's fine cells, where it has lumps of detail that its cells do not see.
Status refine_sunlight(const PartSolve& solve, TransportLight& light) {
    const DetailField* const detail = solve.part.all.detail.get();
    if (!needs_fine_light(detail, solve.grid, solve.split.scaled())) return std::nullopt;
    const SkyDome& sky = solve.outside.sky;
    SkyInflow physical;
    if (solve.settings.sky && sky.physical) physical = sky_inflow(sky);
    const std::vector<Shine> shines =
        shines_of(solve.outside, physical, solve.colored, solve.settings.sky);
    FineLight fine = fine_light_on(solve.grid);
    for (std::size_t index = 0; index < shines.size(); ++index) {
        const Shine& shine = shines[index];
        if (!shine.beam) continue;
        const int channel = channel_of(shine);
        const Matter matter = matter_of(solve.grid, solve.split, solve.albedo, channel);
        BandProblem problem{matter, solve.split};
        problem.beam_direction = -sun_direction(solve.scene->sun);
        problem.inflow = inflow_of(solve, shine, index);
        auto solved = timed_for(light.took, Effect::kDetail, [&] {
            return fine_band(problem, light.bands[index], solve.grid, solve.part.sun, solve.albedo,
                             channel, solve.ordinates, solve.threads, solve.deadline);
        });
        if (!solved.ok()) return solved.error();
        light.sweeps += solved->sweeps;
        solved->band.color = shine.color;
        fine.bands.push_back({index, std::move(solved->band)});
    }
    if (!fine.bands.empty()) light.fine = std::move(fine);
    return std::nullopt;
}

// Whether the grid is the coarser one's, whose bands it would be given back by `extrapolate`: it differs by the sun's
// depth, and by what that changes for the ground.
bool has_bands_of_coarser(const PartSolve& solve, const TransportLight& light) {
    return solve.coarser != nullptr && !solve.own_ground() && light.cells == solve.coarser->cells &&
           light.origin == solve.coarser->origin;
}

// The light of the grid that `solve` names, as it is solved; without the sun's depth.
Result<TransportLight> solve_grid(PartSolve solve) {
    TransportLight light;
    light.sky = solve.settings.sky;
    if (solve.part.whole == nullptr) light.ground = bare_ground(*solve.scene);
    if (light.ground.relief) {
        const TransportLight* const before = solve.coarser;
        light.ground.albedo =
            before != nullptr && before->ground.relief
                ? before->ground.albedo
                : level_albedo(relief_light(solve.scene, light.ground, solve.threads),
                               light.ground);
    }
    light.ground.clouds = solve.part.open_sun;
    light.ground.into_cloud = solve.own_ground() && solve.settings.ground;
    if (solve.settings.cells == 0) return without_grid(solve, std::move(light));

    if (solve.settings.sky_once) solve.outside.sun = glm::dvec3(0);
    if (Status failed = prepare_grid(solve, light)) return *failed;
    if (has_bands_of_coarser(solve, light)) {
        light.bands = solve.coarser->bands;
        light.residual = solve.coarser->residual;
    } else {
        if (Status failed = add_bands_from_outside(solve, light)) return *failed;
        if (solve.part.whole != nullptr)
            if (Status failed = add_bands_of_whole_ground(solve, light)) return *failed;
    }
    if (solve.own_ground() && (solve.settings.ground || solve.settings.ground_shadow))
        if (Status failed = add_own_ground(solve, light)) return *failed;
    if (Status failed = refine_sunlight(solve, light)) return *failed;
    light.albedo = std::move(solve.albedo);
    return light;
}

}  // namespace

Result<TransportLight> light_of_part(const Scene& scene, LightPart part,
                                     const TransportSettings& settings, const SharedLight& coarser,
                                     int threads, const Deadline& deadline) {
    const bool nested = settings.cells > 0 && coarser != nullptr && coarser->has_grid();
    auto light = solve_grid({.scene = scene,
                             .part = part,
                             .settings = settings,
                             .coarser = nested ? coarser.get() : nullptr,
                             .threads = threads,
                             .deadline = deadline});
    if (!light.ok()) return light;
    light->sun = std::move(part.sun);
    if (nested) {
        extrapolate(*coarser, *light, threads);
        // Where its own cells would be too many.
        if (light->fine.bands.empty()) light->fine = coarser->fine;
        light->coarser = coarser;
        if (settings.last) light->solved = {};
    }
    return light;
}

Result<TransportLight> light_of_whole(const Scene& scene, const ParticleSet& particles,
                                      const Survey& survey, const TransportSettings& settings,
                                      const SharedLight& coarser, int threads,
                                      const Deadline& deadline) {
    // Of lines towards the lights only: lines towards the eye would tie the light to a camera.
    const double deepest = std::max(survey.optical_depth_sun, survey.optical_depth_zenith);
    EffectTimes took;
    // Grids on the way to finer ones share it.
    SunDepth sun = coarser && coarser->asked.sun_cells == settings.sun_cells
                       ? coarser->sun
                       : timed_for(took, Effect::kSelfShadow, [&] {
                             return sun_depth(
                                 particles, sun_direction(scene->sun),
                                 sun_cells_in(particles.detail.get(), settings.sun_cells), threads);
                         });
    const auto relief = relief_of(*scene, threads);
    std::shared_ptr<const SunDepth> open;
    if (relief) {
        open = coarser && coarser->ground.clouds
                   ? coarser->ground.clouds
                   : std::make_shared<const SunDepth>(
                         sun_depth(particles, sun_direction(scene->sun), kCellsOverHills, threads));
        if (!(coarser && coarser->asked.sun_cells == settings.sun_cells))
            shade_by_hills(*relief, threads, sun);
    }
    auto light = light_of_part(
        scene, {particles, particles, std::move(sun), deepest, {}, nullptr, std::move(open)},
        settings, coarser, threads, deadline);
    if (light.ok()) {
        light->took.add(took);
        light->asked = {settings.cells, settings.sun_cells};
    }
    return light;
}

Result<TransportLight> transport_light(const Scene& scene, const ParticleSet& particles,
                                       const Survey& survey, const TransportSettings& settings,
                                       int threads, const Deadline& deadline,
                                       const SharedLight& coarser) {
    if (auto error = deadline.over()) return *error;
    if (particles.size() == 0 || !(survey.total_mass > 0)) {
        TransportLight light;
        light.sky = settings.sky;
        light.ground = bare_ground(*scene);
        return light;
    }
    if (!settings.islands.empty() && settings.islands.size() == survey.islands.list.size())
        return light_in_islands(scene, particles, survey, settings, coarser, threads, deadline);
    return light_of_whole(scene, particles, survey, settings, coarser, threads, deadline);
}

}  // namespace awan
