#include "core/survey/merge_lattice.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <glm/common.hpp>
#include <memory>
#include <unordered_map>

#include "core/base/instruction_sets.h"
#include "core/base/parallel.h"
#include "core/generate/gaussian.h"

namespace awan {
namespace {

// Nodes that a particle reaches to either side of its nearest one.
constexpr int kNodesReached = 2;
constexpr int kWithRim = kMergeBlock + 2 * kNodesReached;
constexpr std::size_t kRimNodes = std::size_t{kWithRim} * kWithRim * kWithRim;
constexpr std::size_t kOwnNodes = std::size_t{kMergeBlock} * kMergeBlock * kMergeBlock;
// A block with fewer particles is not merged: it bounds what merging holds in memory.
constexpr std::size_t kLeastOfBlock = 1024;
// Particles to nodes, from which on a block is merged.
constexpr double kWorth = 1.5;
// Nodes with less than this share of the mean mass of their class are left out; the others have what they had.
constexpr double kFaint = 0.01;
// Bits of a block's place along an axis.
constexpr int kPlaceBits = 19;
constexpr double kMostPlaces = 1 << kPlaceBits;
// Particles that a thread takes at a time.
constexpr std::size_t kShare = 1u << 15;

std::size_t rim_index(int x, int y, int z) {
    return static_cast<std::size_t>((z * kWithRim + y) * kWithRim + x);
}

std::uint64_t key_of(int size_class, const glm::ivec3& at) {
    std::uint64_t key = static_cast<std::uint64_t>(size_class);
    for (int axis = 0; axis < 3; ++axis)
        key = key << kPlaceBits | static_cast<std::uint64_t>(at[axis] + 1);
    return key;
}

// A particle on the lattice of its class.
struct OnLattice {
    glm::dvec3 place;    // in cells
    glm::ivec3 nearest;  // node
};
AWAN_INLINE OnLattice on_lattice(const ParticleSet& particles, std::size_t i,
                                 const MergeScales& scales, double per_cell) {
    OnLattice on;
    on.place = (particles.center[i] - scales.origin) * per_cell;
    // Places are above 0: truncating is rounding down, without a call.
    on.nearest = glm::ivec3(on.place + 0.5);
    return on;
}

// Of a particle's mass, what each of the five nodes around gets along an axis. off: of the particle from the nearest
// node, -1/2..1/2; spread: variance that is still missing, in cells squared.
void shares_of(double off, double spread, double* shares) {
    const double low = 0.5 - off, high = 0.5 + off;
    const double plain[3] = {0.5 * low * low, 0.75 - off * off, 0.5 * high * high};
    const double side = 0.5 * spread, middle = 1 - spread;
    shares[0] = side * plain[0];
    shares[1] = middle * plain[0] + side * plain[1];
    shares[2] = side * (plain[0] + plain[2]) + middle * plain[1];
    shares[3] = middle * plain[2] + side * plain[1];
    shares[4] = side * plain[2];
}

// Mass over (2 pi)^1.5, which every Gaussian has in common.
double mass_at(const ParticleSet& particles, std::size_t i) {
    const double s = gaussian_s(particles, i);
    return static_cast<double>(particles.density[i]) * s * s * s;
}

// What a block's particles bring to its nodes and to those within kNodesReached of it. EMPTY: the block is not merged.
using Rim = std::vector<double>;

Rim rim_of(const ParticleSet& particles, const MergeScales& scales, const MergeBlocks& blocks,
           std::size_t block) {
    const auto& [size_class, at] = blocks.places[block];
    const std::size_t first = blocks.first[block], last = blocks.first[block + 1];
    if (size_class == kMergeClasses || last - first < kLeastOfBlock) return {};
    const double per_cell = 1 / scales.cell(size_class);
    const double least = scales.least[static_cast<std::size_t>(size_class)];
    const glm::ivec3 corner = at * kMergeBlock - kNodesReached;
    std::bitset<kRimNodes> near;
    for (std::size_t n = first; n < last; ++n) {
        const glm::ivec3 node =
            on_lattice(particles, blocks.order[n], scales, per_cell).nearest - corner;
        near.set(rim_index(node.x, node.y, node.z));
    }
    std::size_t nodes = 0;
    for (int z = 1; z < kWithRim - 1; ++z)
        for (int y = 1; y < kWithRim - 1; ++y)
            for (int x = 1; x < kWithRim - 1; ++x) {
                bool reached = false;
                for (int n = 0; n < 27 && !reached; ++n)
                    reached = near[rim_index(x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1)];
                nodes += reached ? 1 : 0;
            }
    if (static_cast<double>(last - first) < kWorth * static_cast<double>(nodes)) return {};
    Rim rim(kRimNodes);
    for (std::size_t n = first; n < last; ++n) {
        const std::size_t i = blocks.order[n];
        const OnLattice on = on_lattice(particles, i, scales, per_cell);
        const double s = gaussian_s(particles, i);
        const double spread = std::max(0.0, (s * s - least * least) * per_cell * per_cell);
        double shares[3][5];
        for (int axis = 0; axis < 3; ++axis)
            shares_of(on.place[axis] - on.nearest[axis], spread, shares[axis]);
        const double mass = mass_at(particles, i);
        const glm::ivec3 low = on.nearest - corner - kNodesReached;
        // Without spread the outer shares are 0.
        const int from = spread > 0 ? 0 : 1, to_end = 5 - from;
        for (int z = from; z < to_end; ++z)
            for (int y = from; y < to_end; ++y) {
                const double row = mass * shares[2][z] * shares[1][y];
                double* const to = &rim[rim_index(low.x, low.y + y, low.z + z)];
                for (int x = from; x < to_end; ++x) to[x] += row * shares[0][x];
            }
    }
    return rim;
}

// The nodes of a block that some merged block brings matter to.
struct Nodes {
    int size_class;
    glm::ivec3 at;
    std::array<double, kOwnNodes> mass;
};

// Sums up what the blocks around bring, always in the same order.
void take_rims(const std::unordered_map<std::uint64_t, const Rim*>& rims, Nodes& nodes) {
    nodes.mass.fill(0);
    for (int n = 0; n < 27; ++n) {
        const glm::ivec3 apart(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        const auto found = rims.find(key_of(nodes.size_class, nodes.at + apart));
        if (found == rims.end()) continue;
        // A node of this block, as the other one counts it.
        const glm::ivec3 shift = kNodesReached - apart * kMergeBlock;
        const glm::ivec3 low = glm::max(-shift, glm::ivec3(0)),
                         high = glm::min(kWithRim - shift, glm::ivec3(kMergeBlock));
        for (int z = low.z; z < high.z; ++z)
            for (int y = low.y; y < high.y; ++y)
                for (int x = low.x; x < high.x; ++x)
                    nodes.mass[static_cast<std::size_t>((z * kMergeBlock + y) * kMergeBlock + x)] +=
                        (*found->second)[rim_index(x + shift.x, y + shift.y, z + shift.z)];
    }
}

// Blocks in whose nodes there is matter, by their keys.
std::vector<Nodes> touched_blocks(const MergeBlocks& blocks, const std::vector<Rim>& rims) {
    std::vector<std::pair<std::uint64_t, MergeBlocks::Place>> touched;
    for (std::size_t b = 0; b < rims.size(); ++b) {
        if (rims[b].empty()) continue;
        const auto& [size_class, at] = blocks.places[b];
        for (int n = 0; n < 27; ++n) {
            const glm::ivec3 place = at + glm::ivec3(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
            touched.push_back({key_of(size_class, place), {size_class, place}});
        }
    }
    const auto by_key = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
    std::sort(touched.begin(), touched.end(), by_key);
    touched.erase(std::unique(touched.begin(), touched.end(), same), touched.end());
    std::vector<Nodes> nodes(touched.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes[i].size_class = touched[i].second.size_class;
        nodes[i].at = touched[i].second.at;
    }
    return nodes;
}

// What the nodes of a class come to.
struct OfClass {
    double mass = 0, kept = 0, least = 0;
    std::size_t count = 0;
};

std::array<OfClass, kMergeClasses> sums_of(const std::vector<Nodes>& all) {
    std::array<OfClass, kMergeClasses> sums{};
    for (const Nodes& nodes : all) {
        OfClass& own = sums[static_cast<std::size_t>(nodes.size_class)];
        for (const double mass : nodes.mass) {
            own.mass += mass;
            own.count += mass > 0 ? 1 : 0;
        }
    }
    for (OfClass& own : sums)
        if (own.count > 0) own.least = kFaint * own.mass / static_cast<double>(own.count);
    for (const Nodes& nodes : all) {
        OfClass& own = sums[static_cast<std::size_t>(nodes.size_class)];
        for (const double mass : nodes.mass)
            if (mass > own.least) own.kept += mass;
    }
    return sums;
}

void add_nodes(const std::vector<Nodes>& all, const MergeScales& scales, ParticleSet& set) {
    const auto sums = sums_of(all);
    for (const Nodes& nodes : all) {
        const OfClass& own = sums[static_cast<std::size_t>(nodes.size_class)];
        const double cell = scales.cell(nodes.size_class);
        const auto radius = static_cast<float>(2 * scales.merged_s(nodes.size_class));
        const double s = static_cast<double>(radius) / 2;
        const double density_of_mass = own.kept > 0 ? own.mass / (own.kept * s * s * s) : 0;
        for (std::size_t i = 0; i < kOwnNodes; ++i) {
            if (!(nodes.mass[i] > own.least)) continue;
            const auto n = static_cast<int>(i);
            const glm::ivec3 node =
                nodes.at * kMergeBlock + glm::ivec3(n % kMergeBlock, n / kMergeBlock % kMergeBlock,
                                                    n / (kMergeBlock * kMergeBlock));
            set.center.push_back(scales.origin + cell * glm::dvec3(node));
            set.radius.push_back(radius);
            set.density.push_back(static_cast<float>(nodes.mass[i] * density_of_mass));
        }
    }
}

}  // namespace

double MergeScales::merged_s(int k) const {
    const double cell = cell_over_least[static_cast<std::size_t>(k)];
    return std::sqrt(1 - cell * cell / 4) * least[static_cast<std::size_t>(k)];
}

MergeScales merge_scales(const glm::dvec3& origin, double widest_s, bool fine_tails) {
    constexpr double kHalfOctave = 1.4142135623730951, kQuarterOctave = 1.189207115002721;
    constexpr double kCell = 1.2, kFineCell = 0.9;
    constexpr int kFineClasses = 4;
    MergeScales scales;
    scales.origin = origin;
    const auto put = [&](int k, double least, double cell) {
        scales.least[static_cast<std::size_t>(k)] = least;
        scales.cell_over_least[static_cast<std::size_t>(k)] = cell;
    };
    double least = widest_s;
    for (int k = kWidestClass; k <= kMergeClasses; ++k, least *= kHalfOctave)
        put(k, least, fine_tails && k == kWidestClass ? kFineCell : kCell);
    least = widest_s;
    for (int k = kWidestClass - 1; k >= 0; --k) {
        const bool fine = fine_tails && k >= kWidestClass - kFineClasses;
        least /= fine ? kQuarterOctave : kHalfOctave;
        put(k, least, fine ? kFineCell : kCell);
    }
    return scales;
}

MergeScales from_class(const MergeScales& scales, int k) {
    MergeScales from = scales;
    for (int n = 0; n <= kMergeClasses; ++n) {
        const auto to = static_cast<std::size_t>(n);
        const int of = std::min(n + k, kMergeClasses);
        from.least[to] = scales.least[static_cast<std::size_t>(of)];
        from.cell_over_least[to] = scales.cell_over_least[static_cast<std::size_t>(of)];
        // Beyond the last there is nothing.
        if (n + k > kMergeClasses) from.least[to] = 2 * from.least[to - 1];
    }
    return from;
}

int merge_class(const MergeScales& scales, double s) {
    const auto above = std::upper_bound(scales.least.begin() + 1, scales.least.end(), s);
    return static_cast<int>(above - scales.least.begin()) - 1;
}

MergeBlocks merge_blocks(const ParticleSet& particles, const MergeScales& scales, int threads) {
    MergeBlocks blocks;
    std::vector<std::uint64_t> keys(particles.size());
    std::array<double, kMergeClasses + 1> per_cell{};
    for (int k = 0; k < kMergeClasses; ++k)
        per_cell[static_cast<std::size_t>(k)] = 1 / scales.cell(k);
    const Bounds bounds = bounds_of(particles);
    const glm::dvec3 size = bounds.max - scales.origin;
    if (std::max({size.x, size.y, size.z}) * per_cell[0] / kMergeBlock + 4 > kMostPlaces) return {};
    const auto place_of = [&](std::size_t i) {
        const int k = merge_class(scales, gaussian_s(particles, i));
        if (k >= kMergeClasses) return MergeBlocks::Place{kMergeClasses, glm::ivec3(0)};
        const OnLattice on =
            on_lattice(particles, i, scales, per_cell[static_cast<std::size_t>(k)]);
        return MergeBlocks::Place{k, on.nearest / kMergeBlock};
    };
    parallel_for(threads, (keys.size() + kShare - 1) / kShare, [&](std::size_t share) {
        const std::size_t end = std::min(keys.size(), (share + 1) * kShare);
        for (std::size_t i = share * kShare; i < end; ++i) {
            const MergeBlocks::Place place = place_of(i);
            keys[i] = key_of(place.size_class, place.at);
        }
    });
    std::unordered_map<std::uint64_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> block(particles.size()), count;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const auto [found, fresh] =
            numbers.try_emplace(keys[i], static_cast<std::uint32_t>(count.size()));
        if (fresh) {
            count.push_back(0);
            blocks.places.push_back(place_of(i));
        }
        block[i] = found->second;
        ++count[block[i]];
    }
    std::vector<std::uint64_t>().swap(keys);
    blocks.first.resize(count.size() + 1);
    for (std::size_t b = 0; b < count.size(); ++b) blocks.first[b + 1] = blocks.first[b] + count[b];
    blocks.order.resize(particles.size());
    std::vector<std::uint32_t> next(blocks.first.begin(), blocks.first.end() - 1);
    for (std::size_t i = 0; i < block.size(); ++i)
        blocks.order[next[block[i]]++] = static_cast<std::uint32_t>(i);
    return blocks;
}

ParticleSet on_merge_lattices(const ParticleSet& particles, const MergeScales& scales,
                              const MergeBlocks& blocks, int threads) {
    std::vector<Rim> rims(blocks.size());
    parallel_for(threads, rims.size(),
                 [&](std::size_t b) { rims[b] = rim_of(particles, scales, blocks, b); });
    std::unordered_map<std::uint64_t, const Rim*> by_key;
    for (std::size_t b = 0; b < rims.size(); ++b)
        if (!rims[b].empty())
            by_key.emplace(key_of(blocks.places[b].size_class, blocks.places[b].at), &rims[b]);
    std::vector<Nodes> nodes = touched_blocks(blocks, rims);
    parallel_for(threads, nodes.size(), [&](std::size_t i) { take_rims(by_key, nodes[i]); });

    ParticleSet set;
    add_nodes(nodes, scales, set);
    std::vector<std::uint32_t> stay;
    for (std::size_t b = 0; b < rims.size(); ++b)
        if (rims[b].empty())
            stay.insert(stay.end(), blocks.order.begin() + blocks.first[b],
                        blocks.order.begin() + blocks.first[b + 1]);
    std::sort(stay.begin(), stay.end());
    for (const std::uint32_t i : stay) {
        set.center.push_back(particles.center[i]);
        set.radius.push_back(particles.radius[i]);
        set.density.push_back(particles.density[i]);
    }
    return set;
}

}  // namespace awan
