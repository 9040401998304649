// States of automata that are kept while they run, so that a frame of a long sequence is made from the one before it,
// or from a state some steps earlier, and not from the beginning.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/generate/automaton/state.h"
#include "core/scene/scene.h"

namespace awan::automaton {

// Memory that a state takes.
std::size_t bytes_of(const AutomatonState& state);

// Of each automaton, those at every so many steps, and the one that was asked for last. So many bytes at most: then the
// automata that were not asked for longest go, and of the last one every other state, so that those left stand twice as
// far apart. Thread-safe.
class KeptStates {
  public:
    explicit KeptStates(std::size_t most_bytes) : most_bytes_(most_bytes) {}

    // The latest not after `step` of the automaton of that rules_key() and key; null: there is none.
    std::shared_ptr<const AutomatonState> latest(std::uint64_t rules, std::uint64_t key,
                                                 std::uint64_t step);
    // A state that was made on the way to another; it is kept where it stands at such a step.
    void pass(const AutomatonState& state);
    // One that was asked for.
    void arrive(const AutomatonState& state);

    std::size_t bytes_in_use() const;
    std::size_t states() const;

  private:
    // What was kept of one automaton.
    struct Run {
        // Steps from one state to the next: a power of 2.
        std::uint64_t interval = 8;
        std::map<std::uint64_t, std::shared_ptr<const AutomatonState>> at;
        // The step that was asked for last.
        std::uint64_t asked = 0;
        std::uint64_t used = 0;
    };
    // Rules and key.
    using Name = std::pair<std::uint64_t, std::uint64_t>;

    Run& run_of(const AutomatonState& state);
    void keep(const AutomatonState& state, Run& run);
    void drop(Run& run, std::uint64_t step);
    void make_room(std::size_t bytes, Run& run);

    mutable std::mutex mutex_;
    const std::size_t most_bytes_;
    std::size_t used_ = 0;
    std::uint64_t clock_ = 0;
    std::map<Name, Run> runs_;
};

// Lets all automata of the scene keep theirs there.
void keep_states(SceneDraft& draft, const std::shared_ptr<KeptStates>& kept);

}  // namespace awan::automaton
