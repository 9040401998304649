// What stands behind the clouds: the sky, and the ground as it is lit.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/image.h"
#include "core/generate/particle_set.h"
#include "core/light/ground_light.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// What one ray meets: radiance, as it comes through the haze; distance; the haze's O and L before it (air.h).
struct BackdropSample {
    float rgb[3] = {};
    float distance = 0, opacity = 0, lost = 0;
};

// What every pixel's middle ray meets, row by row from the top.
struct Backdrop {
    int width = 0, height = 0;
    std::vector<float> rgb;  // radiance, 3 a pixel
    // To the ground, scene units; infinite where the ray does not meet it. EMPTY without a ground.
    std::vector<float> distance;
    // Of hills in haze: its O and L before what pixels show, whose radiance is then as it comes through that.
    // EMPTY: what pixels show is not yet seen through any haze.
    std::vector<float> opacity, lost;
    // Of hills: pixels that their middle stands badly for are means of four rays, those through the middles of their
    // quarters, row by row. By pixel: 0, or one more than its place in `quarters`. EMPTY: every pixel is its middle.
    std::vector<std::uint32_t> quarters_of;
    std::vector<std::array<BackdropSample, 4>> quarters;
};

// Whether a picture needs more than the sky's gradient behind it: a physical sky, or a ground below the eye.
bool wants_backdrop(const Scene& scene, const View& view);

struct Air;          // air.h
struct ReliefLight;  // core/light/relief_light.h

// The same for every number of threads. Pixels are point samples, those of the ground, too; where it has hills, those
// differ from their neighbours are means of four. Then they are seen through `air` (null: clear), and lit as `hills`
// says (null: that is found out here, too). wanted: of blocks of kBlockSide x kBlockSide pixels (march_bins.h), row by
// row, whether something is wanted there; elsewhere all is black. EMPTY: everywhere.
Backdrop make_backdrop(const Scene& scene, const View& view, int width, int height,
                       const GroundLight& ground, int threads, const Air* air = nullptr,
                       const ReliefLight* hills = nullptr,
                       std::span<const std::uint8_t> wanted = {});

// Lays it under a picture of clouds alone (premultiplied), which becomes opaque. Both have one size.
void lay_under(Image& picture, const Backdrop& backdrop);

// Whether the ground may hide some of the cloud from an eye above it.
bool matter_below_ground(const Scene& scene, const View& view, const ParticleSet& particles);

}  // namespace awan
