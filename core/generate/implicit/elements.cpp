#include "core/generate/implicit/elements.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/exact_math.h"

namespace awan::implicit {
namespace {

// A value at a time. of(key) gives the value of a key frame, or none where the key does not say; `standard` holds
// where no key says.
template <typename T, typename Of>
T at_time(const ImplicitPrimitive& primitive, const T& standard, bool smooth, double time, Of of) {
    const ImplicitKey *before = nullptr, *after = nullptr;
    for (const ImplicitKey& key : primitive.keys) {
        if (!of(key)) continue;
        if (key.time <= time) before = &key;
        if (key.time > time && after == nullptr) after = &key;
    }
    if (before == nullptr) return after == nullptr ? standard : *of(*after);
    if (after == nullptr) return *of(*before);
    double t = (time - before->time) / (after->time - before->time);
    if (smooth) t = smoothstep(t);
    return *of(*before) * (1 - t) + *of(*after) * t;
}

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
            primitive, standard, smooth,
            time, [=](const ImplicitKey& key) -> const auto& { return key.*member; });
    };
    const glm::dvec3 center = value(primitive.center, &ImplicitKey::center);
    const double radius = value(primitive.radius, &ImplicitKey::radius);
    const double weight = value(primitive.weight, &ImplicitKey::weight);
    const glm::dmat3 turned = turn(primitive.rotate);
    const double core = primitive.core;
    switch (primitive.shape) {
        case ImplicitShape::kSphere:
            if (core > 0)
                elements.push_back(
                    piece(Element::Kind::kSegment, center, center, core, radius, weight, frame));
            else
                elements.push_back(sphere_element(center, radius, weight, frame));
            break;
        case ImplicitShape::kEllipsoid:
            elements.push_back(ball(center, radius * primitive.radii, turned, weight, frame));
            break;
        case ImplicitShape::kCylinder:
        case ImplicitShape::kSegment: {
            const auto kind = primitive.shape == ImplicitShape::kCylinder ? Element::Kind::kCylinder
                                                                          : Element::Kind::kSegment;
            for (std::size_t i = 1; i < primitive.points.size(); ++i) {
                elements.push_back(piece(kind, center + turned * primitive.points[i - 1],
                                         center + turned * primitive.points[i], core, radius,
                                         weight, frame));
                elements.back().last = i + 1 == primitive.points.size();
            }
            break;
        }
    }
}

Box box_at_all_times(const ImplicitPrimitive& primitive) {
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
