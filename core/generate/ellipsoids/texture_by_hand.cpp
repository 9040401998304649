// Textures whose sines are given by hand: any frequencies, amplitudes and phases.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/generate/ellipsoids/sine_sums.h"
#include "core/generate/ellipsoids/texture.h"

namespace awan::ellipsoids {
namespace {

using std::numbers::pi;

// sin(2 pi turns) of any finite number of turns; beyond 2^50 there are no digits of a part left.
double sin_of_turns(double turns) {
    return sin_turns(turns - std::floor(turns));
}

TermSines sines_of(const TextureFunction& texture, const HandSine& row, const glm::dvec3& at) {
    // Phases in turns: pi/2 is a quarter, pi a half.
    double phase_x = 0.25 * sin_of_turns(row.z_before * at.z);
    double phase_z = 0.25 * sin_of_turns(row.x_before * at.x);
    if (texture.in_space && texture.printed) {
        // As Sunar et al. 2005 (4.6): the phase in the place of the frequency, P Z/2 in radians.
        phase_x += 0.5 * sin_of_turns(phase_x * at.y / 2);
        phase_z += 0.5 * sin_of_turns(phase_x * at.y / 2);
    } else if (texture.in_space) {
        const double height = 0.5 * sin_of_turns(row.x * at.y / 2);
        phase_x += height;
        phase_z += height;
    }
    return {sin_of_turns(row.x * at.x + phase_x + row.phase_x),
            sin_of_turns(row.z * at.z + phase_z + row.phase_z)};
}

double product(const TextureFunction& texture, const glm::dvec3& at) {
    double a = texture.floor, b = texture.floor;
    for (std::size_t i = 0; i < texture.by_hand.size(); ++i) {
        const TermSines sines = sines_of(texture, texture.by_hand[i], at);
        a += texture.coefficient[i] * sines.x;
        b += texture.coefficient[i] * sines.z;
    }
    return std::max(a, 0.0) * std::max(b, 0.0);
}

struct Found {
    glm::dvec3 at;
    double value;
};

// Goes uphill in steps that halve when none helps.
double climbed(const TextureFunction& texture, Found from, glm::dvec3 step) {
    const int axes = texture.in_space ? 3 : 2;
    constexpr int kHalvings = 18, kSteps = 40;
    for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5)
        for (int n = 0; n < kSteps; ++n) {
            bool found = false;
            for (int k = 0; k < axes; ++k) {
                const int axis = k == 2 ? 1 : 2 * k;
                for (const double side : {-1.0, 1.0}) {
                    glm::dvec3 there = from.at;
                    there[axis] += side * step[axis];
                    const double value = product(texture, there);
                    if (!(value > from.value)) continue;
                    from = {there, value};
                    found = true;
                }
            }
            if (!found) break;
        }
    return from.value;
}

// The largest product over some of the longest waves: a low-discrepancy set of places (Roberts 2018), the best of which
// climb.
double largest_product(const TextureFunction& texture) {
    constexpr int kPlaces = 8192;
    constexpr std::size_t kClimbed = 64;
    constexpr double kWaves = 8;
    double low_x = texture.by_hand[0].x, low_z = texture.by_hand[0].z;
    for (const HandSine& row : texture.by_hand) {
        low_x = std::min(low_x, row.x);
        low_z = std::min(low_z, row.z);
    }
    const glm::dvec3 size(kWaves / low_x, kWaves / low_x, kWaves / low_z);
    // 1/g, 1/g^2, 1/g^3 of the number g of three dimensions.
    constexpr double kX = 0.8191725133961645, kZ = 0.6710436067037893, kY = 0.5497004779019703;
    std::vector<Found> best;
    const auto better = [](const Found& a, const Found& b) { return a.value > b.value; };
    for (int i = 0; i < kPlaces; ++i) {
        const auto part = [&](double by) { return i * by - std::floor(i * by); };
        const glm::dvec3 at =
            size * glm::dvec3(part(kX), texture.in_space ? part(kY) : 0, part(kZ));
        best.push_back({at, product(texture, at)});
    }
    std::stable_sort(best.begin(), best.end(), better);
    best.resize(kClimbed);
    double most = 0;
    // From steps as long as a quarter of the longest wave: they find other hills, too.
    const glm::dvec3 step(0.25 / low_x, 0.25 / low_x, 0.25 / low_z);
    for (const Found& one : best) most = std::max(most, climbed(texture, one, step));
    return most;
}

}  // namespace

void take_by_hand(const SineTexture& texture, TextureFunction& function) {
    const std::vector<Sine>& sines = texture.sines;
    function.terms = sines.size();
    // F0 of a row before the first, as that of the rule.
    function.turns_x = sines[0].frequency_x / (4 * pi);
    function.turns_z = sines[0].frequency_z / (4 * pi);
    double sum = 0;
    for (std::size_t i = 0; i < sines.size(); ++i) {
        HandSine row;
        row.x = sines[i].frequency_x / (2 * pi);
        row.z = sines[i].frequency_z / (2 * pi);
        row.x_before = i > 0 ? function.by_hand[i - 1].x : function.turns_x;
        row.z_before = i > 0 ? function.by_hand[i - 1].z : function.turns_z;
        row.phase_x = sines[i].phase_x / 360;
        row.phase_z = sines[i].phase_z / 360;
        const auto squared = [](double ratio) { return ratio * ratio; };
        row.blur_x = std::max(squared(row.x / (2 * function.turns_x)),
                              squared(row.z_before / function.turns_z));
        row.blur_z = std::max(squared(row.z / (2 * function.turns_z)),
                              squared(row.x_before / function.turns_x));
        function.by_hand.push_back(row);
        function.coefficient[i] = sines[i].amplitude;
        sum += sines[i].amplitude;
    }
    function.floor = texture.offset * sum;
    const double highest = function.floor + sum;
    function.scale =
        1 / (function.printed ? highest * highest
                              : std::max(largest_product(function), 1e-3 * highest * highest));
}

TextureValue hand_texture_at(const TextureFunction& texture, const glm::dvec3& place, double blur_x,
                             double blur_z) {
    const glm::dvec3 at = place - texture.shift;
    double a = texture.floor, b = texture.floor, lost_a = 0, lost_b = 0;
    for (std::size_t i = 0; i < texture.by_hand.size(); ++i) {
        const HandSine& row = texture.by_hand[i];
        const double c = texture.coefficient[i];
        const TermSines sines = sines_of(texture, row, at);
        const double kept_x = kept_of_sine(blur_x * row.blur_x),
                     kept_z = kept_of_sine(blur_z * row.blur_z);
        a += c * kept_x * sines.x;
        b += c * kept_z * sines.z;
        lost_a += 0.5 * c * c * (1 - kept_x * kept_x);
        lost_b += 0.5 * c * c * (1 - kept_z * kept_z);
    }
    if (!texture.printed) {
        a = std::max(a, 0.0);
        b = std::max(b, 0.0);
    }
    return {texture.scale * a * b,
            texture.scale * texture.scale * (a * a * lost_b + b * b * lost_a + lost_a * lost_b)};
}

}  // namespace awan::ellipsoids
