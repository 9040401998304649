#include "core/light/diffusion.h"

#include <algorithm>
#include <cmath>

#include "core/base/aligned_floats.h"
#include "core/base/float_runs.h"
#include "core/base/instruction_sets.h"
#include "core/base/team.h"

namespace awan {
namespace {

// Keeps the conductance of empty cells finite: over so few cells light does not diffuse but streams.
constexpr float kStreaming = 0.75F;

// Floats of a block: what one step leaves in a processor's near cache, the next takes from there.
constexpr std::size_t kBlock = 4096;

using Vector = AlignedFloats;

// to = operator from, of the cells first..last-1. `from` has a layer of zeros behind it, so that no neighbour is out of
// bounds; conductances are 0 across the sides.
AWAN_INLINE void apply_body(const Diffusion& diffusion, const float* from, std::size_t first,
                            std::size_t last, float* to) {
    const float *diagonal = diffusion.diagonal.data(), *gx = diffusion.across[0].data(),
                *gy = diffusion.across[1].data(), *gz = diffusion.across[2].data();
    const auto row = static_cast<std::size_t>(diffusion.cells.x);
    const std::size_t layer = row * static_cast<std::size_t>(diffusion.cells.y);
    std::size_t i = first;
    for (; i < std::min(last, layer); ++i) {
        to[i] = diagonal[i] * from[i] - gx[i] * from[i + 1] - gy[i] * from[i + row] -
                gz[i] * from[i + layer];
        if (i >= 1) to[i] -= gx[i - 1] * from[i - 1];
        if (i >= row) to[i] -= gy[i - row] * from[i - row];
    }
    for (; i < last; ++i)
        to[i] = diagonal[i] * from[i] - gx[i] * from[i + 1] - gy[i] * from[i + row] -
                gz[i] * from[i + layer] - gx[i - 1] * from[i - 1] - gy[i - row] * from[i - row] -
                gz[i - layer] * from[i - layer];
}
AWAN_KERNEL(void, apply,
            (const Diffusion& diffusion, const float* from, std::size_t first, std::size_t last,
             float* __restrict to),
            (diffusion, from, first, last, to))

// Jacobi's step, damped so that what changes from cell to cell falls off.
constexpr float kDamping = 0.8F;
// Cells of a grid that a few of those steps settle, and how many.
constexpr std::size_t kFewCells = 48;
constexpr int kCoarsestSteps = 6;
// Along an axis on which cells are longer than this to the shortest side, light goes from cell to cell so much less
// that it is settled along the others first.
constexpr float kMuchLonger = 2.5F;

AWAN_INLINE void begin_body(const float* __restrict r, const float* __restrict diagonal,
                            std::size_t count, float* __restrict x) {
    for (std::size_t i = 0; i < count; ++i) x[i] = kDamping * r[i] / diagonal[i];
}
AWAN_KERNEL(void, begin,
            (const float* __restrict r, const float* __restrict diagonal, std::size_t count,
             float* __restrict x),
            (r, diagonal, count, x))

AWAN_INLINE void relax_body(const float* __restrict r, const float* __restrict q,
                            const float* __restrict diagonal, std::size_t count,
                            float* __restrict x) {
    for (std::size_t i = 0; i < count; ++i) x[i] += kDamping * (r[i] - q[i]) / diagonal[i];
}
AWAN_KERNEL(void, relax,
            (const float* __restrict r, const float* __restrict q, const float* __restrict diagonal,
             std::size_t count, float* __restrict x),
            (r, q, diagonal, count, x))

AWAN_INLINE void step_body(float a, const float* __restrict p, const float* __restrict q,
                           float* __restrict x, float* __restrict r, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        x[i] += a * p[i];
        r[i] -= a * q[i];
    }
}
AWAN_KERNEL(void, step,
            (float a, const float* __restrict p, const float* __restrict q, float* __restrict x,
             float* __restrict r, std::size_t count),
            (a, p, q, x, r, count))

AWAN_INLINE void turn_body(float b, const float* __restrict z, float* __restrict p,
                           std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) p[i] = z[i] + b * p[i];
}
AWAN_KERNEL(void, turn,
            (float b, const float* __restrict z, float* __restrict p, std::size_t count),
            (b, z, p, count))

// Cells that are worth a thread.
constexpr std::size_t kCellsOfMember = 8192;

// A sum over all cells, made of those of blocks, in their order whoever adds them up.
class BlockSum {
  public:
    explicit BlockSum(std::size_t count) : count_(count), parts_((count + kBlock - 1) / kBlock) {}
    // work(first, last): of the cells first..last-1, those of one block of a member's share. Then all wait.
    template <typename Work>
    double of(Team& team, std::size_t member, const Work& work) {
        const auto [begin, end] = team.share_of(member, parts_.size());
        for (std::size_t block = begin; block < end; ++block)
            parts_[block] = work(block * kBlock, std::min((block + 1) * kBlock, count_));
        team.wait();
        double sum = 0;
        for (const double part : parts_) sum += part;
        return sum;
    }

  private:
    std::size_t count_;
    std::vector<double> parts_;
};

// A row of fine cells and the row of coarse ones that they are in, one or two each.
AWAN_INLINE void gather_row_body(const float* __restrict r, const float* __restrict q,
                                 std::size_t count, std::size_t factor, float* __restrict to) {
    if (factor == 1) {
        for (std::size_t i = 0; i < count; ++i) to[i] += r[i] - q[i];
        return;
    }
    for (std::size_t i = 0; i < count / 2; ++i)
        to[i] += (r[2 * i] - q[2 * i]) + (r[2 * i + 1] - q[2 * i + 1]);
    if (count % 2 != 0) to[count / 2] += r[count - 1] - q[count - 1];
}
AWAN_KERNEL(void, gather_row,
            (const float* __restrict r, const float* __restrict q, std::size_t count,
             std::size_t factor, float* __restrict to),
            (r, q, count, factor, to))

AWAN_INLINE void spread_row_body(const float* __restrict from, std::size_t count,
                                 std::size_t factor, float* __restrict x) {
    if (factor == 1) {
        for (std::size_t i = 0; i < count; ++i) x[i] += from[i];
        return;
    }
    for (std::size_t i = 0; i < count / 2; ++i) {
        x[2 * i] += from[i];
        x[2 * i + 1] += from[i];
    }
    if (count % 2 != 0) x[count - 1] += from[count / 2];
}
AWAN_KERNEL(void, spread_row,
            (const float* __restrict from, std::size_t count, std::size_t factor,
             float* __restrict x),
            (from, count, factor, x))

// Fine cells of a coarse one along each axis, 1 or 2.
glm::ivec3 factors_of(const Diffusion& fine, const Diffusion& coarse) {
    return {coarse.cells.x < fine.cells.x ? 2 : 1, coarse.cells.y < fine.cells.y ? 2 : 1,
            coarse.cells.z < fine.cells.z ? 2 : 1};
}

// work(fine row's first cell, coarse row's first cell) for all rows along x in the layers `layers` of coarse cells.
template <typename Work>
void for_rows(const glm::ivec3& fine, const glm::ivec3& coarse, const glm::ivec3& factors,
              Team::Share layers, const Work& work) {
    const int end = std::min(static_cast<int>(layers.end) * factors.z, fine.z);
    for (int k = static_cast<int>(layers.begin) * factors.z; k < end; ++k)
        for (int j = 0; j < fine.y; ++j)
            work((static_cast<std::size_t>(k) * static_cast<std::size_t>(fine.y) +
                  static_cast<std::size_t>(j)) *
                     static_cast<std::size_t>(fine.x),
                 (static_cast<std::size_t>(k / factors.z) * static_cast<std::size_t>(coarse.y) +
                  static_cast<std::size_t>(j / factors.y)) *
                     static_cast<std::size_t>(coarse.x));
}

// The operator on coarser cells: what leaves and what is absorbed adds up, and so do the faces between two cells, but
// from middle to middle the way is twice as long. Sides: of a cell, on return of a coarse one.
Diffusion coarser_of(const Diffusion& fine, glm::vec3& sides) {
    float shortest = std::max({sides.x, sides.y, sides.z});
    for (int axis = 0; axis < 3; ++axis)
        if (fine.cells[axis] > 1) shortest = std::min(shortest, sides[axis]);
    Diffusion coarse;
    glm::ivec3 factors(1);
    for (int axis = 0; axis < 3; ++axis) {
        if (fine.cells[axis] > 1 && sides[axis] < kMuchLonger * shortest) factors[axis] = 2;
        coarse.cells[axis] = (fine.cells[axis] + factors[axis] - 1) / factors[axis];
    }
    sides *= glm::vec3(factors);
    const auto nx = static_cast<std::size_t>(coarse.cells.x);
    const std::size_t layer = nx * static_cast<std::size_t>(coarse.cells.y),
                      size = layer * static_cast<std::size_t>(coarse.cells.z);
    const auto fine_row = static_cast<std::size_t>(fine.cells.x);
    const std::size_t fine_stride[3] = {1, fine_row,
                                        fine_row * static_cast<std::size_t>(fine.cells.y)};
    coarse.diagonal.assign(size, 0.F);
    for (std::vector<float>& across : coarse.across) across.assign(size, 0.F);
    int j = 0, k = 0;
    const Team::Share all{0, static_cast<std::size_t>(coarse.cells.z)};
    for_rows(fine.cells, coarse.cells, factors, all, [&](std::size_t from, std::size_t to) {
        for (int i = 0; i < fine.cells.x; ++i) {
            const std::size_t cell = from + static_cast<std::size_t>(i),
                              in = to + static_cast<std::size_t>(i / factors.x);
            const int at[3] = {i, j, k};
            float lost = fine.diagonal[cell];
            for (int axis = 0; axis < 3; ++axis) {
                const std::vector<float>& across = fine.across[axis];
                lost -= across[cell];
                if (at[axis] > 0) lost -= across[cell - fine_stride[axis]];
                if ((at[axis] + 1) % factors[axis] == 0)
                    coarse.across[axis][in] += across[cell] / static_cast<float>(factors[axis]);
            }
            coarse.diagonal[in] += std::max(lost, 0.F);
        }
        if (++j == fine.cells.y) {
            j = 0;
            ++k;
        }
    });
    const std::size_t stride[3] = {1, nx, layer};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < size; ++i) {
            coarse.diagonal[i] += coarse.across[axis][i];
            if (i + stride[axis] < size)
                coarse.diagonal[i + stride[axis]] += coarse.across[axis][i];
        }
    return coarse;
}

// What a V-cycle works on, of each level.
struct Level {
    const Diffusion& diffusion;
    Vector x;     // the answer; a layer of zeros behind it
    Vector r, q;  // to what, and what the operator makes of x
    std::size_t size() const { return q.size(); }
    explicit Level(const Diffusion& of)
        : diffusion(of),
          x(of.diagonal.size() +
            static_cast<std::size_t>(of.cells.x) * static_cast<std::size_t>(of.cells.y)),
          r(of.diagonal.size()),
          q(of.diagonal.size()) {
        std::fill(x.begin(), x.end(), 0.F);
    }
};

// levels[at].x becomes about what the operator makes levels[at].r of: always the same linear function of it, and
// symmetric, as conjugate gradients need it. As one member of a team; all end together.
void cycle(std::vector<Level>& levels, std::size_t at, Team& team, std::size_t member) {
    Level& fine = levels[at];
    const Team::Share own = team.share_of(member, fine.size());
    const std::size_t first = own.begin, last = own.end;
    const float* const diagonal = fine.diffusion.diagonal.data();
    const auto apply_own = [&] {
        apply(fine.diffusion, fine.x.data(), first, last, fine.q.data());
    };
    const auto settle = [&] {
        team.wait();
        apply_own();
        team.wait();
        relax(fine.r.data() + first, fine.q.data() + first, diagonal + first, last - first,
              fine.x.data() + first);
    };
    begin(fine.r.data() + first, diagonal + first, last - first, fine.x.data() + first);
    if (at + 1 == levels.size()) {
        for (int i = 0; i < kCoarsestSteps; ++i) settle();
        team.wait();
        return;
    }
    team.wait();
    apply_own();
    team.wait();
    Level& coarse = levels[at + 1];
    const glm::ivec3 factors = factors_of(fine.diffusion, coarse.diffusion),
                     few = coarse.diffusion.cells;
    const auto row = static_cast<std::size_t>(fine.diffusion.cells.x);
    const auto factor = static_cast<std::size_t>(factors.x);
    const Team::Share layers = team.share_of(member, static_cast<std::size_t>(few.z));
    const std::size_t layer = static_cast<std::size_t>(few.x) * static_cast<std::size_t>(few.y);
    std::fill(coarse.r.data() + layers.begin * layer, coarse.r.data() + layers.end * layer, 0.F);
    for_rows(fine.diffusion.cells, few, factors, layers, [&](std::size_t from, std::size_t to) {
        gather_row(fine.r.data() + from, fine.q.data() + from, row, factor, coarse.r.data() + to);
    });
    team.wait();
    if (coarse.size() < kCellsOfMember) {
        // Not worth waiting for each other.
        Team alone(1);
        if (member == 0) cycle(levels, at + 1, alone, 0);
        team.wait();
    } else {
        cycle(levels, at + 1, team, member);
    }
    for_rows(fine.diffusion.cells, few, factors, layers, [&](std::size_t to, std::size_t from) {
        spread_row(coarse.x.data() + from, row, factor, fine.x.data() + to);
    });
    settle();
    team.wait();
}

}  // namespace

Diffusion make_diffusion(const glm::ivec3& cells, const glm::vec3& sides,
                         std::span<const float> depth, std::span<const float> scattered,
                         double forward) {
    Diffusion diffusion;
    diffusion.cells = cells;
    const auto nx = static_cast<std::size_t>(cells.x), ny = static_cast<std::size_t>(cells.y),
               nz = static_cast<std::size_t>(cells.z);
    const auto cosine = static_cast<float>(forward);
    std::vector<float> transport(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
        transport[i] = std::max(depth[i] - cosine * scattered[i], 0.F);
    diffusion.diagonal.resize(depth.size());
    for (std::size_t i = 0; i < depth.size(); ++i)
        diffusion.diagonal[i] = std::max(depth[i] - scattered[i], 0.F);
    const std::size_t stride[3] = {1, nx, nx * ny}, count[3] = {nx, ny, nz};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<float>& across = diffusion.across[axis];
        const float side = sides[static_cast<int>(axis)], per_side = 1 / side;
        across.assign(depth.size(), 0.F);
        // Along an axis cells stand in runs of stride * count.
        const std::size_t run = stride[axis] * count[axis];
        for (std::size_t i = 0, in_run = 0; i < depth.size(); ++i, ++in_run) {
            if (in_run == run) in_run = 0;
            const bool last = in_run >= run - stride[axis];
            // An outer face, by Marshak's condition: half a cell's way, and behind it only what leaves.
            const float out = per_side / (1.5F * side * transport[i] + 2);
            if (in_run < stride[axis]) diffusion.diagonal[i] += out;
            if (last) {
                diffusion.diagonal[i] += out;
                continue;
            }
            const std::size_t next = i + stride[axis];
            across[i] = per_side / (1.5F * side * (transport[i] + transport[next]) + kStreaming);
            diffusion.diagonal[i] += across[i];
            diffusion.diagonal[next] += across[i];
        }
    }
    glm::vec3 side = sides;
    for (const Diffusion* finest = &diffusion; finest->diagonal.size() > kFewCells;
         finest = &diffusion.coarser.back())
        diffusion.coarser.push_back(coarser_of(*finest, side));
    return diffusion;
}

void solve_diffusion(const Diffusion& diffusion, std::span<const float> source, double tolerance,
                     std::span<float> value, int threads) {
    const std::size_t count = source.size();
    const std::size_t layer =
        static_cast<std::size_t>(diffusion.cells.x) * static_cast<std::size_t>(diffusion.cells.y);
    std::fill(value.begin(), value.end(), 0.F);
    const double goal = tolerance * tolerance * dot_product(source.data(), source.data(), count);
    if (!(goal > 0)) return;
    std::vector<Level> levels;
    levels.reserve(1 + diffusion.coarser.size());
    levels.emplace_back(diffusion);
    for (const Diffusion& coarser : diffusion.coarser) levels.emplace_back(coarser);
    Vector &residual = levels[0].r, &scaled = levels[0].x;
    std::copy(source.begin(), source.end(), residual.begin());
    Vector product(count), direction(count + layer);
    std::fill(direction.begin(), direction.end(), 0.F);
    BlockSum curvatures(count), lefts(count), rzs(count);
    Team team(std::clamp<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), 1,
                                      std::max<std::size_t>(count / kCellsOfMember, 1)));
    // All members come to the same figures, and so to the same end.
    run_team(team, [&](std::size_t member) {
        const auto [begin, end] = team.share_of(member, count);
        double rz = 0;
        for (int i = 0; i < kMaxDiffusionSteps; ++i) {
            cycle(levels, 0, team, member);
            const double next = rzs.of(team, member, [&](std::size_t first, std::size_t last) {
                return dot_product(residual.data() + first, scaled.data() + first, last - first);
            });
            if (!(next > 0)) return;
            turn(i > 0 ? static_cast<float>(next / rz) : 0.F, scaled.data() + begin,
                 direction.data() + begin, end - begin);
            rz = next;
            team.wait();
            const double curvature =
                curvatures.of(team, member, [&](std::size_t first, std::size_t last) {
                    apply(diffusion, direction.data(), first, last, product.data());
                    return dot_product(direction.data() + first, product.data() + first,
                                       last - first);
                });
            if (!(curvature > 0)) return;
            const auto along = static_cast<float>(rz / curvature);
            const double left = lefts.of(team, member, [&](std::size_t first, std::size_t last) {
                const std::size_t n = last - first;
                step(along, direction.data() + first, product.data() + first, value.data() + first,
                     residual.data() + first, n);
                return dot_product(residual.data() + first, residual.data() + first, n);
            });
            if (left <= goal) return;
        }
    });
}

}  // namespace awan
