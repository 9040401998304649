#include "core/generate/ellipsoids/texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/generate/ellipsoids/sine_sums.h"

namespace awan::ellipsoids {
namespace {

// A place in turns, -1/2 .. 1/2. Any finite product: beyond 2^52 there are no digits of a part of a turn left, and 0
// is as good as any.
double turns_of(double place, double turns_a_unit) {
    const double turns = place * turns_a_unit;
    const double part = turns - std::floor(turns);
    return part >= 0.5 ? part - 1 : part;
}

// With the phases of Sunar et al. 2005 (4.6), where the phase stands in the place of the frequency before the height.
TermSines printed_term(double& half_x, double& half_z, double height) {
    using std::numbers::pi;
    double phase_x = pi / 2 * sin_of_part(half_z), phase_z = pi / 2 * sin_of_part(half_x);
    phase_x += pi * sin_turns(turns_of(phase_x * height, 0.25 / pi));
    phase_z += pi * sin_turns(turns_of(phase_x * height, 0.25 / pi));
    half_x = part_of_turn(2 * half_x);
    half_z = part_of_turn(2 * half_z);
    return {sin_turns(half_x + phase_x / (2 * pi)), sin_turns(half_z + phase_z / (2 * pi))};
}

}  // namespace

double kept_of_sine(double variance) {
    double one = 1 / (1 + variance / 16);
    one *= one;
    one *= one;
    return one * one;
}

TextureFunction texture_function(const SineTexture& texture, bool in_space,
                                 const glm::dvec3& shift) {
    TextureFunction function;
    function.terms = static_cast<std::size_t>(texture.terms);
    function.in_space = in_space;
    function.printed = texture.form == TextureForm::kPrinted;
    function.turns_x = texture.frequency_x / (4 * std::numbers::pi);
    function.turns_z = texture.frequency_z / (4 * std::numbers::pi);
    function.shift = shift;
    if (!texture.sines.empty()) {
        take_by_hand(texture, function);
        return function;
    }
    double sum = 0, coefficient = 1;
    for (std::size_t i = 0; i < function.terms; ++i) {
        function.coefficient[i] = coefficient;
        sum += coefficient;
        coefficient *= kCoefficientRatio;
    }
    function.floor = texture.offset * sum;
    const double highest = function.floor + sum;
    function.scale = function.printed ? 1 / (highest * highest)
                                      : scale_to_one(function.terms, function.floor, in_space,
                                                     function.coefficient);
    return function;
}

TextureValue texture_at(const TextureFunction& texture, const glm::dvec3& place, double blur_x,
                        double blur_z) {
    if (!texture.by_hand.empty()) return hand_texture_at(texture, place, blur_x, blur_z);
    const glm::dvec3 at = place - texture.shift;
    double half_x = turns_of(at.x, texture.turns_x), half_z = turns_of(at.z, texture.turns_z);
    double half_y = texture.in_space ? turns_of(at.y, texture.turns_x) : 0;
    double a = texture.floor, b = texture.floor, lost_a = 0, lost_b = 0;
    // Where even the finest term keeps more than .9995 of itself, what is seen is a point.
    const auto finest = static_cast<double>(1u << (2 * (texture.terms - 1)));
    const bool blurred = std::max(blur_x, blur_z) * finest > 1e-3;
    for (std::size_t i = 0; i < texture.terms; ++i) {
        const double c = texture.coefficient[i];
        const TermSines sines = texture.printed
                                    ? printed_term(half_x, half_z, texture.in_space ? at.y : 0)
                                    : clean_term(half_x, half_z, half_y);
        if (!blurred) {
            a += c * sines.x;
            b += c * sines.z;
            continue;
        }
        const double kept_x = kept_of_sine(blur_x), kept_z = kept_of_sine(blur_z);
        a += c * kept_x * sines.x;
        b += c * kept_z * sines.z;
        lost_a += 0.5 * c * c * (1 - kept_x * kept_x);
        lost_b += 0.5 * c * c * (1 - kept_z * kept_z);
        blur_x *= 4;
        blur_z *= 4;
    }
    if (!texture.printed) {
        a = std::max(a, 0.0);
        b = std::max(b, 0.0);
    }
    return {texture.scale * a * b,
            texture.scale * texture.scale * (a * a * lost_b + b * b * lost_a + lost_a * lost_b)};
}

double blur_along(const TextureFunction& texture, bool along_z, const glm::dvec3& step) {
    using std::numbers::pi;
    // Frequencies of the first term: its own; that of the phase from across, half as high (F0); that of the phase
    // from above.
    const double fx = texture.turns_x * 4 * pi, fz = texture.turns_z * 4 * pi;
    const double own = along_z ? fz * step.z : fx * step.x;
    const double across = along_z ? fx * step.x : fz * step.z;
    const double upward = texture.in_space ? fx * step.y : 0;
    // By how much the argument changes along each axis. d/dX: F; d/dY: pi/2 * F/2 * cos; d/dZ: pi * F/2 * cos. The
    // mean of a squared cosine is 1/2.
    return own * own + pi * pi / 32 * across * across + pi * pi / 8 * upward * upward;
}

double blur_of_blob(const TextureFunction& texture, bool along_z, double sigma) {
    double blur = 0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0);
        step[axis] = sigma;
        blur += blur_along(texture, along_z, step);
    }
    return blur;
}

double opacity(const TextureValue& value, double threshold, double range) {
    const double half = std::sqrt(3 * value.variance);
    if (!(half > 1e-9)) return std::clamp((value.mean - threshold) / range, 0.0, 1.0);
    // The mean of max(0, T - x) over values T spread evenly over mean - half .. mean + half.
    const auto above = [&](double x) {
        const double reach = value.mean + half - x;
        if (reach <= 0) return 0.0;
        return reach >= 2 * half ? value.mean - x : reach * reach / (4 * half);
    };
    return std::clamp((above(threshold) - above(threshold + range)) / range, 0.0, 1.0);
}

}  // namespace awan::ellipsoids
