// The hierarchy of spheres of Ostroushko et al. 2010 ("Mathematical model of the cloud"). Every sphere follows from
// its place in the tree alone, by keyed randomness, so that nothing need be stored. Only +, -, *, / and square roots
// are used: the same bits on every machine.
//
// As printed, with D = r - r_j, the farthest at which child j lies inside its parent:
//   r_j = I_j r;   along its axis (+x, -x, +z, -z, -y for j = 1..5) child j goes s_j D d, across it xi_j f(s_j D, D),
//   f(C, R) = R^2 - C^2   (fifth child: f(s_5, D); to -x where xi_5 = -1, to +z where xi_5 = 1).
//
// There are two misprints. f is a length and must have a root, f(C, R) = sqrt(R^2 - C^2): without it a cloud of
// radius 100 throws its children up to 0.19 * 100^2 / 100 = 19 parents' radii away (s = .9), and one of radius .01
// does not move them. And the fifth's f must be f(s_5 D, D), as that of all others: s_5 is a number, D a length. So
// corrected, a child is at most D from its parent's centre and touches the parent from within where the axes are not
// scaled; every sphere holds all that is below it.
//
// That is SpheresPlaces::kCross with five parts, where axes do not turn: child_offset(). Any other places and numbers
// of parts keep to the same rule along an axis of each part's own and across it: part_offset().
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/exact_math.h"
#include "core/generate/keyed_random.h"
#include "core/scene/spheres.h"

namespace awan::spheres {

// As printed, and at most.
inline constexpr int kSphereChildren = 5;
inline constexpr int kMostSphereChildren = static_cast<int>(limits::kMaxSphereParts);

// A sphere of the hierarchy.
struct Sphere {
    // In the cloud's own coordinates.
    glm::dvec3 center{0};
    double radius = 0;
};

// f(C, R) with its root. |C| <= R.
inline double other_coordinate(double c, double r) {
    return std::sqrt(std::max(r * r - c * c, 0.0));
}
// f(C, R) as printed; its dimension is length^2.
inline double other_coordinate_printed(double c, double r) {
    return r * r - c * c;
}

// What is random in a child.
struct SphereDraw {
    // I_j: its radius over its parent's.
    double ratio;
    // s_j: how far along its axis it goes, over the farthest at which it lies in its parent.
    double shift;
    // xi_j, -1 or 1: to which side it goes across.
    double side;
};

// The centre of child 0..4 (1..5 in the paper) of the unit sphere at the origin, less the parent's centre. axes: d_x,
// d_y, d_z; across: what the offset across is multiplied with, along x and z (1 as printed); up: where the fifth
// child goes, 1 up or -1 down.
glm::dvec3 child_offset(int child, const SphereDraw& draw, const glm::dvec3& axes,
                        const glm::dvec3& across, double up);

// Where a part of a sphere goes, for the other places: unit vectors.
struct SpherePart {
    // Its axis.
    glm::dvec3 along{1, 0, 0};
    // Where it goes across, for xi = -1 and 1. Upright to `along`.
    glm::dvec3 across[2] = {{0, 0, -1}, {0, 0, 1}};
    // It goes `share` of the way along its axis, then as far across as its parent allows: 1 but for a row.
    double share = 1;
};

// Part j of n.
//   kCross, kTurned   the last goes up, the others level: at azimuths 0, 1/(n-1), 2/(n-1) .. of a turn. With n = 5 the
//                     places are those printed, in another order
//   kDome             at heights t^2, t = j / (n-1), a golden angle apart: most of them near the base, one on top
//   kBall             at heights from -1 to 1, a golden angle apart
//   kRow              from one end of x to the other, each beside the axis by a golden angle more
SpherePart sphere_part(SpheresPlaces places, int j, int n, double up);

// The centre of such a part of the unit sphere at the origin. It lies in its parent, and touches it from within. turn:
// of all parts of a sphere, about y (kRow: about x).
glm::dvec3 part_offset(const SpherePart& part, const SphereDraw& draw, SpheresPlaces places,
                       const exact::SinCos& turn);

// The share of the way from the lower to the upper end of a range, 0..1, for u uniform in 0..1.
double at_share(SpheresLaw law, double u);

// The mean of x^power, x between the ends of the span and distributed by that law. Exact but for rounding, power <= 3.
double mean_of_power(const Span& span, SpheresLaw law, int power);

// A point of a quadrature rule over a law: where in the range, 0..1, and how much it counts; weights sum up to 1. Exact
// for polynomials of degree 8 and less.
struct LawPoint {
    double at, weight;
};
std::vector<LawPoint> points_of(SpheresLaw law);

// One sphere of the tree, and what its children come from.
struct SphereNode {
    // At the tree's time.
    Sphere sphere;
    // In a morph: in the two realisations between which it moves.
    Sphere from, to;
    // The key of its place in the realisation `from`...
    std::uint64_t key = 0;
    // ... and in the realisation `to`.
    std::uint64_t other = 0;
};

// The parts of one sphere.
class SphereChildren {
  public:
    explicit SphereChildren(int count) : count_(static_cast<std::size_t>(count)) {}
    std::size_t size() const { return count_; }
    SphereNode& operator[](std::size_t j) { return nodes_[j]; }
    const SphereNode& operator[](std::size_t j) const { return nodes_[j]; }
    const SphereNode* begin() const { return nodes_.data(); }
    const SphereNode* end() const { return nodes_.data() + count_; }

  private:
    std::size_t count_;
    std::array<SphereNode, kMostSphereChildren> nodes_;
};

// A cloud's tree at one time. A sphere of level k < levels has parts() children of level k + 1.
class SphereTree {
  public:
    // key: the cloud's, keyed(seed, place); place: its number in the scene, for the other seeds of a morph. time:
    // seconds.
    SphereTree(const SpheresCloud& cloud, std::uint64_t key, std::uint64_t place, double time);

    int levels() const { return levels_; }
    int parts() const { return parts_; }
    const SphereNode& root() const { return root_; }
    // The children of a sphere of that level (0: the root).
    SphereChildren children(const SphereNode& parent, int level) const;
    // The centre of a child less its parent's, in the parent's radii. turn: of the parent's parts (turns()).
    glm::dvec3 offset(int level, int child, const SphereDraw& draw,
                      const exact::SinCos& turn) const;

    Span ratios() const { return ratios_; }
    Span shifts() const { return shifts_; }
    SpheresLaw ratio_law() const { return ratio_law_; }
    SpheresLaw shift_law() const { return shift_law_; }
    // parts() times the mean of the squared ratios: how many of a sphere's children a ray through it meets.
    double met() const;
    // The scales of the axes at the step from `level` to `level` + 1.
    const glm::dvec3& axes(int level) const { return level == 0 ? first_axes_ : later_axes_; }
    glm::dvec3 across(int level) const { return across_ ? axes(level) : glm::dvec3(1); }
    double up() const { return up_; }
    // Whether spheres move between two realisations, and how far they are on their way, 0..1.
    bool morphs() const { return morphs_; }
    double weight() const { return weight_; }
    // Whether the parts of a sphere stand turned by chance or by time.
    bool turns() const { return turns_; }
    // By which the whole cloud is turned (SpheresPose).
    const glm::dmat3& rotation() const { return rotation_; }

  private:
    Sphere child(const Sphere& parent, int level, int j, std::uint64_t key,
                 const exact::SinCos& turn) const;
    exact::SinCos turn_of(std::uint64_t key) const;

    int levels_, parts_;
    Span ratios_, shifts_;
    SpheresLaw ratio_law_, shift_law_;
    SpheresPlaces places_;
    glm::dvec3 first_axes_{1}, later_axes_{1};
    bool across_;
    double up_;
    // As printed: child_offset().
    bool printed_;
    bool turns_;
    // Degrees, that a sphere's parts have turned by now at most.
    double turned_;
    std::array<SpherePart, kMostSphereChildren> places_of_parts_;
    // Of the pose.
    bool rotated_ = false;
    glm::dmat3 rotation_{1};
    bool morphs_ = false;
    double weight_ = 0;
    SphereNode root_;
};

// Where a cloud is at a time: between two poses linear.
SpheresPose pose_at(const std::vector<SpheresPose>& poses, double time);

// By the length of `turn`, degrees, about it.
glm::dmat3 rotation_of(const glm::dvec3& turn);

}  // namespace awan::spheres
