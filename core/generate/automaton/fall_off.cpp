#include "core/generate/automaton/fall_off.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "core/base/instruction_sets.h"
#include "core/base/parallel.h"

namespace awan::automaton {
namespace {

// The square of a distance that no cell within an ellipsoid has: those are below 1.
constexpr float kOutside = 2;

// A matrix of 8 x 8 bits, a row a byte, mirrored about its diagonal (Warren 2012, section 7-3).
std::uint64_t transposed(std::uint64_t x) {
    std::uint64_t t = (x ^ (x >> 7)) & 0x00aa00aa00aa00aau;
    x ^= t ^ (t << 7);
    t = (x ^ (x >> 14)) & 0x0000cccc0000ccccu;
    x ^= t ^ (t << 14);
    t = (x ^ (x >> 28)) & 0x00000000f0f0f0f0u;
    return x ^ t ^ (t << 28);
}

// Eight bytes that are 0 or 1 as the eight bits of one byte.
std::uint64_t gathered(std::uint64_t bytes) {
    return bytes * 0x0102040810204080u >> 56;
}

std::uint64_t eight_bytes(const std::uint8_t* bytes) {
    std::uint64_t x;
    std::memcpy(&x, bytes, 8);
    return x;
}

// square: d^2 of 64 cells. Gives the word of those inside, and writes their digits. shape: those that stand for each
// distance, or null.
AWAN_INLINE std::uint64_t pack_body(const float* square, const std::uint16_t* shape,
                                    std::uint64_t* planes) {
    alignas(64) std::array<std::int32_t, 64> digits;
    alignas(64) std::array<std::uint8_t, 64> outside, high, low;
    // In float: the last bit of d decides nothing that shows, and IEEE's square root is the same everywhere. One loop
    // for each step, so that they become vector instructions.
    alignas(64) std::array<float, 64> d;
    for (std::size_t i = 0; i < 64; ++i) d[i] = square[i] < 1.0F ? square[i] : 1.0F;
    for (std::size_t i = 0; i < 64; ++i) d[i] = std::sqrt(d[i]);
    for (std::size_t i = 0; i < 64; ++i) digits[i] = static_cast<std::int32_t>(d[i] * 65536.0F);
    for (std::size_t i = 0; i < 64; ++i) outside[i] = static_cast<std::uint8_t>(digits[i] >> 16);
    if (shape != nullptr)
        for (std::size_t i = 0; i < 64; ++i) digits[i] = digits[i] < 65536 ? shape[digits[i]] : 0;
    for (std::size_t i = 0; i < 64; ++i) high[i] = static_cast<std::uint8_t>(digits[i] >> 8);
    for (std::size_t i = 0; i < 64; ++i) low[i] = static_cast<std::uint8_t>(digits[i]);
    std::uint64_t inside = 0;
    for (std::size_t group = 0; group < 8; ++group)
        inside |= (gathered(eight_bytes(&outside[8 * group])) ^ 255) << (8 * group);
    if (inside == 0) return 0;
    // Eight cells' bytes, mirrored, are a byte each of eight planes; eight of those together are the words of the
    // planes.
    std::array<std::array<std::uint8_t, 8>, kDistancePlanes> bytes;
    for (std::size_t half = 0; half < 2; ++half)
        for (std::size_t group = 0; group < 8; ++group) {
            const std::uint64_t x = transposed(eight_bytes(&(half == 0 ? high : low)[8 * group]));
            for (std::size_t bit = 0; bit < 8; ++bit)
                bytes[half * 8 + 7 - bit][group] = static_cast<std::uint8_t>(x >> (8 * bit));
        }
    std::memcpy(planes, bytes.data(), sizeof bytes);
    return inside;
}
AWAN_KERNEL(std::uint64_t, pack,
            (const float* square, const std::uint16_t* shape, std::uint64_t* planes),
            (square, shape, planes))

// The cells of a row that anything was written to: first .. last - 1.
struct Reach {
    // It starts empty.
    std::size_t first = SIZE_MAX, last = 0;
};

// Keeps in `out` the smaller of what is there and d^2, along a row of cells i:
//   d^2 = ((start + i) inverse)^2 + rest,    inverse: a cell in radii, rest: the part across the row.
AWAN_INLINE void keep_smallest_body(float start, float inverse, float rest, std::int32_t count,
                                    float* out) {
    for (std::int32_t i = 0; i < count; ++i) {
        const float along = (start + static_cast<float>(i)) * inverse;
        const float d2 = along * along + rest;
        out[i] = d2 < out[i] ? d2 : out[i];
    }
}
AWAN_KERNEL(void, keep_smallest,
            (float start, float inverse, float rest, std::int32_t count, float* out),
            (start, inverse, rest, count, out))

// Writes d^2 where no ellipsoid has been yet: the first one that holds a cell counts.
AWAN_INLINE void keep_first_body(float start, float inverse, float rest, std::int32_t count,
                                 float* out) {
    for (std::int32_t i = 0; i < count; ++i) {
        const float along = (start + static_cast<float>(i)) * inverse;
        const float d2 = along * along + rest;
        out[i] = out[i] < 1.0F ? out[i] : d2;
    }
}
AWAN_KERNEL(void, keep_first,
            (float start, float inverse, float rest, std::int32_t count, float* out),
            (start, inverse, rest, count, out))

// Adds to a row the part of it within the ellipsoid, as squares of distances.
void add_row(const AutomatonEllipsoid& ellipsoid, double rest, AutomatonOverlap overlap,
             std::size_t nx, float* square, Reach& reach) {
    // One cell more on either side than the ellipsoid reaches: which cells lie within is decided by their squares.
    const double half = std::sqrt(1 - rest) * ellipsoid.radii.x + 1;
    const double side = static_cast<double>(nx);
    const double x = ellipsoid.center.x - 0.5;
    const auto first = static_cast<std::size_t>(std::clamp(std::floor(x - half), 0.0, side));
    const auto last = static_cast<std::size_t>(std::clamp(std::ceil(x + half) + 1, 0.0, side));
    if (first >= last) return;
    reach.first = std::min(reach.first, first);
    reach.last = std::max(reach.last, last);
    const auto inverse = static_cast<float>(1 / ellipsoid.radii.x);
    const auto start = static_cast<float>(static_cast<double>(first) - x);
    (overlap == AutomatonOverlap::kFirst ? keep_first : keep_smallest)(
        start, inverse, static_cast<float>(rest), static_cast<std::int32_t>(last - first),
        square + first);
}

double squared(double x) {
    return x * x;
}

}  // namespace

Status make_fall_off(const AutomatonGrid& grid, const std::vector<AutomatonEllipsoid>& ellipsoids,
                     AutomatonOverlap overlap, double base, int threads, const Deadline& deadline,
                     FallOff& into) {
    into.inside.resize(grid.all_words());
    into.distance.resize(grid.all_words() * kDistancePlanes);
    into.row_inside.resize(grid.rows());
    const std::uint16_t* const shape = into.shape.empty() ? nullptr : into.shape.data();
    const double work =
        static_cast<double>(grid.rows()) * static_cast<double>(64 * grid.words + 20);
    std::atomic<bool> late{false};
    parallel_for(useful_threads(threads, work), grid.nz, [&](std::size_t k) {
        if (late.load(std::memory_order_relaxed) || deadline.over()) {
            late = true;
            return;
        }
        std::vector<float> square(grid.words * 64);
        std::vector<const AutomatonEllipsoid*> near;
        const double z = static_cast<double>(k) + 0.5;
        for (const AutomatonEllipsoid& one : ellipsoids)
            if (std::abs(z - one.center.z) < one.radii.z) near.push_back(&one);
        for (std::size_t j = 0; j < grid.ny; ++j) {
            const std::size_t row = grid.row(j, k);
            const double y = static_cast<double>(j) + 0.5;
            bool touched = false;
            Reach reach;
            if (y >= base)
                for (const AutomatonEllipsoid* one : near) {
                    const double rest = squared((y - one->center.y) / one->radii.y) +
                                        squared((z - one->center.z) / one->radii.z);
                    if (!(rest < 1)) continue;
                    if (!touched) std::fill(square.begin(), square.end(), kOutside);
                    touched = true;
                    add_row(*one, rest, overlap, grid.nx, square.data(), reach);
                }
            bool any = false;
            for (std::size_t w = 0; w < grid.words; ++w) {
                const std::size_t word = row * grid.words + w;
                into.inside[word] = 64 * w < reach.last && 64 * (w + 1) > reach.first
                                        ? pack(square.data() + 64 * w, shape,
                                               &into.distance[word * kDistancePlanes])
                                        : 0;
                any |= into.inside[word] != 0;
            }
            into.row_inside[row] = any;
        }
    });
    if (auto error = deadline.over()) return *error;
    return std::nullopt;
}

}  // namespace awan::automaton
