#include "core/generate/automaton/weighted.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace awan::automaton {
namespace {

// out += weight * in, or out = weight * in where it is the first.
void add_row(const float* in, float weight, std::size_t n, bool first, float* out) {
    if (first)
        for (std::size_t i = 0; i < n; ++i) out[i] = weight * in[i];
    else
        for (std::size_t i = 0; i < n; ++i) out[i] += weight * in[i];
}

// How far apart two places of an axis are.
std::size_t apart(std::size_t a, std::size_t b) {
    return a > b ? a - b : b - a;
}

}  // namespace

WeightedSmoother::WeightedSmoother(const AutomatonGrid& grid, std::vector<CloudBits> fields,
                                   std::array<std::vector<float>, 3> weights)
    : grid_(grid),
      fields_(std::move(fields)),
      weights_(std::move(weights)),
      stride_(grid.words * 64),
      ring_(2 * weights_[2].size() - 1),
      x_sums_(stride_ * grid.ny),
      x_rows_(grid.ny),
      sums_(stride_ * grid.ny),
      rows_(grid.ny) {
    for (Sums& sums : ring_) {
        sums.sums.resize(stride_ * grid.ny);
        sums.rows.resize(grid.ny);
    }
}

double WeightedSmoother::most() const {
    double most = static_cast<double>(fields_.size());
    for (const std::vector<float>& along : weights_) {
        double sum = static_cast<double>(along[0]);
        for (std::size_t n = 1; n < along.size(); ++n) sum += 2 * static_cast<double>(along[n]);
        most *= sum;
    }
    return most;
}

bool WeightedSmoother::sum_along_x(std::size_t row, float* out) const {
    const std::size_t words = grid_.words;
    bool any = false;
    for (const CloudBits field : fields_) {
        const std::uint64_t* const bits = field->data() + row * words;
        if (std::all_of(bits, bits + words, [](std::uint64_t word) { return word == 0; })) continue;
        if (!any) std::fill_n(out, stride_, 0.0F);
        any = true;
        for (std::size_t w = 0; w < words; ++w) {
            const std::uint64_t own = bits[w];
            const std::uint64_t before = w > 0 ? bits[w - 1] : 0;
            const std::uint64_t after = w + 1 < words ? bits[w + 1] : 0;
            if ((own | before | after) == 0) continue;
            for (std::size_t s = 0; s < weights_[0].size(); ++s) {
                std::uint64_t bytes[8] = {};
                add_bits(s == 0 ? own : own << s | before >> (64 - s), bytes);
                if (s > 0) add_bits(own >> s | after << (64 - s), bytes);
                std::uint8_t counts[64];
                std::memcpy(counts, bytes, 64);
                const float weight = weights_[0][s];
                float* const to = out + 64 * w;
                for (std::size_t i = 0; i < 64; ++i)
                    to[i] += weight * static_cast<float>(counts[i]);
            }
        }
    }
    return any;
}

const WeightedSmoother::Sums& WeightedSmoother::sums(std::size_t k) {
    Sums& sums = ring_[k % ring_.size()];
    if (sums.k == k) return sums;
    sums.k = k;
    const std::size_t reach = weights_[1].size() - 1;
    for (std::size_t j = 0; j < grid_.ny; ++j)
        x_rows_[j] = sum_along_x(grid_.row(j, k), &x_sums_[j * stride_]);
    for (std::size_t j = 0; j < grid_.ny; ++j) {
        sums.rows[j] = 0;
        const std::size_t last = std::min(j + reach, grid_.ny - 1);
        for (std::size_t n = j - std::min(j, reach); n <= last; ++n) {
            if (x_rows_[n] == 0) continue;
            add_row(&x_sums_[n * stride_], weights_[1][apart(n, j)], stride_, sums.rows[j] == 0,
                    &sums.sums[j * stride_]);
            sums.rows[j] = 1;
        }
    }
    return sums;
}

WeightedSmoother::Plane WeightedSmoother::plane(std::size_t k) {
    std::fill(rows_.begin(), rows_.end(), std::uint8_t{0});
    const std::size_t reach = weights_[2].size() - 1;
    const std::size_t last = std::min(k + reach, grid_.nz - 1);
    for (std::size_t n = k - std::min(k, reach); n <= last; ++n) {
        const Sums& near = sums(n);
        for (std::size_t j = 0; j < grid_.ny; ++j) {
            if (near.rows[j] == 0) continue;
            add_row(&near.sums[j * stride_], weights_[2][apart(n, k)], stride_, rows_[j] == 0,
                    &sums_[j * stride_]);
            rows_[j] = 1;
        }
    }
    return {sums_.data(), rows_.data(), stride_};
}

}  // namespace awan::automaton
