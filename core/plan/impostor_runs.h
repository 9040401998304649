// Impostors in flight (Harris & Lastra 2001): a cloud's picture is drawn once, facing the eye, and shown in place of
// the cloud for as long as a bound on its error holds. Here is decided which clouds have one in which frames, before
// the first is drawn: a flight's path is known, so a picture can be of the eye in the middle of the frames that it
// serves, and whether it pays can be told. (Not to be confused with core/impostor.h, atlases for engines.)
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "core/survey/separate_clouds.h"
#include "core/survey/survey.h"

namespace awan {

// auto: where they pay. on: wherever the bound lets a picture serve two frames.
enum class Impostors { kAuto, kOn, kOff };
inline constexpr const char* kImpostorsWords[] = {"auto", "on", "off"};

// By how far at most an impostor shows a cloud's matter beside its place, pixels.
inline constexpr double kImpostorPixels = 1;
inline constexpr double kLeastImpostorPixels = 0.05, kMostImpostorPixels = 64;

struct FlightImpostorWish {
    Impostors mode = Impostors::kAuto;
    double pixels = kImpostorPixels;
};

// The other halves of the bound. The phase function, along any ray to the cloud, changes by at most this share while
// its picture is kept: single scattering changes by as much, all light by less.
inline constexpr double kMostPhaseChange = 0.1;
// Sides of a picture's texels where they are shown, in pixels.
inline constexpr double kLeastTexel = 0.45, kMostTexel = 1.1;
// Haze is laid over a picture as if it were flat: the most optical depth of haze from its plane to its ends.
inline constexpr double kMostHazeWithin = 0.1;

// A cloud's picture as it is drawn: from the eye, facing the cloud, all of which it holds.
struct FacingPicture {
    View view;
    int width = 0, height = 0;
    // The plane that it is shown on, across view.forward, so far from the eye; and the ends of what shows of the cloud.
    // 1 / plane is the mean of 1 / near and 1 / far: matter at both ends is then off by as much.
    double plane = 1, near = 1, far = 1;
    // Largest slopes, x / z and y / z in the view's frame, of what shows.
    double across = 0, up = 0;
};

// None: the eye is within the cloud, or so near to it that one picture cannot face it all; or the picture would have
// more than 4 times the pixels of the frame.
std::optional<FacingPicture> facing_picture(const SeparateCloud& cloud, const View& view,
                                            const ImageSettings& image);

// The bound: by how many pixels the picture may show matter of the cloud beside its place, seen from another eye.
// Matter at distance z along `forward` (near <= z <= far) on a ray of slope m is shown in the plane at p. With e the
// eye's way since, across and along `forward`, both are seen at slopes that differ by exactly
//     (m e_along - e_across) (p - z) / ((z - e_along) (p - e_along)),
// which is the largest at an end of the cloud and at a corner of its slopes. Infinite where it has no bound.
double displacement(const FacingPicture& picture, const View& view, const ImageSettings& image);

// Frames first..last (of the flight) in which a cloud is shown by its picture from the eye of frame `key`.
struct ImpostorRun {
    std::size_t cloud = 0;
    std::uint64_t first = 0, last = 0, key = 0;
    FacingPicture picture;
};

// The rectangle around what a box fills of a picture, pixels from the top left corner.
struct PictureBox {
    double left = 0, top = 0, right = 0, bottom = 0;
    bool any() const { return left < right && top < bottom; }
    bool meets(const PictureBox& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
    PictureBox with(const PictureBox& other) const;
};
PictureBox picture_box(const View& view, const ImageSettings& image, const Bounds& box);

struct ImpostorPlan {
    bool on = false;
    // Why, or why not.
    std::string reason;
    // The share of the eye pass's work that is forecast to be saved.
    double saved = 0;
    // By cloud, then by frames.
    std::vector<ImpostorRun> runs;
    // Of each frame: whether it is made of clouds' pictures. Where these would save little of it, it is drawn whole.
    std::vector<bool> frames;
};

// views: of all frames.
ImpostorPlan plan_impostors(const FlightImpostorWish& wish, const Scene& scene,
                            const SeparateClouds& clouds, const std::vector<View>& views);

}  // namespace awan
