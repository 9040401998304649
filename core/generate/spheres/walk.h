// Goes through a hierarchy of spheres on all threads, each of which holds nothing but its way down in memory.
#pragma once

#include <atomic>
#include <vector>

#include "core/base/deadline.h"
#include "core/base/parallel.h"
#include "core/generate/spheres/subdivision.h"

namespace awan::spheres {

// The pieces of work: the subtrees below the spheres of level 3, and as the last one what lies above, or ends above
// them.
inline std::size_t walk_subtrees(const SphereTree& tree) {
    const auto parts = static_cast<std::size_t>(tree.parts());
    return parts * parts * parts;
}
inline std::size_t walk_tasks(const SphereTree& tree) {
    return walk_subtrees(tree) + 1;
}

namespace walk_detail {

struct Subtree {
    SphereNode node;
    bool present = false;
};

template <typename Divide>
void below(const SphereTree& tree, const SphereNode& node, int level, std::size_t task,
           const Divide& divide) {
    if (!divide(node, level, task) || level == tree.levels()) return;
    for (const SphereNode& child : tree.children(node, level))
        below(tree, child, level + 1, task, divide);
}

template <typename Divide>
void above(const SphereTree& tree, const SphereNode& node, int level, std::size_t place,
           std::vector<Subtree>& subtrees, const Divide& divide) {
    if (level == 3) {
        subtrees[place] = {node, true};
        return;
    }
    if (!divide(node, level, subtrees.size()) || level == tree.levels()) return;
    std::size_t j = 0;
    for (const SphereNode& child : tree.children(node, level))
        above(tree, child, level + 1, static_cast<std::size_t>(tree.parts()) * place + j++,
              subtrees, divide);
}

}  // namespace walk_detail

// Calls divide(node, level, task) -> bool for the root, and for the children of every sphere for which it said true
// (leaves are not divided whatever it says). Within one task: parents first, in order, on one thread. False when the
// deadline was over.
template <typename Divide>
bool walk_spheres(const SphereTree& tree, int threads, const Deadline& deadline,
                  const Divide& divide) {
    std::vector<walk_detail::Subtree> subtrees(walk_subtrees(tree));
    walk_detail::above(tree, tree.root(), 0, 0, subtrees, divide);
    std::atomic<bool> late{false};
    parallel_for(threads, subtrees.size(), [&](std::size_t task) {
        if (!subtrees[task].present || late.load(std::memory_order_relaxed)) return;
        if (deadline.over()) {
            late = true;
            return;
        }
        walk_detail::below(tree, subtrees[task].node, 3, task, divide);
    });
    return !late;
}

}  // namespace awan::spheres
