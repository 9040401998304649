#include "core/draw/march_layers.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/draw/march_setup.h"
#include "core/survey/separate_clouds.h"

namespace awan {
namespace {

// Rows that a thread lays at a time: whole blocks of the march, and of the haze's squares.
constexpr int kRows = kBlockSide;

// Those islands whose light the clouds may be in.
std::vector<std::uint8_t> islands_of(const TransportLight& light,
                                     const std::vector<Bounds>& boxes) {
    std::vector<std::uint8_t> wanted;
    for (const LightIsland& island : light.islands)
        wanted.push_back(std::any_of(boxes.begin(), boxes.end(), [&](const Bounds& box) {
            return overlap({island.low, island.high}, box);
        }));
    return wanted;
}

Image blank(int width, int height) {
    Image image{width, height, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    return image;
}

Error late(const Deadline& deadline) {
    return deadline.over().value_or(Error{ErrorCode::kOverDeadline, "", "the deadline passed"});
}

void in_bands(int height, int threads, const std::function<void(int, int)>& work) {
    const auto bands = static_cast<std::size_t>((height + kRows - 1) / kRows);
    parallel_for(threads, bands, [&](std::size_t band) {
        const int first = static_cast<int>(band) * kRows;
        work(first, std::min(first + kRows, height));
    });
}

// Of a frame's pixels, at most 1.
double share_of(const FacingPicture& facing, const ImageSettings& image) {
    return std::min(1.0, static_cast<double>(facing.width) * facing.height /
                             (static_cast<double>(image.width) * image.height));
}

// A frame while its layers are laid.
class LayeredFrame {
  public:
    LayeredFrame(const Scene& scene, const ParticleSet& particles, const View& view,
                 const TransportLight& light, const MarchSettings& settings, int threads,
                 const Deadline& deadline, EffectTimes& took)
        : scene_(scene),
          view_(view),
          light_(light),
          settings_(settings),
          threads_(threads),
          deadline_(deadline),
          width_(scene->image.width),
          height_(scene->image.height),
          rays_(picture_rays(view, width_, height_)),
          laid_(no_layers(width_, height_)) {
        bare_ = march_scene(scene, view, light, particles, none_, settings.step_error, threads);
        bare_.one_ray = settings.one_ray;
        set_behind(scene, light, settings, width_, height_, threads, took, behind_, bare_);
        scaled_.emplace(bare_.scaled);
    }
    LayeredFrame(const LayeredFrame&) = delete;
    LayeredFrame& operator=(const LayeredFrame&) = delete;

    void lay_pictures(std::span<const CloudLayer> layers) {
        in_bands(height_, threads_, [&](int first, int end) {
            for (const CloudLayer& layer : layers)
                lay_picture(*layer.picture, rays_, bare_.air, bare_.sky.backdrop, *scaled_, first,
                            end, laid_);
        });
    }

    Status lay_marched(const CloudsAlone& clouds) {
        const std::vector<SeenParticle> seen =
            see_particles(*clouds.particles, view_, width_, height_, threads_);
        if (seen.empty()) return std::nullopt;
        MarchScene march =
            march_scene(scene_, view_, light_, *clouds.particles, seen, settings_.step_error,
                        threads_, islands_of(light_, clouds.boxes));
        march.one_ray = settings_.one_ray;
        march.alone = true;
        march.air = bare_.air;
        march.sky.backdrop = bare_.sky.backdrop;  // rays end at its ground
        march.cut =
            march.cut && march.sky.backdrop != nullptr && !march.sky.backdrop->distance.empty();
        Image image = blank(width_, height_);
        const auto shows = [&](int x, int y, bool has_matter) {
            return has_matter && any_left(x, y);
        };
        if (!march_blocks(march, threads_, deadline_, image, {}, shows)) return late(deadline_);
        const float hazed = haze_before(clouds.boxes);
        in_bands(height_, threads_, [&](int first, int end) {
            lay_pixels(image, hazed, *scaled_, first, end, laid_);
        });
        return std::nullopt;
    }

    // Over what stands behind.
    Result<Image> finish() {
        Image image{width_, height_, scene_->image.background == Background::kSky, {}};
        image.pixels.resize(4 * image.pixel_count());
        if (!march_blocks(bare_, threads_, deadline_, image)) return late(deadline_);
        in_bands(height_, threads_, [&](int first, int end) {
            const auto width = static_cast<std::size_t>(width_);
            for (std::size_t at = static_cast<std::size_t>(first) * width;
                 at < static_cast<std::size_t>(end) * width; ++at)
                finish(at, image.pixels.data() + 4 * at);
        });
        return image;
    }

  private:
    bool any_left(int block_x, int block_y) const {
        const int right = std::min((block_x + 1) * kBlockSide, width_),
                  bottom = std::min((block_y + 1) * kBlockSide, height_);
        for (int y = block_y * kBlockSide; y < bottom; ++y)
            for (int x = block_x * kBlockSide; x < right; ++x)
                if (laid_.seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(x)] >= kLeastSeen)
                    return true;
        return false;
    }

    // The opacity of the haze before the middle of clouds: what dims the light that comes through the peak.
    float haze_before(const std::vector<Bounds>& boxes) const {
        if (bare_.air == nullptr || boxes.empty()) return 0;
        double nearest = 1e300;
        glm::dvec3 to{0, 0, 1};
        for (const Bounds& box : boxes) {
            const glm::dvec3 middle = 0.5 * (box.min + box.max) - view_.eye;
            const double distance = glm::length(middle);
            if (distance < nearest) nearest = distance, to = middle;
        }
        if (!(nearest > 0)) return 0;
        const HazeRay ray(bare_.air->haze, view_.eye.y, to.y / nearest);
        return static_cast<float>(ray.opacity(nearest));
    }

    // pixel: what stands behind, as it comes through the haze. As march_finish.h, `finish`.
    void finish(std::size_t at, float* pixel) const {
        const float left = laid_.left[at];
        const Rgb4& light = laid_.light[at];
        float peak[3] = {};
        const double opacity = 1 - static_cast<double>(left);
        if (bare_.sky.peak && opacity > 0) {
            const double depth = -exact::log(std::max(static_cast<double>(left), 1e-9));
            const double scaled = static_cast<double>(bare_.scaled);
            const double dimmed = 1 - std::min(static_cast<double>(laid_.hazed[at]) / opacity, 1.0);
            const auto through = static_cast<float>(exact::exp(-scaled * depth) *
                                                    -exact::expm1(-(1 - scaled) * depth) * dimmed);
            const float often =
                std::min((1 - bare_.scaled) / bare_.most_peak * static_cast<float>(depth), 1.0F);
            const BehindPeak& behind = *bare_.sky.through_peak;
            for (std::size_t c = 0; c < 3; ++c) {
                const float once = behind.once[3 * at + c];
                peak[c] = through * (once + often * (behind.often[3 * at + c] - once));
            }
        }
        for (int c = 0; c < 3; ++c) pixel[c] = light[c] + left * pixel[c] + peak[c];
        pixel[3] = 1 - left * (1 - pixel[3]);
    }

    const Scene& scene_;
    const View& view_;
    const TransportLight& light_;
    const MarchSettings& settings_;
    const int threads_;
    const Deadline& deadline_;
    const int width_, height_;
    const PictureRays rays_;
    const std::vector<SeenParticle> none_;
    MarchBehind behind_;
    MarchScene bare_;
    LaidLayers laid_;
    std::optional<ScaledClear> scaled_;
};

}  // namespace

Result<CloudPicture> march_picture(const Scene& scene, const CloudsAlone& cloud,
                                   const FacingPicture& facing, const TransportLight& light,
                                   const MarchSettings& settings, int threads,
                                   const Deadline& deadline) {
    CloudPicture picture{facing, blank(facing.width, facing.height)};
    const std::vector<SeenParticle> seen =
        see_particles(*cloud.particles, facing.view, facing.width, facing.height, threads,
                      share_of(facing, scene->image));
    if (seen.empty()) return picture;
    MarchScene march =
        march_scene(scene, facing.view, light, *cloud.particles, seen, settings.step_error, threads,
                    islands_of(light, cloud.boxes), facing.width, facing.height);
    march.one_ray = settings.one_ray;
    march.cut = false;  // it stands above all ground
    if (!march_blocks(march, threads, deadline, picture.texels, {},
                      [](int, int, bool has_matter) { return has_matter; }))
        return late(deadline);
    return picture;
}

Result<Image> march_layers(const Scene& scene, const ParticleSet& particles, const View& view,
                           const TransportLight& light, const MarchSettings& settings,
                           const std::vector<CloudLayer>& layers, int threads,
                           const Deadline& deadline, EffectTimes* times) {
    EffectTimes took;
    if (auto error = deadline.over()) return *error;
    LayeredFrame frame(scene, particles, view, light, settings, threads, deadline, took);
    const std::span<const CloudLayer> all(layers);
    for (std::size_t first = 0; first < all.size();) {
        if (auto error = deadline.over()) return *error;
        if (all[first].picture == nullptr) {
            if (const Status failed = frame.lay_marched(all[first].clouds)) return *failed;
            ++first;
            continue;
        }
        std::size_t end = first;
        while (end < all.size() && all[end].picture != nullptr) ++end;
        frame.lay_pictures(all.subspan(first, end - first));
        first = end;
    }
    auto image = frame.finish();
    if (image && times != nullptr) times->add(took);
    return image;
}

}  // namespace awan
