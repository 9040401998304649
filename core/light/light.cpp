#include "core/light/light.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/gl/programs.h"
#include "core/gl/tile_lists.h"
#include "core/light/light_grid.h"
#include "core/light/sun_depth.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

constexpr int kTile = 8;  // texels a side, as in light_columns.glsl
// Where a particle is cut off, in standard deviations, where there are few or many. What lies beyond, 0.4% of its mass
// or 2.6%, is added to what lies within.
constexpr double kReach = 3.3, kReachOfMany = 2.7;
// Half width, in s, of the smooth step that stands for a Gaussian's mass (light_columns.glsl).
constexpr double kSpread = 1.88;
constexpr int kShadowCells = 64;  // along the cloud's longest side, of its shadow on the ground
// List entries of a dispatch: about half a second of llvmpipe between looks at the deadline.
constexpr std::uint64_t kMaxEntries = 1u << 21;
// Distance of the sample points from the centre, in standard deviations: where most of a particle's mass is.
constexpr float kSampleDistance = 1.2F;

struct GpuParticle {
    glm::vec4 place, matter;
};

// A particle on the grid. One that is narrower than the grid can show is widened, and its optical depth times area
// kept.
struct OnGrid {
    GpuParticle gpu;
    gl::TileBox tiles;
};

// Of the light on a line through a particle with optical depth tau, gain + (1 - gain) exp(-tau) goes on. That is the
// transmittance of a depth -log(gain + (1 - gain) exp(-tau)), for which light_columns.glsl takes
//     start tau / (1 + bend tau);
// the two agree for thin lines and on the line through the centre, where tau is `whole`.
struct GainCurve {
    double start, bend;
};

GainCurve gain_curve(double gain, double whole) {
    const double start = 1 - gain;
    if (!(start > 0)) return {0, 0};
    // The limit for thin particles, in which the quotients below lose their digits.
    if (whole < 1e-4) return {start, gain / 2};
    const double depth = -exact::log1p(start * exact::expm1(-std::min(whole, 700.0)));
    return {start, std::max(0.0, (start * whole / depth - 1) / whole)};
}

// within_reach: the share of a Gaussian within `reach`.
OnGrid put_on_grid(const ParticleSet& particles, std::size_t i, const LightGrid& grid, double gain,
                   double reach, double within_reach) {
    const double s = gaussian_s(particles, i), tau = central_depth(particles, i);
    const glm::dvec3 place = grid.place(particles.center[i]);
    const double across = std::max(s / grid.texel, 0.6), along = std::max(s / grid.slab, 0.4);
    const double narrowing = s / grid.texel / across;
    const double thinned = tau * narrowing * narrowing / within_reach;
    const GainCurve curve = gain_curve(gain, thinned);
    const double wide = reach * across, deep = kSpread * along;
    const auto tile = [](double cell, int count) {
        return static_cast<std::int32_t>(
            std::clamp(std::floor(cell / kTile), 0.0, static_cast<double>((count - 1) / kTile)));
    };
    OnGrid on{{glm::vec4(place.x, place.y, place.z, 0.5 / (across * across)),
               glm::vec4(thinned, 0.5 / (kSpread * along), curve.start, curve.bend)},
              {tile(place.x - wide, grid.cells.x), tile(place.y - wide, grid.cells.y),
               tile(place.x + wide, grid.cells.x), tile(place.y + wide, grid.cells.y),
               tile(place.z - deep, grid.cells.z), tile(place.z + deep + 1, grid.cells.z)}};
    on.tiles.center_x = static_cast<float>(place.x / kTile);
    on.tiles.center_y = static_cast<float>(place.y / kTile);
    on.tiles.per_x = on.tiles.per_y = static_cast<float>(kTile / wide);
    return on;
}

struct OneLight {
    glm::dvec3 to_light;
    double gain;
    bool sky;
    glm::vec3 about;  // as in light_samples.glsl
};

// Of light that is scattered about.
glm::vec3 about_in(const Medium& medium, const Plan& plan) {
    if (!plan.on(Effect::kMultipleScattering)) return {-1, 0, 0};
    const double turned = std::max(1 - medium.albedo * asymmetry(medium), 1e-6);
    const double k = std::sqrt(std::min(3 * (1 - medium.albedo) / turned, 3.0));
    return {turned, k, kKeptBetweenSides};
}

// The particles as the passes take them.
struct PlacedParticles {
    LightGrid grid;
    std::vector<GpuParticle> particles;
    std::vector<gl::TileBox> tiles;
    // Centres on the grid; w: distance of the sample points, scene units.
    std::vector<glm::vec4> points;
};

PlacedParticles place_particles(const ParticleSet& particles, const OneLight& light) {
    PlacedParticles placed;
    placed.grid = light_grid(particles, light.to_light);
    placed.particles.resize(particles.size());
    placed.tiles.resize(particles.size());
    placed.points.resize(particles.size());
    const double reach = particles.size() >= kManySplats ? kReachOfMany : kReach;
    const double within_reach = -exact::expm1(-reach * reach / 2);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const OnGrid on = put_on_grid(particles, i, placed.grid, light.gain, reach, within_reach);
        placed.particles[i] = on.gpu;
        placed.tiles[i] = on.tiles;
        placed.points[i] =
            glm::vec4(glm::vec3(on.gpu.place), kSampleDistance * 0.5F * particles.radius[i]);
    }
    return placed;
}

// light_columns: what particles take from the light in each cell of the grid. Only columns of cells with particles in
// them are worked out; the others stay as they are in `volume`, 0.
Status fill_columns(const PlacedParticles& placed, Device& device, const Deadline& deadline,
                    const gl::Buffer& volume) {
    const glm::ivec3 cells = placed.grid.cells;
    const gl::TexelBuffer particles{std::span<const GpuParticle>(placed.particles)};
    return gl::for_each_region(
        placed.tiles, (cells.x + kTile - 1) / kTile, (cells.y + kTile - 1) / kTile, cells.z / kTile,
        kMaxEntries, 1u << 20, deadline, [&](const gl::TileRegion& region) -> Status {
            const gl::Buffer begin{std::span<const std::uint32_t>(region.begin)};
            const gl::Buffer items{std::span<const std::uint32_t>(region.items)};
            const std::vector<std::uint32_t> filled = region.filled_tiles();
            const gl::Buffer filled_buffer{std::span<const std::uint32_t>(filled)};
            device.programs().light_columns.use();
            particles.bind(0);
            begin.bind(1);
            items.bind(2);
            volume.bind(3);
            filled_buffer.bind(4);
            glUniform3i(0, cells.x, cells.y, cells.z);
            glUniform4i(1, region.x, region.y, region.width, region.height);
            const std::uint32_t longest = region.longest_list();
            for (std::uint32_t first = 0; first < longest; first += gl::kMaxRun) {
                if (auto error = deadline.over()) return error;
                glUniform2i(2, static_cast<GLint>(first), static_cast<GLint>(gl::kMaxRun));
                glDispatchCompute(static_cast<GLuint>(filled.size()), 1, 1);
                glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
                glFinish();
            }
            return std::nullopt;
        });
}

// light_sums: from what each cell takes to what reaches it.
void sum_columns(const glm::ivec3& cells, Device& device, const gl::Buffer& volume) {
    device.programs().light_sums.use();
    volume.bind(0);
    glUniform3i(0, cells.x, cells.y, cells.z);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glDispatchCompute(static_cast<GLuint>((cells.x * cells.y + 63) / 64), 1, 1);
}

// A column that is longer than the cloud is wide loses the more, one that is shorter less.
double kept_between_sides(const LightGrid& grid) {
    const double along = grid.slab * (grid.cells.z - 1),
                 across = grid.texel * (std::min(grid.cells.x, grid.cells.y) - 1);
    return std::clamp(std::sqrt(across / along), 0.4, 1.6);
}

// Vec4s a particle that light_samples makes.
constexpr std::size_t kSamples = 3;

// light_samples: the light at each particle.
std::vector<glm::vec4> sample_at_particles(const PlacedParticles& placed, const OneLight& light,
                                           Device& device, const gl::Buffer& volume) {
    const LightGrid& grid = placed.grid;
    const gl::Buffer point_buffer{std::span<const glm::vec4>(placed.points)};
    std::vector<glm::vec4> samples(kSamples * placed.points.size());
    const gl::Buffer sample_buffer(samples.size() * sizeof(glm::vec4));
    device.programs().light_samples.use();
    point_buffer.bind(0);
    volume.bind(1);
    sample_buffer.bind(2);
    glUniform3i(0, grid.cells.x, grid.cells.y, grid.cells.z);
    glUniform1i(1, static_cast<GLint>(placed.points.size()));
    const auto set_axis = [](GLint location, glm::dvec3 axis, double step) {
        const glm::vec3 a(axis / step);
        glUniform3f(location, a.x, a.y, a.z);
    };
    set_axis(2, grid.u, grid.texel);
    set_axis(3, grid.v, grid.texel);
    set_axis(4, grid.w, grid.slab);
    glUniform1i(5, light.sky ? 1 : 0);
    glUniform3f(6, light.about.x, light.about.y,
                light.about.z * static_cast<float>(kept_between_sides(grid)));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glDispatchCompute(static_cast<GLuint>((placed.points.size() + 63) / 64), 1, 1);
    sample_buffer.read(samples.data(), samples.size() * sizeof(glm::vec4));
    return samples;
}

// What each cell of a grid takes, and then what reaches it. One for all lights: new memory costs as much as setting it
// to zero twice.
class Volume {
  public:
    // All zero, for so many cells.
    const gl::Buffer& of(const glm::ivec3& cells) {
        const std::size_t bytes = static_cast<std::size_t>(cells.x) *
                                  static_cast<std::size_t>(cells.y) *
                                  static_cast<std::size_t>(cells.z) * 2 * sizeof(float);
        if (!buffer_ || bytes > bytes_) {
            buffer_.emplace(bytes);
            bytes_ = bytes;
        }
        buffer_->clear();
        return *buffer_;
    }

  private:
    std::optional<gl::Buffer> buffer_;
    std::size_t bytes_ = 0;
};

// All three steps for one light.
Result<std::vector<glm::vec4>> one_light(const ParticleSet& particles, const OneLight& light,
                                         Volume& volumes, Device& device,
                                         const Deadline& deadline) {
    const PlacedParticles placed = place_particles(particles, light);
    const glm::ivec3 cells = placed.grid.cells;
    const gl::Buffer& volume = volumes.of(cells);
    if (Status failed = fill_columns(placed, device, deadline, volume)) return *failed;
    sum_columns(cells, device, volume);
    std::vector<glm::vec4> samples = sample_at_particles(placed, light, device, volume);
    if (auto error = gl::gl_status("the light pass")) return *error;
    if (auto error = deadline.over()) return *error;
    return samples;
}

// Lit by the direct sun and the open sky: the cloud's own light is not sent down by these passes.
GroundLight ground_under(const Scene& scene, const ParticleSet& particles, const Plan& plan) {
    GroundLight ground = bare_ground(*scene);
    if (particles.size() == 0 || !has_ground(*scene, bounds_of(particles))) return ground;
    ground.into_cloud = plan.on(Effect::kGroundLight);
    if (plan.on(Effect::kGroundShadow))
        cast_shadow(sun_depth(particles, sun_direction(scene->sun), kShadowCells, 1),
                    scene->medium.albedo, 0, 0, 1, ground);
    return ground;
}

}  // namespace

Result<Lighting> light(const Scene& scene, const ParticleSet& particles, const Plan& plan,
                       Device& device, const Deadline& deadline) {
    Lighting lighting;
    lighting.ground = timed_for(lighting.took, Effect::kGroundShadow,
                                [&] { return ground_under(scene, particles, plan); });
    if (!plan.on(Effect::kSelfShadow) || particles.size() == 0) return lighting;
    const auto gain = [&](double half_angle) {
        return plan.on(Effect::kMultipleScattering)
                   ? scene->medium.albedo * gathering_fraction(scene->medium, half_angle)
                   : 0.0;
    };
    const glm::vec3 about = about_in(scene->medium, plan);
    const glm::vec4 full(0, 0, 0, 1), none(0);
    Volume volumes;
    lighting.particles.assign(particles.size(), {full, none, none, full, full});
    if (outside_of(scene).sun != glm::dvec3(0)) {
        auto sun = timed_for(lighting.took, Effect::kSelfShadow, [&] {
            return one_light(particles,
                             {sun_direction(scene->sun), gain(kSunGathering), false, about},
                             volumes, device, deadline);
        });
        if (!sun.ok()) return sun.error();
        for (std::size_t i = 0; i < particles.size(); ++i) {
            lighting.particles[i].direct = (*sun)[kSamples * i];
            lighting.particles[i].scattered = (*sun)[kSamples * i + 1];
            lighting.particles[i].diffuse = (*sun)[kSamples * i + 2];
        }
    }
    if (plan.on(Effect::kSkyLight) || lighting.ground.into_cloud) {
        const Effect from = plan.on(Effect::kSkyLight) ? Effect::kSkyLight : Effect::kGroundLight;
        auto sky = timed_for(lighting.took, from, [&] {
            return one_light(particles, {{0, 1, 0}, gain(kSkyGathering), true, about}, volumes,
                             device, deadline);
        });
        if (!sky.ok()) return sky.error();
        for (std::size_t i = 0; i < particles.size(); ++i) {
            lighting.particles[i].from_above = (*sky)[kSamples * i];
            lighting.particles[i].from_below = (*sky)[kSamples * i + 1];
        }
    }
    return lighting;
}

}  // namespace awan
