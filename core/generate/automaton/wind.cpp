#include "core/generate/automaton/wind.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/exact_math.h"

namespace awan::automaton {
namespace {

using Word = std::uint64_t;

glm::dvec2 velocity(const AutomatonWind& wind, const AutomatonSpeed& speed, double y) {
    const double v = speed.constant + speed.linear * y + speed.quadratic * y * y;
    if (v == 0) return {0, 0};
    const exact::SinCos to =
        exact::sincos_degrees(speed.direction.value_or(wind.direction) + speed.turn * y);
    return {v * to.sin, v * to.cos};
}

glm::dvec2 of_bands(const AutomatonWind& wind, const std::vector<AutomatonWindBand>& bands,
                    double y) {
    glm::dvec2 sum(0);
    for (const AutomatonWindBand& band : bands)
        if (y >= band.from && y <= band.to) sum += velocity(wind, band.speed, y);
    return sum;
}

// Shifts the bits of a row by `by` cells towards +x. What leaves is lost; zeros come in.
void shift_row(Word* row, std::size_t words, std::int64_t by, Word last_mask) {
    const auto bits = static_cast<std::uint64_t>(std::abs(by));
    const std::size_t whole = static_cast<std::size_t>(bits / 64);
    const unsigned part = bits % 64;
    const auto get = [&](std::size_t w, bool there) { return there ? row[w] : 0; };
    if (by > 0)
        for (std::size_t w = words; w-- > 0;) {
            const Word near = get(w - whole, w >= whole);
            const Word far = get(w - whole - 1, w >= whole + 1);
            row[w] = part == 0 ? near : near << part | far >> (64 - part);
        }
    else
        for (std::size_t w = 0; w < words; ++w) {
            const Word near = get(w + whole, w + whole < words);
            const Word far = get(w + whole + 1, w + whole + 1 < words);
            row[w] = part == 0 ? near : near >> part | far << (64 - part);
        }
    row[words - 1] &= last_mask;
}

// By how many whole cells something as fast as that moves in step `step`.
std::int64_t whole_cells(double speed, std::uint64_t step) {
    // A shift of more than the widest grid empties it just as well.
    const double one = std::clamp(speed, -2048.0, 2048.0);
    const double before = std::floor(one * static_cast<double>(step));
    return static_cast<std::int64_t>(std::floor(one * static_cast<double>(step + 1)) - before);
}

// Moves the rows of layer j by `by` cells towards +z. What leaves is lost; empty rows come in.
void shift_rows(const AutomatonGrid& grid, std::size_t j, std::int64_t by,
                const std::array<std::vector<Word>*, 3>& fields,
                std::vector<std::uint8_t>& row_lives) {
    const auto nz = static_cast<std::int64_t>(grid.nz);
    for (std::int64_t n = 0; n < nz; ++n) {
        // Those that are moved onto others come before these are moved.
        const std::int64_t k = by > 0 ? nz - 1 - n : n, from = k - by;
        const std::size_t to_row = grid.row(j, static_cast<std::size_t>(k));
        std::uint8_t& lives = row_lives[to_row];
        const bool comes = from >= 0 && from < nz;
        const std::size_t from_row = comes ? grid.row(j, static_cast<std::size_t>(from)) : to_row;
        const bool moves = comes && row_lives[from_row] != 0;
        for (std::vector<Word>* const bits : fields) {
            Word* const to = bits->data() + to_row * grid.words;
            if (moves)
                std::copy_n(bits->data() + from_row * grid.words, grid.words, to);
            else if (lives != 0)
                std::fill_n(to, grid.words, Word{0});
        }
        lives = moves ? 1 : 0;
    }
}

}  // namespace

glm::dvec2 wind_on_layers(const AutomatonWind& wind, double y) {
    return velocity(wind, wind.layers, y) + of_bands(wind, wind.layer_bands, y);
}

glm::dvec2 wind_on_ellipsoids(const AutomatonWind& wind, double y) {
    return of_bands(wind, wind.ellipsoids, y);
}

void shift_layers(const AutomatonWind& wind, std::uint64_t step, const AutomatonGrid& grid,
                  const std::array<std::vector<Word>*, 3>& fields,
                  std::vector<std::uint8_t>& row_lives) {
    if (wind.layers.still() && wind.layer_bands.empty()) return;
    for (std::size_t j = 0; j < grid.ny; ++j) {
        const glm::dvec2 speed = wind_on_layers(wind, static_cast<double>(j) + 0.5);
        const std::int64_t along_x = whole_cells(speed.x, step),
                           along_z = whole_cells(speed.y, step);
        if (along_z != 0) shift_rows(grid, j, along_z, fields, row_lives);
        for (std::size_t k = 0; k < grid.nz && along_x != 0; ++k)
            if (row_lives[grid.row(j, k)] != 0)
                for (std::vector<Word>* const bits : fields)
                    shift_row(bits->data() + grid.row(j, k) * grid.words, grid.words, along_x,
                              grid.last_mask());
    }
}

}  // namespace awan::automaton
