// An automaton beside the plain one, step by step.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <string>

#include "core/generate/automaton/run.h"
#include "tests/automaton_reference.h"

namespace awan::test {

inline void expect_same_bits(const AutomatonCloud& cloud, const AutomatonState& state,
                             const PlainAutomaton& plain, const std::string& what) {
    const automaton::AutomatonGrid grid(cloud.cells);
    int differ = 0, set = 0;
    const std::array<std::pair<const std::vector<std::uint64_t>*, const std::vector<std::uint8_t>*>,
                     3>
        fields = {{{&state.hum, &plain.hum}, {&state.act, &plain.act}, {&state.cld, &plain.cld}}};
    for (const auto& [bits, bytes] : fields) {
        std::uint64_t population = 0;
        for (const std::uint64_t word : *bits)
            population += static_cast<std::uint64_t>(std::popcount(word));
        plain.each([&](int x, int y, int z) {
            const std::size_t row =
                grid.row(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
            const auto i = static_cast<std::size_t>(x);
            const bool bit = ((*bits)[row * grid.words + i / 64] >> (i % 64) & 1) != 0;
            differ += bit != (plain.get(*bytes, x, y, z) != 0);
            set += bit;
            population -= bit;
        });
        EXPECT_EQ(population, 0u) << what << ": bits where there are no cells";
    }
    EXPECT_EQ(differ, 0) << what << ", " << set << " set";
}

// Steps both and compares after each; the clouds that there were in all.
inline std::uint64_t compare(const AutomatonCloud& cloud, std::uint64_t key, int steps,
                             const std::string& what) {
    automaton::AutomatonScratch scratch;
    auto state = *automaton::first_state(cloud, key, 1, {}, scratch);
    PlainAutomaton plain(cloud, key);
    expect_same_bits(cloud, state, plain, what + " at first");
    std::uint64_t clouds = 0;
    for (int n = 0; n < steps; ++n) {
        EXPECT_FALSE(automaton::step_automaton(cloud, 1, {}, scratch, state));
        plain.step_once();
        expect_same_bits(cloud, state, plain, what + " after step " + std::to_string(n));
        for (const std::uint64_t word : state.cld)
            clouds += static_cast<std::uint64_t>(std::popcount(word));
    }
    return clouds;
}

inline AutomatonCloud busy(double nx, double ny, double nz) {
    AutomatonCloud cloud;
    cloud.cells = {nx, ny, nz};
    RandomEllipsoids random;
    random.count = 4;
    random.smallest = {2, 2, 2};
    random.largest = {nx / 2 + 2, ny / 2 + 2, nz / 2 + 2};
    random.level.reset();
    cloud.random = random;
    cloud.base = 1;
    cloud.humidity = 0.3;
    cloud.activation = 0.03;
    cloud.extinction = 0.3;
    return cloud;
}

}  // namespace awan::test
