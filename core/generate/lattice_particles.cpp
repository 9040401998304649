#include "core/generate/lattice_particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"

namespace awan {
namespace {

// What a layer of cells comes to. Layers are summed in their order, whichever thread made them.
struct Layer {
    std::size_t kept = 0;
    // The sum of the values of the cells that stay, sharpened if asked for.
    double sum = 0;
};

class Cells {
  public:
    Cells(const LatticeField& field, const LatticeOptions& options)
        : field_(field), options_(options) {}

    // Calls keep(i, j, value) for every cell of layer k that stays.
    template <typename Keep>
    void of_layer(int k, const Keep& keep) const {
        for (int j = 0; j < field_.ny; ++j)
            for (int i = 0; i < field_.nx; ++i) {
                const float plain = field_.values[field_.index(i, j, k)];
                if (!(plain > options_.threshold)) continue;
                const double value =
                    options_.sharpen ? sharpened_at(field_, i, j, k) : double{plain};
                if (value > 0) keep(i, j, value);
            }
    }

  private:
    const LatticeField& field_;
    const LatticeOptions& options_;
};

double layer_sum(const LatticeField& field, int k) {
    double sum = 0;
    for (int j = 0; j < field.ny; ++j)
        for (int i = 0; i < field.nx; ++i)
            sum += static_cast<double>(field.values[field.index(i, j, k)]);
    return sum;
}

}  // namespace

double sharpened_at(const LatticeField& field, int i, int j, int k) {
    const auto at = [&](int x, int y, int z) {
        const bool inside =
            x >= 0 && y >= 0 && z >= 0 && x < field.nx && y < field.ny && z < field.nz;
        return inside ? static_cast<double>(field.values[field.index(x, y, z)]) : 0.0;
    };
    const double around =
        ((at(i - 1, j, k) + at(i + 1, j, k)) + (at(i, j - 1, k) + at(i, j + 1, k))) +
        (at(i, j, k - 1) + at(i, j, k + 1));
    const double plain = at(i, j, k);
    return plain - kLatticeS * kLatticeS / 2 * (around - 6 * plain);
}

double lattice_mass(const LatticeField& field) {
    double sum = 0;
    for (int k = 0; k < field.nz; ++k) sum += layer_sum(field, k);
    return sum * field.cell * field.cell * field.cell;
}

ReadyParticles lattice_particles(const LatticeField& field, const LatticeOptions& options,
                                 int threads) {
    ReadyParticles particles;
    const auto layers = static_cast<std::size_t>(std::max(field.nz, 0));
    const Cells cells(field, options);
    std::vector<Layer> layer(layers);
    parallel_for(threads, layers, [&](std::size_t k) {
        cells.of_layer(static_cast<int>(k), [&](int, int, double value) {
            ++layer[k].kept;
            layer[k].sum += value;
        });
    });
    double sum = 0;
    std::vector<std::size_t> first(layers);
    std::size_t count = 0;
    for (std::size_t k = 0; k < layers; ++k) {
        first[k] = count;
        count += layer[k].kept;
        sum += layer[k].sum;
    }
    if (count == 0) return particles;

    const auto radius = static_cast<float>(2 * kLatticeS * field.cell);
    const double s = static_cast<double>(radius) / 2;
    const double mass_of_one = exact::pow(2 * std::numbers::pi, 1.5) * s * s * s;
    // From a cell's value to a particle's density. The quotient of the sums is 1 where nothing was left out.
    const double scale = lattice_mass(field) / (sum * mass_of_one);
    particles.positions.resize(count);
    particles.radii.assign(count, radius);
    particles.densities.resize(count);
    parallel_for(threads, layers, [&](std::size_t k) {
        std::size_t at = first[k];
        cells.of_layer(static_cast<int>(k), [&](int i, int j, double value) {
            particles.positions[at] =
                field.origin + field.cell * glm::dvec3(i, j, static_cast<double>(k));
            particles.densities[at] = static_cast<float>(value * scale);
            ++at;
        });
    });
    return particles;
}

}  // namespace awan
