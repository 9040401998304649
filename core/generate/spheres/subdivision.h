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
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "core/generate/keyed_random.h"
#include "core/scene/spheres.h"

namespace awan::spheres {

inline constexpr int kSphereChildren = 5;

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

// A cloud's tree at one time. A sphere of level k < levels has five children of level k + 1.
class SphereTree {
  public:
    // key: the cloud's, keyed(seed, place); place: its number in the scene, for the other seeds of a morph. time:
    // seconds.
    SphereTree(const SpheresCloud& cloud, std::uint64_t key, std::uint64_t place, double time);

    int levels() const { return levels_; }
    const SphereNode& root() const { return root_; }
    // The children of a sphere of that level (0: the root).
    std::array<SphereNode, kSphereChildren> children(const SphereNode& parent, int level) const;

    Span ratios() const { return ratios_; }
    Span shifts() const { return shifts_; }
    // The scales of the axes at the step from `level` to `level` + 1.
    const glm::dvec3& axes(int level) const { return level == 0 ? first_axes_ : later_axes_; }
    glm::dvec3 across(int level) const { return across_ ? axes(level) : glm::dvec3(1); }
    double up() const { return up_; }
    // Whether spheres move between two realisations, and how far they are on their way, 0..1.
    bool morphs() const { return morphs_; }
    double weight() const { return weight_; }

  private:
    Sphere child(const Sphere& parent, int level, int j, std::uint64_t key) const;

    int levels_;
    Span ratios_, shifts_;
    glm::dvec3 first_axes_, later_axes_;
    bool across_;
    double up_;
    bool morphs_ = false;
    double weight_ = 0;
    SphereNode root_;
};

}  // namespace awan::spheres
