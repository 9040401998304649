// What the source documents measured of their systems, and the same measured here: what `awan bench` prints.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/deadline.h"
#include "core/gl/device.h"

namespace awan {

// Documents with figures of time, and Ebert's chapter, which prints none: its frames are measured here alone. (Gardner
// 1985 prints none either.)
enum class BenchSource { kCubes, kAutomaton, kSpheres, kImplicit };
inline constexpr const char* kBenchSourceWords[] = {"cubes", "automaton", "spheres", "implicit"};
struct BenchDocument {
    // Who, when, and on which machine; or that it says nothing of times.
    const char* title;
    const char* machine;
};
const BenchDocument& document_of(BenchSource source);

enum class BenchUnit { kMilliseconds, kFramesASecond };

struct BenchFigure {
    BenchSource source = BenchSource::kCubes;
    // Where the document has it, "figure 5.4"; EMPTY: it names the dependence without a figure.
    std::string place;
    std::string what;
    BenchUnit unit = BenchUnit::kMilliseconds;
    // As printed, or as its text reads a graph; none: it prints none.
    std::optional<double> theirs;
    double ours = 0;

    // How many times as fast, > 0; none without theirs.
    std::optional<double> times_as_fast() const {
        if (!theirs) return std::nullopt;
        return unit == BenchUnit::kMilliseconds ? *theirs / ours : ours / *theirs;
    }
};

struct BenchWish {
    std::vector<BenchSource> sources;
    // Of what may use several. Ostroushko et al. measured one core, and one is measured here too.
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};

// Calls `begin` with what is measured next, and `take` with each figure as it is there. A figure is the median of
// several runs, the first of them not counted. renderer: set to what drew the splats, where any were drawn. Takes
// about a minute; with splats and no GPU three. Errors: kNoRenderer (frames are drawn by splats),
// kOverDeadline, kCancelled, kOutOfMemory.
Status measure_figures(const BenchWish& wish, const std::function<void(const std::string&)>& begin,
                       const std::function<void(BenchFigure)>& take, std::string& renderer,
                       const Deadline& deadline);

}  // namespace awan
