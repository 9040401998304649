// The commands of `awan` as functions on plain values. Each returns the exit code: 0 fine, 2 bad
// usage, 3 a scene that cannot be, 4 could not render, 5 could not read or write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/gl/device.h"
#include "server/http/server.h"

namespace awan {

inline constexpr int kExitFine = 0;
inline constexpr int kExitUsage = 2;

struct RenderCommand {
    std::string scene;
    std::string output;
    // Instead of what the document says.
    std::optional<int> width, height;
    std::string format;               // "", "png", "exr"; of an animation "webp", "apng"
    std::optional<double> time;       // seconds
    std::string frames;               // of the scene's sequence: "", "all", "3", "0-11,20"
    double frames_per_second = 12;    // that an animation shows
    std::string background;           // "", "sky", "transparent"
    std::optional<std::string> rung;  // at most one of these three
    std::optional<double> error, time_ms;
    std::string state;  // of an automaton, to begin with: a file, or ""
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_render(const RenderCommand& command);

struct AccuracyCommand {
    std::vector<std::string> scenes;
    std::vector<std::string> outputs;
    std::string format;           // "", "json", "csv", "png"
    std::string theme = "light";  // or "dark"
    double scale = 1;             // of the plot
    int side = 128;               // pixels of the reference's longer side
    std::uint32_t samples = 384;
    std::vector<std::string> rungs;  // empty: all but truth
    int runs = 4;
    double within_seconds = 0;  // of each scene; 0: as long as it takes
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_accuracy(const AccuracyCommand& command);

struct ParticlesCommand {
    std::string scene;
    std::string output = "-";
    std::string format;  // "", "json", "csv", "ply", "awn"
    std::string state;
    int threads = 1;
};
int run_particles(const ParticlesCommand& command);

struct PlanCommand {
    std::string scene;
    std::string output = "-";
    std::string state;
    int threads = 1;
};
int run_plan(const PlanCommand& command);

// The state of an automaton at the scene's time, for --state.
struct StateCommand {
    std::string scene;
    std::string output;
    std::optional<std::uint64_t> cloud;  // by its place in the scene; none: the only automaton
    int threads = 1;
};
int run_state(const StateCommand& command);

struct ConvertCommand {
    std::string input;
    std::string output;
    std::string format;  // "", "json", "awn"
};
int run_convert(const ConvertCommand& command);

struct ServeCommand {
    HttpOptions http;
    std::size_t working = 2;  // requests computed at once
    std::size_t queue = limits::kRenderQueue;
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_serve(const ServeCommand& command);

// The error as it is printed, "awan: SCENE: POINTER: message", and its exit code.
int report_error(const std::string& subject, const Error& error);

// "host:port", "[v6]:port", "host" or "port"; nothing when it is none of them.
struct ListenAddress {
    std::string host;
    int port = 0;
};
std::optional<ListenAddress> parse_listen(const std::string& text);

}  // namespace awan
