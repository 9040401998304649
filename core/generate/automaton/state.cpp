#include "core/generate/automaton/state.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include "core/base/parallel.h"
#include "core/generate/automaton/parcels.h"
#include "core/generate/automaton/random_bits.h"
#include "core/generate/automaton/shape.h"
#include "core/generate/automaton/wind.h"

namespace awan::automaton {
namespace {

using Word = std::uint64_t;

// The keys of the random numbers of a step, one for each thing that they decide.
struct Keys {
    Keys(std::uint64_t key, std::uint64_t step) {
        const std::uint64_t own = keyed(keyed(key, 0x6175746f6d61746fu), step);
        hum = keyed(own, 0), hum_distance = keyed(own, 1);
        act = keyed(own, 2), act_distance = keyed(own, 3);
        ext = keyed(own, 4), ext_distance = keyed(own, 5);
        ext_outside = keyed(own, 6);
    }
    std::uint64_t hum, hum_distance, act, act_distance, ext, ext_distance, ext_outside;
};

struct Rules {
    Chance hum, act, ext, ext_outside;
};

Rules rules_of(const AutomatonCloud& cloud) {
    return {chance_of(cloud.humidity), chance_of(cloud.activation), chance_of(cloud.extinction),
            chance_of(cloud.outside_extinction)};
}

// The cells of `lanes`, which lie within ellipsoids, that get an event of probability p F(d) = p (1 - e). It is two
// independent events: one of probability p, and one "not e"; e is what FallOff::distance holds.
Word supplied(Word lanes, Chance p, const Word* distance, std::uint64_t key,
              std::uint64_t distance_key, std::uint64_t word) {
    const Word some = lanes_that_happen(lanes, p, key, word);
    return some & ~lanes_below(some, distance, distance_key, word);
}

// The activation bits (act) of a row and of its eight neighbours in y and z; null beyond the grid.
struct Neighbours {
    const Word* own;
    const Word* others[7];
    int count = 0;
};

Neighbours neighbours(const AutomatonGrid& grid, const std::vector<Word>& act, std::size_t j,
                      std::size_t k) {
    const auto at = [&](std::size_t jj, std::size_t kk) {
        return act.data() + grid.row(jj, kk) * grid.words;
    };
    Neighbours all{at(j, k), {}, 0};
    const auto add = [&](bool there, std::size_t jj, std::size_t kk) {
        if (there) all.others[all.count++] = at(jj, kk);
    };
    add(j >= 1, j - 1, k);
    add(j >= 2, j - 2, k);
    add(j + 1 < grid.ny, j + 1, k);
    add(k >= 1, j, k - 1);
    add(k >= 2, j, k - 2);
    add(k + 1 < grid.nz, j, k + 1);
    add(k + 2 < grid.nz, j, k + 2);
    return all;
}

Word near_act(const Neighbours& near, std::size_t w, std::size_t words) {
    const Word own = near.own[w];
    const Word before = w > 0 ? near.own[w - 1] : 0, after = w + 1 < words ? near.own[w + 1] : 0;
    Word any = (own << 1 | before >> 63) | (own << 2 | before >> 62) | (own >> 1 | after << 63) |
               (own >> 2 | after << 62);
    for (int n = 0; n < near.count; ++n) any |= near.others[n][w];
    return any;
}

struct Stepping {
    const AutomatonGrid& grid;
    const Rules& rules;
    const Keys& keys;
    const FallOff& fall_off;
    AutomatonState& state;
    std::vector<Word>& next_act;
};

// One step of a row. True when it has any bit set afterwards.
bool step_row(const Stepping& s, std::size_t j, std::size_t k) {
    const Neighbours near = neighbours(s.grid, s.state.act, j, k);
    const std::size_t first = s.grid.row(j, k) * s.grid.words;
    Word any = 0;
    for (std::size_t w = 0; w < s.grid.words; ++w) {
        const std::size_t word = first + w;
        const Word hum = s.state.hum[word], act = s.state.act[word], cld = s.state.cld[word];
        const Word inside = s.fall_off.inside[word];
        if ((hum | act | cld | inside) == 0) {
            s.next_act[word] = 0;
            continue;
        }
        const Word ready = hum & ~act;
        Word next_hum = ready, next_cld = cld | act;
        Word next_act = ready == 0 ? 0 : ready & near_act(near, w, s.grid.words);
        const Word* const distance = &s.fall_off.distance[word * kDistancePlanes];
        next_hum |= supplied(inside & ~next_hum, s.rules.hum, distance, s.keys.hum,
                             s.keys.hum_distance, word);
        next_act |= supplied(inside & ~next_act, s.rules.act, distance, s.keys.act,
                             s.keys.act_distance, word);
        if (next_cld != 0) {
            const Word some = lanes_that_happen(next_cld & inside, s.rules.ext, s.keys.ext, word);
            next_cld &= ~lanes_below(some, distance, s.keys.ext_distance, word);
            next_cld &= ~lanes_that_happen(next_cld & ~inside, s.rules.ext_outside,
                                           s.keys.ext_outside, word);
        }
        s.state.hum[word] = next_hum;
        s.next_act[word] = next_act;
        s.state.cld[word] = next_cld;
        any |= next_hum | next_act | next_cld;
    }
    return any != 0;
}

Status fall_off_of(const AutomatonCloud& cloud, const AutomatonGrid& grid, int threads,
                   const Deadline& deadline, const AutomatonState& state,
                   AutomatonScratch& scratch) {
    if (scratch.fall_off_ready) return std::nullopt;
    if (scratch.fall_off.shape.empty()) scratch.fall_off.shape = fall_off_digits(cloud);
    if (Status late = make_fall_off(grid, state.ellipsoids, cloud.overlap, cloud.base, threads,
                                    deadline, scratch.fall_off))
        return late;
    scratch.fall_off_ready = true;
    return std::nullopt;
}

// Finds which rows have any bit set, for a scratch that has seen no step of this state.
void find_lives(const AutomatonGrid& grid, const AutomatonState& state, AutomatonScratch& scratch) {
    scratch.row_lives.assign(grid.rows(), 0);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        Word any = 0;
        for (std::size_t w = row * grid.words; w < (row + 1) * grid.words; ++w)
            any |= state.hum[w] | state.act[w] | state.cld[w];
        scratch.row_lives[row] = any != 0;
    }
}

}  // namespace

std::uint64_t rules_key(const AutomatonCloud& cloud) {
    std::uint64_t key = 0;
    for (const char digit : automaton_rules_of(cloud))
        key = keyed(key, static_cast<std::uint64_t>(digit));
    return key;
}

Result<AutomatonState> first_state(const AutomatonCloud& cloud, std::uint64_t key, int threads,
                                   const Deadline& deadline, AutomatonScratch& scratch) {
    const AutomatonGrid grid(cloud.cells);
    AutomatonState state;
    state.nx = grid.nx, state.ny = grid.ny, state.nz = grid.nz;
    state.key = key;
    state.rules = rules_key(cloud);
    state.ellipsoids = first_ellipsoids(cloud, key);
    scratch.fall_off_ready = false;
    if (Status late = fall_off_of(cloud, grid, threads, deadline, state, scratch)) return *late;
    for (auto* bits : {&state.hum, &state.act, &state.cld}) bits->assign(grid.all_words(), 0);
    const Rules rules = rules_of(cloud);
    const Keys keys(key, UINT64_MAX);
    for (std::size_t word = 0; word < grid.all_words(); ++word) {
        const Word inside = scratch.fall_off.inside[word];
        if (inside == 0) continue;
        const Word* const distance = &scratch.fall_off.distance[word * kDistancePlanes];
        state.hum[word] = supplied(inside, rules.hum, distance, keys.hum, keys.hum_distance, word);
        state.act[word] = supplied(inside, rules.act, distance, keys.act, keys.act_distance, word);
    }
    find_lives(grid, state, scratch);
    return state;
}

Status step_automaton(const AutomatonCloud& cloud, int threads, const Deadline& deadline,
                      AutomatonScratch& scratch, AutomatonState& state) {
    const AutomatonGrid grid(cloud.cells);
    if (scratch.first.empty() && !state.ellipsoids.empty())
        scratch.first = first_ellipsoids(cloud, state.key);
    if (scratch.row_lives.size() != grid.rows()) find_lives(grid, state, scratch);
    if (!cloud.wind.ellipsoids.empty() &&
        move_ellipsoids(cloud, scratch.first, state.key, state.step, state.ellipsoids))
        scratch.fall_off_ready = false;
    if (Status late = fall_off_of(cloud, grid, threads, deadline, state, scratch)) return late;
    if (cloud.smooth_steps > 1) {
        state.earlier.insert(state.earlier.begin(), state.cld);
        if (state.earlier.size() >= cloud.smooth_steps) state.earlier.pop_back();
    }

    scratch.act.resize(grid.all_words());
    const Rules rules = rules_of(cloud);
    const Keys keys(state.key, state.step);
    const Stepping stepping{grid, rules, keys, scratch.fall_off, state, scratch.act};
    std::atomic<bool> late{false};
    const double work = static_cast<double>(grid.all_words()) * 40;
    parallel_for(useful_threads(threads, work), grid.nz, [&](std::size_t k) {
        if (late.load(std::memory_order_relaxed) || deadline.over()) {
            late = true;
            return;
        }
        for (std::size_t j = 0; j < grid.ny; ++j) {
            const std::size_t row = grid.row(j, k);
            std::uint8_t& lives = scratch.row_lives[row];
            if (lives == 0 && scratch.fall_off.row_inside[row] == 0)
                std::fill_n(scratch.act.begin() + static_cast<std::ptrdiff_t>(row * grid.words),
                            grid.words, Word{0});
            else
                lives = step_row(stepping, j, k);
        }
    });
    if (auto error = deadline.over()) return *error;
    std::swap(state.act, scratch.act);
    shift_layers(cloud.wind, state.step, grid, {&state.hum, &state.act, &state.cld},
                 scratch.row_lives);
    ++state.step;
    return std::nullopt;
}

}  // namespace awan::automaton
