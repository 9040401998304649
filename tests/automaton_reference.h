// The automaton once more, one byte a cell and one random number a cell, straight from its rules: what the words of
// core/generate/automaton must agree with bit by bit. Shares with it the keyed random words, the ellipsoids and their
// d.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "core/base/exact_math.h"
#include "core/generate/automaton/parcels.h"
#include "core/generate/keyed_random.h"
#include "core/scene/automaton.h"

namespace awan::test {

struct PlainAutomaton {
    PlainAutomaton(const AutomatonCloud& c, std::uint64_t k)
        : cloud(c),
          key(k),
          nx(static_cast<int>(c.cells.x)),
          ny(static_cast<int>(c.cells.y)),
          nz(static_cast<int>(c.cells.z)),
          first(automaton::first_ellipsoids(c, k)),
          ellipsoids(first) {
        const std::size_t n = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) *
                              static_cast<std::size_t>(nz);
        hum.assign(n, 0), act.assign(n, 0), cld.assign(n, 0);
        const std::uint64_t step = UINT64_MAX;
        each([&](int x, int y, int z) {
            const int d = digits(x, y, z);
            if (d < 0) return;
            hum[at(x, y, z)] =
                happens(cloud.humidity, step, 0, x, y, z) && random16(step, 1, x, y, z) >= d;
            act[at(x, y, z)] =
                happens(cloud.activation, step, 2, x, y, z) && random16(step, 3, x, y, z) >= d;
        });
    }

    void step_once() {
        automaton::move_ellipsoids(cloud, first, key, step, ellipsoids);
        std::vector<std::uint8_t> h = hum, a = act, c = cld;
        each([&](int x, int y, int z) {
            const std::size_t n = at(x, y, z);
            h[n] = hum[n] && !act[n];                       // (3.1)
            c[n] = cld[n] || act[n];                        // (3.2)
            a[n] = !act[n] && hum[n] && any_near(x, y, z);  // (3.3)
            const int d = digits(x, y, z);
            if (d >= 0) {
                if (happens(cloud.extinction, step, 4, x, y, z) && random16(step, 5, x, y, z) < d)
                    c[n] = 0;  // (3.5)
                if (happens(cloud.humidity, step, 0, x, y, z) && random16(step, 1, x, y, z) >= d)
                    h[n] = 1;  // (3.6)
                if (happens(cloud.activation, step, 2, x, y, z) && random16(step, 3, x, y, z) >= d)
                    a[n] = 1;  // (3.7)
            } else if (happens(cloud.outside_extinction, step, 6, x, y, z)) {
                c[n] = 0;
            }
        });
        hum = shifted(h), act = shifted(a), cld = shifted(c);
        ++step;
    }

    bool any_near(int x, int y, int z) const {  // (3.4)
        constexpr int kNear[11][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0},
                                      {0, 0, 1}, {0, 0, -1}, {2, 0, 0}, {-2, 0, 0},
                                      {0, 0, 2}, {0, 0, -2}, {0, -2, 0}};
        for (const auto& d : kNear)
            if (get(act, x + d[0], y + d[1], z + d[2])) return true;
        return false;
    }

    // Whole cells in step `step` of what moves so many a step.
    int cells_of(double v) const {
        return static_cast<int>(std::floor(v * static_cast<double>(step + 1)) -
                                std::floor(v * static_cast<double>(step)));
    }
    // Cells a step along x and z at height h, by the sine and the cosine of where it blows to.
    glm::dvec2 speed_at(const AutomatonSpeed& wind, double h) const {
        const double v = wind.constant + wind.linear * h + wind.quadratic * h * h;
        const auto to =
            exact::sincos_degrees(wind.direction.value_or(cloud.wind.direction) + wind.turn * h);
        return {v * to.sin, v * to.cos};
    }
    std::vector<std::uint8_t> shifted(
        const std::vector<std::uint8_t>& bits) const {  // (3.8)-(3.10)
        std::vector<std::uint8_t> to(bits.size(), 0);
        each([&](int x, int y, int z) {
            const double h = y + 0.5;
            glm::dvec2 v = speed_at(cloud.wind.layers, h);
            for (const AutomatonWindBand& band : cloud.wind.layer_bands)
                if (h >= band.from && h <= band.to) v += speed_at(band.speed, h);
            to[at(x, y, z)] =
                static_cast<std::uint8_t>(get(bits, x - cells_of(v.x), y, z - cells_of(v.y)));
        });
        return to;
    }

    // floor((1 - F(d)) 2^16) of the ellipsoid that says; -1 outside.
    int digits(int x, int y, int z) const {
        const int d = distance(x, y, z);
        if (d < 0 || cloud.fall_off == AutomatonShape::kLinear) return d;
        const double u = d / 65536.0;
        double f = 0;
        if (cloud.fall_off == AutomatonShape::kQuadratic) f = 1 - u * u;
        if (cloud.fall_off == AutomatonShape::kSmooth) f = 1 - 3 * u * u + 2 * u * u * u;
        if (cloud.fall_off == AutomatonShape::kTable) {
            const auto last = cloud.fall_off_table.size() - 1;
            const auto n = static_cast<std::size_t>(u * static_cast<double>(last));
            const double share = u * static_cast<double>(last) - static_cast<double>(n);
            f = (1 - share) * static_cast<double>(cloud.fall_off_table[n]) +
                share * static_cast<double>(cloud.fall_off_table[n + 1]);
        }
        return std::clamp(static_cast<int>(std::floor((1 - f) * 65536)), 0, 65535);
    }

    // floor(d 2^16) of the ellipsoid that says, in float as the tables have it; -1 outside.
    int distance(int x, int y, int z) const {
        if (y + 0.5 < cloud.base) return -1;
        int best = -1;
        for (const AutomatonEllipsoid& e : ellipsoids) {
            const double v = (y + 0.5 - e.center.y) / e.radii.y,
                         w = (z + 0.5 - e.center.z) / e.radii.z;
            const double rest = v * v + w * w;
            if (!(rest < 1)) continue;
            // The row's origin as the table takes it: d differs in the last bit of a float from another.
            const double middle = e.center.x - 0.5;
            const double begin = std::clamp(
                std::floor(middle - (std::sqrt(1 - rest) * e.radii.x + 1)), 0.0, cloud.cells.x);
            const float along = (static_cast<float>(begin - middle) +
                                 static_cast<float>(x - static_cast<int>(begin))) *
                                static_cast<float>(1 / e.radii.x);
            const float square = along * along + static_cast<float>(rest);
            if (x < begin || !(square < 1.0F)) continue;
            const auto d = static_cast<int>(std::sqrt(square) * 65536.0F);
            if (d >= 65536) continue;
            if (cloud.overlap == AutomatonOverlap::kFirst) return d;
            best = best < 0 || d < best ? d : best;
        }
        return best;
    }

    std::uint64_t words_of(int x, int y, int z) const {
        const int words = (nx + 63) / 64;
        return static_cast<std::uint64_t>((z * ny + y) * words + x / 64);
    }
    int bit(std::uint64_t of, int what, unsigned plane, int x, int y, int z) const {
        const std::uint64_t own = keyed(keyed(key, 0x6175746f6d61746fu), of);
        const std::uint64_t word =
            keyed(keyed(own, static_cast<std::uint64_t>(what)), words_of(x, y, z) << 7 | plane);
        return static_cast<int>(word >> (x % 64) & 1);
    }
    bool happens(double p, std::uint64_t of, int what, int x, int y, int z) const {
        std::uint64_t random = 0;
        for (unsigned plane = 0; plane < 64; ++plane)
            random = random << 1 | static_cast<std::uint64_t>(bit(of, what, plane, x, y, z));
        return p >= 1 || random < static_cast<std::uint64_t>(p * 0x1p64);
    }
    int random16(std::uint64_t of, int what, int x, int y, int z) const {
        int random = 0;
        for (unsigned plane = 0; plane < 16; ++plane)
            random = random << 1 | bit(of, what, plane, x, y, z);
        return random;
    }

    std::size_t at(int x, int y, int z) const {
        return static_cast<std::size_t>((z * ny + y) * nx + x);
    }
    int get(const std::vector<std::uint8_t>& bits, int x, int y, int z) const {
        const bool in = x >= 0 && x < nx && y >= 0 && y < ny && z >= 0 && z < nz;
        return in ? bits[at(x, y, z)] : 0;
    }
    template <typename Do>
    void each(Do run) const {
        for (int z = 0; z < nz; ++z)
            for (int y = 0; y < ny; ++y)
                for (int x = 0; x < nx; ++x) run(x, y, z);
    }

    AutomatonCloud cloud;
    std::uint64_t key, step = 0;
    int nx, ny, nz;
    std::vector<AutomatonEllipsoid> first, ellipsoids;
    std::vector<std::uint8_t> hum, act, cld;
};

}  // namespace awan::test
