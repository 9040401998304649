// All paths of one pixel.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/base/deadline.h"
#include "core/generate/particle_set.h"
#include "core/survey/survey.h"
#include "core/truth/haze_walk.h"
#include "core/truth/matter.h"
#include "core/truth/walk.h"

namespace awan::truth {

// What all pixels of a picture share. What it refers to outlives it.
struct Picture {
    const View& view;
    int width, height;  // pixels
    // Whether pixels show the mean over their area, or what their middle's ray does.
    bool whole_pixels;
    // Whether sky and ground are drawn behind the clouds.
    bool opaque;
    const Matter& matter;
    // Its `matter` is the one above.
    const Setting& setting;
    // None: there is no haze, or it is not to be seen.
    const std::optional<HazeSetting>& air;
    // Paths a pixel, both halves together; even, >= 2.
    std::uint32_t samples;
    std::uint64_t seed;
    const Deadline& deadline;
    // Set by the first pixel that finds the time over; all others stop then.
    std::atomic<bool>& stop;

    // Whether there is no time left; looks at the clock.
    bool over() const {
        if (!stop.load(std::memory_order_relaxed) && deadline.over()) stop = true;
        return stop.load(std::memory_order_relaxed);
    }
};

struct Pixel {
    // Mean radiance of each half of the paths.
    std::array<glm::dvec3, 2> half{glm::dvec3(0), glm::dvec3(0)};
    std::array<double, 2> alpha{0, 0};  // of the halves
    // Of paths that met the cloud: how many there were, and their scatterings.
    double paths = 0, scatterings = 0;
};

// Paths of pixels, walked together as soon as there are enough of them.
class PixelPaths {
  public:
    explicit PixelPaths(const Picture& picture) : picture_(picture) {}

    // Gives the pixel what is known without paths, and lets its paths begin; the pixel has their light after the next
    // finish(). near: the particles that its rays may meet. False: out of time. Depends on the picture's seed and on x
    // and y alone.
    bool begin(const ParticleSet& near, int x, int y, Pixel& pixel);

    // Walks all that have begun. False: out of time.
    bool finish();

    // A path that has begun: what it brings back is multiplied by `scale`, then `plus` is added, and all that to a half
    // of a pixel.
    struct Path {
        Pixel* pixel;
        std::size_t half;
        glm::dvec3 scale, plus;
        bool met_cloud;
    };
    bool add(const Start& start, const Path& path);

    const Picture& picture() const { return picture_; }

  private:
    const Picture& picture_;
    std::vector<Start> starts_;
    std::vector<Path> paths_;
    std::vector<Brought> brought_;
};

}  // namespace awan::truth
