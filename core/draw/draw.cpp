#include "core/draw/draw.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <optional>

#include "core/draw/air_image.h"
#include "core/draw/backdrop.h"
#include "core/draw/billboards.h"
#include "core/draw/splat_detail.h"
#include "core/draw/splat_parts.h"
#include "core/gl/programs.h"
#include "core/light/sun_depth.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

// List entries of a dispatch: at most about half a second of llvmpipe.
constexpr std::uint64_t kMaxEntries = 1u << 20;
constexpr int kShadowCells = 32;  // along the clouds' longest side, of their shadows in haze
constexpr std::uint64_t kMaxTiles = 1u << 14;  // 4 Mi pixels, 64 MiB of them in GL at a time

// What is the same for the picture and its finer parts.
struct Drawing {
    const Scene& scene;
    const Plan& plan;
    const SplatSetting& splats;
    Device& device;
    const Deadline& deadline;
    bool sky;                          // the program draws the sky behind
    const gl::TextureArray* textures;  // null: nothing is painted
    const gl::TextureArray* colors;    // null: none of them has any
    const SplatDetail* detail;         // null: there is none
};

void set_uniforms(const Drawing& drawing, const SplatWindow& window) {
    const Scene& scene = drawing.scene;
    const View& view = drawing.splats.view;
    const auto set3 = [](GLint location, glm::dvec3 v) {
        const glm::vec3 f(v);
        glUniform3f(location, f.x, f.y, f.z);
    };
    const auto in_frame = [&](glm::dvec3 v) {
        return glm::normalize(
            glm::dvec3(glm::dot(v, view.right), glm::dot(v, view.up), glm::dot(v, view.forward)));
    };
    glUniform2i(1, window.width, window.height);
    glUniform2f(2, static_cast<float>(window.tangent.x), static_cast<float>(window.tangent.y));
    glUniform2f(12, static_cast<float>(window.middle.x), static_cast<float>(window.middle.y));
    const Outside outside = outside_of(scene);
    set3(3, in_frame(outside.to_sun));
    set3(4, in_frame({0, 1, 0}));
    // Black where the sky is physical: the program draws gradients only.
    set3(5, outside.sky.zenith);
    set3(6, outside.sky.horizon);
    glUniform1f(7, static_cast<float>(scene->medium.g));
    glUniform1i(8, scene->medium.phase == PhaseFunction::kCornetteShanks ? 1 : 0);
    const Medium& medium = scene->medium;
    const DropletFit fit = medium.droplets ? droplet_fit(medium.droplet) : DropletFit{};
    glUniform4f(13, static_cast<float>(fit.narrow), static_cast<float>(fit.wide),
                static_cast<float>(fit.alpha), static_cast<float>(fit.share));
    glUniform1i(9, drawing.splats.sorted ? 1 : 0);
    glUniform1i(10, drawing.sky ? 1 : 0);
}

void set_detail(const SplatDetail& detail, const SplatWindow& window) {
    const auto set = [](GLint location, const glm::mat4x3& matrix) {
        glUniformMatrix4x3fv(location, 1, GL_FALSE, &matrix[0][0]);
    };
    set(14, detail.to_extinction);
    set(18, detail.to_bumps);
    glUniform3f(22, detail.keep, kSoftness, detail.bump / static_cast<float>(window.gap()));
    glUniform1f(23, static_cast<float>(std::sqrt(2 * std::numbers::pi)) * detail.edge);
    glUniform3f(24, detail.aside.x, detail.aside.y, detail.aside.z);
    detail.extinction.bind(3);
    detail.bumps.bind(4);
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

// Draws the given particles on a window's pixels.
Result<Image> draw_splats(const Drawing& drawing, const SplatWindow& window,
                          std::span<const std::uint32_t> order) {
    Image image{
        window.width, window.height, drawing.scene->image.background == Background::kSky, {}};
    image.pixels.resize(4 * image.pixel_count());
    const SplatList list = make_splats(drawing.splats, window, order);
    const gl::TexelBuffer splats{std::span<const Splat>(list.splats)};
    const gl::TexelBuffer paint{std::span<const PaintedSplat>(list.paint)};
    Device::Programs& programs = drawing.device.programs();
    // A deep particle reaches farther than the 4 s within which the plan takes the eye to be inside: one behind the eye
    // would be seen in front of it.
    const bool half_lines =
        drawing.plan.on(Effect::kInterior) ||
        (list.reaches_eye &&
         drawing.scene->effects[static_cast<int>(Effect::kInterior)] != Switch::kOff);
    const bool with_detail = drawing.textures == nullptr && drawing.detail != nullptr;
    const auto program = drawing.textures != nullptr
                             ? programs.painted(half_lines, drawing.colors != nullptr)
                         : with_detail ? programs.detailed(half_lines)
                                       : programs.plain(half_lines);
    if (!program.ok()) return program.error();
    (*program)->use();
    if (with_detail) set_detail(*drawing.detail, window);
    set_uniforms(drawing, window);
    std::vector<float> spare;
    const auto status = gl::for_each_region(
        list.tiles, (image.width + kTileWidth - 1) / kTileWidth,
        (image.height + kTileHeight - 1) / kTileHeight, 1, kMaxEntries, kMaxTiles, drawing.deadline,
        [&](const gl::TileRegion& region) -> Status {
            splats.bind(0);
            paint.bind(1);
            if (drawing.textures != nullptr) drawing.textures->bind(2);
            if (drawing.colors != nullptr) drawing.colors->bind(3);
            return draw_region(region, drawing.deadline, spare, image);
        });
    if (status) return *status;
    return image;
}

// Draws a window, those parts of it on finer pixels that have matter below its own.
Result<Image> draw_window(const Drawing& drawing, const SplatWindow& window,
                          std::vector<std::uint32_t> order, const SplatBudget& budget) {
    SplatParts divided = divide(drawing.splats.particles, drawing.textures != nullptr,
                                drawing.splats.view, window, std::move(order), budget);
    auto image = draw_splats(drawing, window, divided.rest);
    if (!image.ok()) return image;
    for (SplatPart& part : divided.parts) {
        auto fine =
            draw_window(drawing, window_of(part, window), std::move(part.order), part.left_over);
        if (!fine.ok()) return fine;
        put_mean(*fine, part, *image);
    }
    return image;
}

// The picture on more pixels, interpolated between the middles of its own.
Image enlarged(const Image& from, int width, int height) {
    struct Between {
        std::size_t low, high;
        float part;
    };
    const auto between = [](int to, int pixels, int of) {
        const double at = std::clamp((to + 0.5) * of / pixels - 0.5, 0.0, of - 1.0);
        const int low = std::min(static_cast<int>(at), of - 1);
        return Between{static_cast<std::size_t>(low),
                       static_cast<std::size_t>(std::min(low + 1, of - 1)),
                       static_cast<float>(at - low)};
    };
    Image image{width, height, from.opaque, {}};
    image.pixels.resize(4 * image.pixel_count());
    std::vector<Between> across;
    for (int x = 0; x < width; ++x) across.push_back(between(x, width, from.width));
    float* to = image.pixels.data();
    for (int y = 0; y < height; ++y) {
        const Between down = between(y, height, from.height);
        const std::size_t row = 4 * static_cast<std::size_t>(from.width);
        const float* const low = from.pixels.data() + down.low * row;
        const float* const high = from.pixels.data() + down.high * row;
        for (const Between& x : across)
            for (std::size_t c = 0; c < 4; ++c) {
                const std::size_t a = 4 * x.low + c, b = 4 * x.high + c;
                const float above = low[a] + x.part * (low[b] - low[a]);
                const float below = high[a] + x.part * (high[b] - high[a]);
                *to++ = above + down.part * (below - above);
            }
    }
    return image;
}

// Puts what stands behind the clouds under them: through the haze, or as it is.
void put_behind(const Scene& scene, const View& view, const GroundLight& ground, const Air* air,
                int threads, EffectTimes& took, Image& image) {
    Backdrop behind;
    if (ground.relief && view.eye.y > ground.height) {
        behind = timed_for(took, Effect::kTerrain, [&] {
            return make_backdrop(scene, view, image.width, image.height, ground, threads, air);
        });
    } else if (image.opaque) {
        behind = make_backdrop(scene, view, image.width, image.height, ground, threads);
    }
    if (air == nullptr) {
        lay_under(image, behind);
        return;
    }
    const auto start = Deadline::Clock::now();
    put_air_behind(*air, behind.rgb.empty() ? nullptr : &behind, image);
    took.of(Effect::kAerialPerspective) += ms_since(start);
}

}  // namespace

Result<Image> draw(const Scene& scene, const ParticleSet& particles, const View& view,
                   const Plan& plan, const Lighting& lighting, Device& device,
                   const Deadline& deadline, EffectTimes* times, int threads, bool in_passing) {
    EffectTimes took;
    const std::optional<Air> air = air_of(scene, particles, view, plan, took);
    const Air* const haze = air ? &*air : nullptr;
    const SplatSetting splats = splat_setting(scene, particles, view, plan, lighting, haze);
    const bool opaque = scene->image.background == Background::kSky;
    // The program draws no sky where something else is put behind the clouds below.
    const bool backdrop = opaque && wants_backdrop(scene, view);
    std::optional<gl::TextureArray> textures, colors;
    if (splats.levels) {
        auto uploaded = timed_for(took, Effect::kTexture,
                                  [&] { return upload_textures(scene, *splats.levels, deadline); });
        if (!uploaded.ok()) return uploaded.error();
        textures.emplace(*std::move(uploaded));
        if (has_colors(scene)) colors.emplace(upload_colors(scene));
    }
    std::optional<SplatDetail> detail;
    if (!textures && particles.detail && plan.on(Effect::kDetail) && particles.size() > 0)
        detail.emplace(timed_for(took, Effect::kDetail, [&] {
            return splat_detail(particles, view, scene->image.height, threads);
        }));
    const bool coarse = in_passing && !textures;
    const Drawing drawing{scene,
                          plan,
                          splats,
                          device,
                          deadline,
                          opaque && !backdrop && haze == nullptr && !coarse,
                          textures ? &*textures : nullptr,
                          colors ? &*colors : nullptr,
                          detail ? &*detail : nullptr};
    std::vector<std::uint32_t> order = drawing_order(scene, particles, view, plan);
    ImageSettings size = scene->image;
    if (coarse) {
        size.width = (size.width + 1) / 2;
        size.height = (size.height + 1) / 2;
    }
    // Finer pixels would take back what coarse ones save.
    auto drawn = coarse ? draw_splats(drawing, whole_picture(view, size), order)
                        : draw_window(drawing, whole_picture(view, size), std::move(order),
                                      splat_budget(scene->image, particles.size()));
    if (!drawn.ok()) return drawn;
    Image& image = *drawn;
    if (coarse) image = enlarged(image, scene->image.width, scene->image.height);
    if (backdrop || haze != nullptr || (coarse && opaque))
        put_behind(scene, view, lighting.ground, haze, threads, took, image);
    if (times != nullptr) times->add(took);
    return drawn;
}

}  // namespace awan
