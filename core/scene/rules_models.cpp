// The rules of the models that concern several fields at once.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/scene/automaton.h"
#include "core/scene/checks.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/formula.h"
#include "core/scene/implicit.h"
#include "core/scene/limits.h"
#include "core/scene/rules.h"
#include "core/scene/spheres.h"

namespace awan {
namespace {

Error too_small(std::string pointer, const char* least, double its_value, double value) {
    return invalid(std::move(pointer), std::string("must be at least `") + least + "`, " +
                                           to_text(its_value) + ", not " + to_text(value));
}

// --- automaton

Status check_random(const AutomatonCloud& cloud, const std::string& at) {
    if (!cloud.random) return std::nullopt;
    const RandomEllipsoids& random = *cloud.random;
    if (Status wrong = count_in_range(random.count, 0,
                                      limits::kMaxAutomatonEllipsoids - cloud.ellipsoids.size(),
                                      at + "/random/count"))
        return wrong;
    for (int axis = 0; axis < 3; ++axis)
        if (!(random.largest[axis] >= random.smallest[axis]))
            return too_small(at + "/random/largest/" + std::to_string(axis), "smallest",
                             random.smallest[axis], random.largest[axis]);
    return std::nullopt;
}

Status check_bands(const std::vector<AutomatonWindBand>& bands, const std::string& at) {
    for (std::size_t i = 0; i < bands.size(); ++i)
        if (!(bands[i].to >= bands[i].from))
            return too_small(at + "/" + std::to_string(i) + "/to", "from", bands[i].from,
                             bands[i].to);
    return std::nullopt;
}

// of_table: whether the word is "table", which wants a list, as no other word does.
Status check_shape_table(bool of_table, const std::vector<float>& table, const std::string& word,
                         const std::string& at) {
    const std::string pointer = at + "/" + word + "_table";
    if (!of_table && !table.empty()) return invalid(pointer, "belongs to " + word + " \"table\"");
    if (of_table && table.size() < 2)
        return invalid(pointer, "must have two values at least, from the middle to the edge, not " +
                                    std::to_string(table.size()));
    return std::nullopt;
}

Status check_shapes(const AutomatonCloud& cloud, const std::string& at) {
    if (Status wrong = check_shape_table(cloud.fall_off == AutomatonShape::kTable,
                                         cloud.fall_off_table, "fall_off", at))
        return wrong;
    const bool weights = cloud.smooth_weight == AutomatonWeight::kTable;
    if (Status wrong = check_shape_table(weights, cloud.smooth_weight_table, "smooth_weight", at))
        return wrong;
    if (weights && !(cloud.smooth_weight_table[0] > 0))
        return invalid(at + "/smooth_weight_table/0",
                       "must be above 0: a cell counts towards its own density");
    return std::nullopt;
}

// Cells within the boxes around all ellipsoids, at most.
double cells_of_ellipsoids(const AutomatonCloud& cloud) {
    const double wider = 1 + cloud.wind.mutation;
    const auto box = [&](const glm::dvec3& radii) {
        double cells = 1;
        for (int axis = 0; axis < 3; ++axis)
            cells *= std::min(cloud.cells[axis], 2 * wider * radii[axis] + 1);
        return cells;
    };
    double cells = 0;
    for (const AutomatonEllipsoid& ellipsoid : cloud.ellipsoids) cells += box(ellipsoid.radii);
    const RandomEllipsoids random = random_ellipsoids_of(cloud);
    return cells + static_cast<double>(random.count) * box(random.largest);
}

Status check_work(const AutomatonCloud& cloud, const std::string& at) {
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    const double own = cells_of_ellipsoids(cloud);
    const double a_step = cells + (cloud.wind.ellipsoids.empty() ? 0 : own);
    const double work = own + a_step * static_cast<double>(cloud.steps);
    if (work <= limits::kMaxAutomatonWork) return std::nullopt;
    const double left = std::floor((limits::kMaxAutomatonWork - own) / a_step);
    return invalid(at + "/steps", "is more than this grid may make: cells" +
                                      std::string(cloud.wind.ellipsoids.empty()
                                                      ? ""
                                                      : " (and those in ellipsoids, which move)") +
                                      " times steps may be " + to_text(limits::kMaxAutomatonWork) +
                                      ", here " + to_text(std::max(left, 0.0)) + " steps");
}

// --- spheres

Status check_span(const Span& span, const std::string& pointer_to_low) {
    if (span.low <= span.high) return std::nullopt;
    return invalid(pointer_to_low, "must be at most the upper end, " + to_text(span.high) +
                                       ", not " + to_text(span.low));
}

Status check_leaves(const SpheresCloud& cloud, const std::string& at) {
    std::uint64_t leaves = 1, most = 0;
    for (; leaves <= limits::kMaxSphereLeaves / cloud.parts; ++most) leaves *= cloud.parts;
    if (cloud.levels <= most) return std::nullopt;
    return invalid(at + "/levels", "makes more than " + std::to_string(limits::kMaxSphereLeaves) +
                                       " spheres; of " + std::to_string(cloud.parts) +
                                       " parts each there may be " + std::to_string(most) +
                                       " levels");
}

Status check_poses(const SpheresCloud& cloud, const std::string& at) {
    for (std::size_t i = 0; i < cloud.poses.size(); ++i) {
        const std::string here = at + "/poses/" + std::to_string(i);
        const SpheresPose& pose = cloud.poses[i];
        if (i > 0 && !(pose.time > cloud.poses[i - 1].time))
            return invalid(here + "/time", "must be later than that of the pose before, " +
                                               to_text(cloud.poses[i - 1].time));
        for (int axis = 0; axis < 3; ++axis) {
            const double side = cloud.size[axis] * pose.scale[axis];
            if (side < limits::kMinSpheresSide || side > limits::kMaxSpheresSide)
                return invalid(here + "/scale/" + std::to_string(axis),
                               "times the cloud's side must be from " +
                                   to_text(limits::kMinSpheresSide) + " to " +
                                   to_text(limits::kMaxSpheresSide) + ", not " + to_text(side));
        }
    }
    return std::nullopt;
}

// --- implicit

Status check_shape(const ImplicitPrimitive& p, const std::string& at) {
    const bool cylinder = p.shape == ImplicitShape::kCylinder;
    const bool skeleton = cylinder || p.shape == ImplicitShape::kSegment;
    const std::size_t points = p.points.size();
    if (!skeleton && points > 0)
        return invalid(at + "/points", "belongs to a cylinder or a segment");
    if (cylinder && points != 2)
        return invalid(at + "/points",
                       "must have the two ends of a cylinder, not " + std::to_string(points));
    if (skeleton && points < 2)
        return invalid(at + "/points",
                       "must have two points at least, not " + std::to_string(points));
    if (p.shape != ImplicitShape::kEllipsoid && p.radii != glm::dvec3(1))
        return invalid(at + "/radii", "belongs to an ellipsoid");
    if (p.shape == ImplicitShape::kEllipsoid && p.core != 0)
        return invalid(at + "/core", "belongs to spheres, cylinders and segments");
    return std::nullopt;
}

// Times of keys rise.
template <typename Key>
Status check_times(const std::vector<Key>& keys, const std::string& at) {
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (!(keys[i].time > keys[i - 1].time))
            return invalid(
                at + "/" + std::to_string(i) + "/time",
                "must be later than that of the key before, " + to_text(keys[i - 1].time));
    return std::nullopt;
}

// That a key gives what the shape has.
Status check_key(const ImplicitPrimitive& p, const ImplicitKey& key, const std::string& at) {
    const bool skeleton = p.shape == ImplicitShape::kCylinder || p.shape == ImplicitShape::kSegment;
    if (key.points && !skeleton)
        return invalid(at + "/points", "belongs to a cylinder or a segment");
    if (key.points && key.points->size() != p.points.size())
        return invalid(at + "/points", "must be as many as the primitive's `points`, " +
                                           std::to_string(p.points.size()) + ", not " +
                                           std::to_string(key.points->size()));
    if (key.radii && p.shape != ImplicitShape::kEllipsoid)
        return invalid(at + "/radii", "belongs to an ellipsoid");
    if (key.core && p.shape == ImplicitShape::kEllipsoid)
        return invalid(at + "/core", "belongs to spheres, cylinders and segments");
    return std::nullopt;
}

// Semi-axes are lengths too, whatever radius a key gives.
Status check_axes(double radius, const glm::dvec3& radii, const std::string& at) {
    for (int i = 0; i < 3; ++i)
        if (radius * radii[i] > limits::kMaxImplicitRadius)
            return invalid(at + "/radii/" + std::to_string(i),
                           "times the radius must be at most " +
                               to_text(limits::kMaxImplicitRadius) + ", not " +
                               to_text(radius * radii[i]));
    return std::nullopt;
}

Status check_primitive(const ImplicitPrimitive& p, const std::string& at) {
    if (Status wrong = check_shape(p, at)) return wrong;
    if (Status wrong = check_times(p.keys, at + "/keys")) return wrong;
    double largest = p.radius;
    for (const ImplicitKey& key : p.keys) largest = std::max(largest, key.radius.value_or(0));
    if (Status wrong = check_axes(largest, p.radii, at)) return wrong;
    for (std::size_t i = 0; i < p.keys.size(); ++i) {
        const std::string of = at + "/keys/" + std::to_string(i);
        if (Status wrong = check_key(p, p.keys[i], of)) return wrong;
        if (p.keys[i].radii)
            if (Status wrong = check_axes(largest, *p.keys[i].radii, of)) return wrong;
    }
    return std::nullopt;
}

Status check_primitives(const std::vector<ImplicitPrimitive>& primitives, const std::string& at) {
    std::uint64_t elements = 0;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const std::size_t points = primitives[i].points.size();
        elements += points > 1 ? points - 1 : 1;
        if (elements > limits::kMaxImplicitElements)
            return invalid(at + "/" + std::to_string(i),
                           "a cloud may have at most " +
                               std::to_string(limits::kMaxImplicitElements) +
                               " primitives in all, each piece of a skeleton counted");
    }
    for (std::size_t i = 0; i < primitives.size(); ++i)
        if (Status wrong = check_primitive(primitives[i], at + "/" + std::to_string(i)))
            return wrong;
    return std::nullopt;
}

Status check_axis(const glm::dvec3& axis, const std::string& at) {
    if (glm::length(axis) >= 1e-6) return std::nullopt;
    return invalid(at + "/axis", "must have a length of 1e-6 at least");
}

// Attractors and vortices.
Status check_warps(const ImplicitCloud& cloud, const std::string& at) {
    for (std::size_t i = 0; i < cloud.attractors.size(); ++i)
        if (Status wrong = check_times(cloud.attractors[i].keys,
                                       at + "/attractors/" + std::to_string(i) + "/keys"))
            return wrong;
    for (std::size_t i = 0; i < cloud.vortices.size(); ++i) {
        const ImplicitVortex& vortex = cloud.vortices[i];
        const std::string of = at + "/vortices/" + std::to_string(i);
        if (Status wrong = check_axis(vortex.axis, of)) return wrong;
        if (Status wrong = check_times(vortex.keys, of + "/keys")) return wrong;
        for (std::size_t k = 0; k < vortex.keys.size(); ++k)
            if (vortex.keys[k].axis)
                if (Status wrong =
                        check_axis(*vortex.keys[k].axis, of + "/keys/" + std::to_string(k)))
                    return wrong;
    }
    return std::nullopt;
}

Status check_flow(const ImplicitFlow& flow, const std::string& at) {
    for (int i = 0; i < 3; ++i)
        if (!(flow.max[i] - flow.min[i] >= limits::kMinImplicitRadius))
            return invalid(at + "/max/" + std::to_string(i),
                           "must be greater than `min` by " + to_text(limits::kMinImplicitRadius) +
                               " at least");
    const double wanted = flow.size.x * flow.size.y * flow.size.z;
    if (wanted != static_cast<double>(flow.vectors.size()))
        return invalid(at + "/vectors", "must have as many vectors as `size` says, " +
                                            to_text(wanted) + ", not " +
                                            std::to_string(flow.vectors.size()));
    return std::nullopt;
}

// No row twice, and no more particles than there may be primitives.
Status check_particles(const std::vector<ImplicitParticle>& table, const std::string& at) {
    std::vector<std::size_t> order(table.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (table[a].id != table[b].id) return table[a].id < table[b].id;
        return table[a].time != table[b].time ? table[a].time < table[b].time : a < b;
    });
    std::uint64_t particles = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const ImplicitParticle& row = table[order[i]];
        const bool another = i == 0 || table[order[i - 1]].id != row.id;
        if (!another && table[order[i - 1]].time == row.time)
            return invalid(at + "/" + std::to_string(order[i]),
                           "is particle " + std::to_string(row.id) + " at " + to_text(row.time) +
                               " seconds again, as row " + std::to_string(order[i - 1]));
        particles += another ? 1 : 0;
        if (particles > limits::kMaxImplicitElements)
            return invalid(at, "may have at most " + std::to_string(limits::kMaxImplicitElements) +
                                   " particles, each with any number of rows");
    }
    return std::nullopt;
}

// --- ellipsoids

Status check_quadric(const Quadric& quadric, const std::string& at) {
    const auto shape = shape_of(quadric);
    if (!shape)
        return invalid(at,
                       "is no ellipsoid: its part of second degree must be positive definite, "
                       "and some point must lie within");
    for (int axis = 0; axis < 3; ++axis) {
        if (!(shape->radii[axis] >= limits::kMinEllipsoidRadius &&
              shape->radii[axis] <= limits::kMaxEllipsoidRadius))
            return invalid(at, "must have semi-axes from " + to_text(limits::kMinEllipsoidRadius) +
                                   " to " + to_text(limits::kMaxEllipsoidRadius) + ", not " +
                                   to_text(shape->radii[axis]));
        if (!(std::abs(shape->center[axis]) <= limits::kMaxEllipsoidCoordinate))
            return invalid(at, "must have its middle within " +
                                   to_text(limits::kMaxEllipsoidCoordinate) + " of the origin");
    }
    return std::nullopt;
}

Status check_limits(double least, double most, const std::string& at) {
    if (least <= most) return std::nullopt;
    return invalid(at + "/translucence_min", "must be at most translucence_max, " + to_text(most) +
                                                 ", not " + to_text(least));
}

// All lists together, named at the one that goes over.
Status check_counts(const EllipsoidsCloud& cloud, const std::string& at) {
    const std::string most = "a cloud may have at most " + std::to_string(limits::kMaxEllipsoids) +
                             " ellipsoids in all, this makes it more";
    if (cloud.ellipsoids.size() > limits::kMaxEllipsoids) return invalid(at + "/ellipsoids", most);
    std::uint64_t count = cloud.ellipsoids.size();
    if (cloud.quadrics.size() > limits::kMaxEllipsoids - count)
        return invalid(at + "/quadrics", most);
    count += cloud.quadrics.size();
    for (std::size_t i = 0; i < cloud.formations.size(); ++i) {
        if (cloud.formations[i].count > limits::kMaxEllipsoids - count)
            return invalid(at + "/formations/" + std::to_string(i) + "/count", most);
        count += cloud.formations[i].count;
    }
    if (most_particles(cloud) > limits::kMaxParticles)
        return invalid(at + "/plane/resolution", "the plane and the ellipsoids may have " +
                                                     std::to_string(limits::kMaxParticles) +
                                                     " cells together, not " +
                                                     std::to_string(most_particles(cloud)));
    return std::nullopt;
}

}  // namespace

Status check_rules(const AutomatonCloud& cloud, const std::string& at) {
    const double cells = cloud.cells.x * cloud.cells.y * cloud.cells.z;
    if (cells > limits::kMaxAutomatonCells)
        return invalid(at + "/cells", "must be at most " + to_text(limits::kMaxAutomatonCells) +
                                          " cells in all, not " + to_text(cells));
    if (Status wrong = check_random(cloud, at)) return wrong;
    const std::uint64_t ellipsoids = cloud.ellipsoids.size() + random_ellipsoids_of(cloud).count;
    if (cloud.chosen && *cloud.chosen >= ellipsoids)
        return invalid(at + "/chosen", "must be below " + std::to_string(ellipsoids) +
                                           ", how many ellipsoids there are, not " +
                                           std::to_string(*cloud.chosen));
    if (Status wrong = check_bands(cloud.wind.layer_bands, at + "/wind/layer_bands")) return wrong;
    if (Status wrong = check_bands(cloud.wind.ellipsoids, at + "/wind/ellipsoids")) return wrong;
    if (Status wrong = check_shapes(cloud, at)) return wrong;
    if (Status wrong = count_in_range(cloud.warm_up, 0, cloud.steps, at + "/warm_up")) return wrong;
    return check_work(cloud, at);
}

Status check_rules(const SpheresCloud& cloud, const std::string& at) {
    if (Status wrong = check_span(ratios_of(cloud), at + "/ratio_min")) return wrong;
    if (Status wrong = check_span(shifts_of(cloud), at + "/shift_min")) return wrong;
    if (Status wrong = check_leaves(cloud, at)) return wrong;
    return check_poses(cloud, at);
}

Status check_rules(const ImplicitCloud& cloud, const std::string& at) {
    if (cloud.primitives)
        if (Status wrong = check_primitives(*cloud.primitives, at + "/primitives")) return wrong;
    if (cloud.growth) {
        if (Status wrong = count_in_range(cloud.growth->most, cloud.growth->seeds,
                                          limits::kMaxGrowth, at + "/growth/most"))
            return wrong;
        if (Status wrong = check_times(cloud.growth->keys, at + "/growth/keys")) return wrong;
    }
    if (Status wrong = check_particles(cloud.particles, at + "/particles")) return wrong;
    if (Status wrong = check_times(cloud.keys, at + "/keys")) return wrong;
    if (cloud.formula)
        if (const auto formula = parse_formula(*cloud.formula, at + "/formula"); !formula)
            return formula.error();
    if (cloud.squash) {
        if (Status wrong = check_axis(cloud.squash->axis, at + "/squash")) return wrong;
        if (Status wrong = check_times(cloud.squash->keys, at + "/squash/keys")) return wrong;
    }
    if (Status wrong = check_warps(cloud, at)) return wrong;
    if (cloud.flow) return check_flow(*cloud.flow, at + "/flow");
    return std::nullopt;
}

Status check_rules(const EllipsoidsCloud& cloud, const std::string& at) {
    if (cloud.plane) {
        if (Status wrong =
                in_range(cloud.plane->thickness, 0, cloud.plane->extent, at + "/plane/thickness"))
            return wrong;
        if (Status wrong = check_limits(cloud.plane->least, cloud.plane->most, at + "/plane"))
            return wrong;
    }
    if (Status wrong = check_limits(cloud.translucence.least, cloud.translucence.most, at))
        return wrong;
    for (std::size_t i = 0; i < cloud.quadrics.size(); ++i)
        if (Status wrong = check_quadric(cloud.quadrics[i], at + "/quadrics/" + std::to_string(i)))
            return wrong;
    return check_counts(cloud, at);
}

}  // namespace awan
