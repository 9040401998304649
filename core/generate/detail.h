// Structure finer than the particles: where matter is thin, it is gathered into lumps with gaps between them.
//
// A field n(x) says where. It is uniform in 0..1, made of rounded bumps in three sizes (inverted cells of Worley
// 1996, lumps on lumps as in the clouds of Schneider & Vos 2015) and folded a little by a warp without divergence.
// Where the smooth extinction sigma is below `edge`, the matter is put into a share E(v) of space, u = sigma / edge,
// v = 2 u / (1 + u); between the lumps there is nothing. Near u = 1 the lumps have about the extinction `edge`, in thin
// matter less, so that an edge is soft and frays rather than crumbles. So silhouettes follow the bumps, the inside
// stays as it was, and the mean over realisations is sigma itself:
//   sigma' = keep * edge * min(u / E(v), kMostGathered) * ramp(n; v),    E(v) = mean of ramp(n; v) over n,
//   ramp(n; v) = clamp((n - 1 + v (1 + w)) / w, 0, 1),    w = kSoftness;    sigma' = keep * sigma where u >= 1.
// Only where u < .06 or so does the bound kMostGathered lose mass; `keep` puts it back everywhere.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace awan {

// Voxels along a side of the cube in which n is tabled. Space is tiled with it.
inline constexpr int kDetailSide = 96;
// The largest bumps along a side of the tile.
inline constexpr int kDetailBumps = 5;
// w, how soft the edges of lumps are; at 0 they would be hard.
inline constexpr float kSoftness = 0.3f;
// The largest extinction of a lump, in units of `edge`.
inline constexpr float kMostGathered = 1.5f;

// The field n, tabled. The word of voxel (x, y, z) holds its own byte and those of its neighbours at x + 1, y + 1 and
// both (lowest byte first); x fastest; one more layer than kDetailSide along z. A byte b stands for n = (b + 1/2) /
// 256. Never changed once made, and shared: 3.6 MB.
using DetailTile = std::shared_ptr<const std::vector<std::uint32_t>>;

// The field n, fitted to a cloud: what detailed() needs to turn a smooth extinction into a detailed one.
struct DetailField {
    DetailTile tile;
    // From scene units to voxels, turned so that no axis of the tile is one of the scene.
    glm::dmat3 to_tile{1};
    // Where voxel (0, 0, 0) lies, scene units.
    glm::dvec3 origin{0};
    // Size of the largest bumps, scene units.
    double bump = 1;
    // The extinction below which matter is gathered, 1/unit; > 0. `keep`: see above.
    float edge = 1;
    float keep = 1;
};

// What of the matter the field is fitted to.
struct DetailFigures {
    // A typical extinction inside the matter, 1/unit.
    double extinction = 0;
    // The mean radius of its particles, weighted by mass, scene units.
    double radius = 0;
    // A point anywhere in the matter, scene units.
    glm::dvec3 origin{0};
};

// Whose tile is made when the program is built and kept in it (cmake/write_detail_tile.cpp): that of scenes without a
// seed. Making one takes longer than all else of a small picture.
inline constexpr std::uint64_t kShippedTileSeed = 1;

// The bytes of a seed's tile, of nothing else: kDetailSide^3, x fastest. Takes about 50 ms of one core.
std::vector<std::uint8_t> detail_tile_bytes(std::uint64_t seed, int threads);
// Those of kShippedTileSeed, without making them.
std::span<const std::uint8_t> shipped_tile_bytes();

// The tile of a seed: the shipped one, or made.
DetailTile make_detail_tile(std::uint64_t seed, int threads);

// Keeps the tiles of the last few seeds, for other times and cameras of the same clouds. Thread-safe.
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

// amount: 0..1, `edge` over the typical extinction, up to a constant. size: the largest bumps over the mean radius.
// `keep` is left at 1.
DetailField make_detail(const DetailFigures& figures, double amount, double size, DetailTile tile);

// n at a point, trilinear between voxels; of a place in the tile, voxels, which repeats.
float bumps_at(const DetailField& field, const glm::dvec3& point);
float bumps_in_tile(const DetailField& field, const glm::dvec3& voxel);

// v, and E(v), see above: the share of space that lumps take.
inline float spread(float u) {
    return 2 * u / (1 + u);
}
float gathered_share(float v);

// sigma' of a smooth extinction and n. Continuous in both; 0 for 0.
inline float detailed(const DetailField& field, float extinction, float n) {
    const float u = extinction / field.edge;
    if (!(u < 1)) return field.keep * extinction;
    const float v = spread(u);
    const float ramp = (n - 1 + v * (1 + kSoftness)) * (1 / kSoftness);
    if (!(ramp > 0)) return 0;
    const float share = gathered_share(v);
    const float lump = u < kMostGathered * share ? u / share : kMostGathered;
    return field.keep * field.edge * lump * (ramp < 1 ? ramp : 1);
}

// The mean of sigma' over n, without `keep`, relative to the smooth extinction: 1 but where matter is very thin.
double kept_by_detail(const DetailField& field, double extinction);

// A bound: no smooth extinction up to this one has a larger sigma'.
double most_detailed(const DetailField& field, double extinction);

}  // namespace awan
