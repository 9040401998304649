// Particles on the lattices of core/survey/merge.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/generate/particle_set.h"

namespace awan {

// Classes of size, from the narrowest up.
inline constexpr int kMergeClasses = 48;

struct MergeScales {
    // Where node (0, 0, 0) of every lattice lies, scene units.
    glm::dvec3 origin{0};
    // Of class k, the least s; the cell of its lattice over that. Scene units.
    std::array<double, kMergeClasses + 1> least{}, cell_over_least{};
    double cell(int k) const {
        return cell_over_least[static_cast<std::size_t>(k)] * least[static_cast<std::size_t>(k)];
    }
    // The s of its merged particles: with the spline's own variance that of the least.
    double merged_s(int k) const;
};
// Classes of half an octave, with cells of 1.2. fine_tails: in the octave below the widest s, whose tails are the edge
// of what is seen, of a quarter of one, with cells of .9. Where the widest class begins: kWidestClass.
inline constexpr int kWidestClass = 39;
MergeScales merge_scales(const glm::dvec3& origin, double widest_s, bool fine_tails);
// The same, from class k on: what is narrower is in class 0 as well.
MergeScales from_class(const MergeScales& scales, int k);

// The class of a particle: 0 also where it is narrower; kMergeClasses where it is wider than all.
int merge_class(const MergeScales& scales, double s);

// A part of space, kMergeBlock nodes a side, in a class. Particles are in the block of the node nearest to them.
inline constexpr int kMergeBlock = 8;
struct MergeBlocks {
    // Which particles lie in the blocks: block b has order[first[b]] .. order[first[b + 1] - 1], in their own order.
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> first;
    // Of each block: its class and its place among the blocks of its class.
    struct Place {
        int size_class;
        glm::ivec3 at;
    };
    std::vector<Place> places;

    std::size_t size() const { return places.size(); }
};
// Blocks in the order of their first particles; the last may hold those that are never merged, of class kMergeClasses.
// EMPTY where the space has more blocks along a side than are counted.
MergeBlocks merge_blocks(const ParticleSet& particles, const MergeScales& scales, int threads);

// The particles merged where there are more of them than nodes: nodes first, then those that stay, in their own order.
// Mass is that of the particles but for the rounding of floats.
ParticleSet on_merge_lattices(const ParticleSet& particles, const MergeScales& scales,
                              const MergeBlocks& blocks, int threads);

}  // namespace awan
