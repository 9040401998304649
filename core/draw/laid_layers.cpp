#include "core/draw/laid_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "core/base/catmull_rom.h"
#include "core/base/exact_math.h"

namespace awan {
namespace {

// The haze is found so many pixels apart, and linear between them.
constexpr int kHazeSide = 8;

// Of the plane that a picture stands in, seen in the frame: at pixel coordinates (x, y) it is met at texel coordinates
// (column, row) / depth and at `meets` / depth times the ray's own length. All are linear in x and y.
struct Plane {
    std::array<double, 3> column, row, depth;
    double meets = 0;

    static double at(const std::array<double, 3>& linear, double x, double y) {
        return linear[0] + linear[1] * x + linear[2] * y;
    }
};

Plane plane_of(const FacingPicture& facing, const PictureRays& rays) {
    const View& own = facing.view;
    const glm::dvec3 e = rays.eye - own.eye;
    const glm::dvec3 parts[3] = {rays.corner, rays.per_x, rays.per_y};
    const double across = own.tan_half_fov * own.aspect, up = own.tan_half_fov;
    const double ex = glm::dot(e, own.right), ey = glm::dot(e, own.up);
    Plane plane;
    plane.meets = facing.plane - glm::dot(e, own.forward);
    for (std::size_t i = 0; i < 3; ++i) {
        const double depth = glm::dot(parts[i], own.forward);
        const double x = (ex * depth + plane.meets * glm::dot(parts[i], own.right)) / facing.plane;
        const double y = (ey * depth + plane.meets * glm::dot(parts[i], own.up)) / facing.plane;
        plane.depth[i] = depth;
        // Texel 0's middle is at 0.
        plane.column[i] = 0.5 * facing.width * (x / across + depth) - 0.5 * depth;
        plane.row[i] = 0.5 * facing.height * (depth - y / up) - 0.5 * depth;
    }
    return plane;
}

struct Box {
    int left = 0, right = -1, top = 0, bottom = -1;  // pixels, all included
};

// The pixels that may see the picture.
Box box_of(const FacingPicture& facing, const PictureRays& rays) {
    const View& own = facing.view;
    const double across = own.tan_half_fov * own.aspect, up = own.tan_half_fov;
    const glm::dvec3 forward = glm::cross(rays.per_y, rays.per_x);
    const glm::dvec3 axis = glm::normalize(forward);
    const double away = glm::dot(rays.corner, axis);
    double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
    for (const double u : {-across, across})
        for (const double v : {-up, up}) {
            const glm::dvec3 d =
                own.eye + facing.plane * (own.forward + u * own.right + v * own.up) - rays.eye;
            const double z = glm::dot(d, axis) / away;
            if (!(z > 0)) return {0, rays.width - 1, 0, rays.height - 1};
            const glm::dvec3 at = d / z - rays.corner;
            const double x = glm::dot(at, rays.per_x) / glm::dot(rays.per_x, rays.per_x);
            const double y = glm::dot(at, rays.per_y) / glm::dot(rays.per_y, rays.per_y);
            low_x = std::min(low_x, x), high_x = std::max(high_x, x);
            low_y = std::min(low_y, y), high_y = std::max(high_y, y);
        }
    const auto pixel = [](double at, int most) {
        return static_cast<int>(std::clamp(std::floor(at), -1.0, static_cast<double>(most)));
    };
    return {std::max(pixel(low_x, rays.width), 0),
            std::min(pixel(high_x, rays.width), rays.width - 1),
            std::max(pixel(low_y, rays.height), 0),
            std::min(pixel(high_y, rays.height), rays.height - 1)};
}

// The haze before a picture's plane on one ray: its light, and last the share of light that comes through.
Rgb4 haze_at(const Air& air, const PictureRays& rays, const Plane& plane, double x, double y) {
    const glm::dvec3 ray = rays.corner + x * rays.per_x + y * rays.per_y;
    const double length = glm::length(ray);
    const double depth = Plane::at(plane.depth, x, y);
    const double t = depth > 0 ? std::max(plane.meets / depth * length, 0.0) : 0.0;
    const glm::dvec3 d = ray / length;
    const AirBefore before = air_before(air, HazeRay(air.haze, rays.eye.y, d.y), x, y, t);
    const glm::vec3 light(in_scattering(air, d, before));
    return Rgb4{light.x, light.y, light.z, static_cast<float>(1 - before.opacity)};
}

// Of one row of squares of kHazeSide pixels.
class HazeRow {
  public:
    // Finds the haze of the squares that pixels of row y are in, unless it is known.
    void reach(int y, const Air& air, const PictureRays& rays, const Plane& plane, const Box& box) {
        const int top = y / kHazeSide * kHazeSide;
        if (top == top_) return;
        top_ = top;
        left_ = box.left / kHazeSide * kHazeSide;
        for (std::size_t row = 0; row < 2; ++row) {
            corners_[row].clear();
            for (int x = left_; x <= box.right + kHazeSide; x += kHazeSide)
                corners_[row].push_back(
                    haze_at(air, rays, plane, x, top + static_cast<int>(row) * kHazeSide));
        }
    }
    Rgb4 at(int x, int y) const {
        const auto column = static_cast<std::size_t>((x - left_) / kHazeSide);
        const float across = (static_cast<float>((x - left_) % kHazeSide) + 0.5F) / kHazeSide;
        const float down = (static_cast<float>(y - top_) + 0.5F) / kHazeSide;
        const auto along = [&](const std::vector<Rgb4>& row) {
            return row[column] + (row[column + 1] - row[column]) * across;
        };
        const Rgb4 upper = along(corners_[0]);
        return upper + (along(corners_[1]) - upper) * down;
    }

  private:
    int left_ = 0, top_ = -1;
    std::array<std::vector<Rgb4>, 2> corners_;
};

Rgb4 texel(const Image& texels, int column, int row) {
    Rgb4 value;
    std::memcpy(&value,
                texels.pixels.data() +
                    4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(texels.width) +
                         static_cast<std::size_t>(column)),
                sizeof value);
    return value;
}

// Beyond the picture there is nothing.
Rgb4 between_texels(const Image& texels, double column, double row) {
    const double left = std::floor(column), top = std::floor(row);
    if (!(left >= 1 && top >= 1 && left < texels.width - 2 && top < texels.height - 2))
        return Rgb4{};
    const auto x = static_cast<int>(left), y = static_cast<int>(top);
    const std::array<float, 4> across = catmull_rom(static_cast<float>(column - left)),
                               down = catmull_rom(static_cast<float>(row - top));
    Rgb4 sum{};
    for (int j = 0; j < 4; ++j) {
        Rgb4 line{};
        for (int i = 0; i < 4; ++i)
            line += texel(texels, x - 1 + i, y - 1 + j) * across[static_cast<std::size_t>(i)];
        sum += line * down[static_cast<std::size_t>(j)];
    }
    const Rgb4 above = sum > 0.0F ? sum : Rgb4{};
    return Rgb4{above[0], above[1], above[2], std::min(above[3], 1.0F)};
}

// The share of a pixel in which the ground does not hide what stands at a distance.
float seen_before(const Backdrop& behind, std::size_t at, double distance) {
    const auto farther = [&](float ground) { return static_cast<double>(ground) > distance; };
    if (!behind.quarters_of.empty() && behind.quarters_of[at] != 0) {
        float share = 0;
        for (const BackdropSample& quarter : behind.quarters[behind.quarters_of[at] - 1])
            share += farther(quarter.distance) ? 0.25F : 0.0F;
        return share;
    }
    return farther(behind.distance[at]) ? 1.0F : 0.0F;
}

}  // namespace

ScaledClear::ScaledClear(float scaled) {
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const double root = static_cast<double>(i) / kSteps;
        table_[i] =
            i == 0 ? 0.0F : static_cast<float>(exact::pow(root, 2 * static_cast<double>(scaled)));
    }
}

LaidLayers no_layers(int width, int height) {
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {width,
            height,
            std::vector<Rgb4>(pixels),
            std::vector<float>(pixels, 1.0F),
            std::vector<float>(pixels, 1.0F),
            std::vector<float>(pixels)};
}

void lay_picture(const CloudPicture& picture, const PictureRays& rays, const Air* air,
                 const Backdrop* behind, const ScaledClear& scaled, int first, int end,
                 LaidLayers& to) {
    const Plane plane = plane_of(picture.facing, rays);
    if (!(plane.meets > 0)) return;
    const Box box = box_of(picture.facing, rays);
    const bool hides = behind != nullptr && !behind->distance.empty();
    HazeRow haze;
    for (int y = std::max(first, box.top); y <= std::min(end - 1, box.bottom); ++y) {
        if (air != nullptr) haze.reach(y, *air, rays, plane, box);
        std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width) +
                         static_cast<std::size_t>(box.left);
        for (int x = box.left; x <= box.right; ++x, ++at) {
            const float left = to.left[at], seen = to.seen[at];
            const double px = x + 0.5, py = y + 0.5;
            const double depth = Plane::at(plane.depth, px, py);
            if (seen < kLeastSeen || !(depth > 0)) continue;
            Rgb4 own = between_texels(picture.texels, Plane::at(plane.column, px, py) / depth,
                                      Plane::at(plane.row, px, py) / depth);
            if (!(own[3] > 0)) continue;
            if (hides) {
                const glm::dvec3 ray = rays.corner + px * rays.per_x + py * rays.per_y;
                own *= seen_before(*behind, at, plane.meets / depth * glm::length(ray));
            }
            const float opacity = own[3];
            if (air != nullptr) {
                const Rgb4 before = haze.at(x, y);
                own *= before[3];
                to.light[at] += before * (opacity * left);
                to.hazed[at] += left * opacity * (1 - before[3]);
            }
            to.light[at] += own * seen;
            to.left[at] = left * (1 - opacity);
            to.seen[at] = seen * scaled.of(1 - opacity);
        }
    }
}

void lay_pixels(const Image& layer, float hazed, const ScaledClear& scaled, int first, int end,
                LaidLayers& to) {
    const auto width = static_cast<std::size_t>(to.width);
    for (std::size_t at = static_cast<std::size_t>(first) * width;
         at < static_cast<std::size_t>(end) * width; ++at) {
        Rgb4 own;
        std::memcpy(&own, layer.pixels.data() + 4 * at, sizeof own);
        const float opacity = own[3], left = to.left[at];
        if (!(opacity > 0)) continue;
        to.light[at] += own * to.seen[at];
        to.seen[at] *= scaled.of(1 - opacity);
        to.hazed[at] += left * opacity * hazed;
        to.left[at] = left * (1 - opacity);
    }
}

}  // namespace awan
