// A cloud seen from many sides, for game engines that draw it on a card ("octahedral impostor"): which views there are,
// and the scene of each. What is drawn of a view is a picture like any other.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/deadline.h"
#include "core/scene/scene.h"

namespace awan {

// kHemisphere: from level with the cloud to straight above it. kSphere: from below too.
enum class ImpostorMapping { kHemisphere, kSphere };
inline constexpr const char* kImpostorWords[] = {"hemi-octahedral", "octahedral"};

// Views along a side of an atlas, and the pixels of one: engines use 8 to 16 of 128 to 512.
inline constexpr int kMostImpostorViews = 32, kMostImpostorSize = 2048;

struct ImpostorWish {
    int views = 8;   // along a side of the atlas, 2 to kMostImpostorViews
    int size = 128;  // pixels, of a view's side; views * size is at most limits::kMaxImageSide
    ImpostorMapping mapping = ImpostorMapping::kHemisphere;
};

// Of an impostor whose scene names no rung.
inline constexpr const char* kImpostorRung = "transport-32";
// Of every view, degrees: nearly parallel rays.
inline constexpr double kImpostorFov = 10;

// View i, j of the atlas, from the left and from the top, has u = 2 i / (views - 1) - 1 and v likewise. The direction
// towards its eye is, before it is made a unit vector, on the hemisphere
//     x = (u + v) / 2,  z = (u - v) / 2,  y = 1 - |x| - |z|,
// and on the sphere
//     x = u,  z = v,  y = 1 - |u| - |v|,  where y < 0: x = sign(u) (1 - |v|),  z = sign(v) (1 - |u|)
// (Cigolle et al. 2014).
glm::dvec3 impostor_direction(ImpostorMapping mapping, double u, double v);

struct ImpostorView {
    glm::dvec3 direction{0, 1, 0};  // unit, from the middle to the eye
    Scene scene;                    // with the camera of this view
};

struct Impostor {
    ImpostorWish wish;
    // All eyes look at it and stand at this distance from it; a sphere of `radius` around it fills every view.
    glm::dvec3 center{0};
    double radius = 1, distance = 1;
    std::vector<ImpostorView> views;  // row by row from the top
};

// The views are over nothing and without haze, of the scene's rung, or of kImpostorRung. with_depth: they have the
// layer `depth`, unless their rung has none. The sphere holds every particle's radius. Errors: of generate();
// kInvalidScene where the eyes would stand beyond the limits; kTooLarge, the atlas.
Result<Impostor> impostor_of(const Scene& scene, const ImpostorWish& wish, bool with_depth,
                             int threads, const Deadline& deadline);

}  // namespace awan
