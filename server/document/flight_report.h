// What came of a flight, as JSON and as lines for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline.h"

namespace awan {

// One picture of it.
struct FlownFrame {
    // Its number, and its seconds in the sequence.
    std::uint64_t frame = 0;
    double time = 0;
    // All of the scene; those that the picture shows some of; of those the ones that are drawn as billboards, which
    // only the rungs of splats do.
    std::size_t particles = 0, in_view = 0, billboards = 0;
    // Wall time of all its stages.
    double ms = 0;
    StageTimes times;
    double encode_ms = 0;
    bool light_was_kept = false;
    ImpostorFrame impostors;
};
// particles, in_view: counted before its picture was drawn. Without encode_ms and ms.
FlownFrame flown_frame(std::uint64_t frame, double time, std::size_t particles, std::size_t in_view,
                       const Rendered& rendered);

struct FlightReport {
    // Files, or what else the scenes are called.
    std::vector<std::string> scenes;
    // A word of kFlightPathWords, or a file; of kThicknessWords, "" where the scene is as it stands.
    std::string path, mode;
    int width = 0, height = 0, threads = 1;
    std::string rung;
    // What draws: the GL renderer, or the processor.
    std::string renderer;
    // Of the flight, whether all were flown or not.
    std::uint64_t frames_asked = 0;
    bool timed_out = false;
    // From the beginning to the last frame; of that, what was settled before the first.
    double seconds = 0, settle_seconds = 0;
    std::vector<FlownFrame> frames;
    ImpostorReport impostors;

    // Frames over the time that they took, without what was settled before.
    double frames_per_second() const;
};

// The most memory that this process has had, bytes.
std::uint64_t peak_memory();

// {"awan","scenes","path","mode","width","height","threads","rung","renderer","frames","frames_asked","timed_out",
// "time_s","settle_s","fps","particles","in_view","billboards","lights_made","stages_ms":{...},
// "impostors":{"mode","pixels","on","reason","clouds","saved_forecast","frames","kept","drawn","redrawn","whole",
// "pictures_share","eye_share"},"peak_memory_mib","each":[{"frame","time","particles","in_view","billboards","ms",
// "light_was_kept","impostors":{"kept","drawn","redrawn","whole"},"stages_ms":{...}}]}. Of impostors: clouds that stand
// apart, frames that were made of pictures, and in these the clouds shown by a picture of an earlier frame, pictures
// drawn, those of them that took the place of one whose bound was crossed, clouds drawn as they are; shares of all
// frames' time that went into drawing pictures, and into the rest of the eye pass of these frames.
// particles, in_view, billboards and stages_ms: of the mean frame; null where no frame was flown.
std::string flight_to_json(const FlightReport& report);

// The same without the single frames, a line each, as the reports of Pakawan were (Sunar et al. 2005).
std::string flight_to_text(const FlightReport& report);

}  // namespace awan
