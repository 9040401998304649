#include "core/generate/automaton/fall_off.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>

#include "core/parallel.h"

namespace awan {
namespace {

constexpr float kOutside = 2;  // a square of a distance that no cell within an ellipsoid has

// A bit matrix of 8 rows, a byte each, turned about its diagonal (Warren, Hacker's Delight 2, 7-3).
std::uint64_t transposed(std::uint64_t x) {
    std::uint64_t t = (x ^ (x >> 7)) & 0x00aa00aa00aa00aau;
    x ^= t ^ (t << 7);
    t = (x ^ (x >> 14)) & 0x0000cccc0000ccccu;
    x ^= t ^ (t << 14);
    t = (x ^ (x >> 28)) & 0x00000000f0f0f0f0u;
    return x ^ t ^ (t << 28);
}

// `square`: d^2 of 64 cells. The word of those inside, and their digits.
std::uint64_t pack(const float* square, std::uint64_t* planes) {
    std::array<std::uint8_t, 64> high, low;
    std::array<std::int32_t, 64> digits;
    // In float: a last bit of d decides nothing that shows, and IEEE's root is the same everywhere.
    for (std::size_t i = 0; i < 64; ++i)
        digits[i] = static_cast<std::int32_t>(std::sqrt(std::min(square[i], 1.0F)) * 65536.0F);
    for (std::size_t i = 0; i < 64; ++i) {
        high[i] = static_cast<std::uint8_t>(digits[i] >> 8);
        low[i] = static_cast<std::uint8_t>(digits[i]);
    }
    std::uint64_t inside = 0;
    for (std::size_t i = 0; i < 64; ++i)
        inside |= static_cast<std::uint64_t>(digits[i] < 65536) << i;
    if (inside == 0) return 0;
    std::array<std::array<std::uint8_t, 8>, kDistancePlanes> bytes;
    for (std::size_t half = 0; half < 2; ++half)
        for (std::size_t group = 0; group < 8; ++group) {
            std::uint64_t x;
            std::memcpy(&x, (half == 0 ? high : low).data() + 8 * group, 8);
            x = transposed(x);
            for (std::size_t bit = 0; bit < 8; ++bit)
                bytes[half * 8 + 7 - bit][group] = static_cast<std::uint8_t>(x >> (8 * bit));
        }
    std::memcpy(planes, bytes.data(), sizeof bytes);
    return inside;
}

// Of a row: the part of it within the ellipsoid, squares of distances.
template <bool kFirstWins>
void add_row(const AutomatonEllipsoid& ellipsoid, double rest, std::size_t nx, float* square) {
    // A cell to spare on either side: the test is that of the square.
    const double half = std::sqrt(1 - rest) * ellipsoid.radii.x + 1;
    const double side = static_cast<double>(nx);
    const double x = ellipsoid.center.x - 0.5;
    const auto first = static_cast<std::size_t>(std::clamp(std::floor(x - half), 0.0, side));
    const auto last = static_cast<std::size_t>(std::clamp(std::ceil(x + half) + 1, 0.0, side));
    const auto inverse = static_cast<float>(1 / ellipsoid.radii.x);
    const auto start = static_cast<float>(static_cast<double>(first) - x);
    const auto other = static_cast<float>(rest);
    float* const out = square + first;
    const auto count = static_cast<std::int32_t>(last - std::min(first, last));
    for (std::int32_t i = 0; i < count; ++i) {
        const float along = (start + static_cast<float>(i)) * inverse;
        const float d2 = along * along + other;
        if (kFirstWins)
            out[i] = out[i] < 1.0F ? out[i] : d2;
        else
            out[i] = d2 < out[i] ? d2 : out[i];
    }
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
            if (y >= base)
                for (const AutomatonEllipsoid* one : near) {
                    const double rest = squared((y - one->center.y) / one->radii.y) +
                                        squared((z - one->center.z) / one->radii.z);
                    if (!(rest < 1)) continue;
                    if (!touched) std::fill(square.begin(), square.end(), kOutside);
                    touched = true;
                    if (overlap == AutomatonOverlap::kFirst)
                        add_row<true>(*one, rest, grid.nx, square.data());
                    else
                        add_row<false>(*one, rest, grid.nx, square.data());
                }
            bool any = false;
            for (std::size_t w = 0; w < grid.words; ++w) {
                const std::size_t word = row * grid.words + w;
                into.inside[word] =
                    touched ? pack(square.data() + 64 * w, &into.distance[word * kDistancePlanes])
                            : 0;
                any |= into.inside[word] != 0;
            }
            into.row_inside[row] = any;
        }
    });
    if (auto error = deadline.over()) return *error;
    return std::nullopt;
}

}  // namespace awan
