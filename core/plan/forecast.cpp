#include "core/plan/forecast.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/exact_math.h"
#include "core/plan/criteria.h"
#include "core/plan/forecast_errors.h"
#include "core/plan/forecast_times.h"
#include "core/plan/known_error.h"
#include "core/plan/transport_settings.h"

namespace awan {
namespace {

constexpr double kSmallestError = 1e-3;  // nothing below was measured
constexpr double kLargestError = 20;

double predicted_error(const ErrorModel& model, const ErrorFigures& figures) {
    const double log_error =
        std::inner_product(figures.begin(), figures.end(), model.coefficient.begin(), 0.0);
    return exact::exp(std::clamp(log_error, exact::log(kSmallestError), exact::log(kLargestError)));
}

double predicted_ms(const TimeModel& model, const TimeFigures& figures) {
    return std::inner_product(figures.begin(), figures.end(), model.coefficient.begin(), 0.0);
}

// Of a scene in islands: the solves that run at a time, the lights, the particles sorted into islands and those that
// the islands at work have of each other.
double island_bytes(const IslandWork& work, double bands, double particles, double vectors,
                    int threads) {
    return 64 * vectors * work.largest * std::max(threads, 1) + 64 * bands * work.cells +
           6 * work.nodes + 8e6 + 64 * particles * (2 + std::max(threads, 1));
}

// Cells of the solve for the sun where there is detail; 0: there is none. `cells`: of the grid.
double fine_cells(const Rung& rung, const Scene& scene, const Survey& survey, double cells) {
    if (!detail_counts(scene, survey)) return 0;
    double fine = cells * exact::pow(fine_cells_a_side(rung.cells), 3);
    if (fine > kMostFineCells && rung.cells <= 32) fine = 8 * cells;
    return fine <= kMostFineCells ? fine : 0;
}

// At its peak, beside particles and picture: the transport solve's vectors, or the light grid and lists of the splats.
double predicted_bytes(const Rung& rung, const Scene& scene, const Survey& survey,
                       const TimeFigures& figures, int threads) {
    // Of GMRES (core/light/transport.cpp) and the sweeps, 16 floats a cell.
    constexpr double kVectors = 2 * 12 + 8;
    // Of the sun's solve on fine cells, which takes few sweeps.
    constexpr double kFineVectors = 18;
    const double pairs = figures[3], particles = figures[2];
    switch (rung.method) {
        case Method::kSplats:
            return 1e6 + 160 * particles + 8 * pairs / 128;
        case Method::kMarch:
            if (!survey.islands.list.empty()) {
                const IslandWork work = island_work(transport_settings(rung), scene, survey);
                return island_bytes(work, scene->sky.none ? 1 : 4, particles, kVectors, threads) +
                       64 * kFineVectors * fine_cells(rung, scene, survey, work.largest) *
                           std::max(threads, 1);
            }
            return std::min(exact::pow(rung.cells, 3), figures[5]) * 64 * kVectors +
                   64 * kFineVectors *
                       fine_cells(rung, scene, survey,
                                  std::min(exact::pow(rung.cells, 3), figures[5])) +
                   8e6 + 64 * particles;
        case Method::kPaths:
        case Method::kLook:  // never asked for (plan.cpp)
        case Method::kDisplay:
            break;
    }
    return 32e6 + 64 * particles + 32 * figures[4];
}

// Time with so many threads over that of the calibration; `serial`: share that threads do not shorten.
constexpr double kMarchSerial = 0.25;
double stretch(int threads, double serial) {
    const auto time = [&](int n) { return serial + (1 - serial) / std::max(n, 1); };
    return time(threads) / time(kCalibratedThreads);
}

double measuring_ms(const Rung& rung, const Scene& scene, const Survey& survey, int threads) {
    if (rung.method == Method::kPaths || rung.method == Method::kLook) return 0;
    const TimeModel& model = rung.cells > 0 ? kMeasureGridTime : kMeasureOtherTime;
    return predicted_ms(model, measuring_figures(rung, scene, survey)) *
           stretch(threads, kMarchSerial);
}

// What hills add, ms, with two threads on the machine of the calibration. Their height map and its light, which are the
// same for every picture; and what each pixel's ray meets, of splats by one thread. Measured with and without hills at
// 160 x 90 to 1600 x 900 pixels, within a third: 400 to 1300 ms by `single`, 750 to 1500 by `harris`.
constexpr double kHills_ms = 350, kHillsPixel_ms = 0.9e-3;
constexpr double kHillsSerial = 0.5;
double hills_ms(const Rung& rung, const Scene& scene, double pixels, int threads) {
    if (!has_terrain(*scene) || rung.method == Method::kLook || rung.method == Method::kDisplay)
        return 0;
    const int drawing = rung.method == Method::kSplats ? 1 : threads;
    return kHills_ms * stretch(threads, kHillsSerial) +
           kHillsPixel_ms * pixels * stretch(drawing, 0);
}

const ErrorModel& error_model(const Rung& rung) {
    switch (rung.method) {
        case Method::kSplats:
            return rung.id == RungId::kAdditive ? kAdditiveError : kHarrisError;
        case Method::kMarch:
            return rung.cells == 0 ? kSingleError : kTransportError;
        case Method::kPaths:
        case Method::kLook:  // never asked for (plan.cpp)
        case Method::kDisplay:
            break;
    }
    return kPathNoise;
}

}  // namespace

RungForecast forecast(const Rung& rung, const Scene& scene, const Survey& survey,
                      std::uint32_t samples, int threads, const MachineSpeed& speed) {
    RungForecast forecast;
    forecast.rung = &rung;
    const ErrorFigures errors = error_figures(rung, scene, survey);
    const TimeFigures times = time_figures(rung, scene, survey, samples);
    const bool empty = survey.particles == 0 || !(survey.total_mass > 0);
    if (!empty) forecast.error = predicted_error(error_model(rung), errors);
    // Of grids, the model is of what they are measured to differ by.
    if (!empty && rung.cells > 0)
        forecast.error = exact::hypot(
            forecast.error, known_error(scene, survey, detail_counts(scene, survey), rung.cells));
    double ms = predicted_ms(kPrepareTime, times);
    const double march_speed = stretch(threads, kMarchSerial);
    switch (rung.method) {
        case Method::kSplats:
            ms += rung.id == RungId::kAdditive ? predicted_ms(kAdditiveTime, times)
                                               : predicted_ms(kHarrisLightTime, times) +
                                                     predicted_ms(kHarrisDrawTime, times);
            break;
        case Method::kMarch: {
            const double light = predicted_ms(kMarchLightTime, times);
            const double draw = predicted_ms(kMarchDrawTime, times);
            forecast.light_ms = light * march_speed * speed.slowness;
            forecast.draw_ms = draw * march_speed * speed.slowness;
            ms += (light + draw) * march_speed;
            break;
        }
        case Method::kPaths:
            forecast.error /= std::sqrt(std::max(samples, 1U));
            ms += predicted_ms(kPathTime, times) * stretch(threads, 0);
            break;
        case Method::kLook:
        case Method::kDisplay:
            break;
    }
    const double pixels = static_cast<double>(scene->image.width) * scene->image.height;
    ms += hills_ms(rung, scene, pixels, threads);
    const double measure_ms = empty ? 0 : measuring_ms(rung, scene, survey, threads);
    forecast.measure_ms = measure_ms * speed.slowness;
    forecast.time_ms = (ms + measure_ms) * speed.slowness;
    forecast.bytes = predicted_bytes(rung, scene, survey, times, threads);
    return forecast;
}

std::uint32_t samples_for(double error, const Scene& scene, const Survey& survey) {
    const Rung& truth = rung_of(RungId::kTruth);
    const double noise = forecast(truth, scene, survey, 1, 1, {}).error;
    const double samples = std::ceil(noise * noise / (error * error) / 2) * 2;
    return static_cast<std::uint32_t>(std::clamp(samples, 2.0, double{kMaxTruthSamples}));
}

}  // namespace awan
