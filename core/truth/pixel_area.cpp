#include "core/truth/pixel_area.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/exact_math.h"
#include "core/generate/gaussian.h"
#include "core/survey/narrow.h"
#include "core/truth/oracles.h"
#include "core/truth/path_random.h"

namespace awan::truth {
namespace {

// The least s, in sides of a square, for which its middle will do, and the 2 x 2 points of Gauss and Legendre's rule.
// Their errors are at most s^-2 / 12 and s^-4 / 720 of a Gaussian's height: 0.9% and 0.6%.
constexpr double kMiddle = 3, kFour = 0.7;
constexpr int kMostDivisions = 24;

// A particle before a pixel: where its centre is seen (pixels), how far from there it has matter, and its s.
struct Spot {
    double x, y, reach, s;
    std::size_t particle;
};

// Part of the picture, pixels.
struct Square {
    double x, y, side;
};

bool touches(const Spot& spot, const Square& at) {
    const double dx = std::max({at.x - spot.x, spot.x - at.x - at.side, 0.0});
    const double dy = std::max({at.y - spot.y, spot.y - at.y - at.side, 0.0});
    return dx * dx + dy * dy <= spot.reach * spot.reach;
}

class Area {
  public:
    Area(const View& view, int width, int height, const ParticleSet& particles,
         std::size_t most_parts, double smallest,
         const std::function<double(const glm::dvec3&)>& end, std::uint64_t seed)
        : view_(view),
          width_(width),
          height_(height),
          particles_(particles),
          most_parts_(most_parts),
          smallest_(smallest),
          end_(end),
          random_(seed) {}

    AreaRays rays(const Square& pixel) {
        std::vector<Spot> spots;
        for (std::size_t i = 0; i < particles_.size(); ++i) {
            const Spot spot = spot_of(i, pixel);
            if (touches(spot, pixel)) spots.push_back(spot);
        }
        // Breadth first, so that all parts are as fine as there is room for.
        std::vector<Part> parts;
        if (!spots.empty()) parts.push_back({pixel, std::move(spots)});
        for (int level = 0; !parts.empty(); ++level) {
            const bool more = level < kMostDivisions && parts.size() <= most_parts_;
            std::vector<Part> next;
            for (Part& part : parts) {
                if (narrowest(part) >= kFour)
                    add_rule(part);
                else if (more)
                    divide(part, next);
                else
                    add_random(part);
            }
            parts.swap(next);
        }
        return std::move(found_);
    }

  private:
    struct Part {
        Square square;
        std::vector<Spot> spots;
    };

    // A particle that the eye is in or beside is seen everywhere, and is wide.
    Spot spot_of(std::size_t i, const Square& pixel) const {
        const glm::dvec3 p = particles_.center[i] - view_.eye;
        const double z = glm::dot(p, view_.forward), s = gaussian_s(particles_, i);
        const double depth = central_depth(particles_, i);
        const double cut =
            std::clamp(std::sqrt(2 * exact::log(std::max(1.0, depth * 1e7))), 4.0, 9.0);
        if (!(z > 2 * cut * s)) return {pixel.x, pixel.y, 1e300, 1e300, i};
        const double per_x = width_ / (2 * view_.tan_half_fov * view_.aspect),
                     per_y = height_ / (2 * view_.tan_half_fov);
        const double u = glm::dot(p, view_.right) / z, v = glm::dot(p, view_.up) / z;
        // Off the middle a ball is seen longer, and from near by larger.
        const double longer = std::sqrt(1 + u * u + v * v) / (1 - cut * s / z);
        return {width_ / 2.0 + u * per_x, height_ / 2.0 - v * per_y,
                cut * s / z * std::max(per_x, per_y) * longer, s / z * std::min(per_x, per_y), i};
    }

    // A particle's s, in sides of a part; that of a deep one counts less, for its steep edges.
    double width_in(const Part& part, const Spot& spot) const {
        const double depth = central_depth(particles_, spot.particle);
        return spot.s * kLeastWidth / (least_width(depth) * part.square.side);
    }

    double narrowest(const Part& part) const {
        double least = 1e300;
        for (const Spot& spot : part.spots) least = std::min(least, width_in(part, spot));
        return least;
    }

    // With what else is seen in it.
    double finest(const Part& part) const {
        double least = 1e300;
        for (const Spot& spot : part.spots) {
            const double width = width_in(part, spot);
            const double share = smallest_ / gaussian_s(particles_, spot.particle);
            least = std::min({least, width, std::max(width * share, kFour)});
        }
        return least;
    }

    void divide(const Part& part, std::vector<Part>& parts) const {
        const double half = part.square.side / 2;
        for (int quarter = 0; quarter < 4; ++quarter) {
            Part one{{part.square.x + quarter % 2 * half, part.square.y + quarter / 2 * half, half},
                     {}};
            for (const Spot& spot : part.spots)
                if (touches(spot, one.square)) one.spots.push_back(spot);
            if (!one.spots.empty()) parts.push_back(std::move(one));
        }
    }

    void add(const Part& part, const ParticleSet& matter, double x, double y, double share) {
        const double u = ((part.square.x + x * part.square.side) / width_ * 2 - 1) *
                         view_.tan_half_fov * view_.aspect;
        const double v =
            (1 - (part.square.y + y * part.square.side) / height_ * 2) * view_.tan_half_fov;
        const glm::dvec3 d = glm::normalize(view_.forward + u * view_.right + v * view_.up);
        found_.rays.push_back({d, share * part.square.side * part.square.side,
                               end_ ? line_optical_depth(matter, view_.eye, d, 0, end_(d)) : 0});
    }

    ParticleSet matter_of(const Part& part) const {
        ParticleSet matter;
        for (const Spot& spot : part.spots) {
            matter.center.push_back(particles_.center[spot.particle]);
            matter.radius.push_back(particles_.radius[spot.particle]);
            matter.density.push_back(particles_.density[spot.particle]);
        }
        return matter;
    }

    void add_rule(const Part& part) {
        const ParticleSet matter = matter_of(part);
        if (finest(part) >= kMiddle) {
            add(part, matter, 0.5, 0.5, 1);
            return;
        }
        const double far = std::sqrt(1.0 / 12);
        for (const double y : {0.5 - far, 0.5 + far})
            for (const double x : {0.5 - far, 0.5 + far}) add(part, matter, x, y, 0.25);
    }

    // Four rays, each anywhere in a quarter.
    void add_random(const Part& part) {
        const ParticleSet matter = matter_of(part);
        found_.random = true;
        for (int quarter = 0; quarter < 4; ++quarter)
            add(part, matter, 0.5 * (quarter % 2 + random_.unit()),
                0.5 * (quarter / 2 + random_.unit()), 0.25);
    }

    const View& view_;
    double width_, height_;
    const ParticleSet& particles_;
    std::size_t most_parts_;
    double smallest_;
    const std::function<double(const glm::dvec3&)>& end_;
    PathRandom random_;
    AreaRays found_;
};

}  // namespace

AreaRays area_rays(const View& view, int width, int height, int x, int y, const ParticleSet& near,
                   std::size_t most_parts, double smallest,
                   const std::function<double(const glm::dvec3&)>& end, std::uint64_t seed) {
    return Area(view, width, height, near, most_parts, smallest, end, seed)
        .rays({static_cast<double>(x), static_cast<double>(y), 1});
}

}  // namespace awan::truth
