// The times of a scene that belong together.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/camera_keys.h"
#include "core/scene/interpolation.h"
#include "core/scene/limits.h"
#include "core/scene/table.h"

namespace awan {

// Frames 0 .. frames-1 of a scene, the first at `from`, the last at `to`, evenly between.
struct Sequence {
    double from = 0;
    double to = 1;
    std::uint64_t frames = 1;
    // Where the camera is at each time, in place of the scene's eye, target and fov. EMPTY: it stands.
    std::vector<CameraKey> camera{};
    // Straight between them, else along a curve.
    bool linear_camera = false;
    // The clouds of all frames are those of `from`: only the camera moves.
    bool clouds_stand = false;
};

inline constexpr const char* kSequenceCloudsWords[] = {"move", "stand"};

inline constexpr Field kSequenceFields[] = {
    field<&Sequence::from>({.name = "from",
                            .wanted = "a number (seconds)",
                            .range = within(limits::kMaxTime),
                            .unit = "seconds",
                            .says = "Seconds, of the first frame."}),
    field<&Sequence::to>({.name = "to",
                          .wanted = "a number (seconds)",
                          .range = within(limits::kMaxTime),
                          .required = true,
                          .unit = "seconds",
                          .says = "Seconds, of the last frame."}),
    field<&Sequence::frames>({.name = "frames",
                              .wanted = "an integer >= 1",
                              .counts = count_from_to(1, limits::kMaxFrames),
                              .required = true,
                              .says = "How many, evenly from the first to the last."}),
    field<&Sequence::camera>(
        {.name = "camera",
         .wanted = "a list of camera keys",
         .counts = at_most(limits::kMaxCameraKeys),
         .says =
             "Keys of a camera that moves, in rising order of time; in place of eye, target and "
             "fov of the scene's camera. Before the first and after the last it stands."}),
    field<&Sequence::linear_camera>(
        {.name = "interpolation",
         .words = kInterpolationWords,
         .says = "Between camera keys: along a curve through all of them, or straight.",
         .idle = [](const void* o) { return static_cast<const Sequence*>(o)->camera.size() < 2; }}),
    field<&Sequence::clouds_stand>(
        {.name = "clouds",
         .words = kSequenceCloudsWords,
         .says = "Whether clouds move and change from frame to frame, or stand as they are at "
                 "`from` while the camera moves, whose light is then made once."}),
};
static_assert(covers<Sequence>(kSequenceFields));

inline constexpr Table kSequenceTable{
    .name = "Sequence",
    .says =
        "Frames of a scene, evenly between two times, and where the "
        "camera is at each.",
    .fields = kSequenceFields,
    .standard = standard_of<Sequence>};
template <>
inline const Table& table_of<Sequence>() {
    return kSequenceTable;
}

}  // namespace awan
