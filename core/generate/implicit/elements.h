// The pieces of a cloud's macrostructure (Ebert 2002) at one time: what its primitives and its growth come to.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/generate/implicit/lanes.h"
#include "core/scene/implicit.h"

namespace awan::implicit {

// An axis-aligned box; empty where min > max.
struct Box {
    glm::dvec3 min{1e300}, max{-1e300};

    bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void add(const glm::dvec3& p) { add(p, glm::dvec3(0)); }
    void add(const glm::dvec3& p, const glm::dvec3& reach);
    void add(const Box& other);
};
bool touch(const Box& a, const Box& b);

// A coordinate system for floats: a place p is (p - middle) / unit in it.
struct Frame {
    glm::dvec3 middle{0};
    double unit = 1;
};

// What density falls off from: a ball (or the affine image of one, an ellipsoid), or a piece of a skeleton. The
// pieces of one skeleton stand one behind the other.
struct Element {
    enum class Kind : std::uint8_t { kBall, kSegment, kCylinder };
    Kind kind = Kind::kBall;
    // Whether it is the last piece of its skeleton.
    bool last = true;
    // The centre of a ball, one end of a piece. In the frame, like all lengths here.
    glm::vec3 at{0};
    // Of a ball: the inverse of its axes. Of a piece: row[0] is the unit vector towards its other end.
    glm::vec3 row[3]{};
    // The length of a piece.
    float length = 0;
    // Within this distance it is solid.
    float core = 0;
    // 1 / radius of influence.
    float inverse = 1;
    float weight = 1;
    // The element has no density outside of it; in the frame.
    Box box;
};

// Appends the elements of a primitive at a time, seconds. Those of one skeleton stand together, the last marked.
void add_elements(const ImplicitPrimitive& primitive, bool smooth, double time, const Frame& frame,
                  std::vector<Element>& elements);

// A sphere, as the particles of a growth are. center, radius: units.
Element sphere_element(const glm::dvec3& center, double radius, double weight, const Frame& frame);

// A box around the primitive at all times together, units.
Box box_at_all_times(const ImplicitPrimitive& primitive);

// The cubic of Wyvill, McPheeters & Wyvill 1986, of a^2 >= 0: h(a) = (1 - a^2)^2 (1 - 4/9 a^2). That is the printed
// -4/9 a^6 + 17/9 a^4 - 22/9 a^2 + 1, and exactly 0 from a = 1 on.
AWAN_INLINE lanes::Floats wyvill(const lanes::Floats& a2) {
    const lanes::Floats s = lanes::min(a2, lanes::all(1.0f)), t = 1.0f - s;
    return t * t * (1.0f - s * (4.0f / 9));
}

// The density of elements list[0 .. count) at p, in the frame: the sum of weight h(d / radius), at least 0. d is the
// distance from the element's solid part; of an ellipsoid, whose radii differ, it is measured where it is a sphere.
AWAN_INLINE lanes::Floats macro_density(const Element* elements, const std::uint32_t* list,
                                        int count, const lanes::Vec& p) {
    using lanes::Floats;
    Floats sum{}, nearest = lanes::all(1e30f);
    for (int i = 0; i < count; ++i) {
        const Element& e = elements[list[i]];
        const Floats x = p.x - e.at.x, y = p.y - e.at.y, z = p.z - e.at.z;
        const glm::vec3& r0 = e.row[0];
        if (e.kind == Element::Kind::kBall) {
            const glm::vec3 &r1 = e.row[1], &r2 = e.row[2];
            const Floats u = r0.x * x + r0.y * y + r0.z * z;
            const Floats v = r1.x * x + r1.y * y + r1.z * z;
            const Floats w = r2.x * x + r2.y * y + r2.z * z;
            sum += e.weight * wyvill(u * u + v * v + w * w);
            continue;
        }
        const Floats along = r0.x * x + r0.y * y + r0.z * z;
        Floats d2;
        if (e.kind == Element::Kind::kSegment) {
            const Floats t = lanes::clamp(along, 0.0f, e.length);
            const Floats dx = x - t * r0.x, dy = y - t * r0.y, dz = z - t * r0.z;
            d2 = dx * dx + dy * dy + dz * dz;
            if (e.core > 0) {
                const Floats d = lanes::max(lanes::sqrt(d2) - e.core, Floats{});
                d2 = d * d;
            }
        } else {
            const Floats dx = x - along * r0.x, dy = y - along * r0.y, dz = z - along * r0.z;
            const Floats side =
                lanes::max(lanes::sqrt(dx * dx + dy * dy + dz * dz) - e.core, Floats{});
            const Floats past = lanes::max(lanes::max(-along, along - e.length), Floats{});
            d2 = side * side + past * past;
        }
        // Of a skeleton only the closest piece counts.
        nearest = lanes::min(nearest, d2);
        if (!e.last) continue;
        sum += e.weight * wyvill(nearest * (e.inverse * e.inverse));
        nearest = lanes::all(1e30f);
    }
    return lanes::max(sum, Floats{});
}

}  // namespace awan::implicit
