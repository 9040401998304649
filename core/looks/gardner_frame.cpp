#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/generate/keyed_random.h"
#include "core/looks/gardner.h"
#include "core/scene/outside.h"

namespace awan::gardner {
namespace {

using ellipsoids::placed_ellipsoids;
using ellipsoids::texture_function;

UnitSphere sphere_of(const PlacedEllipsoid& one, const Motion& motion, const glm::dvec3& eye) {
    UnitSphere sphere;
    // By columns: where the scene's axes go. It is Motion::back without its translation, then the ellipsoid's own
    // turn and radii.
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 e(0);
        e[axis] = 1;
        const glm::dvec3 local = glm::dvec3(e.x * motion.turn.cos - e.z * motion.turn.sin, e.y,
                                            e.z * motion.turn.cos + e.x * motion.turn.sin) /
                                 motion.scale;
        sphere.to_unit[axis] = one.direction_to_unit(local);
    }
    sphere.eye = one.to_unit(motion.back(eye));
    return sphere;
}

// The pixels where the ellipsoid may show, from its dual conic: the tangent lines x = const are the roots of a
// quadratic. A pixel is added on every side.
PixelBox box_of(const PlacedEllipsoid& one, const Motion& motion, const View& view, int width,
                int height) {
    const PixelBox all{0, 0, width - 1, height - 1};
    const glm::dvec3 center = motion(one.center) - view.eye;
    std::array<glm::dvec3, 3> axes;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 e(0);
        e[axis] = 1;
        axes[static_cast<std::size_t>(axis)] = motion(one.from_unit(e)) - motion(one.center);
    }
    // Half of the ellipsoid's width along a vector is the root of its product with itself.
    const auto product = [&](const glm::dvec3& a, const glm::dvec3& b) {
        double sum = 0;
        for (const glm::dvec3& axis : axes) sum += glm::dot(axis, a) * glm::dot(axis, b);
        return sum;
    };
    const double ahead = glm::dot(center, view.forward);
    const double deep = product(view.forward, view.forward);
    const double reach = std::sqrt(deep);
    if (ahead + reach <= 0) return {};
    // It is around the eye or beside it.
    if (!(ahead - reach > 1e-6 * reach)) return all;
    const auto tangents = [&](const glm::dvec3& side, double& low, double& high) {
        const double a = ahead * ahead - deep;
        const double b = ahead * glm::dot(center, side) - product(view.forward, side);
        const double c = glm::dot(center, side) * glm::dot(center, side) - product(side, side);
        const double root = std::sqrt(std::max(b * b - a * c, 0.0));
        low = (b - root) / a;
        high = (b + root) / a;
    };
    double left = 0, right = 0, bottom = 0, top = 0;
    tangents(view.right, left, right);
    tangents(view.up, bottom, top);
    // From a share 0..1 of the picture's width or height to a pixel.
    const auto pixel = [](double share, int count) {
        const double at = share * count;
        return static_cast<int>(std::floor(std::clamp(at, -2.0, count + 1.0)));
    };
    const double tan_x = view.tan_half_fov * view.aspect, tan_y = view.tan_half_fov;
    PixelBox box{
        pixel(0.5 + 0.5 * left / tan_x, width) - 1, pixel(0.5 - 0.5 * top / tan_y, height) - 1,
        pixel(0.5 + 0.5 * right / tan_x, width) + 1, pixel(0.5 - 0.5 * bottom / tan_y, height) + 1};
    box.x0 = std::max(box.x0, 0);
    box.y0 = std::max(box.y0, 0);
    box.x1 = std::min(box.x1, width - 1);
    box.y1 = std::min(box.y1, height - 1);
    return box;
}

// Textures that are ready: the search for k takes up to a millisecond, and many clouds have one texture.
struct MadeTexture {
    SineTexture texture;
    bool in_space;
    TextureFunction function;
};
TextureFunction ready(const SineTexture& texture, bool in_space, const glm::dvec3& shift,
                      std::vector<MadeTexture>& made) {
    // How many of the latest are kept.
    constexpr std::size_t kKept = 8;
    auto known = std::find_if(made.begin(), made.end(), [&](const MadeTexture& one) {
        return one.in_space == in_space && one.texture == texture;
    });
    if (known == made.end()) {
        if (made.size() == kKept) made.erase(made.begin());
        made.push_back({texture, in_space, texture_function(texture, in_space)});
        known = made.end() - 1;
    }
    TextureFunction function = known->function;
    function.shift = shift;
    return function;
}

}  // namespace

Frame frame_of(const Scene& scene, const View& view, bool textures) {
    Frame frame;
    std::vector<MadeTexture> made;
    for (std::size_t k = 0; k < scene->clouds.size(); ++k) {
        const Cloud& cloud = scene->clouds[k];
        const EllipsoidsCloud& model = *cloud.ellipsoids;
        SeenCloud seen;
        seen.model = &model;
        seen.motion = motion_of(cloud, clouds_time(*scene));
        const glm::dvec3 shift = clouds_time(*scene) * model.drift;
        if (textures) seen.in_space = ready(model.texture, true, shift, made);
        if (model.plane) {
            if (textures) {
                seen.on_plane.own = ready(model.plane->texture, false, shift, made);
                for (const PlanePattern& pattern : model.plane->patterns)
                    seen.on_plane.patterns.push_back(ready(pattern.texture, false, shift, made));
            }
            seen.plane_height = seen.motion.translate.y + cloud.scale * model.plane->altitude;
        }
        frame.clouds.push_back(seen);
        // The same key as in generate(), so the same ellipsoids as in the volume.
        const std::uint64_t key = keyed(cloud.seed.value_or(scene->seed), k);
        for (const PlacedEllipsoid& one : placed_ellipsoids(model, key)) {
            const PixelBox box =
                box_of(one, seen.motion, view, scene->image.width, scene->image.height);
            if (box.x0 > box.x1 || box.y0 > box.y1) continue;
            frame.ellipsoids.push_back({sphere_of(one, seen.motion, view.eye), one, k, box});
        }
    }
    return frame;
}

Whites whites_of(const Scene& scene) {
    // As in automatic exposure (core/formats/image_file.cpp).
    constexpr double kCloudReflectance = 0.5;
    constexpr double kPi = 3.14159265358979324;
    const Outside outside = outside_of(scene);
    const glm::dvec3 sky =
        outside.sky.shines ? means_of(outside.sky, 12).irradiance_up / kPi : glm::dvec3(0);
    Whites whites;
    whites.sunlit = kCloudReflectance / kPi * outside.sun + sky;
    whites.ambient = whites.sunlit;
    const double bright = luminance(whites.sunlit), blue = luminance(sky);
    // Half way to the sky's hue. The other half is light from the cloud's own lit sides and from the ground.
    if (blue > 0) whites.ambient = 0.5 * whites.sunlit + 0.5 * (bright / blue) * sky;
    return whites;
}

}  // namespace awan::gardner
