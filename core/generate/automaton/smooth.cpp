#include "core/generate/automaton/smooth.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace awan::automaton {
namespace {

// Of each byte: its eight bits as eight bytes that are 0 or 1, that of bit 0 first in memory.
constexpr std::array<std::uint64_t, 256> make_bytes_of_bits() {
    std::array<std::uint64_t, 256> bytes{};
    for (std::size_t bits = 0; bits < 256; ++bits)
        for (std::size_t i = 0; i < 8; ++i)
            bytes[bits] |= static_cast<std::uint64_t>(bits >> i & 1) << (8 * i);
    return bytes;
}
constexpr std::array<std::uint64_t, 256> kBytesOfBits = make_bytes_of_bits();

// out = in (assign) or out += in, for n counts.
template <typename From>
void add_row(const From* in, std::size_t n, bool assign, std::uint16_t* out) {
    if (assign)
        for (std::size_t i = 0; i < n; ++i) out[i] = in[i];
    else
        for (std::size_t i = 0; i < n; ++i) out[i] = static_cast<std::uint16_t>(out[i] + in[i]);
}

}  // namespace

void add_bits(std::uint64_t bits, std::uint64_t* bytes) {
    for (std::size_t group = 0; group < 8; ++group)
        bytes[group] += kBytesOfBits[bits >> (8 * group) & 255];
}

PlaneSmoother::PlaneSmoother(const AutomatonGrid& grid, std::vector<CloudBits> fields,
                             std::array<std::size_t, 3> reach)
    : grid_(grid),
      fields_(std::move(fields)),
      i0_(reach[0]),
      j0_(reach[1]),
      k0_(reach[2]),
      stride_(grid.words * 64),
      ring_(2 * k0_ + 1),
      x_sums_(stride_ * grid.ny),
      x_rows_(grid.ny),
      counts_(stride_ * grid.ny),
      rows_(grid.ny) {
    for (Sums& sums : ring_) {
        sums.counts.resize(stride_ * grid.ny);
        sums.rows.resize(grid.ny);
    }
}

double PlaneSmoother::most() const {
    return static_cast<double>((2 * i0_ + 1) * (2 * j0_ + 1) * (2 * k0_ + 1) * fields_.size());
}

// A byte holds such a sum: 9 cells of 8 steps are 72. False when all are 0, and then nothing is written.
bool PlaneSmoother::sum_along_x(std::size_t row, std::uint8_t* out) const {
    bool any = false;
    const std::size_t words = grid_.words;
    for (const CloudBits field : fields_) {
        const std::uint64_t* const bits = field->data() + row * words;
        if (std::all_of(bits, bits + words, [](std::uint64_t word) { return word == 0; })) continue;
        if (!any) std::memset(out, 0, stride_);
        any = true;
        for (std::size_t w = 0; w < words; ++w) {
            const std::uint64_t own = bits[w];
            const std::uint64_t before = w > 0 ? bits[w - 1] : 0;
            const std::uint64_t after = w + 1 < words ? bits[w + 1] : 0;
            if ((own | before | after) == 0) continue;
            std::uint64_t bytes[8];
            std::memcpy(bytes, out + 64 * w, 64);
            add_bits(own, bytes);
            for (std::size_t s = 1; s <= i0_; ++s) {
                add_bits(own << s | before >> (64 - s), bytes);
                add_bits(own >> s | after << (64 - s), bytes);
            }
            std::memcpy(out + 64 * w, bytes, 64);
        }
    }
    return any;
}

const PlaneSmoother::Sums& PlaneSmoother::sums(std::size_t k) {
    Sums& sums = ring_[k % ring_.size()];
    if (sums.k == k) return sums;
    sums.k = k;
    for (std::size_t j = 0; j < grid_.ny; ++j)
        x_rows_[j] = sum_along_x(grid_.row(j, k), &x_sums_[j * stride_]);
    for (std::size_t j = 0; j < grid_.ny; ++j) {
        sums.rows[j] = 0;
        const std::size_t last = std::min(j + j0_, grid_.ny - 1);
        for (std::size_t n = j - std::min(j, j0_); n <= last; ++n) {
            if (x_rows_[n] == 0) continue;
            add_row(&x_sums_[n * stride_], stride_, sums.rows[j] == 0, &sums.counts[j * stride_]);
            sums.rows[j] = 1;
        }
    }
    return sums;
}

PlaneSmoother::Plane PlaneSmoother::plane(std::size_t k) {
    std::fill(rows_.begin(), rows_.end(), std::uint8_t{0});
    const std::size_t last = std::min(k + k0_, grid_.nz - 1);
    for (std::size_t n = k - std::min(k, k0_); n <= last; ++n) {
        const Sums& near = sums(n);
        for (std::size_t j = 0; j < grid_.ny; ++j) {
            if (near.rows[j] == 0) continue;
            add_row(&near.counts[j * stride_], stride_, rows_[j] == 0, &counts_[j * stride_]);
            rows_[j] = 1;
        }
    }
    return {counts_.data(), rows_.data(), stride_};
}

}  // namespace awan::automaton
