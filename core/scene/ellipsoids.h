// What a cloud of model "ellipsoids" is: Gardner 1985, "Visual simulation of clouds" (document 002): a textured sky plane and
// ellipsoids whose shading and translucence a sum of sines modulates.
//
// Gardner's axes have Z up; ours have y up: his X, Y, Z are our x, z, y. A formation that moves apart from the others is a
// cloud of its own, with a velocity.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace awan {

// How the texturing function is taken (core/generate/ellipsoids/texture.h says what differs and why).
enum class TextureForm { kClean, kPrinted };

// T(X,Y,Z) = k sum Ci [sin(FXi X + PXi) + T0] * sum Ci [sin(FYi Y + PYi) + T0], 0..1.
struct SineTexture {
    TextureForm form = TextureForm::kClean;
    std::uint64_t terms = 6;   // of either sum; the source: 4 to 7
    double frequency_x = 0.9;  // FX1, radians/unit, along x and upward
    double frequency_z = 0.9;  // FY1, radians/unit, along z
    double offset = 1;         // T0, "controls the contrast": more of it, less contrast
    bool operator==(const SineTexture&) const = default;
};

// Intensity I = (1-a){(1-t)[(1-s) Id + s Is] + t It} + a.
struct SineShading {
    double specular = 0.1;  // s
    double texture = 0.35;  // t
    double ambient = 0.25;  // a
    double shininess = 4;   // exponent of Is, Phong's; the source gives none
};

// TR = clamp(1 - (It - T1 - (T2-T1)(1-g))/D, 0, 1).
struct Translucence {
    double threshold = 0;          // T1, at the centre of the limb curve
    double threshold_edge = 0.65;  // T2, on the silhouette
    double range = 0.2;            // D, of texture, from clear to opaque
};

// TR = clamp(1 - (It - T1)/D, 0, 1). Endless in the look; in the volume a square slab around the cloud's origin.
struct SkyPlane {
    double altitude = 10;    // y, units
    double extent = 120;     // side of the square, units; of the volume
    double thickness = 1.5;  // units; of the volume
    double threshold = 0.3;
    double range = 0.3;
    double density = 10;             // multiplies the cloud's
    std::uint64_t resolution = 128;  // cells along a side of the slab
    SineTexture texture{TextureForm::kClean, 6, 0.3, 0.3, 1};
};

// Rows and patches, towers, or towers on a patch. Ellipsoids are linked: each but the first overlaps an earlier one.
enum class FormationKind { kHorizontal, kVertical, kCombined };
struct Formation {
    FormationKind kind = FormationKind::kCombined;
    std::uint64_t count = 40;  // ellipsoids
    glm::dvec3 center{0};      // of the first ellipsoid
    glm::dvec3 radii{2.4, 1.6, 2.4};
    double variation = 0.3;  // 0..: radii are between (1 - v) and (1 + v) times `radii`
    double link = 0.5;       // share of the way from touching (0) to the same centre (1)
    double heading = 90;     // degrees, from +z towards +x: which way the row goes
    double spread = 50;      // degrees, by which a link may depart from `heading`, or from upward
};

struct Ellipsoid {
    glm::dvec3 center{0};
    glm::dvec3 radii{1};
    double rotate_y = 0;  // degrees, from +z towards +x
    // Instead of the cloud's.
    std::optional<double> threshold, threshold_edge, range;
};

struct EllipsoidsCloud {
    SineTexture texture;
    SineShading shading;
    Translucence translucence;
    std::optional<SkyPlane> plane;
    // Where there is no plane, no formation and no ellipsoid there is one Formation of the defaults.
    std::vector<Formation> formations;
    std::vector<Ellipsoid> ellipsoids;
    glm::dvec3 drift{0};  // of the texture, units a second, whatever the ellipsoids do
    double density = 10;  // multiplies the cloud's: extinction where the texture is opaque
    std::uint64_t resolution = 64;  // cells along the longest side of the ellipsoids' box
};

// Every value of it as numbers, lists with their lengths: two clouds are equal when these are.
std::vector<double> figures_of(const EllipsoidsCloud& cloud);

// What cannot be, with the pointer to it; `at` is the pointer to the cloud's "ellipsoids".
Status check_ellipsoids(const EllipsoidsCloud& cloud, const std::string& at);

// No more particles are made of it; of one that can be.
std::uint64_t most_particles(const EllipsoidsCloud& cloud);

}  // namespace awan
