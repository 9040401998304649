#include "core/looks/gardner.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/parallel.h"
#include "core/draw/backdrop.h"
#include "core/light/ground_light.h"
#include "core/looks/looks.h"
#include "core/scene/outside.h"

namespace awan {
namespace {

using ellipsoids::blur_along;
using ellipsoids::blur_of_blob;
using ellipsoids::limited;
using ellipsoids::opacity;
using ellipsoids::parts_of;
using ellipsoids::PlaneParts;
using ellipsoids::texture_at;
using ellipsoids::TextureValue;
using ellipsoids::threshold_at;

using namespace gardner;

// The side of a tile, pixels.
constexpr int kTile = 16;
// A ray ends where less than this share of the light from behind is left.
constexpr double kUnseen = 1e-4;
// The standard deviation of what a pixel sees, in pixels. A square has .29.
constexpr double kHalfPixel = 0.35;
// How far along a ray the plane is drawn, scene units: its horizon.
constexpr double kFarthest = 1e15;

struct Surface {
    double distance;
    // That of its ellipsoid. A plane has that of its cloud, counted on from the last ellipsoid.
    std::size_t index;
    SphereHit hit;
};

struct Picture {
    const Scene& scene;
    const View& view;
    const Frame& frame;
    Whites whites;
    glm::dvec3 to_sun;
    double pixel_angle;
    // The ground's height, where there is one and the eye is above it.
    std::optional<double> ground;
};

// What stands in front: premultiplied radiance, and the share that it lets through.
struct Veil {
    glm::dvec3 radiance{0};
    double through = 1;
};

void lay_behind(const Picture& picture, double opaque, const SineShading& shading, double i,
                Veil& veil) {
    const glm::dvec3 radiance =
        (i - shading.ambient) * picture.whites.sunlit + shading.ambient * picture.whites.ambient;
    veil.radiance += veil.through * opaque * radiance;
    veil.through *= 1 - opaque;
}

// The normal of a wall, and those of walls near by that cut through it or nearly so (EllipsoidsCloud::join): each
// counts by its limb curve, so that none comes or goes at once. As printed a wall has its own, and there is a crease
// where one comes out of another.
glm::dvec3 shading_normal(const Picture& picture, const Surface& surface,
                          const std::vector<Surface>& surfaces) {
    const auto& all = picture.frame.ellipsoids;
    const SeenEllipsoid& one = all[surface.index];
    const SeenCloud& cloud = picture.frame.clouds[one.cloud];
    const glm::dvec3 own = normal_of(one.sphere, surface.hit);
    const double join = cloud.model->join;
    if (!(join > 0)) return own;
    glm::dvec3 sum = surface.hit.limb * own;
    for (const Surface& other : surfaces) {
        if (other.index >= all.size() || other.index == surface.index) continue;
        const SeenEllipsoid& near = all[other.index];
        if (near.cloud != one.cloud) continue;
        const double width = join * cloud.motion.scale *
                             std::min(one.placed.mean_radius(), near.placed.mean_radius());
        const double share = joined_share(surface.distance, other.distance, width);
        if (share > 0) sum += share * other.hit.limb * normal_of(near.sphere, other.hit);
    }
    const double length = glm::length(sum);
    return length > 0 ? sum / length : own;
}

void shade_ellipsoid(const Picture& picture, const Surface& surface,
                     const std::vector<Surface>& surfaces, const glm::dvec3& direction,
                     Veil& veil) {
    const SeenEllipsoid& one = picture.frame.ellipsoids[surface.index];
    const SeenCloud& cloud = picture.frame.clouds[one.cloud];
    const double sigma = kHalfPixel * surface.distance * picture.pixel_angle / cloud.motion.scale;
    const TextureValue value = texture_at(cloud.in_space, one.placed.from_unit(surface.hit.at),
                                          blur_of_blob(cloud.in_space, false, sigma),
                                          blur_of_blob(cloud.in_space, true, sigma));
    const Translucence& translucence = one.placed.translucence;
    const double opaque =
        limited(opacity(value, threshold_at(translucence, surface.hit.limb), translucence.range),
                translucence.least, translucence.most);
    if (!(opaque > 0)) return;
    const glm::dvec3 normal = shading_normal(picture, surface, surfaces);
    const SineShading& shading = cloud.model->shading;
    const double i =
        intensity(shading, diffuse(normal, picture.to_sun),
                  specular(normal, picture.to_sun, -direction, shading.shininess), value.mean);
    lay_behind(picture, opaque, shading, i, veil);
}

// The share of the plane that is left at that distance along the ground (SkyPlane::horizon).
double left_of_horizon(double distance, double horizon) {
    return std::clamp(2 - 2 * distance / horizon, 0.0, 1.0);
}

void shade_plane(const Picture& picture, const SeenCloud& cloud, double distance,
                 const glm::dvec3& direction, Veil& veil) {
    const Motion& motion = cloud.motion;
    const glm::dvec3 at = motion.back(picture.view.eye + distance * direction);
    // A pixel's footprint on the plane: across the ray, and along it, where it is longer by 1 / sine of the ray's
    // elevation.
    const double level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const double cos = level > 0 ? direction.x / level : 1,
                 sin = level > 0 ? direction.z / level : 0;
    // Both in the plane's own coordinates.
    const glm::dvec3 away(cos * motion.turn.cos - sin * motion.turn.sin, 0,
                          sin * motion.turn.cos + cos * motion.turn.sin);
    const double sigma = kHalfPixel * distance * picture.pixel_angle / motion.scale;
    const glm::dvec3 along = away * (sigma / std::max(std::abs(direction.y), 1e-15));
    const glm::dvec3 across = glm::dvec3(-away.z, 0, away.x) * sigma;
    const auto seen = [&](const TextureFunction& texture) {
        const auto blur = [&](bool along_z) {
            return blur_along(texture, along_z, along) + blur_along(texture, along_z, across);
        };
        return texture_at(texture, at, blur(false), blur(true));
    };
    const SkyPlane& plane = *cloud.model->plane;
    const PlaneParts parts = parts_of(plane, cloud.on_plane, at, seen);
    double opaque = parts.opacity(0, plane.least, plane.most);
    if (plane.horizon) opaque *= left_of_horizon(distance * level / motion.scale, *plane.horizon);
    if (!(opaque > 0)) return;
    // Lit from above even where it is seen from below: it is thin.
    const glm::dvec3 normal(0, 1, 0);
    const SineShading& shading = cloud.model->shading;
    const double i =
        intensity(shading, diffuse(normal, picture.to_sun),
                  specular(normal, picture.to_sun, -direction, shading.shininess), parts.texture());
    lay_behind(picture, opaque, shading, i, veil);
}

Veil seen_along(const Picture& picture, const glm::dvec3& direction,
                const std::vector<std::size_t>& near, std::vector<Surface>& surfaces) {
    surfaces.clear();
    const Frame& frame = picture.frame;
    const double eye_y = picture.view.eye.y;
    for (const std::size_t index : near)
        if (const auto met = hit(frame.ellipsoids[index].sphere, direction))
            surfaces.push_back({met->distance, index, *met});
    for (std::size_t k = 0; k < frame.clouds.size(); ++k) {
        const auto& height = frame.clouds[k].plane_height;
        if (!height || !((*height - eye_y) * direction.y > 0)) continue;
        surfaces.push_back({std::min((*height - eye_y) / direction.y, kFarthest),
                            frame.ellipsoids.size() + k,
                            {}});
    }
    // Sorted by distance; where two are as far, in the order of the scene, whatever the threads.
    std::sort(surfaces.begin(), surfaces.end(), [](const Surface& a, const Surface& b) {
        return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
    });
    Veil veil;
    for (const Surface& surface : surfaces) {
        if (picture.ground && eye_y + surface.distance * direction.y < *picture.ground) break;
        if (surface.index < frame.ellipsoids.size()) {
            shade_ellipsoid(picture, surface, surfaces, direction, veil);
        } else {
            shade_plane(picture, frame.clouds[surface.index - frame.ellipsoids.size()],
                        surface.distance, direction, veil);
        }
        if (veil.through < kUnseen) break;
    }
    return veil;
}

// Finds the ellipsoids that may show in a tile, then draws its pixels.
void draw_tile(const Picture& picture, int tile_x, int tile_y, Image& image) {
    const int x0 = tile_x * kTile, y0 = tile_y * kTile;
    const int x1 = std::min(x0 + kTile, image.width), y1 = std::min(y0 + kTile, image.height);
    std::vector<std::size_t> near;
    std::vector<Surface> surfaces;
    for (std::size_t i = 0; i < picture.frame.ellipsoids.size(); ++i) {
        const PixelBox& box = picture.frame.ellipsoids[i].box;
        if (box.x0 < x1 && box.x1 >= x0 && box.y0 < y1 && box.y1 >= y0) near.push_back(i);
    }
    const View& view = picture.view;
    for (int y = y0; y < y1; ++y) {
        const double v = (1 - (y + 0.5) / image.height * 2) * view.tan_half_fov;
        for (int x = x0; x < x1; ++x) {
            const double u = ((x + 0.5) / image.width * 2 - 1) * view.tan_half_fov * view.aspect;
            const glm::dvec3 d = glm::normalize(view.forward + u * view.right + v * view.up);
            const Veil veil = seen_along(picture, d, near, surfaces);
            float* const pixel =
                image.pixels.data() +
                4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                     static_cast<std::size_t>(x));
            for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(veil.radiance[c]);
            pixel[3] = static_cast<float>(1 - veil.through);
        }
    }
}

}  // namespace

Result<Image> gardner_look(const Scene& scene, const View& view, int threads,
                           const Deadline& deadline) {
    Image image{scene->image.width, scene->image.height, false, {}};
    image.pixels.resize(4 * image.pixel_count());
    const Frame frame = frame_of(scene, view, true);
    Picture picture{scene,
                    view,
                    frame,
                    whites_of(scene),
                    outside_of(scene).to_sun,
                    2 * view.tan_half_fov / image.height,
                    std::nullopt};
    if (scene->ground && view.eye.y > scene->ground->height) picture.ground = scene->ground->height;
    const int across = (image.width + kTile - 1) / kTile, down = (image.height + kTile - 1) / kTile;
    std::atomic<bool> late = false;
    parallel_for(threads, static_cast<std::size_t>(across) * static_cast<std::size_t>(down),
                 [&](std::size_t tile) {
                     if (late || deadline.over()) {
                         late = true;
                         return;
                     }
                     const int at = static_cast<int>(tile);
                     draw_tile(picture, at % across, at / across, image);
                 });
    if (auto error = deadline.over()) return *error;
    if (scene->image.background == Background::kSky)
        lay_under(image, make_backdrop(scene, view, image.width, image.height, bare_ground(*scene),
                                       threads));
    return image;
}

double gardner_look_ms(const Scene& scene, const View& view, int threads) {
    // Measured (tests/bench/ellipsoids_bench), in nanoseconds: a pixel and its background; a ray and an ellipsoid
    // that may be in its way; one that is and is shaded; a plane.
    constexpr double kPixel = 90, kTest = 12, kShade = 250, kPlane = 350;
    const Frame frame = frame_of(scene, view, false);
    double boxes = 0;
    for (const SeenEllipsoid& one : frame.ellipsoids)
        boxes += static_cast<double>(one.box.x1 - one.box.x0 + 1) *
                 static_cast<double>(one.box.y1 - one.box.y0 + 1);
    double planes = 0;
    for (const SeenCloud& cloud : frame.clouds) planes += cloud.plane_height ? 1 : 0;
    const double pixels =
        static_cast<double>(scene->image.width) * static_cast<double>(scene->image.height);
    // An ellipse fills .79 of its box. Of many ellipsoids in a row only the first few are shaded.
    const double met = std::min(0.79 * boxes, 6 * pixels);
    return (pixels * (kPixel + kPlane * planes) + boxes * kTest + met * kShade) * 1e-6 /
           std::max(threads, 1);
}

}  // namespace awan
