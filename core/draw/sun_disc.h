// The sun itself in a picture, and the glare that a lens makes of it. Rungs leave it out: light that goes straight on
// is no light of the clouds, and thousands of times as bright.
#pragma once

#include "core/base/image.h"
#include "core/generate/particle_set.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan {

// Whether its pictures show the sun: over a sky, where the scene wishes it, or leaves it open and the picture is not
// EXR.
bool shows_sun_disc(const SceneDraft& scene);

// Adds the disc to a picture with its sky, dimmed by what stands before it: the particles with their detail, and in
// `haze` the scene's; the ground hides it. Radiance: the sun's irradiance over the disc's solid angle, darker towards
// the limb, of every pixel the mean; no channel is more than `most`, as film has it: what is far above white would have
// stairs for a limb. To all but EXR the glare. The same for every number of threads.
void add_sun_disc(const Scene& scene, const View& view, const ParticleSet& particles, bool haze,
                  double most, int threads, Image& image);

}  // namespace awan
