#include "core/generate/spheres/subdivision.h"

#include <algorithm>
#include <cmath>

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

// Between one part and the next of a spiral over a ball: as far as can be from all before.
constexpr double kGoldenAngle = 137.50776405003785;

glm::dvec3 level_at(const exact::SinCos& azimuth) {
    return {azimuth.cos, 0, azimuth.sin};
}

SpherePart part_of_spiral(int j, double height) {
    const exact::SinCos azimuth = exact::sincos_degrees(kGoldenAngle * j);
    const double level = std::sqrt(std::max(1 - height * height, 0.0));
    SpherePart part;
    part.along = level * level_at(azimuth) + glm::dvec3(0, height, 0);
    part.across[1] = {-azimuth.sin, 0, azimuth.cos};
    part.across[0] = -part.across[1];
    return part;
}

SpherePart part_of_cross(int j, int n, double up) {
    SpherePart part;
    if (j == n - 1) {
        part.along = {0, up, 0};
        part.across[0] = {-1, 0, 0};
        part.across[1] = {0, 0, 1};
        return part;
    }
    const exact::SinCos azimuth = exact::sincos_degrees(360.0 * j / (n - 1));
    part.along = level_at(azimuth);
    part.across[1] = {-azimuth.sin, 0, azimuth.cos};
    part.across[0] = -part.across[1];
    return part;
}

SpherePart part_of_row(int j, int n) {
    const double place = 2.0 * j / (n - 1) - 1;
    const exact::SinCos about = exact::sincos_degrees(kGoldenAngle * j);
    SpherePart part;
    part.along = {place < 0 ? -1 : 1, 0, 0};
    part.across[1] = {0, about.cos, about.sin};
    part.across[0] = -part.across[1];
    part.share = std::abs(place);
    return part;
}

}  // namespace

SpherePart sphere_part(SpheresPlaces places, int j, int n, double up) {
    const double t = static_cast<double>(j) / (n - 1);
    switch (places) {
        case SpheresPlaces::kCross:
        case SpheresPlaces::kTurned:
            return part_of_cross(j, n, up);
        case SpheresPlaces::kDome:
            return part_of_spiral(j, up * t * t);
        case SpheresPlaces::kBall:
            return part_of_spiral(j, 2 * (j + 0.5) / n - 1);
        case SpheresPlaces::kRow:
            return part_of_row(j, n);
    }
    return {};
}

glm::dvec3 part_offset(const SpherePart& part, const SphereDraw& draw, SpheresPlaces places,
                       const exact::SinCos& turn) {
    const double reach = 1 - draw.ratio, along = draw.shift * reach * part.share;
    const glm::dvec3 v =
        along * part.along + other_coordinate(along, reach) * part.across[draw.side < 0 ? 0 : 1];
    if (places == SpheresPlaces::kRow)
        return {v.x, v.y * turn.cos - v.z * turn.sin, v.y * turn.sin + v.z * turn.cos};
    return {v.x * turn.cos + v.z * turn.sin, v.y, v.z * turn.cos - v.x * turn.sin};
}

namespace {

SphereDraw draw_of(std::uint64_t key, const Span& ratios, SpheresLaw ratio_law, const Span& shifts,
                   SpheresLaw shift_law) {
    const double first = unit_open(static_cast<std::uint32_t>(key >> 32));
    // 31 bits; the bit above them is the side's.
    const double second = (static_cast<double>(key & 0x7fffffffu) + 0.5) * 0x1p-31;
    return {ratios.low + (ratios.high - ratios.low) * at_share(ratio_law, first),
            shifts.low + (shifts.high - shifts.low) * at_share(shift_law, second),
            (key >> 31 & 1u) != 0 ? 1.0 : -1.0};
}

Sphere between(const Sphere& a, const Sphere& b, double weight) {
    return {(1 - weight) * a.center + weight * b.center,
            (1 - weight) * a.radius + weight * b.radius};
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

SpheresPose pose_at(const std::vector<SpheresPose>& poses, double time) {
    if (poses.empty()) return {};
    if (!(time > poses.front().time)) return poses.front();
    const auto next = std::find_if(poses.begin(), poses.end(),
                                   [&](const SpheresPose& one) { return one.time > time; });
    if (next == poses.end()) return poses.back();
    const SpheresPose &a = *(next - 1), &b = *next;
    const double w = (time - a.time) / (b.time - a.time);
    return {time, (1 - w) * a.shift + w * b.shift, (1 - w) * a.turn + w * b.turn,
            (1 - w) * a.scale + w * b.scale};
}

glm::dmat3 rotation_of(const glm::dvec3& turn) {
    const double angle = exact::hypot(turn.x, turn.y, turn.z);
    if (!(angle > 0)) return glm::dmat3(1);
    const glm::dvec3 n = turn / angle;
    const exact::SinCos by = exact::sincos_degrees(angle);
    const glm::dvec3 rest = (1 - by.cos) * n;
    // Rodrigues' formula, by columns.
    return {{by.cos + rest.x * n.x, rest.x * n.y + by.sin * n.z, rest.x * n.z - by.sin * n.y},
            {rest.y * n.x - by.sin * n.z, by.cos + rest.y * n.y, rest.y * n.z + by.sin * n.x},
            {rest.z * n.x + by.sin * n.y, rest.z * n.y - by.sin * n.x, by.cos + rest.z * n.z}};
}

SphereTree::SphereTree(const SpheresCloud& cloud, std::uint64_t key, std::uint64_t place,
                       double time)
    : levels_(static_cast<int>(cloud.levels)),
      parts_(static_cast<int>(cloud.parts)),
      ratios_(ratios_of(cloud)),
      shifts_(shifts_of(cloud)),
      ratio_law_(cloud.ratio_law),
      shift_law_(cloud.shift_law),
      places_(cloud.places),
      across_(cloud.scaling == SpheresScaling::kEvery),
      up_(cloud.growth == SpheresGrowth::kUp ? 1 : -1),
      turned_(cloud.turning * time) {
    printed_ = places_ == SpheresPlaces::kCross && parts_ == kSphereChildren && cloud.turning == 0;
    turns_ = places_ != SpheresPlaces::kCross || cloud.turning != 0;
    for (int j = 0; j < parts_; ++j)
        places_of_parts_[static_cast<std::size_t>(j)] = sphere_part(places_, j, parts_, up_);
    const SpheresPose pose = pose_at(cloud.poses, time);
    const glm::dvec3 size = cloud.size * pose.scale;
    first_axes_ = size / largest(size);
    if (cloud.scaling == SpheresScaling::kEvery) later_axes_ = first_axes_;
    rotated_ = pose.turn != glm::dvec3(0);
    if (rotated_) rotation_ = rotation_of(pose.turn);
    const double side = levels_ == 0 ? std::min({size.x, size.y, size.z}) : largest(size);
    root_.sphere = root_.from = root_.to = {pose.shift, side / 2};
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

double SphereTree::met() const {
    return parts_ * mean_of_power(ratios_, ratio_law_, 2);
}

glm::dvec3 SphereTree::offset(int level, int j, const SphereDraw& draw,
                              const exact::SinCos& turn) const {
    glm::dvec3 v;
    if (printed_)
        v = child_offset(j, draw, axes(level), across(level), up_);
    else
        v = axes(level) *
            part_offset(places_of_parts_[static_cast<std::size_t>(j)], draw, places_, turn);
    return rotated_ ? rotation_ * v : v;
}

// A key's own number, which is no child's.
exact::SinCos SphereTree::turn_of(std::uint64_t key) const {
    if (!turns_) return {0, 1};
    const std::uint64_t bits = keyed(key, kMostSphereChildren);
    const double speed = 2 * unit_open(static_cast<std::uint32_t>(bits)) - 1;
    const double start = places_ == SpheresPlaces::kCross
                             ? 0
                             : 360 * unit_open(static_cast<std::uint32_t>(bits >> 32));
    return exact::sincos_degrees(start + speed * turned_);
}

Sphere SphereTree::child(const Sphere& parent, int level, int j, std::uint64_t key,
                         const exact::SinCos& turn) const {
    const SphereDraw draw = draw_of(key, ratios_, ratio_law_, shifts_, shift_law_);
    return {parent.center + parent.radius * offset(level, j, draw, turn),
            parent.radius * draw.ratio};
}

SphereChildren SphereTree::children(const SphereNode& parent, int level) const {
    SphereChildren nodes(parts_);
    const exact::SinCos turn = turn_of(parent.key);
    const exact::SinCos other = morphs_ ? turn_of(parent.other) : turn;
    for (int j = 0; j < parts_; ++j) {
        SphereNode& node = nodes[static_cast<std::size_t>(j)];
        node.key = keyed(parent.key, static_cast<std::uint64_t>(j));
        if (!morphs_) {
            node.sphere = child(parent.sphere, level, j, node.key, turn);
            continue;
        }
        node.other = keyed(parent.other, static_cast<std::uint64_t>(j));
        node.from = child(parent.from, level, j, node.key, turn);
        node.to = child(parent.to, level, j, node.other, other);
        node.sphere = between(node.from, node.to, weight_);
    }
    return nodes;
}

}  // namespace awan::spheres
