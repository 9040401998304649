// A flight around a scene's clouds or through them: the scene with a camera that moves (core/scene/camera_keys.h), as
// thick as it is asked to be. What is drawn of it is a sequence like any other.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/deadline.h"
#include "core/scene/scene.h"

namespace awan {

// keys: along those of the scene's sequence.
enum class FlightPath { kKeys, kOrbit, kThrough };
inline constexpr const char* kFlightPathWords[] = {"keys", "orbit", "through"};

// Optical depth straight up through the thickest place: 1, 6 and 30.
enum class Thickness { kThin, kMedium, kThick };
inline constexpr const char* kThicknessWords[] = {"thin", "medium", "thick"};
inline constexpr double kThicknessDepths[] = {1, 6, 30};

// Of a flight that does not say, and of scenes without a sequence.
inline constexpr std::uint64_t kFlightFrames = 48;
inline constexpr double kFlightFramesPerSecond = 12;
// All orders of scattering on the coarsest grid: light that one makes once and looks at from everywhere.
inline constexpr const char* kFlightRung = "transport-16";
// Of a scene with textures, which only splats show.
inline constexpr const char* kPaintedFlightRung = "harris";

struct FlightWish {
    // None: the scene's camera keys, or where it has none an orbit.
    std::optional<FlightPath> path;
    // None: as it stands.
    std::optional<Thickness> thickness;
    // At most limits::kMaxCameraKeys; none: those of the scene's sequence, or kFlightFrames.
    std::optional<std::uint64_t> frames;
    // Of the flight's clock where the scene has no sequence.
    double frames_per_second = kFlightFramesPerSecond;
    // By name; none: kFlightRung. A look has none.
    std::optional<std::string> rung;
};

// The scene of a flight. Its sequence lasts as long as the scene's own; where it has none, or one of no duration, the
// clouds stand as they are at its time while the camera flies. Every frame of an orbit or a way through has a key.
//
// An orbit is one turn about the middle of what the clouds fill at the sequence's first, middle and last time, from
// the side where the scene's camera is, always as far away as holds all of it in the picture from every side; its eye
// is a little below the middle, as one sees clouds, but never below the ground.
//
// A way through begins in the sun's side of the clouds where all of them are in the picture, follows the level line
// along x or z on which there is most matter, and turns around on its way, so that it sees what it leaves: it ends
// where all is in the picture again.
//
// threads >= 1. Errors: of validate(), generate() and survey(); kInvalidScene where there are no keys to fly along, or
// no matter to make thick.
Result<Scene> flight_of(const SceneDraft& draft, const FlightWish& wish, int threads,
                        const Deadline& deadline);

}  // namespace awan
