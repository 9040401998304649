#include "core/draw/draw.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "core/draw/air_image.h"
#include "core/draw/backdrop.h"
#include "core/draw/splats.h"
#include "core/gl/programs.h"
#include "core/light/sun_depth.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// List entries of a dispatch: at most about half a second of llvmpipe.
constexpr std::uint64_t kMaxEntries = 1u << 20;
constexpr int kShadowCells = 32;  // along the clouds' longest side, of their shadows in haze
constexpr std::uint64_t kMaxTiles = 1u << 14;  // 4 Mi pixels, 64 MiB of them in GL at a time

void set_uniforms(const Scene& scene, const View& view, const Plan& plan) {
    const auto set3 = [](GLint location, glm::dvec3 v) {
        const glm::vec3 f(v);
        glUniform3f(location, f.x, f.y, f.z);
    };
    const auto in_frame = [&](glm::dvec3 v) {
        return glm::normalize(
            glm::dvec3(glm::dot(v, view.right), glm::dot(v, view.up), glm::dot(v, view.forward)));
    };
    glUniform2i(1, scene->image.width, scene->image.height);
    glUniform2f(2, static_cast<float>(view.tan_half_fov * view.aspect),
                static_cast<float>(view.tan_half_fov));
    const Outside outside = outside_of(scene);
    set3(3, in_frame(outside.to_sun));
    set3(4, in_frame({0, 1, 0}));
    // Black where the sky is physical: the program draws gradients only.
    set3(5, outside.sky.zenith);
    set3(6, outside.sky.horizon);
    glUniform1f(7, static_cast<float>(scene->medium.g));
    glUniform1i(8, scene->medium.phase == PhaseFunction::kCornetteShanks ? 1 : 0);
    glUniform1i(9, plan.on(Effect::kViewExtinction) ? 1 : 0);
    glUniform1i(10, scene->image.background == Background::kSky ? 1 : 0);
}

// Takes a region's pixels from GL. `spare` is room for those regions that do not fit the picture's rows.
void take_region(const gl::Buffer& from, const gl::TileRegion& region, std::vector<float>& spare,
                 Image& image) {
    const int left = region.x * kTileWidth, top = region.y * kTileHeight;
    const int width = std::min(region.width * kTileWidth, image.width - left);
    const int height = std::min(region.height * kTileHeight, image.height - top);
    const auto stride = static_cast<std::size_t>(region.width) * kTileWidth * 4;
    const std::size_t row = static_cast<std::size_t>(image.width) * 4;
    float* target = image.pixels.data() + static_cast<std::size_t>(top) * row +
                    static_cast<std::size_t>(left) * 4;
    if (stride == row) {
        from.read(target, static_cast<std::size_t>(height) * row * sizeof(float));
        return;
    }
    spare.resize(static_cast<std::size_t>(height) * stride);
    from.read(spare.data(), spare.size() * sizeof(float));
    for (int y = 0; y < height; ++y)
        std::memcpy(target + static_cast<std::size_t>(y) * row,
                    spare.data() + static_cast<std::size_t>(y) * stride,
                    static_cast<std::size_t>(width) * 4 * sizeof(float));
}

// The haze, with the clouds' shadows in it, as the plan asks.
std::optional<Air> air_of(const Scene& scene, const ParticleSet& particles, const View& view,
                          const Plan& plan, EffectTimes& took) {
    if (!plan.on(Effect::kAerialPerspective)) return std::nullopt;
    auto start = Deadline::Clock::now();
    std::optional<Air> air = make_air(scene, view);
    took.of(Effect::kAerialPerspective) = ms_since(start);
    if (!air || !plan.on(Effect::kLightShafts)) return air;
    start = Deadline::Clock::now();
    shade_air(sun_depth(particles, sun_direction(scene->sun), kShadowCells, 1), 1, *air);
    took.of(Effect::kLightShafts) = ms_since(start);
    return air;
}

// Blends a region's splats into its pixels, by the program, the uniforms and the splats that are bound.
Status draw_region(const gl::TileRegion& region, const Deadline& deadline,
                   std::vector<float>& spare, Image& image) {
    const gl::Buffer begin{std::span<const std::uint32_t>(region.begin)};
    const gl::Buffer items{std::span<const std::uint32_t>(region.items)};
    const std::size_t pixels = static_cast<std::size_t>(region.width) *
                               static_cast<std::size_t>(region.height) * kTileWidth * kTileHeight;
    const gl::Buffer picture(pixels * 4 * sizeof(float));
    begin.bind(1);
    items.bind(2);
    picture.bind(3);
    glUniform4i(0, region.x, region.y, region.width, region.height);
    const std::uint32_t longest = std::max(region.longest_list(), 1u);
    for (std::uint32_t first = 0; first < longest; first += gl::kMaxRun) {
        if (auto error = deadline.over()) return error;
        const bool last = longest - first <= gl::kMaxRun;
        glUniform3i(11, static_cast<GLint>(first), static_cast<GLint>(gl::kMaxRun), last ? 1 : 0);
        glDispatchCompute(static_cast<GLuint>(region.width), static_cast<GLuint>(region.height), 1);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        if (!last) glFinish();
    }
    take_region(picture, region, spare, image);
    return gl::gl_status("the eye pass");
}

// Puts what stands behind the clouds under them: through the haze, or as it is.
void put_behind(const Scene& scene, const View& view, const GroundLight& ground, const Air* air,
                EffectTimes& took, Image& image) {
    Backdrop behind;
    if (image.opaque) behind = make_backdrop(scene, view, image.width, image.height, ground, 1);
    if (air == nullptr) {
        lay_under(image, behind);
        return;
    }
    const auto start = Deadline::Clock::now();
    put_air_behind(*air, image.opaque ? &behind : nullptr, image);
    took.of(Effect::kAerialPerspective) += ms_since(start);
}

}  // namespace

Result<Image> draw(const Scene& scene, const ParticleSet& particles, const View& view,
                   const Plan& plan, const Lighting& lighting, Device& device,
                   const Deadline& deadline, EffectTimes* times) {
    EffectTimes took;
    Image image{
        scene->image.width, scene->image.height, scene->image.background == Background::kSky, {}};
    image.pixels.resize(4 * image.pixel_count());
    const std::optional<Air> air = air_of(scene, particles, view, plan, took);
    const Air* const haze = air ? &*air : nullptr;
    const SplatList list = make_splats(scene, particles, view, plan, lighting, haze);
    const gl::TexelBuffer splats{std::span<const Splat>(list.splats)};

    const Device::Programs& programs = device.programs();
    // A deep particle reaches farther than the 4 s within which the plan takes the eye to be inside: one behind the eye
    // would be seen in front of it.
    const bool half_lines =
        plan.on(Effect::kInterior) ||
        (list.reaches_eye && scene->effects[static_cast<int>(Effect::kInterior)] != Switch::kOff);
    (half_lines ? programs.splat_interior : programs.splat).use();
    set_uniforms(scene, view, plan);
    // The program draws no sky where something else is put behind the clouds below.
    const bool backdrop = image.opaque && wants_backdrop(scene, view);
    if (backdrop || haze != nullptr) glUniform1i(10, 0);
    std::vector<float> spare;
    const auto status =
        gl::for_each_region(list.tiles, (image.width + kTileWidth - 1) / kTileWidth,
                            (image.height + kTileHeight - 1) / kTileHeight, 1, kMaxEntries,
                            kMaxTiles, deadline, [&](const gl::TileRegion& region) -> Status {
                                splats.bind(0);
                                return draw_region(region, deadline, spare, image);
                            });
    if (status) return *status;
    if (backdrop || haze != nullptr) put_behind(scene, view, lighting.ground, haze, took, image);
    if (times != nullptr) times->add(took);
    return image;
}

}  // namespace awan
