#include "core/truth/path_tracer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "core/base/parallel.h"
#include "core/truth/haze_walk.h"
#include "core/truth/oracles.h"
#include "core/truth/pixel_paths.h"
#include "core/truth/primary_ray.h"
#include "core/truth/walk.h"

namespace awan {
namespace {

using truth::Matter;
using truth::Picture;
using truth::Pixel;
using truth::PixelPaths;
using truth::Setting;

// Pixels; particles are looked up by tile, of those of a block of tiles.
constexpr int kTile = 8;
// Blocks of a picture, about: every one looks at all particles.
constexpr double kBlocks = 512;

TruthImage empty_image(const ImageSettings& settings) {
    TruthImage truth;
    for (Image* image : {&truth.half_a, &truth.half_b}) {
        *image = {settings.width, settings.height, settings.background == Background::kSky, {}};
        image->pixels.resize(4 * image->pixel_count());
    }
    return truth;
}

void store(Image& image, int x, int y, const glm::dvec3& rgb, double alpha) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x);
    float* out = image.pixels.data() + 4 * at;
    out[0] = static_cast<float>(rgb.x);
    out[1] = static_cast<float>(rgb.y);
    out[2] = static_cast<float>(rgb.z);
    out[3] = static_cast<float>(alpha);
}

// Pixels from left and top to before right and bottom.
struct Tile {
    int left, top, right, bottom;
};

// Those of `side` pixels that the tile consists of, row by row.
std::vector<Tile> tiles_of(const Tile& all, int side) {
    std::vector<Tile> tiles;
    for (int top = all.top; top < all.bottom; top += side)
        for (int left = all.left; left < all.right; left += side)
            tiles.push_back(
                {left, top, std::min(left + side, all.right), std::min(top + side, all.bottom)});
    return tiles;
}

// Those that a ray through any of the tile's pixels may meet.
ParticleSet particles_before(const Tile& tile, const ParticleSet& particles,
                             const Picture& picture) {
    // The middles of the pixels around the tile.
    const auto direction = [&](int x, int y) {
        return pixel_ray(picture.view, picture.width, picture.height, x, y).direction;
    };
    return truth::particles_near(
        particles, picture.view.eye,
        {direction(tile.left - 1, tile.top - 1), direction(tile.right, tile.top - 1),
         direction(tile.left - 1, tile.bottom), direction(tile.right, tile.bottom)});
}

// Of paths that met the cloud.
struct PathCount {
    double paths = 0, scatterings = 0;

    void add(double more_paths, double more_scatterings) {
        paths += more_paths;
        scatterings += more_scatterings;
    }
};

// Writes a tile's pixels, as far as there is time.
PathCount trace_tile(const Tile& tile, const ParticleSet& particles, const Picture& picture,
                     TruthImage& truth) {
    if (picture.over()) return {};
    const ParticleSet near = particles_before(tile, particles, picture);
    std::array<Pixel, kTile * kTile> pixels;
    PixelPaths paths(picture);
    std::size_t next = 0;
    for (int y = tile.top; y < tile.bottom; ++y)
        for (int x = tile.left; x < tile.right; ++x)
            if (!paths.begin(near, x, y, pixels[next++])) return {};
    if (!paths.finish()) return {};
    PathCount count;
    next = 0;
    for (int y = tile.top; y < tile.bottom; ++y)
        for (int x = tile.left; x < tile.right; ++x) {
            const Pixel& pixel = pixels[next++];
            store(truth.half_a, x, y, pixel.half[0], pixel.alpha[0]);
            store(truth.half_b, x, y, pixel.half[1], pixel.alpha[1]);
            count.add(pixel.paths, pixel.scatterings);
        }
    return count;
}

PathCount trace_block(const Tile& block, const ParticleSet& particles, const Picture& picture,
                      TruthImage& truth) {
    const ParticleSet near = particles_before(block, particles, picture);
    PathCount count;
    for (const Tile& tile : tiles_of(block, kTile)) {
        const PathCount more = trace_tile(tile, near, picture, truth);
        count.add(more.paths, more.scatterings);
    }
    return count;
}

// A tile's side, or a multiple of it in a large picture.
int block_side(int width, int height) {
    const double pixels = static_cast<double>(width) * height;
    return kTile * std::max(static_cast<int>(std::sqrt(pixels / kBlocks) / kTile), 1);
}

// Progress by blocks, from any thread; what is told only rises.
class BlockProgress {
  public:
    BlockProgress(const Progress& progress, std::size_t blocks)
        : progress_(progress), blocks_(static_cast<double>(blocks)) {}

    // How many are done now.
    std::size_t one_done(bool tell) {
        const std::size_t count = ++done_;
        if (!progress_ || !tell) return count;
        // Read again under the lock: another thread may have told more meanwhile.
        const std::lock_guard lock(telling_);
        progress_(static_cast<double>(std::max(count, done_.load())) / blocks_);
        return count;
    }

  private:
    const Progress& progress_;
    double blocks_;
    std::atomic<std::size_t> done_{0};
    std::mutex telling_;
};

// Blocks in an order that spreads them over the picture: those that are done tell what the others will take.
std::size_t spread(std::size_t i, std::size_t blocks) {
    std::size_t stride =
        std::max<std::size_t>(static_cast<std::size_t>(0.618 * static_cast<double>(blocks)), 1);
    while (std::gcd(stride, blocks) != 1) ++stride;
    return i * stride % blocks;
}

// How long all blocks will take, by those that are done.
class Pace {
  public:
    Pace(const Deadline& deadline, std::size_t blocks, int threads)
        : deadline_(deadline), blocks_(static_cast<double>(blocks)), threads_(threads) {}

    // Of a picture that cannot be ready before the deadline, s from its first block to its last; else nothing. What
    // blocks take differs (of many only sky is seen), so the fewer are done the more there must be too much.
    std::optional<double> hopeless(std::size_t done) const {
        if (deadline_.until == Deadline::Clock::time_point::max()) return std::nullopt;
        // Of those under way, half is done.
        const double count = static_cast<double>(done) + 0.5 * threads_;
        if (count < std::max(16, 4 * threads_)) return std::nullopt;
        const double all_s = 1e-3 * ms_since(began_) * blocks_ / count;
        const std::chrono::duration<double> there_is = deadline_.until - began_;
        if (all_s < there_is.count() * (1 + 4 / std::sqrt(count))) return std::nullopt;
        return all_s;
    }

  private:
    const Deadline& deadline_;
    double blocks_;
    int threads_;
    Deadline::Clock::time_point began_ = Deadline::Clock::now();
};

// In the order of the blocks, so that the sum does not depend on the threads.
double scatterings_a_path(const std::vector<PathCount>& counts) {
    PathCount all;
    for (const PathCount& count : counts) all.add(count.paths, count.scatterings);
    return all.paths > 0 ? all.scatterings / all.paths : all.scatterings;
}

}  // namespace

Result<TruthImage> trace_truth(const Scene& scene, const ParticleSet& given, const View& view,
                               const TruthOptions& options, const Progress& progress,
                               const Deadline& deadline) {
    TruthImage truth = empty_image(scene->image);
    // Paths meet the particles as they are, wherever they were merged.
    ParticleSet whole;
    if (given.whole) {
        whole = *given.whole;
        whole.detail = given.detail;
    }
    const ParticleSet& particles = given.whole ? whole : given;
    const auto matter =
        truth::make_matter(particles, sun_direction(scene->sun), options.threads, deadline);
    if (!matter.ok()) return matter.error();
    const Setting setting = truth::setting_of(scene, *matter, options);
    const auto air = options.eye_effects.aerial_perspective
                         ? truth::haze_of(scene, options.eye_effects.light_shafts)
                         : std::optional<truth::HazeSetting>();
    std::atomic<bool> stop{false};
    const Picture picture{
        .view = view,
        .width = scene->image.width,
        .height = scene->image.height,
        .whole_pixels = options.whole_pixels,
        .opaque = truth.half_a.opaque,
        .matter = *matter,
        .setting = setting,
        .air = air,
        .samples = std::max(options.samples / 2, 1u) * 2,
        .seed = options.seed,
        .deadline = deadline,
        .stop = stop,
    };

    const std::vector<Tile> blocks =
        tiles_of({0, 0, picture.width, picture.height}, block_side(picture.width, picture.height));
    std::vector<PathCount> counts(blocks.size());
    BlockProgress told(progress, blocks.size());
    const Pace pace(deadline, blocks.size(), options.threads);
    std::atomic<double> too_long_s{0};
    parallel_for(options.threads, blocks.size(), [&](std::size_t next) {
        if (picture.over()) return;
        const std::size_t i = spread(next, blocks.size());
        counts[i] = trace_block(blocks[i], particles, picture, truth);
        if (const auto all_s = pace.hopeless(told.one_done(!stop)); all_s && !stop) {
            too_long_s = *all_s;
            stop = true;
        }
    });
    if (stop) {
        if (auto error = deadline.over()) return *error;
        return Error{ErrorCode::kOverDeadline, "",
                     too_long_s > 0
                         ? "by its first paths the reference would take about " +
                               std::to_string(std::llround(too_long_s)) + " s, more than there is"
                         : "the reference ran out of time"};
    }
    truth.scatterings = scatterings_a_path(counts);
    return truth;
}

double TruthImage::noise() const {
    const auto at = [](const Image& image, std::size_t i, std::size_t c) {
        return static_cast<double>(image.pixels[4 * i + c]);
    };
    double most = 0;
    for (std::size_t i = 0; i < half_a.pixel_count(); ++i) most = std::max(most, at(half_a, i, 3));
    double square = 0, sum = 0, count = 0;
    for (std::size_t i = 0; i < half_a.pixel_count(); ++i) {
        if (at(half_a, i, 3) < 0.05 * most) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const double a = at(half_a, i, c), b = at(half_b, i, c);
            // The mean's variance is half of that of each half, the difference's twice.
            square += (a - b) * (a - b) / 4;
            sum += (a + b) / 2;
            count += 1;
        }
    }
    return sum > 0 ? std::sqrt(square / count) / (sum / count) : 0;
}

Image mean_of(const TruthImage& truth) {
    Image mean = truth.half_a;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (mean.pixels[i] + truth.half_b.pixels[i]);
    return mean;
}

}  // namespace awan
