#include "core/generate/implicit/elements.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/exact_math.h"
#include "core/generate/implicit/keys.h"

namespace awan::implicit {
namespace {

glm::dmat3 turn(const glm::dvec3& degrees) {
    const exact::SinCos x = exact::sincos_degrees(degrees.x), y = exact::sincos_degrees(degrees.y),
                        z = exact::sincos_degrees(degrees.z);
    // Rotations about the axes, by columns.
    const glm::dmat3 about_x({1, 0, 0}, {0, x.cos, x.sin}, {0, -x.sin, x.cos});
    const glm::dmat3 about_y({y.cos, 0, -y.sin}, {0, 1, 0}, {y.sin, 0, y.cos});
    const glm::dmat3 about_z({z.cos, z.sin, 0}, {-z.sin, z.cos, 0}, {0, 0, 1});
    return about_z * about_y * about_x;
}

Element ball(const glm::dvec3& center, const glm::dvec3& axes, const glm::dmat3& turned,
             double weight, const Frame& frame) {
    Element e;
    e.at = glm::vec3((center - frame.middle) / frame.unit);
    e.weight = static_cast<float>(weight);
    glm::dvec3 reach(0);
    for (int i = 0; i < 3; ++i) {
        e.row[i] = glm::vec3(turned[i] / (axes[i] / frame.unit));
        reach += turned[i] * turned[i] * axes[i] * axes[i];
    }
    e.box.add((center - frame.middle) / frame.unit, glm::sqrt(reach) / frame.unit);
    return e;
}

Element piece(Element::Kind kind, const glm::dvec3& from, const glm::dvec3& to, double core,
              double radius, double weight, const Frame& frame) {
    Element e;
    e.kind = kind;
    const glm::dvec3 a = (from - frame.middle) / frame.unit, b = (to - frame.middle) / frame.unit;
    const double length = glm::length(b - a);
    e.at = glm::vec3(a);
    e.length = static_cast<float>(length);
    if (length > 0) e.row[0] = glm::vec3((b - a) / length);
    e.core = static_cast<float>(core / frame.unit);
    e.inverse = static_cast<float>(frame.unit / radius);
    e.weight = static_cast<float>(weight);
    // No point of a cylinder's rim is farther than this from the end of its axis.
    const glm::dvec3 reach((core + radius) / frame.unit);
    e.box.add(a, reach);
    e.box.add(b, reach);
    return e;
}

}  // namespace

void Box::add(const glm::dvec3& p, const glm::dvec3& reach) {
    min = glm::min(min, p - reach);
    max = glm::max(max, p + reach);
}

void Box::add(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
}

bool touch(const Box& a, const Box& b) {
    for (int i = 0; i < 3; ++i)
        if (!(a.min[i] <= b.max[i] && b.min[i] <= a.max[i])) return false;
    return true;
}

Element sphere_element(const glm::dvec3& center, double radius, double weight, const Frame& frame) {
    return ball(center, glm::dvec3(radius), glm::dmat3(1), weight, frame);
}

void add_elements(const ImplicitPrimitive& primitive, bool smooth, double time, const Frame& frame,
                  std::vector<Element>& elements) {
    const auto value = [&](const auto& standard, auto ImplicitKey::*member) {
        return at_time(
            primitive.keys, standard, smooth,
            time, [=](const ImplicitKey& key) -> const auto& { return key.*member; });
    };
    const glm::dvec3 center = value(primitive.center, &ImplicitKey::center);
    const double radius = value(primitive.radius, &ImplicitKey::radius);
    const double weight = value(primitive.weight, &ImplicitKey::weight);
    const glm::dmat3 turned = turn(value(primitive.rotate, &ImplicitKey::rotate));
    const double core = value(primitive.core, &ImplicitKey::core);
    switch (primitive.shape) {
        case ImplicitShape::kSphere:
            if (core > 0)
                elements.push_back(
                    piece(Element::Kind::kSegment, center, center, core, radius, weight, frame));
            else
                elements.push_back(sphere_element(center, radius, weight, frame));
            break;
        case ImplicitShape::kEllipsoid:
            elements.push_back(ball(center, radius * value(primitive.radii, &ImplicitKey::radii),
                                    turned, weight, frame));
            break;
        case ImplicitShape::kCylinder:
        case ImplicitShape::kSegment: {
            const auto kind = primitive.shape == ImplicitShape::kCylinder ? Element::Kind::kCylinder
                                                                          : Element::Kind::kSegment;
            const std::vector<glm::dvec3> points = value(primitive.points, &ImplicitKey::points);
            for (std::size_t i = 1; i < points.size(); ++i) {
                elements.push_back(piece(kind, center + turned * points[i - 1],
                                         center + turned * points[i], core, radius, weight, frame));
                elements.back().last = i + 1 == points.size();
            }
            break;
        }
    }
}

namespace {

bool is_reshaped(const ImplicitKey& key) {
    return key.radii || key.core || key.points || key.rotate;
}

// The widest that a primitive is at any time: of its keys that give it, else its own.
struct Widest {
    double radius = 0, core = 0;
    glm::dvec3 radii{0};
    bool turns = false;
    std::vector<const std::vector<glm::dvec3>*> points;
};
Widest widest(const ImplicitPrimitive& primitive) {
    Widest most;
    bool radius = false, core = false, radii = false;
    for (const ImplicitKey& key : primitive.keys) {
        if (key.radius) most.radius = std::max(most.radius, *key.radius), radius = true;
        if (key.core) most.core = std::max(most.core, *key.core), core = true;
        if (key.radii) most.radii = glm::max(most.radii, *key.radii), radii = true;
        if (key.points) most.points.push_back(&*key.points);
        most.turns = most.turns || key.rotate.has_value();
    }
    if (!radius) most.radius = primitive.radius;
    if (!core) most.core = primitive.core;
    if (!radii) most.radii = primitive.radii;
    if (most.points.empty()) most.points.push_back(&primitive.points);
    return most;
}

// Around one that changes its form. All that is interpolated stays between its keys, but for a turn: then all ways
// count.
Box box_of_reshaped(const ImplicitPrimitive& primitive) {
    const Widest most = widest(primitive);
    const glm::dmat3 turned = turn(primitive.rotate);
    Box offsets;
    double farthest = 0;
    if (primitive.points.empty()) offsets.add(glm::dvec3(0));
    for (const auto* points : most.points)
        for (const glm::dvec3& p : *points) {
            offsets.add(turned * p);
            farthest = std::max(farthest, glm::length(p));
        }
    glm::dvec3 reach(most.radius + most.core);
    if (primitive.shape == ImplicitShape::kEllipsoid) {
        const glm::dvec3 axes = most.radius * most.radii;
        reach = glm::dvec3(0);
        for (int i = 0; i < 3; ++i) reach += turned[i] * turned[i] * axes[i] * axes[i];
        reach = glm::sqrt(reach);
        if (most.turns) reach = glm::dvec3(std::max({axes.x, axes.y, axes.z}));
    } else if (most.turns) {
        reach += farthest;
        offsets = {};
        offsets.add(glm::dvec3(0));
    }
    Box centers;
    for (const ImplicitKey& key : primitive.keys)
        if (key.center) centers.add(*key.center);
    if (centers.empty()) centers.add(primitive.center);
    Box box;
    box.add(centers.min + offsets.min, reach);
    box.add(centers.max + offsets.max, reach);
    return box;
}

}  // namespace

Box box_at_all_times(const ImplicitPrimitive& primitive) {
    if (std::any_of(primitive.keys.begin(), primitive.keys.end(), is_reshaped))
        return box_of_reshaped(primitive);
    // Interpolation stays between its keys, so the box of every centre with every radius covers all times.
    ImplicitPrimitive one = primitive;
    one.keys.clear();
    double largest = 0;
    bool keyed_radius = false, keyed_center = false;
    for (const ImplicitKey& key : primitive.keys) {
        if (key.radius) largest = std::max(largest, *key.radius), keyed_radius = true;
        keyed_center = keyed_center || key.center.has_value();
    }
    if (keyed_radius) one.radius = largest;
    Box box;
    const auto add = [&](const glm::dvec3& center) {
        one.center = center;
        std::vector<Element> elements;
        add_elements(one, false, 0, {}, elements);
        for (const Element& e : elements) box.add(e.box);
    };
    if (!keyed_center) add(primitive.center);
    for (const ImplicitKey& key : primitive.keys)
        if (key.center) add(*key.center);
    return box;
}

}  // namespace awan::implicit
