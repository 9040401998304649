// The commands of `awan` as functions on plain values. Each returns the exit code: 0 fine, 2 bad
// usage, 3 a scene that cannot be, 4 could not render, 5 could not read or write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/gl/device.h"
#include "core/impostor.h"
#include "server/cli/scene_input.h"
#include "server/http/server.h"

namespace awan {

inline constexpr int kExitFine = 0;
inline constexpr int kExitUsage = 2;

struct RenderCommand {
    SceneInput scene;
    // One or more; each in the format of its name.
    std::vector<std::string> outputs;
    // These and the next are in place of what the document says.
    std::optional<int> width, height;
    // "", "png", "png16", "exr"; of an animation "webp", "apng".
    std::string format;
    // Seconds, in place of the document's.
    std::optional<double> time;
    // Of the scene's sequence: "", "all", "3", "0-11,20".
    std::string frames;
    // That an animation shows.
    double frames_per_second = 12;
    // The frames side by side on one sheet, with its layout beside it; so many in a row, 0: about a square.
    bool flipbook = false;
    int columns = 0;
    // "", "sky", "transparent".
    std::string background;
    // In place of the document's, as ImageSettings::layers.
    std::optional<std::string> layers;
    // Of rung, error and time_ms at most one is set.
    std::optional<std::string> rung;
    std::optional<double> error, time_ms;
    // A channel of PNG: 8 or 16, in place of what the format says.
    std::optional<int> bits;
    // Pictures whose files are all there are not made again.
    bool skip_existing = false;
    // What make and ninja read to know what the files are made of, or "".
    std::string depfile;
    // A line of JSON for every picture, in place of one for people.
    bool json = false;
    // Looked at in passing: one ray a pixel, no error measured.
    bool preview = false;
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_render(const RenderCommand& command);

// A flight around clouds or through them (core/flight_path.h).
struct FlyCommand {
    // One or more, which become one; `input` has what takes the place of values in the first, and no path.
    std::vector<std::string> scenes;
    SceneInput input;
    // "", a word of kFlightPathWords, or a file of camera keys.
    std::string path;
    // "", or a word of kThicknessWords.
    std::string mode;
    std::optional<std::uint64_t> frames;
    std::optional<int> width, height;
    double frames_per_second = 12;
    std::optional<std::string> rung;
    // A word of kImpostorsWords.
    std::string impostors = "auto";
    double impostor_pixels = 1;
    // Until when it flies; 0: to its end.
    double timeout_seconds = 0;
    // A .json or a .txt, or "".
    std::string report;
    // Numbered pictures, animations, and the flight's document, a .json. EMPTY: it is flown for the report alone.
    std::vector<std::string> outputs;
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_fly(const FlyCommand& command);

// What the sources measured, and this machine (source_figures.h).
struct BenchCommand {
    // By their words; EMPTY: all.
    std::vector<std::string> sources;
    // "", "json", "png": of standard output.
    std::string format;
    // Beside the table on standard output, which is left out where one of them goes there.
    std::vector<std::string> outputs;
    // "light" or "dark".
    std::string theme = "light";
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_bench(const BenchCommand& command);

struct AccuracyCommand {
    std::vector<std::string> scenes;
    // What takes the place of values in each of them; no path.
    SceneInput input;
    std::vector<std::string> outputs;
    // "", "json", "csv", "png".
    std::string format;
    // "light" or "dark".
    std::string theme = "light";
    // The size of the plot, a factor.
    double scale = 1;
    // Pixels of the reference's longer side.
    int side = 128;
    std::uint32_t samples = 384;
    // Empty: all but truth.
    std::vector<std::string> rungs;
    int runs = 4;
    // Seconds that each scene may take; 0: as long as it takes.
    double within_seconds = 0;
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_accuracy(const AccuracyCommand& command);

struct ParticlesCommand {
    SceneInput scene;
    std::string output = "-";
    // "", "json", "csv", "ply", "awn", "glb", "vdb", "xml".
    std::string format;
    // Metres of a unit of length, in an .xml.
    double unit = 100;
    // Cells along the longest side of a volume.
    int voxels = 128;
    // Whether that has the light too.
    bool light = false;
    // Seconds, in place of the document's.
    std::optional<double> time;
    // Of the scene's sequence: "", "all", "3", "0-11,20".
    std::string frames;
    bool skip_existing = false;
    std::string depfile;
    int threads = 1;
};
int run_particles(const ParticlesCommand& command);

// A map of the scene's sky.
struct SkyCommand {
    SceneInput scene;
    std::string output;
    // "", "exr", "png".
    std::string format;
    // Pixels, even; half as high.
    int width = limits::kSkyMapWidth;
    // As RenderCommand has them.
    bool skip_existing = false;
    std::string depfile;
    bool json = false;
    int threads = 1;
};
int run_sky(const SkyCommand& command);

// A scene from many sides.
struct ImpostorCommand {
    SceneInput scene;
    std::string output;
    // "", "png", "exr".
    std::string format;
    ImpostorWish wish;
    // As RenderCommand has them.
    bool skip_existing = false;
    std::string depfile;
    bool json = false;
    int threads = 1;
    DeviceChoice device = DeviceChoice::kAuto;
};
int run_impostor(const ImpostorCommand& command);

struct PlanCommand {
    SceneInput scene;
    std::string output = "-";
    // As RenderCommand has them.
    bool skip_existing = false;
    std::string depfile;
    int threads = 1;
};
int run_plan(const PlanCommand& command);

// The state of an automaton at the scene's time, or those up to it, for --state.
struct StateCommand {
    SceneInput scene;
    std::string output;
    // States at every so many steps, and of a sequence up to its last frame; none: the one at the scene's time.
    std::optional<std::uint64_t> every;
    // The cloud's place in the scene; none: the only automaton.
    std::optional<std::uint64_t> cloud;
    // As RenderCommand has them.
    bool skip_existing = false;
    std::string depfile;
    int threads = 1;
};
int run_state(const StateCommand& command);

struct ConvertCommand {
    SceneInput input;
    std::string output;
    // "", "json", "awn".
    std::string format;
    // As RenderCommand has them.
    bool skip_existing = false;
    std::string depfile;
};
int run_convert(const ConvertCommand& command);

// Whether the scenes can be; a line for each.
struct ValidateCommand {
    std::vector<std::string> scenes;
    // What takes the place of values in each of them; no path.
    SceneInput input;
};
int run_validate(const ValidateCommand& command);

// The names of the scenes that ship with the program, or the document of one of them.
struct PresetsCommand {
    std::string name;
};
int run_presets(const PresetsCommand& command);

// What says that two scenes are the same, as text of 32 hex digits: to share scenes out over machines that keep light.
struct DigestCommand {
    SceneInput scene;
};
int run_digest(const DigestCommand& command);

struct ServeCommand {
    HttpOptions http;
    // Requests that compute at once; 0: as many as there are threads, at least 2.
    std::size_t lanes = 0;
    // Of these, kept for what is expected to take at most a second.
    std::size_t short_lanes = 1;
    // That wait, of each weight.
    std::size_t queue = limits::kRenderQueue;
    // MiB for all scenes that are being worked on; 0: half of what the machine or its container has, at most
    // limits::kWorkBytes. MiB of kept answers.
    std::size_t memory_mib = 0, cache_mib = limits::kCacheBytes >> 20;
    // A folder of answers that outlive the server, or "", and its MiB.
    std::string cache_dir;
    std::size_t cache_disk_mib = limits::kDiskCacheBytes >> 20;
    // Seconds from a whole request to its answer.
    double deadline_seconds = std::chrono::duration<double>(limits::kRequestDeadline).count();
    // MiB of a request's body.
    std::size_t body_mib = limits::kMaxBodyBytes >> 20;
    std::size_t connections = limits::kMaxConnections;
    // A file with the token that clients must show, or "".
    std::string token_file;
    // Whoever reaches it may ask, token or not, on other addresses than this machine's own too.
    bool open_to_all = false;
    LogFormat log = LogFormat::kNone;
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
