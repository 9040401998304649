// All paths of one pixel.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

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

// near: the particles that its ray may meet. None: out of time. Depends on the picture's seed and on x and y alone.
std::optional<Pixel> trace_pixel(const Picture& picture, const ParticleSet& near, int x, int y);

}  // namespace awan::truth
