// Which of many items touch each of many places.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace awan::truth {

// Lists of those of n items that touch each of the places 0..lists - 1, as begin/items, in the items' order.
// touch(i, put) calls put(place) for every place that item i touches.
template <typename Touch>
void make_lists(std::size_t lists, std::size_t n, std::vector<std::uint32_t>& begin,
                std::vector<std::uint32_t>& items, const Touch& touch) {
    begin.assign(lists + 1, 0);
    for (std::size_t i = 0; i < n; ++i) touch(i, [&](std::size_t list) { ++begin[list + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    items.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t i = 0; i < n; ++i)
        touch(i, [&](std::size_t list) { items[next[list]++] = static_cast<std::uint32_t>(i); });
}

}  // namespace awan::truth
