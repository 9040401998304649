// The clear sky by scattering in layers of air over a round earth: single scattering along every ray, all further
// orders by the local approximation of Hillaire 2020, in eight bands of wavelengths, with the gases and the aerosol by
// which daylight.h dims the sun. Ozone in its layer is what keeps twilight blue and the horizon free of mauve.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>

namespace awan {

// What the sky of one sun and one air looks like from the ground, as CIE XYZ over the unit of luminance of daylight.h.
struct AirSky {
    // Rows: elevation +-90 (i / (kRows - 1))^2 degrees. Columns: azimuth from the sun's, pi j / (kColumns - 1).
    static constexpr int kRows = 40, kColumns = 13;
    // The radiance is even + haze * (the aerosol's phase function of the angle to the sun).
    struct Half {
        using Map = std::array<std::array<glm::dvec3, kColumns>, kRows>;
        Map even{}, haze{};
    };
    // Above the horizon, and below it: land in the light of sun and sky, behind the air in front of it.
    Half sky, land;
    glm::dvec3 to_sun{0, 1, 0};  // unit
    double turbidity = 2;
    // False when no light is left, from about 10 degrees below the horizon on.
    bool shines = false;
};

// to_sun: unit. turbidity: 2..10. Takes some 4 ms.
AirSky air_sky(const glm::dvec3& to_sun, double turbidity);

// From a direction (unit), linear Rec. 709 over the unit of luminance of daylight.h. Below the horizon there is level
// land, dark as woods and fields are, a kilometre below the eye, which at the horizon is lost in the air. >= 0, finite.
glm::dvec3 radiance(const AirSky& sky, const glm::dvec3& direction);

}  // namespace awan
