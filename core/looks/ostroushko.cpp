// The picture of Ostroushko et al. 2010: rays through the hierarchy of spheres, front to back. Each sphere lets T f +
// 1 - f through (1)-(3) and shows its bump-mapped surface (4) for the rest. Spheres of a level bound those below, and
// one that looks smaller than a pixel is a leaf.
//
// Ours, where the paper says nothing: light (sun and sky on a diffuse surface, as it reaches a sphere through the
// upper levels of all clouds), a ground that hides, and a tile's rays going down the tree together.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/base/parallel.h"
#include "core/draw/backdrop.h"
#include "core/generate/motion.h"
#include "core/looks/looks.h"
#include "core/looks/ostroushko_tile.h"
#include "core/scene/spheres.h"

namespace awan {

looks::LookScene looks::look_scene(const Scene& scene, const View& view) {
    LookScene look;
    look.clouds = look_clouds(scene, view.eye);
    look.light = look_light(scene);
    look.view = view;
    look.width = scene->image.width;
    look.height = scene->image.height;
    look.pixel_angle = 2 * view.tan_half_fov / look.height;
    look.ground = scene->ground && view.eye.y > scene->ground->height;
    if (look.ground) look.ground_height = scene->ground->height;
    return look;
}

Result<Image> ostroushko_look(const Scene& scene, const View& view, int threads,
                              const Deadline& deadline) {
    const looks::LookScene look = looks::look_scene(scene, view);
    Image image{look.width, look.height, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    const int columns = (look.width + looks::kTileSide - 1) / looks::kTileSide;
    const int rows = (look.height + looks::kTileSide - 1) / looks::kTileSide;
    std::atomic<bool> late{false};
    parallel_for(threads, static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns),
                 [&](std::size_t tile) {
                     if (late.load(std::memory_order_relaxed) || deadline.over()) {
                         late = true;
                         return;
                     }
                     const auto index = static_cast<int>(tile);
                     looks::draw_tile(look, index % columns * looks::kTileSide,
                                      index / columns * looks::kTileSide, image.pixels.data());
                 });
    if (auto error = deadline.over()) return *error;
    if (scene->image.background == Background::kSky)
        lay_under(image, make_backdrop(scene, view, look.width, look.height, bare_ground(*scene),
                                       threads));
    return image;
}

// Measured on one thread at 2.1 GHz, pictures of 800 x 600 (tests/bench/spheres_bench), in milliseconds: a pixel of
// sky, a pixel of cloud, and the spheres that rays go down to. Of many spheres more lie hidden or in one pixel than
// of few, so these count by the root of their number.
double ostroushko_look_ms(const Scene& scene, const View& view, int threads) {
    constexpr double kSky = 0.25e-3, kCovered = 1.5e-3, kSpheres = 1.3;
    const double pixels =
        static_cast<double>(scene->image.width) * static_cast<double>(scene->image.height);
    double covered = 0, spheres = 0;
    for (const Cloud& cloud : scene->clouds) {
        const glm::dvec3& size = cloud.spheres->size;
        const double radius = std::max({size.x, size.y, size.z}) / 2 * cloud.scale;
        const Motion motion = motion_of(cloud, clouds_time(*scene));
        const double distance = glm::length(motion.translate - view.eye);
        const double across =
            2 * radius / std::max(distance, radius) / (2 * view.tan_half_fov) * scene->image.height;
        covered += 0.3 * across * across;
        // Of the parts of each level, as many as are larger than a pixel. 2.6 is the dimension of the default cumulus.
        spheres += std::min(exact::pow(static_cast<double>(cloud.spheres->parts),
                                       static_cast<double>(cloud.spheres->levels)),
                            exact::pow(across, 2.6));
    }
    return (kSky * pixels + kCovered * std::min(covered, pixels) + kSpheres * std::sqrt(spheres)) /
           threads;
}

}  // namespace awan
