#include "core/generate/detail.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/generate/keyed_random.h"

namespace awan {
namespace {

// `edge` at amount 1, in typical extinctions.
constexpr double kEdge = 1.4;

// One size of bumps: how many along the tile, and their share of n. Each size sits on the one before.
struct Octave {
    int cells;
    float share;
};
constexpr std::array kOctaves = {Octave{kDetailBumps, 0.58F}, Octave{11, 0.28F}, Octave{23, 0.14F}};

constexpr int kWaves = 10;
// How far the warp moves a point, in largest bumps.
constexpr double kWarp = 0.2;

constexpr auto kSide = static_cast<std::size_t>(kDetailSide);

// std::floor, of most numbers without the call that the oldest x86 needs for it.
template <typename Real>
Real below(Real v) {
    if (!(std::abs(v) < Real{1 << 30})) return std::floor(v);
    const auto cut = static_cast<Real>(static_cast<int>(v));
    return cut > v ? cut - 1 : cut;
}

// A displacement without divergence and with the tile's period: the curl of a sum of waves, at the voxels. Every wave
// fits the tile a whole number of times, so a voxel's phase is the sum of three out of kSide values.
class Warp {
  public:
    explicit Warp(std::uint64_t key) {
        for (std::size_t i = 0; i < kSide; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kDetailSide;
            turn_[i] = {static_cast<float>(exact::cos(angle)),
                        static_cast<float>(exact::sin(angle))};
        }
        for (int i = 0; i < kWaves; ++i) {
            const auto number = [&](std::uint64_t which, double from, double to) {
                const auto bits = static_cast<std::uint32_t>(
                    keyed(keyed(key, static_cast<std::uint64_t>(i)), which) >> 32);
                return from + (to - from) * unit_open(bits);
            };
            Wave& wave = waves_[static_cast<std::size_t>(i)];
            glm::dvec3 k(0);
            for (int axis = 0; axis < 3; ++axis)
                k[axis] = std::floor(number(static_cast<std::uint64_t>(axis), -7, 8));
            if (k == glm::dvec3(0)) k.x = 3;
            const glm::dvec3 a(number(3, -1, 1), number(4, -1, 1), number(5, -1, 1));
            wave.k = glm::ivec3(k);
            const double phase = number(6, 0, 2 * std::numbers::pi);
            wave.start = {static_cast<float>(exact::cos(phase)),
                          static_cast<float>(exact::sin(phase))};
            const glm::dvec3 swing = glm::cross(k, a);
            // All waves are of one strength; together they move a point by about kWarp of a bump (rms).
            const double length = std::max(glm::length(swing), 1e-9);
            wave.swing =
                glm::vec3(swing / length * (kWarp / kDetailBumps * std::sqrt(2.0 / kWaves)));
        }
    }
    // The displacements at the voxels of a row along x, in tiles.
    void row(std::size_t y, std::size_t z, std::array<glm::vec3, kSide>& out) const {
        out.fill(glm::vec3(0));
        for (const Wave& wave : waves_) {
            const Turn first = both(wave.start, both(turn(wave.k.y, y), turn(wave.k.z, z)));
            for (std::size_t x = 0; x < kSide; ++x)
                out[x] += wave.swing * both(first, turn(wave.k.x, x)).cos;
        }
    }

  private:
    struct Turn {
        float cos = 1, sin = 0;
    };
    struct Wave {
        glm::ivec3 k{0};
        glm::vec3 swing{0};
        // The wave's phase at the tile's corner.
        Turn start;
    };
    static Turn both(const Turn& a, const Turn& b) {
        return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
    }
    // The phase of wave number k at voxel i along an axis.
    const Turn& turn(int k, std::size_t i) const {
        return turn_[static_cast<std::size_t>(k + 8 * kDetailSide) * i % kSide];
    }
    std::array<Wave, kWaves> waves_;
    std::array<Turn, kSide> turn_;
};

using Float4 = float __attribute__((vector_size(16)));

// One point in each cell of a periodic grid; bumps about them.
class Bumps {
  public:
    Bumps(int cells, std::uint64_t key) : cells_(cells), row_(static_cast<std::size_t>(cells + 2)) {
        const auto n = static_cast<std::size_t>(cells);
        const auto of_cell = [&](std::size_t i, std::size_t axis) {
            return static_cast<float>(
                unit_open(static_cast<std::uint32_t>(keyed(keyed(key, i), axis) >> 32)));
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            points_[axis].resize(row_ * row_ * row_ + 1);
            for (std::size_t z = 0, at = 0; z < row_; ++z)
                for (std::size_t y = 0; y < row_; ++y)
                    for (std::size_t x = 0; x < row_; ++x, ++at) {
                        const auto wrapped = [n](std::size_t i) { return (i + n - 1) % n; };
                        points_[axis][at] =
                            of_cell((wrapped(z) * n + wrapped(y)) * n + wrapped(x), axis);
                    }
        }
    }
    // 1 at a cell's point, falling with the square of the distance to the nearest point, in cells. p: in tiles, less
    // than a tile outside of 0..1. Without branches: rows that are too far away cost less than to find out which.
    float operator()(const glm::vec3& p) const {
        const glm::vec3 at = p * static_cast<float>(cells_);
        const glm::vec3 floor(below(at.x), below(at.y), below(at.z));
        const glm::vec3 in = at - floor;
        const auto wrapped = [&](float f) {
            const int i = static_cast<int>(f);
            return static_cast<std::size_t>(i < 0 ? i + cells_ : i < cells_ ? i : i - cells_);
        };
        const std::size_t corner =
            (wrapped(floor.z) * row_ + wrapped(floor.y)) * row_ + wrapped(floor.x);
        // Rows of three neighbours along x at a time; the fourth lane is put too far away to count.
        const Float4 aside = Float4{-1, 0, 1, 9} - in.x;
        Float4 nearest = {4, 4, 4, 4};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j) {
                const std::size_t i = corner + (k * row_ + j) * row_;
                const Float4 x = four(points_[0], i) + aside;
                const Float4 y = four(points_[1], i) + (static_cast<float>(j) - 1 - in.y);
                const Float4 z = four(points_[2], i) + (static_cast<float>(k) - 1 - in.z);
                const Float4 apart = x * x + y * y + z * z;
                nearest = apart < nearest ? apart : nearest;
            }
        return 1 - std::min(nearest[0], std::min(nearest[1], nearest[2]));
    }

  private:
    static Float4 four(const std::vector<float>& from, std::size_t i) {
        Float4 values;
        std::memcpy(&values, &from[i], sizeof values);
        return values;
    }
    int cells_;
    // Cells along a row, with one more on each side; the points' coordinates.
    std::size_t row_;
    std::array<std::vector<float>, 3> points_;
};

// Values replaced by their ranks: the bytes are then uniform, which makes the shares of space exact.
std::vector<std::uint8_t> ranks(const std::vector<float>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    constexpr std::size_t kBins = 1u << 16;
    const float scale = static_cast<float>(kBins - 1) / std::max(*high - *low, 1e-20F);
    const auto bin = [&, least = *low](float v) {
        return static_cast<std::size_t>((v - least) * scale);
    };
    std::vector<std::uint32_t> below(kBins + 1, 0);
    for (const float v : values) ++below[bin(v) + 1];
    for (std::size_t i = 1; i <= kBins; ++i) below[i] += below[i - 1];
    std::vector<std::uint8_t> bytes(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t b = bin(values[i]);
        const std::size_t middle = (std::size_t{below[b]} + below[b + 1]) / 2;
        bytes[i] =
            static_cast<std::uint8_t>(std::min<std::size_t>(middle * 256 / values.size(), 255));
    }
    return bytes;
}

// A rotation that lays no axis of the tile along one of the scene, since its repetition would show on flat bases.
glm::dmat3 turned() {
    const glm::dvec3 x = glm::normalize(glm::dvec3(0.78, 0.41, -0.47));
    const glm::dvec3 y = glm::normalize(glm::cross(glm::dvec3(0.31, -0.62, 0.72), x));
    return glm::transpose(glm::dmat3(x, y, glm::cross(x, y)));
}

// The largest sigma' / (keep edge) of any smooth extinction up to u (0..1) edges: where n is 1. It rises until the ramp
// is cut off at its upper end, falls as lumps spread, and rises again to 1 at u = 1.
double densest_lump(float u) {
    const auto at = [](float of) {
        const float v = spread(of), share = gathered_share(v);
        const float lump = of < kMostGathered * share ? of / share : kMostGathered;
        return static_cast<double>(lump * std::min(v * (1 + kSoftness) / kSoftness, 1.0F));
    };
    // Where spread(u) = w / (1 + w).
    constexpr float kCutOff = kSoftness / (2 + kSoftness);
    return std::max(at(std::min(u, kCutOff)), at(u));
}

}  // namespace

float gathered_share(float v) {
    constexpr float w = kSoftness;
    // The n at which the ramp begins.
    const float a = 1 - v * (1 + w);
    if (a >= 1 - w) return (1 - a) * (1 - a) / (2 * w);
    if (a >= 0) return 1 - a - 0.5F * w;
    return 1 - (a + w) * (a + w) / (2 * w);
}

std::vector<std::uint8_t> detail_tile_bytes(std::uint64_t seed, int threads) {
    const std::uint64_t key = keyed(seed, 0xde7a11);
    const Warp warp(keyed(key, 100));
    std::vector<Bumps> octaves;
    for (std::size_t i = 0; i < kOctaves.size(); ++i)
        octaves.emplace_back(kOctaves[i].cells, keyed(key, i));
    std::vector<float> values(kSide * kSide * kSide);
    parallel_for(threads, kSide, [&](std::size_t z) {
        std::array<glm::vec3, kSide> moved;
        for (std::size_t y = 0; y < kSide; ++y) {
            warp.row(y, z, moved);
            for (std::size_t x = 0; x < kSide; ++x) {
                const glm::vec3 at = moved[x] + glm::vec3(x, y, z) / static_cast<float>(kSide);
                float sum = 0;
                for (std::size_t o = 0; o < kOctaves.size(); ++o)
                    sum += kOctaves[o].share * octaves[o](at);
                values[(z * kSide + y) * kSide + x] = sum;
            }
        }
    });
    return ranks(values);
}

DetailField make_detail(const DetailFigures& figures, double amount, double size, DetailTile tile) {
    DetailField field;
    field.tile = std::move(tile);
    field.bump = std::clamp(size * figures.radius, 1e-9, 1e9);
    field.to_tile = turned() * (kDetailSide / (kDetailBumps * field.bump));
    field.origin = figures.origin;
    field.edge = static_cast<float>(std::clamp(amount * kEdge * figures.extinction, 1e-30, 1e9));
    return field;
}

float bumps_at(const DetailField& field, const glm::dvec3& point) {
    return bumps_in_tile(field, field.to_tile * (point - field.origin));
}

float bumps_in_tile(const DetailField& field, const glm::dvec3& at) {
    std::size_t low[3];
    float part[3];
    for (int axis = 0; axis < 3; ++axis) {
        double p = at[axis] - kDetailSide * below(at[axis] / kDetailSide);
        // p is out of its range by rounding, or where the point is so far away that no digits are left.
        if (!(p >= 0 && p < kDetailSide)) p = 0;
        low[axis] = static_cast<std::size_t>(p);
        part[axis] = static_cast<float>(p - static_cast<double>(low[axis]));
    }
    const std::uint32_t* const word =
        field.tile->data() + (low[2] * kSide + low[1]) * kSide + low[0];
    const auto layer = [&](std::uint32_t w) {
        const auto byte = [&](int shift) { return static_cast<float>(w >> shift & 255u); };
        const float a = byte(0) + part[0] * (byte(8) - byte(0));
        const float b = byte(16) + part[0] * (byte(24) - byte(16));
        return a + part[1] * (b - a);
    };
    const float a = layer(word[0]), b = layer(word[kSide * kSide]);
    return (a + part[2] * (b - a) + 0.5F) * (1.0F / 256);
}

double kept_by_detail(const DetailField& field, double extinction) {
    const double u = extinction / static_cast<double>(field.edge);
    if (!(u < 1)) return 1;
    if (!(u > 0)) return 0;
    const auto share = static_cast<double>(gathered_share(spread(static_cast<float>(u))));
    return std::min(1.0, static_cast<double>(kMostGathered) * share / u);
}

double most_detailed(const DetailField& field, double extinction) {
    const double u = std::min(extinction / static_cast<double>(field.edge), 1.0);
    const double lumps = static_cast<double>(field.edge) * densest_lump(static_cast<float>(u));
    return static_cast<double>(field.keep) * std::max(extinction, lumps) * 1.001;
}

}  // namespace awan
