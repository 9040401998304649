#include "core/generate/spheres/subdivision.h"

#include <algorithm>

namespace awan::spheres {

glm::dvec3 child_offset(int child, const SphereDraw& draw, const glm::dvec3& axes,
                        const glm::dvec3& across, double up) {
    const double reach = 1 - draw.ratio, along = draw.shift * reach;
    const double aside = draw.side * other_coordinate(along, reach);
    switch (child) {
        case 0:
            return {along * axes.x, 0, aside * across.z};
        case 1:
            return {-along * axes.x, 0, aside * across.z};
        case 2:
            return {aside * across.x, 0, along * axes.z};
        case 3:
            return {aside * across.x, 0, -along * axes.z};
        default:
            return draw.side < 0 ? glm::dvec3(aside * across.x, up * along * axes.y, 0)
                                 : glm::dvec3(0, up * along * axes.y, aside * across.z);
    }
}

namespace {

SphereDraw draw_of(std::uint64_t key, const Span& ratios, const Span& shifts) {
    const double first = unit_open(static_cast<std::uint32_t>(key >> 32));
    // 31 bits; the bit above them is the side's.
    const double second = (static_cast<double>(key & 0x7fffffffu) + 0.5) * 0x1p-31;
    return {ratios.low + (ratios.high - ratios.low) * first,
            shifts.low + (shifts.high - shifts.low) * second, (key >> 31 & 1u) != 0 ? 1.0 : -1.0};
}

Sphere between(const Sphere& a, const Sphere& b, double weight) {
    return {(1 - weight) * a.center + weight * b.center,
            (1 - weight) * a.radius + weight * b.radius};
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

SphereTree::SphereTree(const SpheresCloud& cloud, std::uint64_t key, std::uint64_t place,
                       double time)
    : levels_(static_cast<int>(cloud.levels)),
      ratios_(ratios_of(cloud)),
      shifts_(shifts_of(cloud)),
      first_axes_(cloud.size / largest(cloud.size)),
      later_axes_(cloud.scaling == SpheresScaling::kEvery ? first_axes_ : glm::dvec3(1)),
      across_(cloud.scaling == SpheresScaling::kEvery),
      up_(cloud.growth == SpheresGrowth::kUp ? 1 : -1) {
    const double side =
        levels_ == 0 ? std::min({cloud.size.x, cloud.size.y, cloud.size.z}) : largest(cloud.size);
    root_.sphere = root_.from = root_.to = {glm::dvec3(0), side / 2};
    root_.key = root_.other = key;
    if (!cloud.morph || !(time > 0)) return;
    const SpheresMorph& morph = *cloud.morph;
    const double steps = std::min(time / morph.duration, static_cast<double>(morph.steps));
    // The morph that is going on. After the last one, its end.
    const double begun = std::min(std::floor(steps), static_cast<double>(morph.steps) - 1);
    weight_ = steps - begun;
    const auto step = static_cast<std::uint64_t>(begun);
    if (step > 0) root_.key = keyed(morph.seed + step - 1, place);
    root_.other = keyed(morph.seed + step, place);
    morphs_ = weight_ > 0;
    // At the end of a morph only the realisation `to` is needed.
    if (weight_ == 1) {
        root_.key = root_.other;
        morphs_ = false;
    }
}

Sphere SphereTree::child(const Sphere& parent, int level, int j, std::uint64_t key) const {
    const SphereDraw draw = draw_of(key, ratios_, shifts_);
    return {parent.center + parent.radius * child_offset(j, draw, axes(level), across(level), up_),
            parent.radius * draw.ratio};
}

std::array<SphereNode, kSphereChildren> SphereTree::children(const SphereNode& parent,
                                                             int level) const {
    std::array<SphereNode, kSphereChildren> nodes;
    for (int j = 0; j < kSphereChildren; ++j) {
        SphereNode& node = nodes[static_cast<std::size_t>(j)];
        node.key = keyed(parent.key, static_cast<std::uint64_t>(j));
        if (!morphs_) {
            node.sphere = child(parent.sphere, level, j, node.key);
            continue;
        }
        node.other = keyed(parent.other, static_cast<std::uint64_t>(j));
        node.from = child(parent.from, level, j, node.key);
        node.to = child(parent.to, level, j, node.other);
        node.sphere = between(node.from, node.to, weight_);
    }
    return nodes;
}

}  // namespace awan::spheres
