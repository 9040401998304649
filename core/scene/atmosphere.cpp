#include "core/scene/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/base/catmull_rom.h"
#include "core/base/exact_math.h"
#include "core/scene/daylight.h"

namespace awan {
namespace {

constexpr double kTurn = std::numbers::pi;
// Kilometres.
constexpr double kEarth = 6360, kAirTop = 100;
// Heights over which the density falls by e, and the tent of ozone (Bruneton 2017).
constexpr double kGasScale = 8, kAerosolScale = 1.2, kOzoneMiddle = 25, kOzoneHalf = 15;
// What the aerosol scatters of what it takes from a ray: background continental aerosol.
constexpr double kAerosolAlbedo = 0.93;
// Asymmetry of its phase function (Bruneton & Neyret 2008).
constexpr double kAerosolAsymmetry = 0.76;
// How far below the eye it is: about where the bases of cumulus are above it.
constexpr double kLandBelow = 1;
// Radians that the sun's disc spans.
constexpr double kSunWidth = 0.0093;

// --- bands of wavelengths

constexpr std::size_t kBands = 8;
using Band = std::array<double, kBands>;
// The first of daylight.h's wavelengths in each.
constexpr std::array<int, kBands + 1> kBandStart = {0, 5, 9, 13, 17, 21, 25, 30, kDaylightWaves};
// Of the land around, as it is seen and for the light that it throws back into the air: fields and woods.
constexpr Band kLandAlbedo = {0.05, 0.05, 0.06, 0.08, 0.1, 0.095, 0.085, 0.085};

struct Air {
    // Per kilometre at the ground, of ozone at the layer's middle.
    Band gas{}, aerosol{}, ozone{};
    // What a radiance of 1 of the sun's irradiance weighs.
    std::array<glm::dvec3, kBands> xyz{};
};

Air air_of(double turbidity) {
    Air air;
    for (std::size_t b = 0; b < kBands; ++b) {
        double total = 0;
        for (int i = kBandStart[b]; i < kBandStart[b + 1]; ++i) {
            const glm::dvec3 share = sun_above_air(i);
            const double weight = share.x + share.y + share.z;
            const AirDepths depths = air_depths(i, turbidity);
            air.gas[b] += weight * depths.gas / kGasScale;
            air.aerosol[b] += weight * depths.aerosol / kAerosolScale;
            air.ozone[b] += weight * depths.ozone / kOzoneHalf;
            air.xyz[b] += share / daylight_unit();
            total += weight;
        }
        air.gas[b] /= total;
        air.aerosol[b] /= total;
        air.ozone[b] /= total;
    }
    return air;
}

// Of gas, aerosol and ozone: densities at a height, or kilometres of the full density along a way.
using Matter = glm::dvec3;

Matter density_at(double height) {
    return {exact::exp(-height / kGasScale), exact::exp(-height / kAerosolScale),
            std::max(0.0, 1 - std::abs(height - kOzoneMiddle) / kOzoneHalf)};
}

// --- rays. A place is told by its height; a ray by the sine of its elevation there.

double height_along(double height, double up, double way) {
    const double r = kEarth + height;
    return std::sqrt(r * r + way * way + 2 * r * way * up) - kEarth;
}

// To the top of the air, going up or past the earth.
double way_out(double height, double up) {
    const double r = kEarth + height, top = kEarth + kAirTop;
    return std::sqrt(std::max(0.0, r * r * (up * up - 1) + top * top)) - r * up;
}

// The sine of the elevation of the earth's edge, <= 0.
double edge_of_earth(double height) {
    const double share = kEarth / (kEarth + height);
    return -std::sqrt(std::max(0.0, 1 - share * share));
}

// To the earth, or none (-1).
double way_down(double height, double up) {
    if (up >= edge_of_earth(height)) return -1;
    const double r = kEarth + height;
    return -r * up - std::sqrt(std::max(0.0, r * r * (up * up - 1) + kEarth * kEarth));
}

double smooth_step(double t) {
    const double x = std::clamp(t, 0.0, 1.0);
    return x * x * (3 - 2 * x);
}

// --- sunlight at every height: columns by height and by the sun's elevation there, which changes along a ray by no
// more than 11 degrees from what it is on the ground

constexpr double kAround = 0.2;  // radians
constexpr int kHeights = 24, kElevations = 49;

struct Sunshine {
    double lowest = 0;  // radians, the table's first elevation
    std::array<std::array<Matter, kElevations>, kHeights> column{};
};

// Heights are close together near the ground.
double height_of(double row, int rows) {
    const double share = row / (rows - 1);
    return kAirTop * share * share;
}
double row_of(double height, int rows) {
    return std::sqrt(std::clamp(height / kAirTop, 0.0, 1.0)) * (rows - 1);
}

Matter column_out(double height, double up) {
    constexpr int kSteps = 24;
    const double out = way_out(height, up);
    Matter sum(0);
    for (int i = 0; i < kSteps; ++i) {
        const double from = i / (1.0 * kSteps), to = (i + 1) / (1.0 * kSteps);
        // Short steps where the way begins, and where it comes lowest.
        const double begin = out * from * from, end = out * to * to;
        sum +=
            density_at(std::max(0.0, height_along(height, up, (begin + end) / 2))) * (end - begin);
    }
    return sum;
}

Sunshine sunshine_of(double elevation) {
    Sunshine sun;
    sun.lowest = elevation - kAround;
    for (int i = 0; i < kHeights; ++i) {
        const double height = height_of(i, kHeights);
        const double edge = edge_of_earth(height);
        for (int j = 0; j < kElevations; ++j) {
            const double up = exact::sin(std::clamp(
                sun.lowest + 2 * kAround * j / (kElevations - 1), -kTurn / 2, kTurn / 2));
            sun.column[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                column_out(height, std::max(up, edge));
        }
    }
    return sun;
}

// What a table of rows and columns says between its entries.
template <class Table>
auto between(const Table& table, double row, double column) {
    const int rows = static_cast<int>(table.size()), columns = static_cast<int>(table[0].size());
    const int i = std::clamp(static_cast<int>(row), 0, rows - 2);
    const int j = std::clamp(static_cast<int>(column), 0, columns - 2);
    const double a = std::clamp(row - i, 0.0, 1.0), b = std::clamp(column - j, 0.0, 1.0);
    const auto& low = table[static_cast<std::size_t>(i)];
    const auto& high = table[static_cast<std::size_t>(i + 1)];
    const auto left = static_cast<std::size_t>(j), right = left + 1;
    return (low[left] * (1 - b) + low[right] * b) * (1 - a) +
           (high[left] * (1 - b) + high[right] * b) * a;
}

// The share of the sun's light of each band at a place. sine: of the sun's elevation there.
Band light_at(const Air& air, const Sunshine& sun, double height, double sine) {
    Band light{};
    const double elevation = exact::asin(std::clamp(sine, -1.0, 1.0));
    const double below = elevation - exact::asin(edge_of_earth(height));
    const double disc = smooth_step(0.5 + below / kSunWidth);
    if (disc == 0) return light;
    const Matter column = between(sun.column, row_of(height, kHeights),
                                  (elevation - sun.lowest) / (2 * kAround) * (kElevations - 1));
    for (std::size_t b = 0; b < kBands; ++b)
        light[b] = disc * exact::exp(-(air.gas[b] * column.x + air.aerosol[b] * column.y +
                                       air.ozone[b] * column.z));
    return light;
}

// --- a walk along a ray, giving to each step what there is

struct Step {
    double height = 0, sun_sine = 0;
    // Of light that scatters all along the step what arrives at the ray's beginning, per unit of coefficient.
    Band weight{};
    // Coefficients of scattering, per kilometre.
    Band gas{}, aerosol{};
};

// to_sun: the sun's sine and, against the ray's direction, its cosine. Gives what gets through.
template <class Each>
Band walk(const Air& air, double height, double up, double sun_sine, double cos_gamma, double way,
          int steps, const Each& each) {
    Band through;
    through.fill(1);
    for (int i = 0; i < steps; ++i) {
        const double from = i / (1.0 * steps), to = (i + 1) / (1.0 * steps);
        const double begin = way * from * from, length = way * to * to - begin;
        const double at = begin + length / 2;
        Step step;
        step.height = std::max(0.0, height_along(height, up, at));
        step.sun_sine = ((kEarth + height) * sun_sine + at * cos_gamma) / (kEarth + step.height);
        const Matter density = density_at(step.height);
        for (std::size_t b = 0; b < kBands; ++b) {
            step.gas[b] = air.gas[b] * density.x;
            const double aerosol = air.aerosol[b] * density.y;
            step.aerosol[b] = kAerosolAlbedo * aerosol;
            const double taken = step.gas[b] + aerosol + air.ozone[b] * density.z;
            const double passes = exact::exp(-taken * length);
            step.weight[b] = through[b] * (taken * length > 1e-6 ? (1 - passes) / taken : length);
            through[b] *= passes;
        }
        each(step);
    }
    return through;
}

// --- light scattered more than once: the same from all sides at a place, a sum of a geometric series (Hillaire 2020)

constexpr int kDiffuseHeights = 10, kDiffuseElevations = 7;

struct Bands {
    Band value{};
    friend Bands operator*(const Bands& a, double k) {
        Bands scaled;
        for (std::size_t b = 0; b < kBands; ++b) scaled.value[b] = a.value[b] * k;
        return scaled;
    }
    friend Bands operator+(const Bands& a, const Bands& c) {
        Bands sum;
        for (std::size_t b = 0; b < kBands; ++b) sum.value[b] = a.value[b] + c.value[b];
        return sum;
    }
};

struct Diffuse {
    std::array<std::array<Bands, kDiffuseElevations>, kDiffuseHeights> radiance{};
};

Bands diffuse_at(const Air& air, const Sunshine& sun, double height, double sun_sine) {
    constexpr int kLevels = 8, kTurns = 2, kSteps = 10;
    constexpr double kShare = 1.0 / (kLevels * kTurns);
    Band once{}, passed_on{};
    const double sun_flat = std::sqrt(std::max(0.0, 1 - sun_sine * sun_sine));
    for (int i = 0; i < kLevels; ++i) {
        const double up = (2 * i + 1.0) / kLevels - 1;
        const double down = way_down(height, up);
        const double way = down >= 0 ? down : way_out(height, up);
        for (int j = 0; j < kTurns; ++j) {
            const double cos_gamma = up * sun_sine + std::sqrt(1 - up * up) * sun_flat *
                                                         exact::cos(kTurn * (j + 0.5) / kTurns);
            const Band through =
                walk(air, height, up, sun_sine, cos_gamma, way, kSteps, [&](const Step& step) {
                    const Band light = light_at(air, sun, step.height, step.sun_sine);
                    for (std::size_t b = 0; b < kBands; ++b) {
                        const double scatters =
                            kShare * (step.gas[b] + step.aerosol[b]) * step.weight[b];
                        once[b] += scatters * light[b] / (4 * kTurn);
                        passed_on[b] += scatters;
                    }
                });
            if (down < 0) continue;
            const double sine = ((kEarth + height) * sun_sine + way * cos_gamma) / kEarth;
            const Band light = light_at(air, sun, 0, sine);
            for (std::size_t b = 0; b < kBands; ++b)
                once[b] +=
                    kShare * through[b] * light[b] * std::max(0.0, sine) * kLandAlbedo[b] / kTurn;
        }
    }
    Bands all;
    for (std::size_t b = 0; b < kBands; ++b) all.value[b] = once[b] / (1 - passed_on[b]);
    return all;
}

Diffuse diffuse_of(const Air& air, const Sunshine& sun) {
    Diffuse diffuse;
    for (int i = 0; i < kDiffuseHeights; ++i)
        for (int j = 0; j < kDiffuseElevations; ++j) {
            const double elevation = std::clamp(
                sun.lowest + 2 * kAround * j / (kDiffuseElevations - 1), -kTurn / 2, kTurn / 2);
            diffuse.radiance[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
                diffuse_at(air, sun, height_of(i, kDiffuseHeights), exact::sin(elevation));
        }
    return diffuse;
}

// --- the sky

double gas_phase(double cos_gamma) {
    return 3 / (16 * kTurn) * (1 + cos_gamma * cos_gamma);
}

// Cornette & Shanks 1992.
double aerosol_phase(double cos_gamma) {
    constexpr double g = kAerosolAsymmetry;
    const double base = 1 + g * g - 2 * g * cos_gamma;
    return 3 / (8 * kTurn) * (1 - g * g) / (2 + g * g) * (1 + cos_gamma * cos_gamma) /
           (base * std::sqrt(base));
}

// Everything that is the same for all rays.
struct Surroundings {
    Air air;
    Sunshine sun;
    Diffuse diffuse;
    double sun_sine = 0, sun_flat = 0;
};

// What a ray of the sky's maps brings: radiance even + haze * (the aerosol's phase function), and what gets through.
struct Seen {
    Band even{}, haze{}, through{};
};

Seen look(const Surroundings& all, double up, double cos_gamma, double way) {
    constexpr int kSteps = 28;
    Seen seen;
    seen.through =
        walk(all.air, 0, up, all.sun_sine, cos_gamma, way, kSteps, [&](const Step& step) {
            const Band light = light_at(all.air, all.sun, step.height, step.sun_sine);
            const double row = row_of(step.height, kDiffuseHeights);
            const double column =
                (exact::asin(std::clamp(step.sun_sine, -1.0, 1.0)) - all.sun.lowest) /
                (2 * kAround) * (kDiffuseElevations - 1);
            const Bands around = between(all.diffuse.radiance, row, column);
            for (std::size_t b = 0; b < kBands; ++b) {
                seen.even[b] +=
                    step.weight[b] * (step.gas[b] * gas_phase(cos_gamma) * light[b] +
                                      (step.gas[b] + step.aerosol[b]) * around.value[b]);
                seen.haze[b] += step.weight[b] * step.aerosol[b] * light[b];
            }
        });
    return seen;
}

double elevation_of(int row) {
    const double share = row / (AirSky::kRows - 1.0);
    return kTurn / 2 * share * share;
}

// The cosine of the angle to the sun of a ray of the maps. up: the sine of its elevation, of either sign.
double cosine_to_sun(const Surroundings& all, double up, int column) {
    return up * all.sun_sine + std::sqrt(std::max(0.0, 1 - up * up)) * all.sun_flat *
                                   exact::cos(kTurn * column / (AirSky::kColumns - 1));
}

void keep(const Air& air, const Seen& seen, int row, int column, AirSky::Half& half) {
    const auto i = static_cast<std::size_t>(row), j = static_cast<std::size_t>(column);
    for (std::size_t b = 0; b < kBands; ++b) {
        half.even[i][j] += seen.even[b] * air.xyz[b];
        half.haze[i][j] += seen.haze[b] * air.xyz[b];
    }
}

// Fills the upper half; gives the irradiance of level land.
Band make_sky(const Surroundings& all, AirSky::Half& half) {
    Band on_land = light_at(all.air, all.sun, 0, all.sun_sine);
    for (double& light : on_land) light *= std::max(0.0, all.sun_sine);
    for (int i = 0; i < AirSky::kRows; ++i) {
        const double elevation = elevation_of(i), up = exact::sin(elevation), way = way_out(0, up);
        // Of the sky, by the trapezoid rule over rows and columns: both sides of the sun.
        const double last = AirSky::kRows - 1.0;
        const double high = kTurn * i / (last * last) * (i == AirSky::kRows - 1 ? 0.5 : 1);
        const double level = 2 * kTurn / (AirSky::kColumns - 1) * up * exact::cos(elevation) * high;
        for (int j = 0; j < AirSky::kColumns; ++j) {
            const double cos_gamma = cosine_to_sun(all, up, j);
            const Seen seen = look(all, up, cos_gamma, way);
            keep(all.air, seen, i, j, half);
            const double share = level * (j == 0 || j == AirSky::kColumns - 1 ? 0.5 : 1);
            for (std::size_t b = 0; b < kBands; ++b)
                on_land[b] += share * (seen.even[b] + aerosol_phase(cos_gamma) * seen.haze[b]);
        }
    }
    return on_land;
}

// Fills the lower half. The way to the land is taken through the air at the eye's height, along the level, so that it
// begins at the horizon where the sky ends.
void make_land(const Surroundings& all, const Band& on_land, AirSky::Half& half) {
    const double level = way_out(0, 0);
    for (int i = 0; i < AirSky::kRows; ++i) {
        const double up = -exact::sin(elevation_of(i));
        const double way = std::min(level, kLandBelow / std::max(-up, 1e-9));
        for (int j = 0; j < AirSky::kColumns; ++j) {
            Seen seen = look(all, 0, cosine_to_sun(all, up, j), way);
            for (std::size_t b = 0; b < kBands; ++b)
                seen.even[b] += i > 0 ? seen.through[b] * on_land[b] * kLandAlbedo[b] / kTurn : 0;
            keep(all.air, seen, i, j, half);
        }
    }
}

}  // namespace

AirSky air_sky(const glm::dvec3& to_sun, double turbidity) {
    const double sine = std::clamp(to_sun.y, -1.0, 1.0);
    Surroundings all{
        air_of(turbidity), sunshine_of(exact::asin(sine)), {}, sine, std::sqrt(1 - sine * sine)};
    all.diffuse = diffuse_of(all.air, all.sun);
    AirSky sky;
    sky.to_sun = to_sun;
    sky.turbidity = turbidity;
    make_land(all, make_sky(all, sky.sky), sky.land);
    for (const auto& row : sky.sky.even)
        for (const glm::dvec3& xyz : row) sky.shines = sky.shines || xyz.y > 0;
    return sky;
}

glm::dvec3 radiance(const AirSky& sky, const glm::dvec3& direction) {
    const AirSky::Half& half = direction.y < 0 ? sky.land : sky.sky;
    const double up = std::min(std::abs(direction.y), 1.0);
    const double row = std::sqrt(exact::asin(up) / (kTurn / 2)) * (AirSky::kRows - 1);
    const double flat =
        exact::hypot(direction.x, direction.z) * exact::hypot(sky.to_sun.x, sky.to_sun.z);
    const double cos_azimuth =
        flat > 1e-12 ? (direction.x * sky.to_sun.x + direction.z * sky.to_sun.z) / flat : 1.0;
    const double column =
        exact::acos(std::clamp(cos_azimuth, -1.0, 1.0)) / kTurn * (AirSky::kColumns - 1);
    const int i = std::min(static_cast<int>(row), AirSky::kRows - 2);
    const int j = std::min(static_cast<int>(column), AirSky::kColumns - 2);
    const std::array<double, 4> down = catmull_rom(row - i), along = catmull_rom(column - j);
    const double phase = aerosol_phase(std::clamp(glm::dot(direction, sky.to_sun), -1.0, 1.0));
    glm::dvec3 xyz(0);
    for (int a = 0; a < 4; ++a) {
        // Smooth in the elevation, so even in its root.
        const auto r = static_cast<std::size_t>(std::min(std::abs(i + a - 1), AirSky::kRows - 1));
        glm::dvec3 even(0), haze(0);
        for (int b = 0; b < 4; ++b) {
            // The sky is the same on both sides of the sun: past the last column stands the one before it.
            const int c = std::abs(j + b - 1);
            const auto s =
                static_cast<std::size_t>(c < AirSky::kColumns ? c : 2 * (AirSky::kColumns - 1) - c);
            even += along[static_cast<std::size_t>(b)] * half.even[r][s];
            haze += along[static_cast<std::size_t>(b)] * half.haze[r][s];
        }
        xyz += down[static_cast<std::size_t>(a)] * (even + phase * haze);
    }
    return balanced_rec709(glm::max(xyz, glm::dvec3(0)));
}

}  // namespace awan
