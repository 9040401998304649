#include "core/scene/daylight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "core/base/exact_math.h"

namespace awan {
namespace {

constexpr double kPi = std::numbers::pi;

// --- the sun's spectrum (appendix 1)

// Every 10 nm from 380 nm. The paper's table of the sun ends at 750 nm; less than 1e-4 of its luminance lies beyond.
constexpr std::size_t kWavelengths = 38;
constexpr double kFirst = 0.38, kStep = 0.01;  // micrometres
// Radiance of the sun above the air, W / (m^2 nm sr).
constexpr std::array<double, kWavelengths> kSun = {
    16559.0, 16233.7, 21127.5, 25888.2, 25829.1, 24232.3, 26760.5, 29658.3, 30545.4, 30057.5,
    30663.7, 28830.4, 28712.1, 27825.0, 27100.6, 27233.6, 26361.3, 25503.8, 25060.2, 25311.6,
    25355.9, 25134.2, 24631.5, 24173.2, 23685.3, 23212.1, 22827.7, 22339.8, 21970.2, 21526.7,
    21097.9, 20728.3, 20240.4, 19870.8, 19427.2, 19072.4, 18628.9, 18259.2};
// The solid angle, sr, by which the table is Thekaekara's 1973 irradiance, from which it was made.
constexpr double kSunSolidAngle = 6.764e-5;
// Absorption by ozone, 1/cm.
constexpr std::array<double, kWavelengths> kOzone = {
    0,     0,     0,     0,     0,     0,     0,     0.003, 0.006, 0.009, 0.014, 0.021, 0.030,
    0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090,
    0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};
// And by water vapour, 1/cm, from 690 nm on.
constexpr std::size_t kFirstVapour = 31;
constexpr std::array<double, kWavelengths - kFirstVapour> kVapour = {0.016, 0.024, 0.0125, 1.0,
                                                                     0.87,  0.061, 0.001};
constexpr double kOzoneDepth = 0.35, kVapourDepth = 2;  // cm

// CIE 1931 colour matching functions, the multi-lobe fit of Wyman, Sloan & Shirley 2013 ("Simple analytic
// approximations to the CIE XYZ color matching functions", table 1); wavelength in micrometres.
double lobe(double wavelength, double height, double middle, double below, double above) {
    const double t = (1e3 * wavelength - middle) * (1e3 * wavelength < middle ? below : above);
    return height * exact::exp(-0.5 * t * t);
}

glm::dvec3 matching(double wavelength) {
    const double w = wavelength;
    return {lobe(w, 0.362, 442.0, 0.0624, 0.0374) + lobe(w, 1.056, 599.8, 0.0264, 0.0323) +
                lobe(w, -0.065, 501.1, 0.0490, 0.0382),
            lobe(w, 0.821, 568.8, 0.0213, 0.0247) + lobe(w, 0.286, 530.9, 0.0613, 0.0322),
            lobe(w, 1.217, 437.0, 0.0845, 0.0278) + lobe(w, 0.681, 459.0, 0.0385, 0.0725)};
}

double wavelength_of(std::size_t i) {
    return kFirst + kStep * static_cast<double>(i);
}

// Kasten's relative optical mass, 1 at the zenith, 36 at the horizon.
double optical_mass(double elevation) {
    const double from_zenith = 90 - glm::degrees(elevation);
    return 1 / (exact::sin(elevation) + 0.15 * exact::pow(93.885 - from_zenith, -1.253));
}

// X, Y, Z of the sun's irradiance; Y in lux.
glm::dvec3 sun_xyz(double elevation, double turbidity) {
    const double m = optical_mass(elevation);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < kWavelengths; ++i)
        sum += kSun[i] * air_transmittance(static_cast<int>(i), m, turbidity) *
               matching(wavelength_of(i));
    return sum * (683 * kSunSolidAngle * kStep * 1e3);
}

// --- the sky (appendix 2)

double perez_value(const std::array<double, 5>& p, double up, double gamma, double cos_gamma) {
    return (1 + p[0] * exact::exp(p[1] / up)) *
           (1 + p[2] * exact::exp(p[3] * gamma) + p[4] * cos_gamma * cos_gamma);
}

double cubic(double a, double b, double c, double d, double t) {
    return ((a * t + b) * t + c) * t + d;
}

// By the depth of the sun below the horizon, degrees. Illuminance falls from sunset to the end of civil twilight (6
// degrees) from some 700 to 3 lux (Seidelmann 1992, Explanatory Supplement), by e every 1.1 degrees, and there is no
// twilight at 18.
double twilight(double below) {
    if (below <= 0) return 1;
    return below < 18 ? exact::exp(-below / 1.1) * (1 - below / 18) : 0;
}

}  // namespace

AirDepths air_depths(int i, double turbidity) {
    const double w = wavelength_of(static_cast<std::size_t>(i));
    const double aerosol = 0.04608 * turbidity - 0.04586;  // Angstrom's beta
    return {0.008735 * exact::pow(w, -4.08), aerosol * exact::pow(w, -1.3),
            kOzone[static_cast<std::size_t>(i)] * kOzoneDepth};
}

glm::dvec3 sun_above_air(int i) {
    const auto number = static_cast<std::size_t>(i);
    return kSun[number] * matching(wavelength_of(number)) * (683 * kSunSolidAngle * kStep * 1e3);
}

double daylight_unit() {
    return sun_xyz(kPi / 2, 2).y;
}

glm::dvec3 rec709(const glm::dvec3& xyz) {
    const glm::dvec3 rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                         -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                         0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
    if (rgb.x >= 0 && rgb.y >= 0 && rgb.z >= 0) return rgb;
    const glm::dvec3 inside(std::max(rgb.x, 0.0), std::max(rgb.y, 0.0), std::max(rgb.z, 0.0));
    const double y = glm::dot(inside, glm::dvec3(0.2126729, 0.7151522, 0.0721750));
    return y > 0 ? inside * (std::max(xyz.y, 0.0) / y) : glm::dvec3(0);
}

glm::dvec3 balanced_rec709(const glm::dvec3& xyz) {
    // What makes rec709 of sun 45 degrees high and sky together on a level plane, turbidity 2, (1.0821, .9807, .9497)
    // at Y = 1, white (atmosphere_test computes it).
    return rec709(xyz) * glm::dvec3(0.9241, 1.0197, 1.0530);
}

double air_transmittance(int number, double m, double turbidity) {
    const auto i = static_cast<std::size_t>(number);
    const AirDepths parts = air_depths(number, turbidity);
    double depth = m * (parts.gas + parts.aerosol + parts.ozone);
    if (i >= kFirstVapour) {
        const double vapour = kVapour[i - kFirstVapour] * kVapourDepth * m;
        depth += 0.2385 * vapour / exact::pow(1 + 20.07 * vapour, 0.45);
    }
    return exact::exp(-depth);
}

double sun_illuminance(double elevation, double turbidity) {
    if (elevation < 0) return 0;
    return sun_xyz(elevation, turbidity).y;
}

glm::dvec3 sunlight(double elevation, double turbidity) {
    const double shown = std::clamp(1 + glm::degrees(elevation), 0.0, 1.0);
    if (shown == 0) return glm::dvec3(0);
    const glm::dvec3 xyz = sun_xyz(std::max(elevation, 0.0), turbidity) / daylight_unit();
    return shown * shown * (3 - 2 * shown) * balanced_rec709(xyz);
}

ClearSky clear_sky(const glm::dvec3& to_sun, double turbidity) {
    ClearSky sky;
    const double t = turbidity;
    const double elevation = exact::asin(std::clamp(to_sun.y, -1.0, 1.0));
    sky.dimmed = twilight(-glm::degrees(elevation));
    sky.to_sun = to_sun;
    if (to_sun.y < 0) {
        // The glow of twilight stands where the sun went down; from straight below it is none.
        const glm::dvec3 level(to_sun.x, 0, to_sun.z);
        const double length = glm::length(level);
        sky.to_sun = length > 0 ? level / length : glm::dvec3(0, 0, 1);
    }
    sky.perez[0] = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                    0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
    sky.perez[1] = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
                    -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
    sky.perez[2] = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
                    -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};

    const double sun = kPi / 2 - std::max(elevation, 0.0);  // from the zenith
    const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * sun);
    const double kcd = (4.0453 * t - 4.9710) * exact::tan(chi) - 0.2155 * t + 2.4192;
    const double x = (cubic(0.00166, -0.00375, 0.00209, 0, sun) * t +
                      cubic(-0.02903, 0.06377, -0.03202, 0.00394, sun)) *
                         t +
                     cubic(0.11693, -0.21196, 0.06052, 0.25886, sun);
    const double y = (cubic(0.00275, -0.00610, 0.00317, 0, sun) * t +
                      cubic(-0.04214, 0.08970, -0.04153, 0.00516, sun)) *
                         t +
                     cubic(0.15346, -0.26756, 0.06670, 0.26688, sun);
    const std::array<double, 3> zenith = {1e3 * kcd / daylight_unit(), x, y};
    for (std::size_t i = 0; i < 3; ++i)
        sky.scale[i] = zenith[i] / perez_value(sky.perez[i], 1, sun, exact::cos(sun));
    return sky;
}

glm::dvec3 radiance(const ClearSky& sky, const glm::dvec3& direction) {
    // exp(B / up) is no more than e^-100 there: nothing changes from here to the horizon.
    constexpr double kLevel = 1e-3;
    const double up = std::max(direction.y, kLevel);
    const double cos_gamma = std::clamp(glm::dot(direction, sky.to_sun), -1.0, 1.0);
    const double gamma = exact::acos(cos_gamma);
    std::array<double, 3> value{};
    for (std::size_t i = 0; i < 3; ++i)
        value[i] = sky.scale[i] * perez_value(sky.perez[i], up, gamma, cos_gamma);
    // Out of the range that the fits were made for, x and y still have to be those of a colour.
    const double x = std::clamp(value[1], 0.05, 0.7), y = std::clamp(value[2], 0.05, 0.7);
    const double luminance = sky.dimmed * std::max(value[0], 0.0);
    return balanced_rec709(luminance * glm::dvec3(x / y, 1, std::max(1 - x - y, 0.0) / y));
}

}  // namespace awan
