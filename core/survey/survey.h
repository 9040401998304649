// What a cloud is, measured before anything is decided about it.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/detail.h"
#include "core/generate/particle_set.h"
#include "core/scene/scene.h"
#include "core/survey/clumps.h"
#include "core/survey/islands.h"

namespace awan {

// Mean extinction of each cell (1/unit), x fastest, then y, then z. The mass in it equals the
// particles' mass (2 pi)^1.5 density s^3 to rounding: every Gaussian is integrated over each cell
// as a product of erf differences, renormalised over the cells it is cut to.
struct DensityVolume {
    glm::dvec3 origin{0};  // corner of cell 0, scene units
    // Side of a (cubic) cell, scene units.
    double cell = 0;
    glm::ivec3 cells{0};
    std::vector<float> extinction;
};

// A resolved camera: orthonormal frame, in scene units.
struct View {
    glm::dvec3 eye{0};
    glm::dvec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
    double tan_half_fov = 0.36;  // vertical
    double aspect = 1;           // width / height
};

// What a ground does to the picture (core/survey/ground_view.h). All 0 where the scene has none, or where the cloud
// lies below it.
struct GroundView {
    // Share of the picture's rays that meet it, clouds or not; 0 from below.
    double seen = 0;
    // Largest share of its light that the cloud's shadow takes, on those rays.
    double shade = 0;
    // Fluence that it sends up, unshaded, over that of sun and sky at the cloud.
    double light = 0;
    // Whether some of the cloud lies below it.
    bool matter_below = false;
    // Share of the picture's rays on which hills stand.
    double hills = 0;
};

// No depth of HazeFigures is above it; level rays may have an infinite one.
inline constexpr double kMostHazeDepth = 1e6;
// Of the haze in view (core/survey/haze_view.h), on a raster of rays; 0 without haze. Depths are the largest of all
// rays.
struct HazeFigures {
    // From the eye to where a ray meets clouds.
    double depth_to_clouds = 0;
    double depth_behind = 0;  // to the ground, or without end
    // The most light that the clouds' shadows take from one ray, over the mean pixel's (luminance).
    double shaded = 0;
};

struct Survey {
    std::size_t particles = 0;
    // Those that light and eye work on: fewer where they are merged (core/survey/merge.h).
    std::size_t drawn = 0;
    // ParticleSet::cloud_density.
    std::vector<double> cloud_density;
    Bounds bounds;
    View view;
    DensityVolume volume;
    Islands islands;  // empty for a single cloud
    Clumps clumps;
    // Integral of extinction over space, unit^2.
    double total_mass = 0;
    double max_extinction = 0;  // largest cell mean, 1/unit
    // Largest over parallel lines towards the sun.
    double optical_depth_sun = 0;
    double optical_depth_zenith = 0;  // largest over vertical lines
    // Largest over the picture's rays, from the eye outward.
    double optical_depth_eye = 0;
    // Of the rays that meet cloud (at least 5% of the largest alpha).
    double mean_depth_eye = 0;
    // Share of the picture's rays that meet cloud.
    double covered = 0;
    // Particles that a ray passes within 4 s, mean over the picture.
    double particles_per_pixel = 0;
    // Between the way sunlight goes and from the cloud's middle to the eye: 1 looks into the sun.
    double sun_cosine = 0;
    // Sums over particles of s^0, s^1, s^2, s^3, unit^k.
    std::array<double, 4> s_sums{};
    // Largest density * s of one particle (dimensionless).
    double max_sigma_s = 0;
    // Smallest and largest projected s in the picture, pixels; infinite for a particle that holds the eye.
    double min_projected_px = 0;
    double max_projected_px = 0;
    // Share of the particles that rays a pixel apart would miss the shape of (survey/narrow.h), by about the area
    // that they cover. The march sees them by rays that stand closer. What is left of their error is below 1% of alpha
    // and of light: 0.7% where there are more than some ten thousand of them, 0.2% otherwise (sub_pixel_test). Splats
    // draw it on finer pixels (draw/splat_parts.h).
    double sub_pixel = 0;
    DetailFigures detail;  // what detail would be made for
    // The eye is within 4 s of a particle.
    bool eye_inside = false;
    double model_error = 0;  // ParticleSet::error
    GroundView ground;
    HazeFigures haze;
    // Further views that the light is to serve, those of a camera that moves. EMPTY: it serves this picture alone.
    std::vector<View> seen_from;
};

// Optical depths are sampled on a raster of 64 x 64 lines over the cloud or the picture, and on the lines through
// every particle's own centre (its own depth alone). They are never too high, and low by < 2% when the raster's step
// is below the smallest s that matters. Time is bounded: raster and volume are coarsened, down to 8 lines a side,
// until the work fits (about 10 ms at 10,000 particles), and may then be 20% low.
Result<Survey> survey(const Scene& scene, const ParticleSet& particles, int threads,
                      const Deadline& deadline);

// How far before `target`, along the view, an eye has every corner of the box in the picture, with a little room around
// it; the view's own eye does not matter.
double distance_that_holds(const View& view, const Bounds& bounds, const glm::dvec3& target);

// The camera of a scene; "auto" looks at the bounds from a three-quarter view and holds all of
// them.
View resolve_view(const Camera& camera, const ImageSettings& image, const Bounds& bounds);

}  // namespace awan
