// Particles on the lattices of core/survey/merge.h.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/generate/particle_set.h"

namespace awan {

// Classes of size, half an octave each, from the narrowest up.
inline constexpr int kMergeClasses = 48;

struct MergeScales {
    // Where node (0, 0, 0) of every lattice lies, scene units.
    glm::dvec3 origin{0};
    // Of class k, the least s; the cell of its lattice; the s of its merged particles. Scene units.
    std::array<double, kMergeClasses + 1> least{};
    double cell(int k) const { return 1.2 * least[static_cast<std::size_t>(k)]; }
    double merged_s(int k) const { return 0.8 * least[static_cast<std::size_t>(k)]; }
};
// least: of class 0, > 0.
MergeScales merge_scales(const glm::dvec3& origin, double least);

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
