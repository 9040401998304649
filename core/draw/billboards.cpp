#include "core/draw/billboards.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/generate/own_textures.h"

namespace awan {
namespace {

// The logarithm of the ratio between two levels.
double step() {
    return exact::log(kDepthRange) / (kDepthLevels - 1);
}

}  // namespace

int DepthLevels::level_of(double depth) const {
    if (!(depth > 0)) return 0;
    const double below = exact::log(deepest / depth) / step();
    return kDepthLevels - 1 -
           static_cast<int>(std::lround(std::clamp(below, 0.0, kDepthLevels - 1.0)));
}

double DepthLevels::depth_of(int level) const {
    return deepest * exact::exp(step() * (level - (kDepthLevels - 1)));
}

DepthLevels depth_levels(const ParticleSet& particles) {
    DepthLevels levels;
    for (std::size_t i = 0; i < particles.paint.size(); ++i)
        if (particles.paint[i].texture != 0)
            levels.deepest = std::max(levels.deepest, central_depth(particles, i));
    return levels;
}

// A Gaussian's mass, seen from afar: 2 pi s^2 times the depth through its centre. The texture's, of depth f A(x, y): f
// times the mean of A times the square's area.
std::vector<float> opacity_of(const Texture& texture, double depth) {
    double sum = 0;
    for (const std::uint8_t one : texture.depth) sum += one;
    const double mean = sum / 255 / static_cast<double>(texture.depth.size());
    const double side = 2 * kBillboardReach;
    const double deepest = depth * 2 * std::numbers::pi / (side * side * mean);
    // There are no more than 256 of them.
    std::vector<float> of(256);
    for (std::size_t i = 0; i < of.size(); ++i)
        of[i] = static_cast<float>(-exact::expm1(-deepest * static_cast<double>(i) / 255));
    std::vector<float> texels;
    texels.reserve(texture.depth.size());
    for (const std::uint8_t one : texture.depth) texels.push_back(of[one]);
    return texels;
}

std::vector<float> halved(const std::vector<float>& texels, std::size_t channels) {
    const auto side = static_cast<std::size_t>(
        std::lround(std::sqrt(static_cast<double>(texels.size() / channels))));
    std::vector<float> means;
    means.reserve(texels.size() / 4);
    for (std::size_t y = 0; y < side; y += 2)
        for (std::size_t x = 0; x < side; x += 2)
            for (std::size_t c = 0; c < channels; ++c) {
                const float* const at = &texels[(y * side + x) * channels + c];
                const std::size_t down = side * channels;
                means.push_back(0.25f * (at[0] + at[channels] + at[down] + at[down + channels]));
            }
    return means;
}

bool has_colors(const Scene& scene) {
    const auto used = textures_of(*scene);
    return std::any_of(used.begin(), used.end(), [&](std::string_view hash) {
        return std::any_of(scene->textures.begin(), scene->textures.end(), [&](const auto& given) {
            return given->hash == hash && !given->color.empty();
        });
    });
}

gl::TextureArray upload_colors(const Scene& scene, bool plain) {
    const std::vector<std::string_view> used = textures_of(*scene);
    gl::TextureArray array(kTextureSide, static_cast<int>(used.size()) + (plain ? 1 : 0), 3);
    int layer = 0;
    const auto put = [&](std::vector<float> texels) {
        for (int mip = 0; !texels.empty(); ++mip) {
            array.put(layer, mip, texels);
            texels = texels.size() > 3 ? halved(texels, 3) : std::vector<float>();
        }
        ++layer;
    };
    for (const std::string_view hash : used) put(linear_colors(*texture_of_hash(*scene, hash)));
    if (plain)
        put(std::vector<float>(3 * static_cast<std::size_t>(kTextureSide) * kTextureSide, 1.0F));
    return array;
}

Result<gl::TextureArray> upload_textures(const Scene& scene, const DepthLevels& levels,
                                         const Deadline& deadline) {
    const std::vector<std::string_view> used = textures_of(*scene);
    gl::TextureArray array(kTextureSide, kDepthLevels * static_cast<int>(used.size()));
    int layer = 0;
    for (const std::string_view hash : used) {
        const auto texture = texture_of_hash(*scene, hash);
        for (int level = 0; level < kDepthLevels; ++level, ++layer) {
            if (auto error = deadline.over()) return *error;
            std::vector<float> texels = opacity_of(*texture, levels.depth_of(level));
            for (int mip = 0; !texels.empty(); ++mip) {
                array.put(layer, mip, texels);
                texels = texels.size() > 1 ? halved(texels) : std::vector<float>();
            }
        }
    }
    return array;
}

BillboardAxes billboard_axes(const glm::dvec3& q, double half_side, const Paint& paint,
                             const glm::dvec3& vertical) {
    const double distance = glm::length(q);
    const glm::dvec3 away = distance > 0 ? q / distance : glm::dvec3(0, 0, 1);
    glm::dvec3 across = glm::cross(vertical, away);
    // Straight above or below the eye no way is up: the picture's is taken.
    if (glm::length(across) < 1e-6) across = glm::cross(glm::dvec3(0, 1, 0), away);
    if (glm::length(across) < 1e-6) across = glm::dvec3(1, 0, 0);
    across = glm::normalize(across);
    const glm::dvec3 up = glm::cross(away, across);
    const exact::SinCos turn = exact::sincos_degrees(paint.turn * (360.0 / 65536));
    const double side = paint.mirrored ? -half_side : half_side;
    return {side * (turn.cos * across + turn.sin * up),
            half_side * (turn.cos * up - turn.sin * across)};
}

glm::dvec3 vertical_in(const View& view) {
    return {view.right.y, view.up.y, view.forward.y};
}

}  // namespace awan
