#include <algorithm>
#include <vector>

#include "core/generate/ellipsoids/sine_sums.h"

namespace awan::ellipsoids {
namespace {

using Coefficients = std::array<double, limits::kMaxTextureTerms>;

// A place, in turns of half the first frequency, and how promising it is.
struct Place {
    // Along x, z, and y.
    std::array<double, 3> turns{};
    double rank = 0;
};

// (A + lift)(B + lift), the sums A and B of the first `terms` terms.
double product(const Place& place, std::size_t terms, double lift,
               const Coefficients& coefficient) {
    double x = part_of_turn(place.turns[0]), z = part_of_turn(place.turns[1]);
    double y = part_of_turn(place.turns[2]);
    double a = lift, b = lift;
    for (std::size_t i = 0; i < terms; ++i) {
        const TermSines sines = clean_term(x, z, y);
        a += coefficient[i] * sines.x;
        b += coefficient[i] * sines.z;
    }
    return std::max(a, 0.0) * std::max(b, 0.0);
}

bool better(const Place& a, const Place& b) {
    // A total order, since no two places are the same.
    return a.rank != b.rank ? a.rank > b.rank : a.turns < b.turns;
}

void keep_best(std::vector<Place>& places, std::size_t count) {
    std::sort(places.begin(), places.end(), better);
    if (places.size() > count) places.resize(count);
}

// Each place becomes those that are a step of -+ `step` away along every axis.
std::vector<Place> split(const std::vector<Place>& places, std::size_t axes, double step) {
    std::vector<Place> finer;
    for (const Place& place : places)
        for (std::size_t corner = 0; corner < (1u << axes); ++corner) {
            Place one = place;
            for (std::size_t axis = 0; axis < axes; ++axis)
                one.turns[axis] += (corner >> axis & 1u) != 0 ? step : -step;
            finer.push_back(one);
        }
    return finer;
}

// Goes uphill along the axes, in steps that halve when none helps.
void climb(Place& place, std::size_t axes, std::size_t terms, double floor, double step,
           const Coefficients& coefficient) {
    for (int halvings = 0; halvings < 14; step /= 2, ++halvings)
        for (bool found = true; found;) {
            found = false;
            for (std::size_t axis = 0; axis < axes; ++axis)
                for (const double side : {-step, step}) {
                    Place one = place;
                    one.turns[axis] += side;
                    one.rank = product(one, terms, floor, coefficient);
                    if (one.rank > place.rank) {
                        place = one;
                        found = true;
                    }
                }
        }
}

}  // namespace

double scale_to_one(std::size_t terms, double floor, bool in_space,
                    const Coefficients& coefficient) {
    const std::size_t axes = in_space ? 3 : 2;
    constexpr std::size_t kKept = 40, kClimbed = 4;
    // One period, cut into 4 cells along each axis. With every further term the cells become half as wide, as its
    // sine is.
    std::vector<Place> places(1);
    double step = 0.5;
    for (int level = 0; level < 2; ++level) places = split(places, axes, step /= 2);
    for (std::size_t used = 1; used <= terms; ++used) {
        places = split(places, axes, step /= 2);
        // What the terms to come may add: most of their sum, which is what one finds at the best places.
        double lift = floor;
        for (std::size_t i = used; i < terms; ++i) lift += 0.7 * coefficient[i];
        for (Place& place : places) place.rank = product(place, used, lift, coefficient);
        keep_best(places, kKept);
    }
    for (Place& place : places) place.rank = product(place, terms, floor, coefficient);
    keep_best(places, kClimbed);
    double most = 0;
    for (Place& place : places) {
        climb(place, axes, terms, floor, step, coefficient);
        most = std::max(most, place.rank);
    }
    // most > 0: there is a place where both first sines exceed all that the other terms could take away.
    return 1 / most;
}

}  // namespace awan::ellipsoids
