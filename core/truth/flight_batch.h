// Flights side by side. Included once for each instruction set, after lanes.h, as that is.

#include "core/truth/lanes_detail.h"

// Idle lanes from which on new flights are fetched.
constexpr int kFetch = kLanes / 2;

// The flights at work, as far as lanes need them one by one.
struct Lanes {
    // Of each lane; those that are idle have none.
    std::uint32_t index[kLanes]{};
    std::uint32_t idle_lanes = (1u << kLanes) - 1;
    // What was fetched, and which lanes were.
    alignas(64) float place[3][kLanes]{}, direction[3][kLanes]{}, to[kLanes]{};
    alignas(64) std::int32_t brick[3][kLanes]{}, fresh[kLanes]{};
    alignas(64) std::uint32_t random[4][kLanes]{};
    // In the tile of detail, voxels: where flights begin, and how far they go a cell.
    alignas(64) float voxel[3][kLanes]{}, voxels_a_cell[3][kLanes]{};
    // Of listed particles, each lane's race with them: the optical depth ahead, and t of a meeting in the brick where
    // it is, infinite: there is none.
    double listed_ahead[kLanes]{};
    alignas(64) float meets[kLanes];

    Lanes() { std::fill(std::begin(meets), std::end(meets), INFINITY); }

    void fetch(const DetailLanes& detail, const Flights& f, std::span<const std::uint32_t> which,
               std::size_t& taken) {
        std::fill(std::begin(fresh), std::end(fresh), 0);
        for (std::uint32_t left = idle_lanes; left != 0 && taken < which.size(); left &= left - 1) {
            const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
            const std::uint32_t i = which[taken++];
            index[lane] = i;
            fresh[lane] = -1;
            idle_lanes &= ~(1u << lane);
            for (std::size_t a = 0; a < 3; ++a) {
                place[a][lane] = f.places.local[a][i];
                brick[a][lane] = f.places.brick[a][i];
                direction[a][lane] = f.direction[a][i];
            }
            to[lane] = f.to != nullptr ? f.to[i] : INFINITY;
            for (std::size_t word = 0; word < 4; ++word) random[word][lane] = f.random[word][i];
            if (detail.words != nullptr) stand_in_tile(detail, lane);
        }
    }

    void stand_in_tile(const DetailLanes& detail, std::size_t lane) {
        const glm::dvec3 from = detail.to_tile * origin(lane) + detail.start,
                         per_cell = detail.to_tile * along(lane);
        for (int a = 0; a < 3; ++a) {
            const auto axis = static_cast<std::size_t>(a);
            voxel[axis][lane] = DetailLanes::within(from[a]);
            voxels_a_cell[axis][lane] = static_cast<float>(per_cell[a]);
        }
    }

    // The place that the lane's flight began at, in q, and its direction.
    glm::dvec3 origin(std::size_t lane) const {
        glm::dvec3 q;
        for (int a = 0; a < 3; ++a)
            q[a] = double{kBrick} * brick[a][lane] + static_cast<double>(place[a][lane]);
        return q;
    }
    glm::dvec3 along(std::size_t lane) const {
        return {static_cast<double>(direction[0][lane]), static_cast<double>(direction[1][lane]),
                static_cast<double>(direction[2][lane])};
    }

    // Where, from t to `leave`, the listed particles of the brick are met.
    void race(const Matter& m, std::size_t lane, std::size_t in, float t, float leave) {
        meets[lane] = INFINITY;
        if (!(t < leave)) return;
        const glm::dvec3 o = origin(lane), d = along(lane);
        const auto a = static_cast<double>(t), b = static_cast<double>(leave);
        double depth = 0;
        for (std::uint32_t k = m.brick_begin[in]; k < m.brick_begin[in + 1]; ++k)
            depth += listed_depth(m.listed[m.brick_items[k]], o, d, a, b);
        if (depth > listed_ahead[lane])
            meets[lane] = static_cast<float>(where_listed(m, in, o, d, a, b, listed_ahead[lane]));
        else
            listed_ahead[lane] -= depth;
    }

    // The lane's flight has ended.
    void free(std::size_t lane, const Flights& f, bool met) {
        const std::size_t i = index[lane];
        f.met[i] = met ? 1 : 0;
        for (std::size_t word = 0; word < 4; ++word) f.random[word][i] = random[word][lane];
        meets[lane] = INFINITY;
        idle_lanes |= 1u << lane;
    }
};

// Flights at work, one a lane. Places are o + t d, relative to the brick that a flight began in.
struct Batch {
    static constexpr auto kSide = static_cast<float>(kBrick);

    Batch(const Matter& matter, const Flights& flights, std::span<const std::uint32_t> those)
        : m(matter), detail(matter), f(flights), which(those) {}

    const Matter& m;
    const DetailLanes detail;
    const Flights& f;
    std::span<const std::uint32_t> which;
    std::size_t taken = 0;
    Lanes lanes;
    // By axis: the cell that flights have come to, among all of the lattice, and the first of the brick where they
    // began; the block where they are: its first cell, and how many more it has a side.
    Floats o[3]{}, d[3]{}, per_d[3]{};
    Ints cell[3]{}, origin[3]{}, block[3]{}, more{};
    // At work; come to a new block.
    Ints active{}, arrived{}, looked{};
    // `far`: t where the block ends. `ahead`: optical depth, as the majorants have it.
    Floats t{}, to{}, far{}, ahead{}, most{}, per_most{}, meets = all(INFINITY);
    RandomLanes random{};

    AWAN_INLINE Ints brick_of_cells(const Ints (&at)[3]) const {
        static_assert(kBrick == 4);
        return ((at[0] >> 2) * m.bricks.y + (at[1] >> 2)) * m.bricks.z + (at[2] >> 2);
    }

    // t of the block's far side along an axis.
    AWAN_INLINE Floats far_side(int a) const {
        const Ints side = block[a] - origin[a] + (d[a] >= 0.0f ? more + 1 : Ints{});
        return (__builtin_convertvector(side, Floats) - o[a]) * per_d[a];
    }

    // The cell of a place along an axis: down to whole cells, within the block.
    AWAN_INLINE Ints cell_at(int a, const Floats& place) const {
        Ints low = __builtin_convertvector(place, Ints);
        low += __builtin_convertvector(low, Floats) > place;
        low += origin[a];
        low = low < block[a] ? block[a] : low;
        return low > block[a] + more ? block[a] + more : low;
    }

    // What stands in the blocks where those lanes have come to.
    AWAN_INLINE void enter(const Ints& lanes_there) {
        alignas(64) std::int32_t at[kLanes], cells[kLanes], listed[kLanes];
        alignas(64) float majorant[kLanes];
        store(at, brick_of_cells(cell));
        for (int lane = 0; lane < kLanes; ++lane) {
            const Brick& one = m.brick[static_cast<std::size_t>(at[lane])];
            majorant[lane] = one.most;
            cells[lane] = (kBrick << one.level) - 1;
            listed[lane] = one.listed;
        }
        most = loaded(majorant);
        per_most = 1.0f / most;
        more = load<Ints>(cells);
        for (int a = 0; a < 3; ++a) block[a] = cell[a] & ~more;
        far = max(min(min(far_side(0), far_side(1)), far_side(2)), t);
        if (m.listed.empty()) return;
        alignas(64) float now[kLanes], leave[kLanes];
        store(now, t);
        store(leave, min(far, to));
        each_lane(lanes_there, [&](std::size_t lane) {
            if (listed[lane] != 0)
                lanes.race(m, lane, static_cast<std::size_t>(at[lane]), now[lane], leave[lane]);
        });
        meets = loaded(lanes.meets);
    }

    // New flights for idle lanes.
    AWAN_INLINE void fetch() {
        lanes.fetch(detail, f, which, taken);
        const auto fresh = load<Ints>(lanes.fresh);
        RandomLanes drawn;
        for (int word = 0; word < 4; ++word) drawn.state[word] = load<Bits>(lanes.random[word]);
        const Floats drawn_depth = minus_log(unit(drawn));
        if (!m.listed.empty()) {
            alignas(64) float first[kLanes];
            store(first, minus_log(unit(drawn)));
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                if (lanes.fresh[lane] != 0)
                    lanes.listed_ahead[lane] = static_cast<double>(first[lane]);
        }
        random = chosen(fresh, drawn, random);
        ahead = fresh ? drawn_depth : ahead;
        t = fresh ? all(0.0f) : t;
        looked = ~fresh & looked;
        to = fresh ? loaded(lanes.to) : to;
        for (int a = 0; a < 3; ++a) {
            const Floats place = loaded(lanes.place[a]), along = loaded(lanes.direction[a]);
            const Ints first = load<Ints>(lanes.brick[a]) * kBrick;
            const Ints within = __builtin_convertvector(min(place, all(kSide - 1)), Ints);
            const Floats per = 1.0f / max(abs(along), all(1e-20f));
            o[a] = fresh ? place : o[a];
            d[a] = fresh ? along : d[a];
            per_d[a] = fresh ? (along >= 0.0f ? per : -per) : per_d[a];
            origin[a] = fresh ? first : origin[a];
            cell[a] = fresh ? first + within : cell[a];
        }
        active |= fresh;
        arrived |= fresh;
    }

    // What lanes have found at a point that they looked at.
    struct Found {
        Ints met{};
        // The brick's first cell, and the place from there.
        Ints first[3]{};
        Floats local[3]{};
        alignas(64) float depth[kLanes];
    };

    // Those lanes look whether there is matter at `further`. Gives those that are done.
    AWAN_INLINE Ints look(const Ints& looks, const Floats& further, Found& found) {
        t = looks ? further : t;
        alignas(64) float part[3][kLanes], extinction[kLanes]{};
        Ints at[3], in[3];
        for (int a = 0; a < 3; ++a) {
            const Floats place = o[a] + t * d[a];
            at[a] = cell_at(a, place);
            found.first[a] = at[a] & ~(kBrick - 1);
            in[a] = at[a] - found.first[a];
            found.local[a] = min(
                max(place - __builtin_convertvector(found.first[a] - origin[a], Floats), all(0.0f)),
                all(kSide));
            store(part[a],
                  min(max(found.local[a] - __builtin_convertvector(in[a], Floats), all(0.0f)),
                      all(1.0f)));
        }
        alignas(64) std::int32_t brick[kLanes], node[kLanes];
        store(brick, brick_of_cells(at));
        store(node, (in[0] * kBrickNodes + in[1]) * kBrickNodes + in[2]);
        // Only where it is looked: memory is what a look costs.
        each_lane(looks, [&](std::size_t lane) {
            const Brick& one = m.brick[static_cast<std::size_t>(brick[lane])];
            extinction[lane] = 0;
            if (one.nodes == kNoNodes) return;
            const Sampled here =
                sampled(m, {kBrickStride * one.nodes + static_cast<std::size_t>(node[lane]),
                            part[0][lane], part[1][lane], part[2][lane]});
            extinction[lane] = here.extinction;
            found.depth[lane] = here.depth;
        });
        RandomLanes drawn = random;
        const Floats least = unit(drawn) * most;
        Floats here = loaded(extinction);
        if (detail.words != nullptr)
            here = with_detail(detail, looks, here, least, [&](Floats(&voxel)[3]) {
                for (std::size_t a = 0; a < 3; ++a)
                    voxel[a] = loaded(lanes.voxel[a]) + t * loaded(lanes.voxels_a_cell[a]);
            });
        found.met = looks & (least < here);
        ahead = looks ? minus_log(unit(drawn)) : ahead;
        random = chosen(looks, drawn, random);
        looked -= looks;
        return looks & (found.met | (looked > kMaxTentative));
    }

    // Those lanes go on to the next block. Gives those that ended instead.
    AWAN_INLINE Ints move(const Ints& moves, const Floats& stop) {
        ahead = moves ? max(ahead - max(stop - t, all(0.0f)) * most, all(0.0f)) : ahead;
        t = moves ? max(t, stop) : t;
        Ints ended = moves & (~(stop < to) | (meets <= stop));
        // Across that side which is reached first, to the cell beyond it; along the others no farther than the block.
        const Floats side[3] = {far_side(0), far_side(1), far_side(2)};
        const Ints by_x = (side[0] <= side[1]) & (side[0] <= side[2]),
                   by_y = ~by_x & (side[1] <= side[2]);
        const Ints across[3] = {by_x, by_y, ~(by_x | by_y)};
        for (int a = 0; a < 3; ++a) {
            const Ints beyond = d[a] >= 0.0f ? block[a] + more + 1 : block[a] - 1;
            const Ints next = across[a] ? beyond : cell_at(a, o[a] + t * d[a]);
            ended |= moves & ((next < 0) | (next >= m.bricks[a] * kBrick));
            cell[a] = moves ? next : cell[a];
        }
        for (int a = 0; a < 3; ++a) cell[a] = ~ended & cell[a];
        arrived = moves & ~ended;
        return ended;
    }

    // Those lanes' flights are over.
    AWAN_INLINE void finish(const Ints& done, const Found& found) {
        alignas(64) std::int32_t met[kLanes];
        alignas(64) float local[3][kLanes];
        alignas(64) std::int32_t first[3][kLanes];
        store(met, found.met);
        for (int a = 0; a < 3; ++a) {
            store(local[a], found.local[a]);
            store(first[a], found.first[a]);
        }
        for (int word = 0; word < 4; ++word) store(lanes.random[word], random.state[word]);
        each_lane(done, [&](std::size_t lane) {
            const std::size_t i = lanes.index[lane];
            const bool by_listed = met[lane] == 0 && lanes.meets[lane] < INFINITY;
            if (met[lane] != 0) {
                for (std::size_t a = 0; a < 3; ++a) {
                    f.places.local[a][i] = local[a][lane];
                    f.places.brick[a][i] = first[a][lane] / kBrick;
                }
                f.depth[i] = found.depth[lane];
                if (!m.listed.empty())
                    f.depth[i] += static_cast<float>(listed_depth_to_sun(m, f.places.at(i)));
            } else if (by_listed) {
                const glm::dvec3 q =
                    lanes.origin(lane) + static_cast<double>(lanes.meets[lane]) * lanes.along(lane);
                f.places.set(i, m, q);
                f.depth[i] = static_cast<float>(depth_to_sun_at(m, q));
            }
            lanes.free(lane, f, met[lane] != 0 || by_listed);
        });
        active &= ~done;
        meets = loaded(lanes.meets);
    }

    AWAN_INLINE void run() {
        for (;;) {
            if (__builtin_popcount(lanes.idle_lanes) >= kFetch && taken < which.size()) fetch();
            if (!any(active)) return;
            if (any(arrived)) enter(arrived);
            arrived = Ints{};
            const Floats stop = min(min(far, to), meets);
            const Floats further = t + ahead * per_most;
            const Ints looks = active & (further < stop), moves = active & ~looks;
            Found found;
            Ints done{};
            if (any(looks)) done = look(looks, further, found);
            if (any(moves)) done |= move(moves, stop);
            if (any(done)) finish(done, found);
        }
    }
};

inline void fly_through(const Matter& m, const Flights& f, std::span<const std::uint32_t> which) {
    Batch(m, f, which).run();
}
