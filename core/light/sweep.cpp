#include "core/light/sweep.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "core/base/team.h"
#include "core/light/sweep_layer.h"

namespace awan {
namespace {

// Cells of a layer that are worth a thread: less takes not much longer than waiting for each other.
constexpr std::size_t kCellsOfMember = 128;
constexpr std::size_t kSides = 2;

// What enters an octant's three faces.
void fill_faces(const glm::ivec3& n, const Ordinates::Octant& octant,
                const InflowFromBelow& from_below, OctantInflow& inflow) {
    const auto fill_face = [&](std::vector<float>& face, int across, int down, const auto& place) {
        face.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(down) *
                    kDirections);
        float* to = face.data();
        for (int b = 0; b < down; ++b)
            for (int a = 0; a < across; ++a)
                for (std::size_t d = 0; d < kDirections; ++d)
                    *to++ = inflow.in[d] + static_cast<float>(from_below(octant.direction[d],
                                                                         place(a + 0.5, b + 0.5)));
    };
    const glm::dvec3 entry(octant.sign.x > 0 ? 0 : n.x, octant.sign.y > 0 ? 0 : n.y,
                           octant.sign.z > 0 ? 0 : n.z);
    fill_face(inflow.x, n.y, n.z, [&](double a, double b) { return glm::dvec3(entry.x, a, b); });
    fill_face(inflow.y, n.x, n.z, [&](double a, double b) { return glm::dvec3(a, entry.y, b); });
    fill_face(inflow.z, n.x, n.y, [&](double a, double b) { return glm::dvec3(a, b, entry.z); });
}

// One side's sweep, about to begin: what enters its first layer is in `layer`.
SideSweep side_of(const SweepGrid& grid, const Ordinates& ordinates, const SweepSource& source,
                  const Inflow& inflow, const InflowFromBelow& from_below, std::size_t index,
                  SweepSpace::Side& space) {
    SideSweep side{.grid = grid, .source = source, .down_z = index == 1, .space = space};
    const std::size_t first = index * kSide;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t d = 0; d < kDirections; ++d)
            // A cell is as if it were cubic and light crossed its longer sides at flatter angles.
            side.cosine[axis][d] = ordinates.cosine[axis][d] / grid.sides[static_cast<int>(axis)];
    side.first = ordinates.octants[first].value[0];
    for (std::size_t m = 0; m < kHarmonics; ++m)
        for (std::size_t d = 0; d < kDirections; ++d) {
            side.value[m][d] = source.weight[m] * ordinates.octants[first].value[m][d];
            side.weighted[m][d] = ordinates.octants[first].weighted[d][m];
        }
    const auto nx = static_cast<std::size_t>(grid.cells.x);
    space.radiance.resize(grid.layer_size() * kSide * kDirections);
    space.factors.resize(space.radiance.size());
    space.layer.resize(space.radiance.size());
    space.row.resize(nx * kSide * kDirections);
    for (std::size_t o = 0; o < kSide; ++o) {
        const Ordinates::Octant& octant = ordinates.octants[first + o];
        OctantInflow& enters = side.inflow[o];
        if (inflow)
            for (std::size_t d = 0; d < kDirections; ++d)
                enters.in[d] = static_cast<float>(inflow(octant.direction[d]));
        if (from_below && octant.sign.y > 0) fill_faces(grid.cells, octant, from_below, enters);
        for (std::size_t c = 0; c < grid.layer_size(); ++c)
            std::copy_n(enters.z.empty() ? enters.in.data() : enters.z.data() + c * kDirections,
                        kDirections, space.layer.data() + (c * kSide + o) * kDirections);
    }
    return side;
}

// Layers begin..end-1 in the order in which the side's light meets them, as one member of the team that takes them:
// each has its share of the cells, and its share of the octants.
void take_layers(const SideSweep& side, int begin, int end, std::size_t member, Team& team,
                 bool second, const SweepResult& result) {
    const std::size_t cells = side.grid.layer_size();
    const auto [from, to] = team.share_of(member, cells);
    const std::size_t walkers = team.size() >= kSide ? kSide : team.size() >= 2 ? 2 : 1;
    const std::size_t octants = kSide / walkers;
    for (int n = begin; n < end; ++n) {
        const auto k = static_cast<std::size_t>(side.down_z ? side.grid.cells.z - 1 - n : n);
        expand_cells(side, k, from, to);
        team.wait();
        if (member < walkers) walk_layer(side, k, member * octants, octants);
        team.wait();
        gather_cells(side, k, from, to, second, result);
    }
}

}  // namespace

// Each side takes its half of the layers first, and then those of the other, to whose moments it adds its own.
void sweep(const SweepGrid& grid, const Ordinates& ordinates, const SweepSource& source,
           const Inflow& inflow, int threads, SweepSpace& space, const SweepResult& result,
           const InflowFromBelow& from_below) {
    assert(grid.harmonics == 1 || grid.harmonics == 16);
    assert(source.moments.size() == static_cast<std::size_t>(grid.harmonics) * grid.size() &&
           result.to.size() == source.moments.size());
    const std::size_t most = std::max<std::size_t>(grid.layer_size() / kCellsOfMember, 1);
    const auto members = [&](std::size_t of) { return std::clamp<std::size_t>(of, 1, most); };
    const auto wanted = static_cast<std::size_t>(std::max(threads, 1));
    std::array<Team, kSides> teams{Team(members((wanted + 1) / 2)), Team(members(wanted / 2))};
    const int half = grid.cells.z / 2;
    const std::array<int, kSides> first{half, grid.cells.z - half};
    std::array<std::optional<SideSweep>, kSides> sides;
    const auto begin = [&](std::size_t index) {
        sides[index].emplace(
            side_of(grid, ordinates, source, inflow, from_below, index, space.sides[index]));
    };
    const auto take = [&](std::size_t index, std::size_t member, bool second) {
        take_layers(*sides[index], second ? first[index] : 0, second ? grid.cells.z : first[index],
                    member, teams[index], second, result);
    };
    if (wanted == 1) {
        for (const bool second : {false, true})
            for (std::size_t index = 0; index < kSides; ++index) {
                if (!second) begin(index);
                take(index, 0, second);
            }
        return;
    }
    Team all(teams[0].size() + teams[1].size());
    run_team(all, [&](std::size_t i) {
        const std::size_t index = i < teams[0].size() ? 0 : 1;
        const std::size_t member = index == 0 ? i : i - teams[0].size();
        as_member(teams[index], [&] {
            if (member == 0) begin(index);
            all.wait();
            take(index, member, false);
            all.wait();
            take(index, member, true);
        });
    });
}

}  // namespace awan
