// Discrete ordinates with delta-M scaling (Wiscombe 1977), weighted diamond differences (sweep.h) and GMRES.
#include "core/light/transport.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/light/diffusion.h"
#include "core/light/gmres.h"
#include "core/light/ground_band.h"
#include "core/light/islands.h"
#include "core/light/legendre.h"
#include "core/light/sky_inflow.h"
#include "core/light/sun_depth.h"
#include "core/light/sweep.h"
#include "core/light/transport_part.h"
#include "core/scene/outside.h"
#include "core/shaders/shared.h"
#include "core/survey/lattice.h"
#include "core/survey/lattice_detail.h"

namespace awan {
namespace {

constexpr int kOrders = 4;  // l = 0..3
// Optical depth that the grid may leave out: up to here smaller cells gain more than what is outside loses; of a thin cloud's
// depth no more than a share.
constexpr double kLeftOut = 0.5;
constexpr double kLeftOutShare = 0.02;
constexpr double kSkyTolerance = 4;  // times the sun's: it is a fifth of the light, and smooth
constexpr double kDiffusionTolerance = 0.05;  // of the preconditioner's own solve
constexpr int kBasis = 12;                    // vectors that GMRES keeps
constexpr double kMaxFineWork =
    3e8;  // cell updates of the density from which the beam's source is averaged
constexpr double kMaxCoarseWork = 6e8;  // and of the grid's own
constexpr int kColorCells = 64;         // of the grid that rung single has for colours

// What one solve needs to know; all colours share it unless particles are coloured.
struct Matter {
    SweepGrid grid;
    std::vector<float> scattered;          // of each cell: depth x albedo of what is not the peak
    std::vector<float> albedo;             // of each cell, true
    std::array<double, kOrders> moment{};  // chi_l of the phase function without its peak
    bool over_ground = false;              // no sky comes from below
};

// What shines on it.
struct Shine {
    bool beam = false;               // the sun, irradiance 1
    double zenith = 0, horizon = 0;  // the sky's two colours
    glm::vec3 color{1};
    // Of a physical sky: `share` of this channel's radiance. Null: none.
    const SkyInflow* physical = nullptr;
    int channel = 0;
    double share = 0;

    InflowFromBelow from_below{};            // the ground's light
    const LightBand* from_ground = nullptr;  // it, for a part of a scene: the whole's band

    bool has_sky() const { return physical != nullptr || zenith > 0 || horizon > 0; }
};

double sky_radiance(double up, double zenith, double horizon) {
    const auto one = [](double v) { return shader::vec3(static_cast<float>(v)); };
    return static_cast<double>(
        shader::sky_radiance(static_cast<float>(up), one(zenith), one(horizon)).x);
}

// From a direction (unit).
double sky_from(const Shine& shine, const glm::dvec3& direction) {
    if (shine.physical != nullptr)
        return shine.share * mean_from(*shine.physical, direction)[shine.channel];
    return sky_radiance(direction.y, shine.zenith, shine.horizon);
}

// The most radiance from any direction.
double brightest_sky(const Shine& shine) {
    if (shine.physical != nullptr) return shine.share * shine.physical->most[shine.channel];
    return std::max(shine.zenith, shine.horizon);
}

// Means over blocks of sub^3 cells.
std::vector<float> block_means(const std::vector<float>& fine, const glm::ivec3& cells, int sub) {
    std::vector<float> means(fine.size() / static_cast<std::size_t>(sub * sub * sub));
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y);
    const auto s = static_cast<std::size_t>(sub);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        const std::size_t x = i % (nx * s), y = i / (nx * s) % (ny * s), z = i / (nx * s * ny * s);
        means[((z / s) * ny + y / s) * nx + x / s] += fine[i];
    }
    const auto scale = static_cast<float>(1.0 / (sub * sub * sub));
    for (float& mean : means) mean *= scale;
    return means;
}

// Light that the beam leaves in each cell: extinction (all of it) x side x exp(-scaled depth from the sun), averaged
// over the cell. A sub-cell's mean is taken along the beam, so that a thick one does not leave more than there is.
std::vector<float> beam_source(const Lattice& coarse, const Lattice& fine_lattice,
                               const std::vector<float>& fine, int sub, const SunDepth& sun,
                               double kept, int threads, const Deadline& deadline) {
    std::vector<float> source(coarse.size());
    const glm::ivec3 n = fine_lattice.cells;
    parallel_for(threads, static_cast<std::size_t>(coarse.cells.z), [&](std::size_t layer) {
        if (deadline.over()) return;
        for (int k = static_cast<int>(layer) * sub; k < (static_cast<int>(layer) + 1) * sub; ++k)
            for (int j = 0; j < n.y; ++j)
                for (int i = 0; i < n.x; ++i) {
                    const auto extinction = static_cast<double>(
                        fine[(static_cast<std::size_t>(k) * static_cast<std::size_t>(n.y) +
                              static_cast<std::size_t>(j)) *
                                 static_cast<std::size_t>(n.x) +
                             static_cast<std::size_t>(i)]);
                    if (!(extinction > 0)) continue;
                    const glm::dvec3 middle = fine_lattice.at(glm::dvec3(i, j, k) + 0.5);
                    const double across = kept * extinction * fine_lattice.cell;
                    const double entry = std::max(kept * depth_at(sun, middle) - 0.5 * across, 0.0);
                    const double left = -std::expm1(-across) * std::exp(-entry) / kept;
                    source[(layer * static_cast<std::size_t>(coarse.cells.y) +
                            static_cast<std::size_t>(j / sub)) *
                               static_cast<std::size_t>(coarse.cells.x) +
                           static_cast<std::size_t>(i / sub)] +=
                        static_cast<float>(left / (sub * sub));
                }
    });
    return source;
}

// The moments of the light in each cell, harmonics floats each.
Result<std::vector<float>> solve(const Matter& matter, const Ordinates& ordinates,
                                 const std::vector<float>& beam, const glm::dvec3& beam_direction,
                                 const Shine& shine, double peak_kept, const Inflow& outside,
                                 const TransportSettings& settings, int threads,
                                 const Deadline& deadline, TransportLight& light) {
    const auto harmonics_count = static_cast<std::size_t>(matter.grid.harmonics);
    const std::size_t cells = matter.grid.size();
    // Order of each harmonic.
    std::array<std::size_t, kHarmonics> order{};
    for (std::size_t l = 0, m = 0; l < kOrders; ++l)
        for (; m < (l + 1) * (l + 1); ++m) order[m] = l;

    std::vector<float> source(cells * harmonics_count);
    if (shine.beam) {
        const std::array<double, kHarmonics> y = harmonics(beam_direction);
        for (std::size_t i = 0; i < cells; ++i)
            for (std::size_t m = 0; m < harmonics_count; ++m)
                source[i * harmonics_count + m] =
                    beam[i] * matter.albedo[i] *
                    static_cast<float>(peak_kept * matter.moment[order[m]] * y[m]);
    }
    Inflow inflow;
    if (outside)
        inflow = outside;
    else if (shine.has_sky())
        inflow = [&](const glm::dvec3& d) { return sky_from(shine, -d); };
    if (inflow && matter.over_ground && !outside)
        inflow = [open = std::move(inflow)](const glm::dvec3& direction) {
            return direction.y > 0 ? 0.0 : open(direction);
        };
    SweepSpace space;
    std::vector<float> right(source.size());
    sweep(matter.grid, ordinates, source, inflow, threads, space, right, shine.from_below);

    std::array<float, kHarmonics> moment{};
    for (std::size_t m = 0; m < harmonics_count; ++m)
        moment[m] = static_cast<float>(matter.moment[order[m]]);
    const Product product = [&](std::span<const float> from, std::span<float> to) -> Status {
        if (auto error = deadline.over()) return error;
        for (std::size_t i = 0; i < cells; ++i)
            for (std::size_t m = 0; m < harmonics_count; ++m)
                source[i * harmonics_count + m] =
                    matter.scattered[i] * moment[m] * from[i * harmonics_count + m];
        sweep(matter.grid, ordinates, source, {}, threads, space, to);
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[i] - to[i];
        return std::nullopt;
    };
    std::vector<float> moments(source.size());
    const Diffusion diffusion =
        make_diffusion(matter.grid.cells, matter.grid.depth, matter.scattered, matter.moment[1]);
    std::vector<float> unsettled(cells);
    const auto diffuse = [&](std::span<const float> vector, std::span<float> addition) {
        for (std::size_t i = 0; i < cells; ++i)
            unsettled[i] = matter.scattered[i] * vector[i * harmonics_count];
        solve_diffusion(diffusion, unsettled, kDiffusionTolerance, addition);
    };
    const auto outcome =
        gmres(product, {harmonics_count, diffuse}, right,
              {shine.beam ? settings.tolerance : kSkyTolerance * settings.tolerance,
               settings.max_sweeps, kBasis},
              threads, moments);
    if (!outcome.ok()) return outcome.error();
    light.sweeps += outcome->products + 1;
    light.residual = std::max(light.residual, outcome->residual);
    return moments;
}

bool proportional(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(a, b)) <= 1e-6 * glm::length(a) * glm::length(b);
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

// The parts of the light, each with one shape in space: in grey matter the sun, the zenith's share of the sky and the
// horizon's; where particles have colours, one for each colour channel. A physical sky has a shape of its own in each channel.
std::vector<Shine> parts_of(const Outside& outside, const SkyInflow& physical, bool colored,
                            bool with_sky) {
    const glm::dvec3 sun = outside.sun;
    const glm::dvec3 zenith = with_sky ? outside.sky.zenith : glm::dvec3(0);
    const glm::dvec3 horizon = with_sky ? outside.sky.horizon : glm::dvec3(0);
    std::vector<Shine> parts;
    if (with_sky && outside.sky.physical) {
        if (!colored && largest(sun) > 0) parts.push_back({true, 0, 0, glm::vec3(sun)});
        for (int c = 0; c < 3; ++c) {
            glm::vec3 color(0);
            // Less than a float is nothing to share by.
            const double most = static_cast<double>(static_cast<float>(physical.most[c]));
            // One solve for both, as below; the sun's last light is too little to measure the sky by.
            const bool one_solve = colored && sun[c] > 1e-30 && sun[c] > 1e-6 * most;
            if (colored && sun[c] > 0) {
                color[c] = static_cast<float>(sun[c]);
                parts.push_back({true, 0, 0, color});
                if (one_solve) {
                    parts.back().physical = &physical;
                    parts.back().channel = c;
                    parts.back().share = 1 / sun[c];
                }
            }
            if (!one_solve && most > 0) {
                color[c] = static_cast<float>(most);
                parts.push_back(
                    {.color = color, .physical = &physical, .channel = c, .share = 1 / most});
            }
        }
        return parts;
    }
    if (colored) {
        for (int c = 0; c < 3; ++c) {
            glm::vec3 color(0);
            color[c] = 1;
            // The beam comes with irradiance 1; the sky is measured by it, for one solve to do both.
            if (sun[c] > 0) {
                color[c] = static_cast<float>(sun[c]);
                parts.push_back({true, zenith[c] / sun[c], horizon[c] / sun[c], color});
            } else if (zenith[c] > 0 || horizon[c] > 0) {
                parts.push_back({false, zenith[c], horizon[c], color});
            }
        }
        return parts;
    }
    if (largest(sun) > 0) parts.push_back({true, 0, 0, glm::vec3(sun)});
    if (largest(zenith) > 0 && largest(horizon) > 0 && proportional(zenith, horizon)) {
        parts.push_back({false, largest(zenith) / largest(horizon), 1, glm::vec3(horizon)});
    } else {
        if (largest(zenith) > 0) parts.push_back({false, 1, 0, glm::vec3(zenith)});
        if (largest(horizon) > 0) parts.push_back({false, 0, 1, glm::vec3(horizon)});
    }
    return parts;
}

int channel_of(const Shine& shine) {
    return shine.color.x > 0 ? 0 : shine.color.y > 0 ? 1 : 2;
}

// Radiance of the ground where the light that comes along `direction` to `from` left it, in units of a band's colour.
double ground_from(const GroundLight& ground, const LightBand& band, bool colored,
                   const glm::dvec3& from, const glm::dvec3& direction) {
    if (!(direction.y > 0)) return 0;
    const glm::dvec3 place =
        from - direction * (std::max(from.y - ground.height, 0.0) / direction.y);
    const glm::dvec3 radiance = radiance_at(ground, place.x, place.z), color(band.color);
    return colored ? glm::dot(radiance, color) : luminance(radiance) / luminance(color);
}

// Albedo of each cell: of the particles in it, each by its share of the extinction.
std::vector<glm::vec3> colored_albedo(const Scene& scene, const ParticleSet& particles,
                                      const Lattice& lattice, const std::vector<float>& mean,
                                      int threads) {
    const auto white = static_cast<float>(scene->medium.albedo);
    std::vector<glm::vec3> albedo(mean.size(), glm::vec3(white));
    for (int c = 0; c < 3; ++c) {
        const std::vector<float> tinted = colored_extinction_in(particles, lattice, c, threads);
        for (std::size_t i = 0; i < mean.size(); ++i)
            if (mean[i] > 0) albedo[i][c] = white * std::clamp(tinted[i] / mean[i], 0.F, 1.F);
    }
    return albedo;
}

// A lattice without what is under the ground: from above it is not there.
Lattice above_ground(double height, Lattice lattice) {
    if (!(lattice.origin.y < height)) return lattice;
    const double top = lattice.origin.y + lattice.cell * lattice.cells.y;
    lattice.origin.y = height;
    lattice.cells.y = std::max(1, static_cast<int>(std::ceil((top - height) / lattice.cell)));
    return lattice;
}

// Without a grid of light the eye pass still needs the particles' colours, and has them from a grid.
void color_only(const Scene& scene, const LightPart& part, int threads, TransportLight& light) {
    const ParticleSet& particles = part.all;
    const Lattice lattice = lattice_around_matter(part.own, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 0,
                                                  kColorCells, threads, kMaxFineWork);
    light.origin = lattice.origin;
    light.cell = lattice.cell;
    light.cells = lattice.cells;
    light.albedo = colored_albedo(scene, particles, lattice,
                                  extinction_in(particles, lattice, threads), threads);
}

}  // namespace

std::size_t TransportLight::bytes() const {
    std::size_t bytes = sizeof *this + sun.depth.capacity() * sizeof(float) +
                        albedo.capacity() * sizeof(glm::vec3) + ground.bytes();
    for (const LightBand& band : bands) bytes += band.moments.capacity() * sizeof(band.moments[0]);
    bytes +=
        regions.nodes.capacity() * sizeof(IslandNode) + regions.list.capacity() * sizeof(Island);
    for (const LightIsland& island : islands)
        bytes += sizeof island - sizeof island.light + island.light.bytes();
    return bytes;
}

Result<TransportLight> transport_light(const Scene& scene, const ParticleSet& particles,
                                       const Survey& survey, const TransportSettings& settings,
                                       int threads, const Deadline& deadline) {
    if (auto error = deadline.over()) return *error;
    if (particles.size() == 0 || !(survey.total_mass > 0)) {
        TransportLight light;
        light.sky = settings.sky;
        light.ground = bare_ground(*scene);
        return light;
    }
    if (!settings.islands.empty() && settings.islands.size() == survey.islands.list.size())
        return light_in_islands(scene, particles, survey, settings, threads, deadline);
    // Of the lights' lines only: the eye's would tie the light to a camera.
    const double deepest = std::max(survey.optical_depth_sun, survey.optical_depth_zenith);
    EffectTimes took;
    SunDepth sun = timed_for(took, Effect::kSelfShadow, [&] {
        return sun_depth(particles, sun_direction(scene->sun), settings.sun_cells, threads);
    });
    auto light = light_of_part(scene, {particles, particles, std::move(sun), deepest, {}, nullptr},
                               settings, threads, deadline);
    if (light.ok()) light->took.add(took);
    return light;
}

Result<TransportLight> light_of_part(const Scene& scene, LightPart part,
                                     const TransportSettings& settings, int threads,
                                     const Deadline& deadline) {
    TransportLight light;
    light.sky = settings.sky;
    const ParticleSet& particles = part.all;
    const glm::dvec3 towards_sun = sun_direction(scene->sun);
    light.sun = std::move(part.sun);
    // A part of a scene has the ground's light from the solve of the whole.
    const bool over_ground = has_ground(*scene, bounds_of(part.own));
    const bool own_ground = over_ground && part.whole == nullptr;
    if (part.whole == nullptr) light.ground = bare_ground(*scene);
    light.ground.into_cloud = own_ground && settings.ground;
    const bool shade_ground = own_ground && settings.ground_shadow;
    if (settings.cells == 0) {
        if (shade_ground) {
            const auto start = Deadline::Clock::now();
            cast_shadow(light.sun, scene->medium.albedo, 0, scene->medium.g, threads, light.ground);
            light.took.of(Effect::kGroundShadow) = ms_since(start);
        }
        if (!particles.color.empty()) color_only(scene, part, threads, light);
        return light;
    }

    const double g = scene->medium.g, albedo = scene->medium.albedo;
    // A backward peak is no light that goes on; it stays in the moments.
    const double f = g > 0 ? phase_moment(scene->medium, kOrders) : 0;
    light.peak_share = f;
    light.peak_from = kOrders;
    const double kept = 1 - albedo * f;

    const double rest = std::min(kLeftOut, kLeftOutShare * part.deepest);
    // Of a great many particles that are large beside a cell there is a bound: what they add up to is smooth.
    Lattice coarse = lattice_around_matter(part.own, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, rest,
                                           settings.cells, threads, kMaxCoarseWork);
    if (over_ground) coarse = above_ground(scene->ground->height, coarse);
    int sub = settings.cells <= 32 ? 3 : 2;
    while (sub > 1 && lattice_work(particles, coarse.cell / sub, coarse.cells * sub) > kMaxFineWork)
        --sub;
    Lattice fine_lattice = coarse;
    fine_lattice.cell = coarse.cell / sub;
    fine_lattice.cells = coarse.cells * sub;
    std::vector<float> fine = extinction_in(particles, fine_lattice, threads);
    if (particles.detail) {
        const auto start = Deadline::Clock::now();
        add_detail(particles, fine_lattice, threads, fine);
        light.took.of(Effect::kDetail) += ms_since(start);
    }
    const std::vector<float> mean = block_means(fine, coarse.cells, sub);
    light.origin = coarse.origin;
    light.cell = coarse.cell;
    light.cells = coarse.cells;
    if (auto error = deadline.over()) return *error;

    const bool colored = !particles.color.empty();
    const Outside outside = outside_of(scene);
    SkyInflow physical;
    if (settings.sky && outside.sky.physical) physical = sky_inflow(outside.sky);
    const std::vector<Shine> parts = parts_of(outside, physical, colored, settings.sky);
    std::vector<float> beam;
    if (std::any_of(parts.begin(), parts.end(), [](const Shine& shine) { return shine.beam; }))
        beam = timed_for(light.took, Effect::kMultipleScattering, [&] {
            return beam_source(coarse, fine_lattice, fine, sub, light.sun, kept, threads, deadline);
        });

    Matter matter;
    matter.grid.cells = coarse.cells;
    matter.grid.harmonics =
        g == 0 && scene->medium.phase == PhaseFunction::kHenyeyGreenstein ? 1 : kHarmonics;
    for (std::size_t l = 0; l < kOrders; ++l)
        matter.moment[l] = (phase_moment(scene->medium, static_cast<int>(l)) - f) / (1 - f);
    matter.grid.depth.resize(mean.size());
    matter.scattered.resize(mean.size());
    matter.albedo.resize(mean.size());
    if (colored) light.albedo = colored_albedo(scene, particles, coarse, mean, threads);
    matter.over_ground = over_ground;
    const Ordinates ordinates = make_ordinates();
    const glm::dvec3 middle = coarse.origin + 0.5 * coarse.cell * glm::dvec3(coarse.cells);
    const auto solved = [&](const Shine& shine) -> Result<LightBand> {
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const double a =
                colored ? static_cast<double>(light.albedo[i][channel_of(shine)]) : albedo;
            const double depth = std::min(static_cast<double>(mean[i]) * coarse.cell * (1 - a * f),
                                          static_cast<double>(kMaxCellDepth));
            matter.grid.depth[i] = static_cast<float>(depth);
            matter.albedo[i] = static_cast<float>(a);
            matter.scattered[i] = static_cast<float>(depth * a * (1 - f) / (1 - a * f));
        }
        Inflow inflow;
        if (part.surroundings)
            inflow = [&, band = light.bands.size()](const glm::dvec3& direction) {
                const bool hidden = over_ground && direction.y > 0;
                const double sky = shine.from_ground != nullptr
                                       ? ground_from(part.whole->ground, *shine.from_ground,
                                                     colored, middle, direction)
                                   : shine.has_sky() && !hidden ? sky_from(shine, -direction)
                                                                : 0;
                return part.surroundings(band, direction, sky);
            };
        auto moments = solve(matter, ordinates, beam, -towards_sun, shine, 1 - f, inflow, settings,
                             threads, deadline, light);
        if (!moments.ok()) return moments.error();
        LightBand band;
        band.color = shine.color;
        if (!shine.beam && !part.surroundings)
            band.most = static_cast<float>(albedo * (1 - f) * brightest_sky(shine));
        band.moments.resize(mean.size());
        const auto count = static_cast<std::size_t>(matter.grid.harmonics);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            band.moments[i].fill(0);
            for (std::size_t l = 0, m = 0; l < kOrders; ++l)
                for (; m < (l + 1) * (l + 1) && m < count; ++m)
                    band.moments[i][m] = matter.albedo[i] *
                                         static_cast<float>((1 - f) * matter.moment[l]) *
                                         (*moments)[i * count + m];
        }
        return band;
    };
    for (const Shine& shine : parts) {
        auto band =
            timed_for(light.took, shine.beam ? Effect::kMultipleScattering : Effect::kSkyLight,
                      [&] { return solved(shine); });
        if (!band.ok()) return band.error();
        light.bands.push_back(*std::move(band));
    }
    if (part.whole != nullptr)
        for (std::size_t b = parts.size(); b < part.whole->bands.size(); ++b) {
            Shine shine;
            shine.from_ground = &part.whole->bands[b];
            shine.color = shine.from_ground->color;
            auto band = timed_for(light.took, Effect::kGroundLight, [&] { return solved(shine); });
            if (!band.ok()) return band.error();
            light.bands.push_back(*std::move(band));
        }
    if (!own_ground || !(settings.ground || settings.ground_shadow)) return light;

    // The solves are ground_light's, the rest is what the cloud sends down.
    const auto start = Deadline::Clock::now();
    if (shade_ground) cast_shadow(light.sun, albedo, f, g, threads, light.ground);
    std::vector<float> depth(mean.size());
    for (std::size_t i = 0; i < mean.size(); ++i)
        depth[i] = mean[i] * static_cast<float>(coarse.cell);
    BeamSource single{beam.empty() ? nullptr : &beam, outside.sun, -towards_sun, {}, albedo};
    for (std::size_t l = 0; l < kOrders; ++l) single.moment[l] = (1 - f) * matter.moment[l];
    const auto from_below = [&](const InflowFromBelow& inflow, int channel) {
        Shine shine;
        shine.color = glm::vec3(0);
        shine.color[channel] = 1;
        shine.from_below = inflow;
        return timed_for(light.took, Effect::kGroundLight, [&] { return solved(shine); });
    };
    if (Status failed = ground_and_cloud(outside.sky, depth, kept, single, colored, settings,
                                         from_below, threads, light))
        return *failed;
    if (shade_ground)
        light.took.of(Effect::kGroundShadow) +=
            ms_since(start) - light.took.of(Effect::kGroundLight);
    return light;
}

}  // namespace awan
