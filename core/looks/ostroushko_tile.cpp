#include "core/looks/ostroushko_tile.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace awan::looks {
namespace {

using spheres::SphereNode;

// A ray ends where less of the light from behind is left: a quarter of a step of 8 bits.
constexpr double kOpaque = 1.0 / 1024;
constexpr std::uint32_t kNowhere = UINT32_MAX;

struct Gathering {
    const LookScene& scene;
    const LookCloud& cloud;
    std::uint32_t index;
    // In the cloud's coordinates.
    Cone cone;
    ConeSpheres& found;

    glm::dvec3 from_eye(const glm::dvec3& v) const { return cloud.motion.scale * turned(cloud, v); }

    void visit(const SphereNode& node, int level, std::uint32_t place) const {
        const glm::dvec3 v = node.sphere.center - cloud.eye;
        const double r = node.sphere.radius;
        if (!may_meet(cone, v, r)) return;
        const double near = std::max(glm::length(v) - r, 0.0);
        const bool leaf =
            level == cloud.levels || 2 * r < near * scene.pixel_angle * scene.finest_pixels;
        if (place == kNowhere && (leaf || level == cloud.lit_level)) {
            place = static_cast<std::uint32_t>(found.places.size());
            found.places.push_back({from_eye(v), false, {}});
        }
        if (!leaf) {
            for (const SphereNode& child : cloud.tree.children(node, level))
                visit(child, level + 1, place);
            return;
        }
        const double scale = cloud.motion.scale;
        const auto below = static_cast<std::size_t>(cloud.tree.levels() - level);
        found.spheres.push_back({from_eye(v), scale * r, scale * near,
                                 cloud.sigma * cloud.thinning[below], mix_bits(node.key), index,
                                 place});
    }
};

// A meeting of a ray with a sphere that is known, but not yet for certain the nearest one.
struct Meeting {
    SphereHit hit;
    std::uint32_t sphere;
};

struct Traced {
    glm::dvec3 radiance{0};
    // The share of the light from behind that is left.
    double left = 1;
};

class Tracer {
  public:
    Tracer(const LookScene& scene, ConeSpheres& found) : scene_(scene), found_(found) {}

    // Follows a ray through the spheres `some`, nearest first, as far as `end`. A sphere's `near` is at most where
    // the ray enters it, so all meetings before the next sphere's `near` are final.
    Traced trace(const glm::dvec3& ray, double end, std::span<const std::uint32_t> some) {
        Traced traced;
        // Meetings sorted so that the nearest is the last.
        waiting_.clear();
        for (const std::uint32_t i : some) {
            const glm::dvec4& ball = found_.balls[i];
            Meeting meeting{{}, i};
            if (!meets(glm::dvec3(ball), ball.w, ray, meeting.hit)) continue;
            if (meeting.hit.enter >= end) continue;
            while (!waiting_.empty() && waiting_.back().hit.enter <= found_.spheres[i].near &&
                   traced.left > kOpaque)
                take_nearest(ray, traced);
            if (traced.left <= kOpaque) return traced;
            meeting.hit.leave = std::min(meeting.hit.leave, end);
            const auto place =
                std::find_if(waiting_.rbegin(), waiting_.rend(),
                             [&](const Meeting& one) { return one.hit.enter > meeting.hit.enter; });
            waiting_.insert(place.base(), meeting);
        }
        while (!waiting_.empty() && traced.left > kOpaque) take_nearest(ray, traced);
        return traced;
    }

  private:
    void take_nearest(const glm::dvec3& ray, Traced& traced) {
        const Meeting meeting = waiting_.back();
        waiting_.pop_back();
        const LookSphere& sphere = found_.spheres[meeting.sphere];
        const double kept = through(meeting.hit, sphere.radius, sphere.sigma);
        if (kept >= 1) return;
        LitPlace& place = found_.places[sphere.place];
        if (!place.known) {
            place.share = reaching(scene_.clouds, scene_.light, place.point);
            place.known = true;
        }
        const glm::dvec3 outward = meeting.hit.enter * ray - sphere.center;
        const double length = glm::length(outward);
        const glm::dvec3 normal = length > 0 ? outward / length : -ray;
        traced.radiance += traced.left * (1 - kept) *
                           shade(scene_.light, place.share,
                                 bumped(scene_.clouds[sphere.cloud], normal, sphere.key));
        traced.left *= kept;
    }

    const LookScene& scene_;
    ConeSpheres& found_;
    std::vector<Meeting> waiting_;
};

// Pixels x .. right - 1, y .. bottom - 1.
struct Block {
    int x, y, right, bottom;
};

Cone cone_of(const LookScene& scene, const Block& block) {
    const int right = block.right - 1, bottom = block.bottom - 1;
    const glm::dvec3 corners[] = {ray_of(scene, block.x, block.y), ray_of(scene, right, block.y),
                                  ray_of(scene, block.x, bottom), ray_of(scene, right, bottom)};
    Cone cone{glm::normalize(corners[0] + corners[1] + corners[2] + corners[3]), 0, 1};
    for (const glm::dvec3& corner : corners)
        cone.cosine = std::min(cone.cosine, glm::dot(cone.axis, corner));
    // Against rounding.
    cone.cosine = std::max(cone.cosine - 1e-12, 0.0);
    cone.sine = std::sqrt(1 - cone.cosine * cone.cosine);
    return cone;
}

// Draws the quarters of a block, each with what it may meet of `some`, down to single pixels.
void draw_block(const LookScene& scene, const Block& block, const ConeSpheres& found,
                std::span<const std::uint32_t> some, Tracer& tracer, float* pixels) {
    if (some.empty()) return;
    const int width = block.right - block.x, height = block.bottom - block.y;
    if (width == 1 && height == 1) {
        const glm::dvec3 ray = ray_of(scene, block.x, block.y);
        const double drop = scene.ground_height - scene.view.eye.y;
        const double end = scene.ground && ray.y < 0 ? std::max(drop / ray.y, 0.0)
                                                     : std::numeric_limits<double>::infinity();
        const Traced traced = tracer.trace(ray, end, some);
        float* const pixel = pixels + 4 * (static_cast<std::size_t>(block.y) *
                                               static_cast<std::size_t>(scene.width) +
                                           static_cast<std::size_t>(block.x));
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(traced.radiance[c]);
        pixel[3] = static_cast<float>(1 - (traced.left > kOpaque ? traced.left : 0));
        return;
    }
    const int middle_x = block.x + (width + 1) / 2, middle_y = block.y + (height + 1) / 2;
    std::vector<std::uint32_t> fewer;
    for (const Block& quarter : {Block{block.x, block.y, middle_x, middle_y},
                                 Block{middle_x, block.y, block.right, middle_y},
                                 Block{block.x, middle_y, middle_x, block.bottom},
                                 Block{middle_x, middle_y, block.right, block.bottom}}) {
        if (quarter.right <= quarter.x || quarter.bottom <= quarter.y) continue;
        const bool pixel = quarter.right - quarter.x == 1 && quarter.bottom - quarter.y == 1;
        // A pixel's one ray is as quick as a cone.
        if (pixel) {
            draw_block(scene, quarter, found, some, tracer, pixels);
            continue;
        }
        const Cone cone = cone_of(scene, quarter);
        fewer.clear();
        for (const std::uint32_t i : some)
            if (may_meet(cone, glm::dvec3(found.balls[i]), found.balls[i].w)) fewer.push_back(i);
        draw_block(scene, quarter, found, fewer, tracer, pixels);
    }
}

}  // namespace

bool may_meet(const Cone& cone, const glm::dvec3& center, double radius) {
    const double along = glm::dot(center, cone.axis);
    if (along < -radius) return false;
    // The square of the centre's distance from the cone's axis. Behind the eye it is too small, which is safe.
    const double reach = radius + along * cone.sine;
    const double beside = std::max(glm::dot(center, center) - along * along, 0.0);
    return reach > 0 && beside * cone.cosine * cone.cosine <= reach * reach;
}

glm::dvec3 ray_of(const LookScene& scene, int x, int y) {
    const View& view = scene.view;
    const double u = ((x + 0.5) / scene.width * 2 - 1) * view.tan_half_fov * view.aspect;
    const double v = (1 - (y + 0.5) / scene.height * 2) * view.tan_half_fov;
    return glm::normalize(view.forward + u * view.right + v * view.up);
}

ConeSpheres spheres_in_cone(const LookScene& scene, const Cone& cone) {
    ConeSpheres found;
    for (std::uint32_t k = 0; k < scene.clouds.size(); ++k) {
        const LookCloud& cloud = scene.clouds[k];
        if (!(cloud.sigma > 0)) continue;
        const Gathering gathering{
            scene, cloud, k, {turned_back(cloud, cone.axis), cone.sine, cone.cosine}, found};
        gathering.visit(cloud.tree.root(), 0, kNowhere);
    }
    struct Place {
        double near;
        std::uint32_t sphere;
    };
    std::vector<Place> sorted(found.spheres.size());
    for (std::uint32_t i = 0; i < sorted.size(); ++i) sorted[i] = {found.spheres[i].near, i};
    std::sort(sorted.begin(), sorted.end(), [](const Place& a, const Place& b) {
        return a.near != b.near ? a.near < b.near : a.sphere < b.sphere;
    });
    std::vector<LookSphere> spheres;
    spheres.reserve(sorted.size());
    found.balls.reserve(sorted.size());
    for (const Place& place : sorted) {
        spheres.push_back(found.spheres[place.sphere]);
        found.balls.emplace_back(spheres.back().center, spheres.back().radius);
    }
    found.spheres = std::move(spheres);
    return found;
}

void draw_tile(const LookScene& scene, int x, int y, float* pixels) {
    const Block block{x, y, std::min(x + kTileSide, scene.width),
                      std::min(y + kTileSide, scene.height)};
    ConeSpheres found = spheres_in_cone(scene, cone_of(scene, block));
    std::vector<std::uint32_t> all(found.spheres.size());
    std::iota(all.begin(), all.end(), 0u);
    Tracer tracer(scene, found);
    draw_block(scene, block, found, all, tracer, pixels);
}

}  // namespace awan::looks
