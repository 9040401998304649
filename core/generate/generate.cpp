#include "core/generate/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <string>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/generate/auto_density.h"
#include "core/generate/cubes.h"
#include "core/generate/keyed_random.h"
#include "core/generate/models.h"
#include "core/generate/motion.h"
#include "core/scene/limits.h"

namespace awan {
namespace {

// A run of particles of one cube, or of one list of ready particles: a piece of work for one thread.
struct Piece {
    const Cloud* cloud;
    // Null where `ready` is not.
    const Cube* cube;
    // Null where `cube` is not.
    const ReadyParticles* ready;
    std::uint64_t key;
    // Which particles of the cube, or of the ready lists: first .. last - 1.
    std::uint64_t first, last;
    // Where in the set its first particle goes.
    std::size_t out;
    double density;
    Fill fill;
    // Of its particles, but for what each has of its own.
    Paint paint;
    bool upright;
};
// Particles of a piece: about half a millisecond of work.
constexpr std::uint64_t kPieceSize = 8192;

void add_pieces(std::vector<Piece>& pieces, Piece whole, std::uint64_t count, std::size_t& total) {
    for (std::uint64_t first = 0; first < count; first += kPieceSize) {
        whole.first = first;
        whole.last = std::min(count, first + kPieceSize);
        whole.out = total;
        pieces.push_back(whole);
        total += static_cast<std::size_t>(whole.last - first);
    }
}

Result<double> density_of_cloud(const Scene& scene, std::size_t k, const Deadline& deadline) {
    const Cloud& cloud = scene->clouds[k];
    if (const auto given = density_of(*scene, cloud)) return *given;
    const Fill fill = fill_of(*scene, cloud);
    const std::uint64_t key = keyed(seed_of(*scene, cloud), k);
    if (cloud.model != CloudModel::kCubes)
        return cloud.auto_density ? own_auto_density(cloud, fill, key, deadline)
                                  : auto_density(cloud, fill, key);
    Cloud filled = cloud;
    for (Cube& cube : filled.cubes) cube.particles = particles_of(*scene, cloud, cube);
    return auto_density(filled, fill, key);
}

// What the particles of a cube (null: of a cloud of another model) are painted with. textures: of the scene.
void set_paint(const Scene& scene, const std::vector<std::string_view>& textures, const Cube* cube,
               Piece& piece) {
    const std::string_view hash = texture_of(*scene, *piece.cloud, cube);
    const auto found = std::find(textures.begin(), textures.end(), hash);
    piece.paint.texture =
        hash.empty() ? std::uint8_t{0} : static_cast<std::uint8_t>(found - textures.begin() + 1);
    piece.upright =
        std::any_of(kOwnTextures.begin(), kOwnTextures.end(),
                    [&](const OwnTexture& own) { return own.upright && hash == own.hash; });
}

// made: the particles of the clouds that are procedural, by the cloud's number.
// densities: of each cloud.
std::vector<Piece> cut_into_pieces(const Scene& scene, const std::vector<ModelParticles>& made,
                                   const std::vector<double>& densities,
                                   std::vector<std::size_t>& cloud_begin, std::size_t& total) {
    std::vector<Piece> pieces;
    const std::vector<std::string_view> textures = textures_of(*scene);
    total = 0;
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const Cloud& cloud = scene->clouds[k];
        const std::uint64_t key = keyed(seed_of(*scene, cloud), k);
        cloud_begin.push_back(total);
        Piece piece{&cloud,
                    nullptr,
                    is_procedural(cloud) ? &made[k].particles : &cloud.ready,
                    key,
                    0,
                    0,
                    0,
                    made[k].extinctions ? 1.0 : densities[k],
                    fill_of(*scene, cloud),
                    {},
                    false};
        if (cloud.model != CloudModel::kCubes) {
            set_paint(scene, textures, nullptr, piece);
            add_pieces(pieces, piece, piece.ready->positions.size(), total);
            continue;
        }
        for (std::size_t c = 0; c < cloud.cubes.size(); ++c) {
            piece.cube = &cloud.cubes[c];
            piece.key = keyed(key, c);
            set_paint(scene, textures, piece.cube, piece);
            add_pieces(pieces, piece, particles_of(*scene, cloud, *piece.cube), total);
        }
    }
    cloud_begin.push_back(total);
    return pieces;
}

// Billboards of one texture are turned and mirrored by chance, so that their likeness does not show; those that have an
// up by a sixteenth of a turn either way at most.
constexpr std::uint64_t kPaintKey = 0x7061696e74;
void paint_piece(const Piece& piece, ParticleSet& set) {
    if (set.paint.empty()) return;
    const std::uint64_t key = keyed(piece.key, kPaintKey);
    std::size_t out = piece.out;
    for (std::uint64_t i = piece.first; i < piece.last; ++i, ++out) {
        const std::uint64_t bits = keyed(key, i);
        Paint& paint = set.paint[out];
        paint = piece.paint;
        if (paint.texture == 0) continue;
        paint.mirrored = (bits & 1u) != 0;
        const auto turn = static_cast<std::uint16_t>(bits >> 16 & 0xffffu);
        paint.turn = piece.upright ? static_cast<std::uint16_t>((turn >> 3) - 0x1000) : turn;
    }
}

void fill_piece(const Piece& piece, double time, ParticleSet& set) {
    const Cloud& cloud = *piece.cloud;
    const Motion motion = motion_of(cloud, time);
    const auto density = static_cast<float>(piece.density * piece.cube->density);
    // So few at a time that they stay in the processor's first cache.
    std::array<FilledParticle, 256> filled;
    std::size_t out = piece.out;
    for (std::uint64_t first = piece.first; first < piece.last; first += filled.size()) {
        const std::uint64_t last = std::min(piece.last, first + filled.size());
        fill_cube(*piece.cube, piece.fill, piece.key, first, last, filled.data());
        for (std::uint64_t i = first; i < last; ++i, ++out) {
            const FilledParticle& particle = filled[static_cast<std::size_t>(i - first)];
            set.center[out] = motion(particle.center);
            set.radius[out] = static_cast<float>(particle.radius * cloud.scale);
            set.density[out] = density;
        }
    }
}

void copy_piece(const Piece& piece, double time, ParticleSet& set) {
    const Cloud& cloud = *piece.cloud;
    const ReadyParticles& ready = *piece.ready;
    const Motion motion = motion_of(cloud, time);
    for (std::uint64_t i = piece.first; i < piece.last; ++i) {
        const auto from = static_cast<std::size_t>(i);
        const std::size_t to = piece.out + static_cast<std::size_t>(i - piece.first);
        const double own =
            ready.densities.empty() ? 1.0 : static_cast<double>(ready.densities[from]);
        set.center[to] = motion(ready.positions[from]);
        set.radius[to] = static_cast<float>(static_cast<double>(ready.radii[from]) * cloud.scale);
        set.density[to] = static_cast<float>(piece.density * own);
        if (!ready.colors.empty()) set.color[to] = ready.colors[from];
    }
}

// Holds what a document of a procedural cloud cannot show by itself: that its particles are within the scene's limits
// once they are scaled and moved. What is narrower than the smallest radius is made as wide as that, with its mass
// kept, which no picture shows.
Status bring_within_limits(ReadyParticles& made, const Motion& motion, double density,
                           const std::string& at) {
    const auto outside = [&](const char* field, const std::string& what) {
        return Error{ErrorCode::kInvalidScene, at + field, what};
    };
    for (std::size_t i = 0; i < made.positions.size(); ++i) {
        float& radius = made.radii[i];
        const double scaled = static_cast<double>(radius) * motion.scale;
        if (scaled < limits::kMinRadius) {
            const double narrower = scaled / limits::kMinRadius;
            // A little above the limit, so that rounding does not fall below it.
            radius = static_cast<float>(limits::kMinRadius * (1 + 1e-6) / motion.scale);
            made.densities[i] *= static_cast<float>(narrower * narrower * narrower);
        } else if (scaled > limits::kMaxRadius * (1 + 1e-6)) {
            return outside("/scale", "makes particles of radius " + std::to_string(scaled) +
                                         "; at most 1e+06 is allowed");
        }
        if (density * static_cast<double>(made.densities[i]) > limits::kMaxDensity * (1 + 1e-6))
            return outside("/density",
                           "times the model's own is more than 1e+06, the most extinction that a "
                           "particle may have");
        const glm::dvec3 p = glm::abs(motion(made.positions[i]));
        if (std::max({p.x, p.y, p.z}) > limits::kMaxCoordinate)
            return outside("", "has particles farther than 1e+09 from the origin");
    }
    return std::nullopt;
}

// Runs the procedural clouds one after the other; each uses all threads. Their densities are those of the set.
Status run_models(const Scene& scene, int threads, const Deadline& deadline, bool coarse,
                  std::vector<ModelParticles>& made, ParticleSet& set) {
    std::uint64_t total = 0;
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const Cloud& cloud = scene->clouds[k];
        if (!is_procedural(cloud)) {
            total += cloud.ready.positions.size();
            for (const Cube& cube : cloud.cubes) total += particles_of(*scene, cloud, cube);
            continue;
        }
        const Motion motion = motion_of(cloud, clouds_time(*scene));
        ModelRequest request;
        request.key = keyed(seed_of(*scene, cloud), k);
        request.place = k;
        request.density = set.cloud_density[k];
        request.time = clouds_time(*scene);
        request.threads = threads;
        request.coarse = coarse;
        const Camera& camera = scene->camera;
        const double fov = camera.automatic ? kAutomaticFov : camera.fov;
        request.pixel_angle =
            2 * exact::tan(fov * std::numbers::pi / 360) / static_cast<double>(scene->image.height);
        if (!camera.automatic) request.eye = motion.back(camera.eye);
        auto particles = model_particles(cloud, request, deadline);
        if (!particles.ok()) return particles.error();
        made[k] = *std::move(particles);
        const double density = made[k].extinctions ? 1.0 : request.density;
        if (Status wrong = bring_within_limits(made[k].particles, motion, density,
                                               "/clouds/" + std::to_string(k)))
            return wrong;
        set.error = std::max(set.error, made[k].error);
        set.variant = keyed(set.variant, made[k].variant);
        total += made[k].particles.positions.size();
        if (total > limits::kMaxParticles)
            return Error{ErrorCode::kInvalidScene, "/clouds/" + std::to_string(k),
                         "a scene may have at most " + std::to_string(limits::kMaxParticles) +
                             " particles in all, this cloud makes it " + std::to_string(total)};
    }
    return std::nullopt;
}

}  // namespace

Result<ParticleSet> generate(const Scene& scene, int threads, const Deadline& deadline,
                             bool coarse) {
    ParticleSet set;
    std::vector<ModelParticles> made(scene->clouds.size());
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const auto density = density_of_cloud(scene, k, deadline);
        if (!density.ok()) return density.error();
        set.cloud_density.push_back(*density);
    }
    if (Status failed = run_models(scene, threads, deadline, coarse, made, set)) return *failed;
    std::size_t total = 0;
    const std::vector<Piece> pieces =
        cut_into_pieces(scene, made, set.cloud_density, set.cloud_begin, total);
    set.center.resize(total);
    set.radius.resize(total);
    set.density.resize(total);
    const bool colored =
        std::any_of(scene->clouds.begin(), scene->clouds.end(), [](const Cloud& cloud) {
            return cloud.model == CloudModel::kParticles && !cloud.ready.colors.empty();
        });
    if (colored) set.color.assign(total, glm::vec3(1));
    if (!textures_of(*scene).empty()) set.paint.resize(total);

    std::atomic<bool> late{false};
    parallel_for(threads, pieces.size(), [&](std::size_t i) {
        if (late.load(std::memory_order_relaxed) || deadline.over()) {
            late = true;
            return;
        }
        if (pieces[i].cube != nullptr) {
            fill_piece(pieces[i], clouds_time(*scene), set);
        } else {
            copy_piece(pieces[i], clouds_time(*scene), set);
        }
        paint_piece(pieces[i], set);
    });
    if (auto error = deadline.over()) return *error;
    return set;
}

Bounds bounds_of(const ParticleSet& particles) {
    Bounds bounds;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::dvec3 r(static_cast<double>(particles.radius[i]));
        const glm::dvec3 low = particles.center[i] - r, high = particles.center[i] + r;
        bounds.min = i == 0 ? low : glm::min(bounds.min, low);
        bounds.max = i == 0 ? high : glm::max(bounds.max, high);
    }
    return bounds;
}

}  // namespace awan
