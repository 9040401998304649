// The clear sky behind a picture, most pixels of it between few rays: it is the same for every picture of a sequence,
// and a ray of it costs as much as an exponential and three inverse functions.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/scene/outside.h"
#include "core/survey/survey.h"

namespace awan {

class SkyPixels {
  public:
    // Rays stand kBlock pixels apart. Blocks between them are interpolated (Catmull & Rom 1974) where that agrees with
    // four rays of their own within kAgreement of the radiance; each pixel of the others has its own ray: across the
    // horizon, close to the sun, where pixels are degrees wide.
    static constexpr int kBlock = 8;
    static constexpr double kAgreement = 1e-4;

    // Of a picture of so many pixels, each > 0. below: whether rays below the horizon are wanted; radiance of pixels
    // there means nothing else. wanted: as of is_wanted (march_bins.h), and must stay where it is; only such pixels are
    // found out. The same for every number of threads.
    SkyPixels(const SkyDome& sky, const View& view, int width, int height, bool below, int threads,
              std::span<const std::uint8_t> wanted = {});

    // Radiance through the middles of a row's pixels. to: one for each of them; those that are not wanted stay.
    void row(int y, std::span<glm::vec3> to) const;

    // The share of blocks that are interpolated.
    double smooth_share() const;

  private:
    glm::dvec3 direction(int x, int y) const;
    glm::vec3 ray(int x, int y) const;
    const glm::vec3* corner(int block_x, int block_y) const;
    glm::vec3 between(int x, int y) const;
    bool agrees(int x, int y) const;
    bool is_smooth(int block_x, int block_y) const;
    bool wants(int block_x, int block_y) const;
    bool wants_ray(int i, int j) const;

    SkyDome sky_;
    View view_;
    int width_, height_;
    bool below_;
    std::span<const std::uint8_t> wanted_;
    // Blocks, and rays across: one before the first block, two behind the last one's beginning.
    int blocks_x_, blocks_y_, rays_x_;
    std::vector<glm::vec3> rays_;
    std::vector<std::uint8_t> smooth_;
};

}  // namespace awan
