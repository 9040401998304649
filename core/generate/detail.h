// Structure finer than the particles: where matter is thin, it is gathered into lumps with gaps between them.
//
// A field n(x), uniform in 0..1 and made of rounded bumps in three sizes (inverted cells: Worley 1996; lumps on lumps
// as in the clouds of Ebert et al. and of Schneider & Vos 2015), folded by a curl-like warp, says where. Where the
// smooth extinction sigma is below `edge`, a share E(u) of space, u = sigma / edge, holds it: there it is about `edge`,
// between the lumps it is nothing. So silhouettes follow the bumps, the inside stays as it was, and the mean over
// realisations is sigma itself:
//     sigma' = keep * edge * min(u / E(u), kMostGathered) * ramp(n; u),    E(u) = mean of ramp(n; u) over n,
//     ramp(n; u) = clamp((n - 1 + u (1 + w)) / w, 0, 1),    w = kSoftness;    sigma' = keep * sigma where u >= 1.
// Only tails, u < .2 or so, lose by the bound kMostGathered; `keep` puts their mass back everywhere.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <vector>

namespace awan {

// Voxels along the tile, which repeats.
inline constexpr int kDetailSide = 96;
// Of the largest, along the tile.
inline constexpr int kDetailBumps = 5;
// w: of the lumps' edges, 0 would be hard.
inline constexpr float kSoftness = 0.3f;
// Extinction of a lump, in units of `edge`
inline constexpr float kMostGathered = 1.5f;

// Voxel (x, y, z)'s byte and those of its neighbours at x + 1, y + 1 and both (lowest byte first), x fastest; one more
// layer than kDetailSide. A byte b stands for n = (b + 1/2) / 256. Never changed once made: 3.6 MB, shared.
using DetailTile = std::shared_ptr<const std::vector<std::uint32_t>>;

struct DetailField {
    DetailTile tile;
    glm::dmat3 to_tile{// Voxels per scene unit, turned: no axis of the tile is one of the scene.
                       1};
    // Scene units: voxel (0, 0, 0).
    glm::dvec3 origin{0};
    // Size of the largest bumps, scene units.
    double bump = 1;
    // Extinction, 1/unit; > 0.
    float edge = 1;
    float keep = 1;
};

// What the field is made for.
struct DetailFigures {
    // A typical one inside of the matter, 1/unit.
    double extinction = 0;
    // Mean of particles, by mass.
    double radius = 0;
    // Anywhere in the matter.
    glm::dvec3 origin{0};
};

// Of the seed alone. About 200 ms of one core.
DetailTile make_detail_tile(std::uint64_t seed, int threads);

// The tiles of the last few seeds, for other times and cameras of the same clouds. Thread-safe.
class DetailTiles {
  public:
    DetailTile of(std::uint64_t seed, int threads);

  private:
    static constexpr std::size_t kKept = 8;
    struct Entry {
        std::uint64_t seed;
        DetailTile tile;
    };
    std::mutex mutex_;
    // Most recently used first.
    std::list<Entry> entries_;
};

// amount: 0..1, of edge / extinction; size: of bumps / radius. keep is 1.
DetailField make_detail(const DetailFigures& figures, double amount, double size, DetailTile tile);

// n at a point, trilinear between voxels.
float bumps_at(const DetailField& field, const glm::dvec3& point);

// E(u) above.
float gathered_share(float u);

// sigma' of the smooth extinction and n. Continuous in both; 0 for 0.
inline float detailed(const DetailField& field, float extinction, float n) {
    const float u = extinction / field.edge;
    if (!(u < 1)) return field.keep * extinction;
    const float ramp = (n - 1 + u * (1 + kSoftness)) * (1 / kSoftness);
    if (!(ramp > 0)) return 0;
    const float share = gathered_share(u);
    const float lump = u < kMostGathered * share ? u / share : kMostGathered;
    return field.keep * field.edge * lump * (ramp < 1 ? ramp : 1);
}

// Its mean over n, without keep, relative to the smooth extinction: 1 but for tails.
double kept_by_detail(const DetailField& field, double extinction);

// No sigma' of a smooth extinction up to this one is above.
double most_detailed(const DetailField& field, double extinction);

}  // namespace awan
