// Pictures to files: what `awan render` and `awan fly` share. One picture, numbered pictures, an animation, a sheet;
// each in one file or several.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/light/machine_speed.h"
#include "core/pipeline.h"
#include "server/cli/cli.h"
#include "server/cli/result_line.h"
#include "server/cli/support.h"
#include "server/cli/targets.h"
#include "server/document/flight_report.h"

namespace awan {

// What the renders of one command share.
struct Work {
    Work(const RenderCommand& c, std::vector<Target> t) : command(c), targets(std::move(t)) {}

    const RenderCommand& command;
    const std::vector<Target> targets;
    // A channel of PNG.
    int png_bits = 8;
    MachineSpeed speed = measure_speed();
    std::optional<Device> device;
    ProgressLine progress;
    DetailTiles tiles;
    // Of frames whose matter is the same. None: each makes its own.
    std::optional<LightCache> lights;
    // The same of particles.
    std::optional<StandingMatter> matter;
    // When to stop, with what is done by then.
    Deadline deadline;
    // Told of every frame once its files are written; null: nobody counts.
    std::function<void(FlownFrame)> flown;
    // Of a flight.
    FlightImpostorWish impostor_wish;
    std::optional<FlightImpostors> impostors;
    // Put before what is said, e.g. "frame 3 of 12, ".
    std::string prefix;
};

// Lights and draws what was planned, on a device that is opened when the first picture needs one. An error in `planned`
// is passed on.
Result<Rendered> render_picture(const Scene& scene, Result<Planned> planned, Work& work);

// Writes the picture to every file that holds one alone. frame: none for a scene that stands still.
Status write_picture(const Rendered& rendered, const Scene& scene, const std::uint64_t* frame,
                     Work& work, double& encode_ms);

// Says what came of a picture; nothing where the picture itself goes to standard output.
void say_result(const PictureResult& result, const Scene& scene, const Rendered* rendered,
                Work& work);

// Whether all files are there already.
bool all_finished(const std::vector<std::string>& files);

// The file of a sheet's layout: clouds.png has clouds.json beside it.
std::string layout_path(const std::string& sheet);

// Makes frames of the scene's sequence, as files of their own or as animations and sheets. Where the work's deadline
// passes it stops, and animations are of the frames that were done by then; without one the error is kOverDeadline.
struct FramesMade {
    std::size_t count = 0;
    bool timed_out = false;
    // Of settling what is the same for all of them.
    double settle_ms = 0;
};
Result<FramesMade> render_frames(const Scene& scene, std::vector<std::uint64_t> frames, Work& work);

}  // namespace awan
