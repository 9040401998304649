#include "core/generate/ellipsoids/formations.h"

#include <algorithm>
#include <cmath>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"

namespace awan::ellipsoids {
namespace {

// Random numbers in (0, 1) for one ellipsoid, by what each is for.
struct Draws {
    std::uint64_t key;
    double operator()(std::uint64_t purpose) const {
        return unit_open(static_cast<std::uint32_t>(keyed(key, purpose) >> 32));
    }
};
enum Purpose : std::uint64_t {
    kSizeX,
    kSizeY,
    kSizeZ,
    kParent,
    kTurn,
    kTilt,
    kWhich,
    kTiltedTo,
    kTiltedBy
};

// How far it is from the centre to the surface along a unit vector.
double reach(const PlacedEllipsoid& one, const glm::dvec3& direction) {
    const glm::dvec3 u = one.direction_to_unit(direction);
    return 1 / std::sqrt(glm::dot(u, u));
}

// The level unit vector at that azimuth, degrees from +z towards +x.
glm::dvec3 level(double degrees) {
    const exact::SinCos turn = exact::sincos_degrees(degrees);
    return {turn.sin, 0, turn.cos};
}

// A random direction up to `spread` degrees from upward, to any side.
glm::dvec3 upward(const Formation& formation, const Draws& draws) {
    const exact::SinCos tilt = exact::sincos_degrees(formation.spread * draws(kTilt));
    const glm::dvec3 side = level(360 * draws(kTurn));
    return {side.x * tilt.sin, tilt.cos, side.z * tilt.sin};
}

// A random level direction, along `heading` or back, up to `spread` degrees to either side.
glm::dvec3 onward(const Formation& formation, const Draws& draws) {
    const double way = draws(kWhich) < 0.5 ? 0 : 180;
    return level(formation.heading + way + formation.spread * (2 * draws(kTurn) - 1));
}

glm::dvec3 drawn_radii(const Formation& formation, const Draws& draws) {
    const auto one = [&](Purpose purpose) {
        return 1 + formation.variation * (2 * draws(purpose) - 1);
    };
    return formation.radii * glm::dvec3(one(kSizeX), one(kSizeY), one(kSizeZ));
}

// Tilted up to `tilt` degrees to a random side: turned about y, tilted, and turned back.
glm::dmat3 tilted_axes(const Formation& formation, const Draws& draws) {
    if (formation.tilt == 0) return glm::dmat3(1);
    const double side = 360 * draws(kTiltedTo);
    return turned_axes(0, formation.tilt * draws(kTiltedBy), side) * turned_axes(0, 0, -side);
}

// A random one of the earlier ellipsoids first .. last.
int earlier(const Draws& draws, int first, int last) {
    return first + std::min(static_cast<int>(draws(kParent) * (last - first + 1)), last - first);
}

void add_formation(std::vector<PlacedEllipsoid>& all, const Formation& formation,
                   const Translucence& translucence, std::uint64_t key) {
    const int first = static_cast<int>(all.size());
    const int count = static_cast<int>(formation.count);
    // How many lie in the patch below. Of a combined formation about a third do.
    const int base = formation.kind == FormationKind::kHorizontal ? count
                     : formation.kind == FormationKind::kVertical ? 1
                                                                  : (count + 2) / 3;
    for (int i = 0; i < count; ++i) {
        const Draws draws{keyed(key, static_cast<std::uint64_t>(i))};
        PlacedEllipsoid one;
        one.center = formation.center;
        one.radii = drawn_radii(formation, draws);
        one.axes = tilted_axes(formation, draws);
        one.translucence = translucence;
        if (i > 0) {
            const bool lies = i < base;
            // A row goes on from one of its last three. Towers stand on the patch, more of them in its middle, and on
            // what stands there already.
            const int last = first + i - 1;
            one.linked_to = lies ? earlier(draws, std::max(first, last - 2), last)
                            : formation.kind == FormationKind::kVertical
                                ? earlier(draws, std::max(first, last - 4), last)
                                : earlier(draws, first, last);
            const PlacedEllipsoid& parent = all[static_cast<std::size_t>(one.linked_to)];
            if (!lies) {
                // Smaller with every step upward, as turrets are.
                const double rise = parent.center.y - formation.center.y;
                const double shrink =
                    std::max(0.45, 0.88 - 0.06 * std::max(rise, 0.0) / formation.radii.y);
                one.radii *= shrink;
            }
            const glm::dvec3 way = lies ? onward(formation, draws) : upward(formation, draws);
            one.center = parent.center +
                         way * ((1 - formation.link) * (reach(parent, way) + reach(one, way)));
        }
        all.push_back(one);
    }
}

}  // namespace

glm::dmat3 turned_axes(double about_z, double about_x, double about_y) {
    const exact::SinCos z = exact::sincos_degrees(about_z), x = exact::sincos_degrees(about_x),
                        y = exact::sincos_degrees(about_y);
    const glm::dmat3 by_z = {{z.cos, z.sin, 0}, {-z.sin, z.cos, 0}, {0, 0, 1}};
    const glm::dmat3 by_x = {{1, 0, 0}, {0, x.cos, x.sin}, {0, -x.sin, x.cos}};
    const glm::dmat3 by_y = {{y.cos, 0, -y.sin}, {0, 1, 0}, {y.sin, 0, y.cos}};
    return by_y * (by_x * by_z);
}

std::vector<PlacedEllipsoid> placed_ellipsoids(const EllipsoidsCloud& cloud, std::uint64_t key) {
    std::vector<PlacedEllipsoid> all;
    for (std::size_t i = 0; i < cloud.formations.size(); ++i)
        add_formation(all, cloud.formations[i], cloud.translucence, keyed(key, i));
    if (cloud.formations.empty() && cloud.ellipsoids.empty() && cloud.quadrics.empty() &&
        !cloud.plane)
        add_formation(all, Formation{}, cloud.translucence, keyed(key, 0));
    for (const Ellipsoid& given : cloud.ellipsoids) {
        PlacedEllipsoid one;
        one.center = given.center;
        one.radii = given.radii;
        one.axes = turned_axes(given.rotate_z, given.rotate_x, given.rotate_y);
        const Translucence& own = cloud.translucence;
        one.translucence = {given.threshold.value_or(own.threshold),
                            given.threshold_edge.value_or(own.threshold_edge),
                            given.range.value_or(own.range), own.least, own.most};
        all.push_back(one);
    }
    for (const Quadric& given : cloud.quadrics)
        if (const auto shape = shape_of(given)) {
            PlacedEllipsoid& one = all.emplace_back();
            one.center = shape->center;
            one.radii = shape->radii;
            one.axes = shape->axes;
            one.translucence = cloud.translucence;
        }
    return all;
}

}  // namespace awan::ellipsoids
