#include "core/light/band_solve.h"

#include <cmath>

#include "core/light/diffusion.h"
#include "core/light/gmres.h"
#include "core/light/sharpening.h"

namespace awan {
namespace {

// Of the preconditioner's own solve. It need not be good: it is one of many steps.
constexpr double kDiffusionTolerance = 0.05;
// Vectors that GMRES keeps.
constexpr int kBasis = 12;

// The source that the sun's beam is to the grid, harmonics floats a cell.
std::vector<float> scattered_beam(const BandProblem& problem, std::size_t harmonics_count) {
    const Matter& matter = problem.matter;
    const std::vector<float>& beam = *problem.beam;
    const std::array<double, kHarmonics> y = harmonics(problem.beam_direction);
    std::vector<float> source(beam.size() * harmonics_count);
    for (std::size_t i = 0; i < beam.size(); ++i)
        for (std::size_t m = 0; m < harmonics_count; ++m)
            source[i * harmonics_count + m] =
                beam[i] * matter.albedo[i] *
                static_cast<float>(problem.split.outside_peak(kOrderOf[m]) * y[m]);
    return source;
}

// From moments of the radiance to those of the source function.
LightBand band_of(const BandProblem& problem, const std::vector<float>& moments) {
    const Matter& matter = problem.matter;
    const auto count = static_cast<std::size_t>(matter.grid.harmonics);
    LightBand band;
    band.moments.resize(matter.grid.size());
    for (std::size_t i = 0; i < band.moments.size(); ++i) {
        band.moments[i].fill(0);
        for (std::size_t m = 0; m < count; ++m)
            band.moments[i][m] = matter.albedo[i] *
                                 static_cast<float>(problem.split.outside_peak(kOrderOf[m])) *
                                 moments[i * count + m];
    }
    return band;
}

// The moments of the radiance of which `guess` is the source function; what does not scatter leaves no trace in it.
std::vector<float> radiance_of_guess(const BandProblem& problem) {
    const Matter& matter = problem.matter;
    const auto count = static_cast<std::size_t>(matter.grid.harmonics);
    std::vector<float> moments(matter.grid.size() * count);
    for (std::size_t i = 0; i < problem.guess.size(); ++i)
        for (std::size_t m = 0; m < count; ++m) {
            const float scatters =
                matter.albedo[i] * static_cast<float>(problem.split.outside_peak(kOrderOf[m]));
            if (std::abs(scatters) > 1e-6F) moments[i * count + m] = problem.guess[i][m] / scatters;
        }
    return moments;
}

}  // namespace

// Written for the moments phi alone, the equation is (1 - K) phi = right: K scatters the light of phi and sweeps it
// through the grid, `right` are the moments of the light that has not been scattered yet on the grid.
Result<SolvedBand> solve_band(const BandProblem& problem, const Ordinates& ordinates, int threads,
                              const Deadline& deadline) {
    const Matter& matter = problem.matter;
    const auto count = static_cast<std::size_t>(matter.grid.harmonics);
    const std::size_t cells = matter.grid.size();
    SweepSpace space;
    std::vector<float> source = problem.beam != nullptr ? scattered_beam(problem, count)
                                                        : std::vector<float>(cells * count);
    std::vector<float> right(source.size());
    sweep(matter.grid, ordinates, {source}, problem.inflow, threads, space, {right},
          problem.from_below);
    if (problem.once) return SolvedBand{band_of(problem, right), 1, 0};

    const Sharpening sharpening = make_sharpening(matter.grid, ordinates);
    std::vector<float> first(cells), even(cells);
    SweepSource scattered{.moments = {}, .scale = matter.scattered, .even = even};
    for (std::size_t m = 0; m < count; ++m)
        scattered.weight[m] = static_cast<float>(problem.split.moment[kOrderOf[m]]);
    // `first`: the first moments of `from` and `addition`. `even`: what is sent out evenly, beside what scatters of
    // `from`.
    const Product one_minus_k = [&](std::span<const float> from, std::span<const float> addition,
                                    std::span<float> to) -> Status {
        if (auto error = deadline.over()) return error;
        if (addition.empty()) {
            for (std::size_t i = 0; i < cells; ++i) first[i] = from[i * count];
            std::fill(even.begin(), even.end(), 0.F);
        } else {
            const float moment = scattered.weight[0];
            for (std::size_t i = 0; i < cells; ++i) {
                first[i] = from[i * count] + addition[i];
                even[i] = matter.scattered[i] * moment * addition[i];
            }
        }
        add_sharpening(sharpening, first, even);
        scattered.moments = from;
        sweep(matter.grid, ordinates, scattered, {}, threads, space, {to, from, addition});
        return std::nullopt;
    };
    // What a vector of moments scatters evenly, spread by diffusion.
    Diffusion diffusion;
    if (!problem.spread)
        diffusion = make_diffusion(matter.grid.cells, matter.grid.sides, matter.grid.depth,
                                   matter.scattered, problem.split.moment[1]);
    std::vector<float> unsettled(cells);
    const auto diffuse = [&](std::span<const float> vector, std::span<float> addition) {
        for (std::size_t i = 0; i < cells; ++i)
            unsettled[i] = matter.scattered[i] * vector[i * count];
        if (problem.spread)
            problem.spread(unsettled, addition);
        else
            solve_diffusion(diffusion, unsettled, kDiffusionTolerance, addition, threads);
    };
    std::vector<float> moments = radiance_of_guess(problem);
    const auto outcome = gmres(one_minus_k, {count, diffuse}, right,
                               {problem.tolerance, problem.max_sweeps, kBasis}, threads, moments);
    if (!outcome.ok()) return outcome.error();
    return SolvedBand{band_of(problem, moments), outcome->products + 1, outcome->residual};
}

}  // namespace awan
