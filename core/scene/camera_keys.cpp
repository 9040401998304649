#include "core/scene/camera_keys.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace awan {
namespace {

// A tangent of the curve at b, between the neighbours a and c, times the time of the segment that it is for. Knots of
// the centripetal spline are the roots of chords: with unit chords u, v and roots r, s of their lengths its derivative
// by the knot is r s (u + v) / (r + s). The knot goes by as fast as in the slower of the two segments, so that rest
// begins and ends softly.
// own, other: seconds of that segment and of the one on the other side of b, > 0.
glm::dvec3 tangent(const glm::dvec3& before, const glm::dvec3& after, double root_own,
                   double root_other, double own, double other) {
    const double before_length = glm::length(before), after_length = glm::length(after);
    if (!(before_length > 0) || !(after_length > 0)) return glm::dvec3(0);
    const glm::dvec3 derivative = root_own * root_other / (root_own + root_other) *
                                  (before / before_length + after / after_length);
    return derivative * std::min(root_own, root_other * (own / other));
}

// The curve through four points between the second and the third, u from 0 to 1 along it. seconds: of the three
// segments. Without a point before or after (null) the tangent there is the chord.
glm::dvec3 curve(const glm::dvec3* a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3* d,
                 const std::array<double, 3>& seconds, double u) {
    const glm::dvec3 chord = c - b;
    const double root = std::sqrt(glm::length(chord));
    // Nothing moves, whatever the neighbours do.
    if (!(root > 0)) return b;
    const glm::dvec3 begins =
        a == nullptr
            ? chord
            : tangent(b - *a, chord, root, std::sqrt(glm::length(b - *a)), seconds[1], seconds[0]);
    const glm::dvec3 ends =
        d == nullptr
            ? chord
            : tangent(chord, *d - c, root, std::sqrt(glm::length(*d - c)), seconds[1], seconds[2]);
    // Hermite's cubic, about its chord: exact at both ends, and a straight line where both tangents are the chord.
    const double v = 1 - u;
    return b + u * chord + u * v * (v * (begins - chord) - u * (ends - chord));
}

// The value of one member of the keys at share u of segment i.
template <typename Member>
glm::dvec3 between(const std::vector<CameraKey>& keys, std::size_t i, double u, bool linear,
                   Member member) {
    const glm::dvec3 b = member(keys[i]), c = member(keys[i + 1]);
    if (linear) return b + u * (c - b);
    const bool has_a = i > 0, has_d = i + 2 < keys.size();
    const glm::dvec3 a = has_a ? member(keys[i - 1]) : b, d = has_d ? member(keys[i + 2]) : c;
    const double own = keys[i + 1].time - keys[i].time;
    const std::array<double, 3> seconds = {has_a ? keys[i].time - keys[i - 1].time : own, own,
                                           has_d ? keys[i + 2].time - keys[i + 1].time : own};
    return curve(has_a ? &a : nullptr, b, c, has_d ? &d : nullptr, seconds, u);
}

glm::dvec3 within_world(const glm::dvec3& p) {
    return glm::clamp(p, glm::dvec3(-limits::kMaxCoordinate), glm::dvec3(limits::kMaxCoordinate));
}

double sine_between(const glm::dvec3& view, const glm::dvec3& up) {
    return glm::length(glm::cross(glm::normalize(view), glm::normalize(up)));
}

// A direction and a picture's up for it, whatever the keys say.
Camera steadied(Camera camera, const CameraKey& before, const CameraKey& after) {
    // The eye passes through its target: one of these three is another place.
    for (const glm::dvec3& instead : {before.target, after.target, before.eye})
        if (!(glm::length(camera.target - camera.eye) > 0)) camera.target = instead;
    const glm::dvec3 view = camera.target - camera.eye;
    // A little more than is asked of cameras, so that rounding does not matter.
    if (sine_between(view, camera.up) > 2 * limits::kMinUpSine) return camera;
    const glm::dvec3 size = glm::abs(view);
    camera.up = size.z <= size.x && size.z <= size.y ? glm::dvec3(0, 0, 1)
                : size.x <= size.y                   ? glm::dvec3(1, 0, 0)
                                                     : glm::dvec3(0, 1, 0);
    return camera;
}

}  // namespace

Camera camera_at(const std::vector<CameraKey>& keys, bool linear, const glm::dvec3& up,
                 double time) {
    const auto later =
        std::upper_bound(keys.begin(), keys.end(), time,
                         [](double moment, const CameraKey& key) { return moment < key.time; });
    const auto of_key = [&](const CameraKey& key) {
        return steadied({false, key.eye, key.target, up, key.fov}, key, key);
    };
    if (later == keys.begin()) return of_key(keys.front());
    if (later == keys.end()) return of_key(keys.back());
    const auto i = static_cast<std::size_t>(later - keys.begin()) - 1;
    const CameraKey &before = keys[i], &after = keys[i + 1];
    if (time == before.time) return of_key(before);
    const double u = (time - before.time) / (after.time - before.time);
    Camera camera;
    camera.automatic = false;
    camera.up = up;
    camera.eye =
        within_world(between(keys, i, u, linear, [](const CameraKey& key) { return key.eye; }));
    camera.target =
        within_world(between(keys, i, u, linear, [](const CameraKey& key) { return key.target; }));
    // A lens does not zoom beyond its keys.
    const double fov = between(keys, i, u, linear, [](const CameraKey& key) {
                           return glm::dvec3(key.fov, 0, 0);
                       }).x;
    camera.fov = std::clamp(fov, std::min(before.fov, after.fov), std::max(before.fov, after.fov));
    return steadied(camera, before, after);
}

}  // namespace awan
