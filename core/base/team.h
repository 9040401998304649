// Threads that take many short steps of one work together, each its share, and wait for each other between them.
#pragma once

#include <barrier>
#include <cstddef>

#include "core/base/parallel.h"

namespace awan {

class Team {
  public:
    explicit Team(std::size_t members)
        : size_(members), barrier_(static_cast<std::ptrdiff_t>(members)) {}

    std::size_t size() const { return size_; }
    // Until all members are here.
    void wait() {
        if (size_ > 1) barrier_.arrive_and_wait();
    }
    struct Share {
        std::size_t begin, end;
    };
    // Of `count` items, one member's.
    Share share_of(std::size_t member, std::size_t count) const {
        return {count * member / size_, count * (member + 1) / size_};
    }

  private:
    std::size_t size_;
    std::barrier<> barrier_;
};

// Calls work(member) once for each member, all at the same time: as many threads as the team has members.
template <typename Work>
void run_team(const Team& team, const Work& work) {
    parallel_for(static_cast<int>(team.size()), team.size(), work);
}

}  // namespace awan
