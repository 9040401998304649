// The colours of clear daylight by the sun's elevation: Preetham, Shirley & Smits 1999, "A practical analytic model for
// daylight". Linear Rec. 709; luminance relative to that of the sun at the zenith through air of turbidity 2.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace awan {

// Irradiance of direct sunlight at normal incidence: Preetham et al. 1999, appendix 1 (Rayleigh, aerosol, ozone, water
// vapour; its mixed gases absorb beyond 750 nm only, where the eye sees nothing), summed over 380..750 nm.
// elevation: radians above the horizon; darkens to 0 from 0 to -1 degree below it. turbidity: 2..10. Components are >=
// 0: what lies outside of Rec. 709 is taken to its edge at the same luminance.
glm::dvec3 sunlight(double elevation, double turbidity);

// Share of light of a wavelength of the tables (number i: 380 + 10 i nm, i = 0..37) that clear air of a relative
// optical mass (1: sun at the zenith) lets through.
double air_transmittance(int i, double optical_mass, double turbidity);

// Optical depths of the air from the ground up at one of those wavelengths, by what it is made of; water vapour, which
// bites into the far red only, is left out.
inline constexpr int kDaylightWaves = 38;
struct AirDepths {
    double gas = 0, aerosol = 0, ozone = 0;
};
AirDepths air_depths(int i, double turbidity);

// The share of 10 nm around it in X, Y and Z of the sun's irradiance above the air; Y in lux.
glm::dvec3 sun_above_air(int i);

// What all luminances are relative to: that of the sun at the zenith through air of turbidity 2, lux.
double daylight_unit();

// Linear Rec. 709; Y of white is 1. What it has no colour for goes to its edge and keeps its luminance.
glm::dvec3 rec709(const glm::dvec3& xyz);

// The same through a camera that is set to daylight, as all light of sun and sky is seen: what a level plane gets of
// both together is white, with the sun 45 degrees high and turbidity 2 (about 5900 K), Y kept. Without it every noon
// cloud would be cream, as the display's white is that of a bluish daylight (6504 K), and hazy horizons mauve.
glm::dvec3 balanced_rec709(const glm::dvec3& xyz);

// Illuminance of direct sunlight at normal incidence, lux; 0 below the horizon.
double sun_illuminance(double elevation, double turbidity);

// The clear sky: Preetham et al. 1999, appendix 2, Perez' five-parameter distribution of Y, x and y. Known of it, and
// left as it is: with the sun near the horizon it is brighter than measured skies.
struct ClearSky {
    glm::dvec3 to_sun{0, 1, 0};                    // unit; at or above the horizon
    std::array<std::array<double, 5>, 3> perez{};  // A..E of Y, x, y
    std::array<double, 3>
        scale{};        // zenith value over the distribution's at the zenith, of Y, x, y
    double dimmed = 1;  // below the horizon: twilight, a fade that is ours
};
// to_sun: unit. turbidity: 2..10.
ClearSky clear_sky(const glm::dvec3& to_sun, double turbidity);

// From a direction (unit). Below the horizon the horizon's gradation goes on, so that there is no edge: it depends on
// the angle to the sun only. >= 0, finite.
glm::dvec3 radiance(const ClearSky& sky, const glm::dvec3& direction);

}  // namespace awan
