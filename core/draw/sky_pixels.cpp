#include "core/draw/sky_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/base/catmull_rom.h"
#include "core/base/parallel.h"
#include "core/draw/march_bins.h"

namespace awan {
namespace {

using Weights = std::array<float, 4>;

constexpr std::array<Weights, SkyPixels::kBlock> make_weights() {
    std::array<Weights, SkyPixels::kBlock> all{};
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = catmull_rom(static_cast<float>(i) / SkyPixels::kBlock);
    return all;
}

constexpr std::array<Weights, SkyPixels::kBlock> kWeights = make_weights();

// One of its blocks is wanted whole, or not at all.
static_assert(kBlockSide % SkyPixels::kBlock == 0);

// Pixels of a block that are looked at.
constexpr std::array<glm::ivec2, 4> kChecks{{{4, 4}, {2, 6}, {6, 3}, {4, 1}}};

// From the zenith to a block that is interpolated, in halves of its diagonal.
constexpr double kAroundZenith = 6;

glm::vec3 mix(const Weights& weights, const glm::vec3* first, std::ptrdiff_t apart) {
    return weights[0] * first[0] + weights[1] * first[apart] + weights[2] * first[2 * apart] +
           weights[3] * first[3 * apart];
}

int blocks_along(int pixels) {
    return (pixels + SkyPixels::kBlock - 1) / SkyPixels::kBlock;
}

}  // namespace

SkyPixels::SkyPixels(const SkyDome& sky, const View& view, int width, int height, bool below,
                     int threads, std::span<const std::uint8_t> wanted)
    : sky_(sky),
      view_(view),
      width_(width),
      height_(height),
      below_(below),
      wanted_(wanted),
      blocks_x_(blocks_along(width)),
      blocks_y_(blocks_along(height)),
      rays_x_(blocks_x_ + 3) {
    const int rays_y = blocks_y_ + 3;
    rays_.resize(static_cast<std::size_t>(rays_x_) * static_cast<std::size_t>(rays_y));
    smooth_.resize(static_cast<std::size_t>(blocks_x_) * static_cast<std::size_t>(blocks_y_));
    parallel_for(threads, static_cast<std::size_t>(rays_y), [&](std::size_t row) {
        const int y = (static_cast<int>(row) - 1) * kBlock;
        for (int i = 0; i < rays_x_; ++i)
            if (wants_ray(i, static_cast<int>(row)))
                rays_[row * static_cast<std::size_t>(rays_x_) + static_cast<std::size_t>(i)] =
                    ray((i - 1) * kBlock, y);
    });
    parallel_for(threads, static_cast<std::size_t>(blocks_y_), [&](std::size_t row) {
        for (int i = 0; i < blocks_x_; ++i)
            smooth_[row * static_cast<std::size_t>(blocks_x_) + static_cast<std::size_t>(i)] =
                wants(i, static_cast<int>(row)) && is_smooth(i, static_cast<int>(row)) ? 1 : 0;
    });
}

bool SkyPixels::wants(int block_x, int block_y) const {
    return is_wanted(wanted_, width_, static_cast<std::size_t>(block_x * kBlock),
                     static_cast<std::size_t>(block_y * kBlock));
}

// The i-th ray of a row of rays, the j-th one, is about the blocks from three before it to itself.
bool SkyPixels::wants_ray(int i, int j) const {
    for (int y = std::max(j - 3, 0); y <= std::min(j, blocks_y_ - 1); ++y)
        for (int x = std::max(i - 3, 0); x <= std::min(i, blocks_x_ - 1); ++x)
            if (wants(x, y)) return true;
    return false;
}

glm::dvec3 SkyPixels::direction(int x, int y) const {
    const double u = ((x + 0.5) / width_ * 2 - 1) * view_.tan_half_fov * view_.aspect;
    const double v = (1 - (y + 0.5) / height_ * 2) * view_.tan_half_fov;
    return glm::normalize(view_.forward + u * view_.right + v * view_.up);
}

glm::vec3 SkyPixels::ray(int x, int y) const {
    return glm::vec3(sky_radiance(sky_, direction(x, y)));
}

// The first of the four by four rays about a block.
const glm::vec3* SkyPixels::corner(int block_x, int block_y) const {
    return rays_.data() + static_cast<std::ptrdiff_t>(block_y) * rays_x_ + block_x;
}

glm::vec3 SkyPixels::between(int x, int y) const {
    const glm::vec3* const first = corner(x / kBlock, y / kBlock);
    std::array<glm::vec3, 4> columns;
    for (std::size_t i = 0; i < columns.size(); ++i)
        columns[i] = mix(kWeights[static_cast<std::size_t>(y % kBlock)], first + i, rays_x_);
    return glm::max(mix(kWeights[static_cast<std::size_t>(x % kBlock)], columns.data(), 1),
                    glm::vec3(0));
}

bool SkyPixels::agrees(int x, int y) const {
    const glm::vec3 one = between(x, y), other = ray(x, y);
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(one[c] - other[c]) <= static_cast<float>(kAgreement) * other[c]))
            return false;
    return true;
}

bool SkyPixels::is_smooth(int block_x, int block_y) const {
    const int left = block_x * kBlock, top = block_y * kBlock;
    // All of the rays about it are on one side of the horizon, where the sky has a crease: so is what is between them.
    int above = 0;
    for (const int y : {top - kBlock, top + 2 * kBlock})
        for (const int x : {left - kBlock, left + 2 * kBlock})
            above += direction(x, y).y < 0 ? 0 : 1;
    if (above == 0 && !below_) return true;
    if (above != 0 && above != 4) return false;
    // Close to the zenith, and to the point below it, the azimuth turns within a block.
    const glm::dvec3 middle = direction(left + kBlock / 2, top + kBlock / 2);
    const double reach = glm::length(direction(left, top) - middle);
    if (glm::length(glm::dvec2(middle.x, middle.z)) < kAroundZenith * reach) return false;
    return std::all_of(kChecks.begin(), kChecks.end(), [&](const glm::ivec2& check) {
        return agrees(left + check.x, top + check.y);
    });
}

void SkyPixels::row(int y, std::span<glm::vec3> to) const {
    const Weights& down = kWeights[static_cast<std::size_t>(y % kBlock)];
    for (int i = 0; i < blocks_x_; ++i) {
        if (!wants(i, y / kBlock)) continue;
        const int left = i * kBlock, right = std::min(left + kBlock, width_);
        const auto block =
            static_cast<std::size_t>(y / kBlock) * static_cast<std::size_t>(blocks_x_) +
            static_cast<std::size_t>(i);
        if (smooth_[block] == 0) {
            for (int x = left; x < right; ++x) to[static_cast<std::size_t>(x)] = ray(x, y);
            continue;
        }
        const glm::vec3* const first = corner(i, y / kBlock);
        std::array<glm::vec3, 4> columns;
        for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = mix(down, first + k, rays_x_);
        for (int x = left; x < right; ++x)
            to[static_cast<std::size_t>(x)] = glm::max(
                mix(kWeights[static_cast<std::size_t>(x - left)], columns.data(), 1), glm::vec3(0));
    }
}

double SkyPixels::smooth_share() const {
    return static_cast<double>(std::count(smooth_.begin(), smooth_.end(), 1)) /
           static_cast<double>(smooth_.size());
}

}  // namespace awan
