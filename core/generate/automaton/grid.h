// The lattice of an automaton as rows of 64-bit words: cell i of a row is bit i % 64 of word i / 64; bits beyond the
// row's length are 0. Rows along x, then y, then z.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace awan::automaton {

// The shape of the lattice.
struct AutomatonGrid {
    explicit AutomatonGrid(const glm::dvec3& cells)
        : nx(static_cast<std::size_t>(cells.x)),
          ny(static_cast<std::size_t>(cells.y)),
          nz(static_cast<std::size_t>(cells.z)),
          words((nx + 63) / 64) {}

    std::size_t rows() const { return ny * nz; }
    std::size_t all_words() const { return rows() * words; }
    std::size_t row(std::size_t j, std::size_t k) const { return k * ny + j; }
    // The bits of a row's last word that are cells.
    std::uint64_t last_mask() const { return nx % 64 == 0 ? ~0ull : (1ull << nx % 64) - 1; }

    std::size_t nx, ny, nz;
    // Words of one row.
    std::size_t words;
};

// How many threads are worth their start for work of so many nanoseconds.
inline int useful_threads(int threads, double nanoseconds) {
    constexpr double kWorthAThread = 2e5;
    const double most = nanoseconds / kWorthAThread;
    return most < 1 ? 1 : most < threads ? static_cast<int>(most) : threads;
}

}  // namespace awan::automaton
