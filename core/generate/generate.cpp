#include "core/generate/generate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "core/generate/cubes.h"
#include "core/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/parallel.h"

namespace awan {
namespace {

// A run of particles of one cube, or of one cloud of ready particles: a piece of work for one
// thread.
struct Piece {
    const Cloud* cloud;
    const Cube* cube;  // null: ready particles
    std::uint64_t key;
    std::uint64_t first, last;  // within the cube or the ready lists
    std::size_t out;            // where the first goes
    double density;
    Fill fill;
};
constexpr std::uint64_t kPieceSize = 8192;  // about half a millisecond of work

struct Motion {
    glm::dvec3 translate;
    double scale;
    SinCos turn;

    glm::dvec3 operator()(glm::dvec3 p) const {
        p *= scale;
        return translate +
               glm::dvec3(p.x * turn.cos + p.z * turn.sin, p.y, p.z * turn.cos - p.x * turn.sin);
    }
};

void add_pieces(std::vector<Piece>& pieces, Piece whole, std::uint64_t count, std::size_t& total) {
    for (std::uint64_t first = 0; first < count; first += kPieceSize) {
        whole.first = first;
        whole.last = std::min(count, first + kPieceSize);
        whole.out = total;
        pieces.push_back(whole);
        total += static_cast<std::size_t>(whole.last - first);
    }
}

std::vector<Piece> cut_into_pieces(const Scene& scene, std::size_t& total) {
    std::vector<Piece> pieces;
    total = 0;
    const double scene_density = scene->density.value_or(kDefaultDensity);
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const Cloud& cloud = scene->clouds[k];
        const std::uint64_t key = keyed(cloud.seed.value_or(scene->seed), k);
        Piece piece{&cloud,
                    nullptr,
                    key,
                    0,
                    0,
                    0,
                    cloud.density.value_or(scene_density),
                    cloud.fill.value_or(scene->fill)};
        if (cloud.model == CloudModel::kParticles) {
            add_pieces(pieces, piece, cloud.ready.positions.size(), total);
            continue;
        }
        for (std::size_t c = 0; c < cloud.cubes.size(); ++c) {
            piece.cube = &cloud.cubes[c];
            piece.key = keyed(key, c);
            add_pieces(pieces, piece, cloud.cubes[c].particles, total);
        }
    }
    return pieces;
}

void fill_piece(const Piece& piece, ParticleSet& set) {
    const Cloud& cloud = *piece.cloud;
    const Motion motion{cloud.translate, cloud.scale, exact_sincos_degrees(cloud.rotate_y)};
    const auto density = static_cast<float>(piece.density * piece.cube->density);
    std::array<FilledParticle, 256> filled;  // stays in the first cache
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

void copy_piece(const Piece& piece, ParticleSet& set) {
    const Cloud& cloud = *piece.cloud;
    const ReadyParticles& ready = cloud.ready;
    const Motion motion{cloud.translate, cloud.scale, exact_sincos_degrees(cloud.rotate_y)};
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

}  // namespace

Result<ParticleSet> generate(const Scene& scene, int threads, const Deadline& deadline) {
    std::size_t total = 0;
    const std::vector<Piece> pieces = cut_into_pieces(scene, total);
    ParticleSet set;
    set.center.resize(total);
    set.radius.resize(total);
    set.density.resize(total);
    const bool colored =
        std::any_of(scene->clouds.begin(), scene->clouds.end(), [](const Cloud& cloud) {
            return cloud.model == CloudModel::kParticles && !cloud.ready.colors.empty();
        });
    if (colored) set.color.assign(total, glm::vec3(1));

    std::atomic<bool> late{false};
    parallel_for(threads, pieces.size(), [&](std::size_t i) {
        if (late.load(std::memory_order_relaxed) || deadline.over()) {
            late = true;
            return;
        }
        if (pieces[i].cube != nullptr) {
            fill_piece(pieces[i], set);
        } else {
            copy_piece(pieces[i], set);
        }
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
