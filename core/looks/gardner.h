// The picture of a cloud as Gardner 1985 draws it: hollow ellipsoids and a plane, whose surfaces a texture shades and
// makes translucent. No light goes through anything, and nothing casts a shadow.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/generate/ellipsoids/formations.h"
#include "core/generate/ellipsoids/plane.h"
#include "core/generate/ellipsoids/texture.h"
#include "core/generate/motion.h"
#include "core/scene/scene.h"
#include "core/survey/survey.h"

namespace awan::gardner {

using ellipsoids::PlacedEllipsoid;
using ellipsoids::PlaneTexture;
using ellipsoids::TextureFunction;

// --- Formulas of Gardner 1985

// The shading intensity, I = (1-a){(1-t)[(1-s) Id + s Is] + t It} + a, of Id, Is and It.
double intensity(const SineShading& shading, double diffuse, double specular, double texture);

// Id and Is: Lambert's law, and the highlight of Phong 1975 with an exponent (Gardner 1985 names them, no more). Unit
// vectors; to_eye points away from the surface. 0 where the light comes from behind.
double diffuse(const glm::dvec3& normal, const glm::dvec3& to_sun);
double specular(const glm::dvec3& normal, const glm::dvec3& to_sun, const glm::dvec3& to_eye,
                double shininess);

// --- One ellipsoid and one ray

// An ellipsoid as the unit sphere about the origin, seen from an eye.
struct UnitSphere {
    // Turns directions of the scene into those of the sphere's space.
    glm::dmat3 to_unit{1};
    // The eye in the sphere's space.
    glm::dvec3 eye{0};
};
struct SphereHit {
    // Scene units along the ray's unit direction, > 0.
    double distance = 0;
    // The place on the unit sphere.
    glm::dvec3 at{0};
    // The limb curve g, 0..1.
    double limb = 0;
};
// The wall that one sees: the near one, or from inside the far one. limb is 1 - b^2, where b is the distance at which
// the ray's line passes the centre: 1 through the centre, 0 on the silhouette, from any eye.
//
// Gardner's own g is the silhouette's conic on the picture, over its value at the conic's own centre:
// limb_on_picture(). The two are the same where the rays are parallel. Under perspective the conic's centre is not
// where the ellipsoid's centre is seen, and where the ellipsoid reaches behind the eye the conic is a hyperbola,
// which has no largest value.
std::optional<SphereHit> hit(const UnitSphere& sphere, const glm::dvec3& direction);

// The normal of the wall that a ray meets, away from the centre. Unit, in the scene's axes.
glm::dvec3 normal_of(const UnitSphere& sphere, const SphereHit& hit);

// How much a wall at `own` (distance along the ray) is shaded as one with another at `other`, 0..1: 1 where they cut
// through each other, and less the further apart they are, up to `width`.
double joined_share(double own, double other, double width);

// Gardner's f(x, z) = a1 x^2 + a2 z^2 + a3 xz + a4 x + a5 z + a6 for directions forward + x right + z up, scaled so
// that its value at its centre is 1; zero on the silhouette. None where the conic is no ellipse.
struct LimbCurve {
    double a1 = 0, a2 = 0, a3 = 0, a4 = 0, a5 = 0, a6 = 0;
    double operator()(double x, double z) const {
        return a1 * x * x + a2 * z * z + a3 * x * z + a4 * x + a5 * z + a6;
    }
};
std::optional<LimbCurve> limb_on_picture(const UnitSphere& sphere, const View& view);

// --- The scene as the look sees it

// A rectangle of pixels, both ends included; empty where x0 > x1.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
};

// An ellipsoid as the picture sees it.
struct SeenEllipsoid {
    UnitSphere sphere;
    PlacedEllipsoid placed;
    std::size_t cloud = 0;
    // It shows nowhere else.
    PixelBox box;
};

// A cloud as the picture sees it.
struct SeenCloud {
    const EllipsoidsCloud* model = nullptr;
    Motion motion{};
    TextureFunction in_space;
    PlaneTexture on_plane;
    // Scene units; none where the cloud has no plane.
    std::optional<double> plane_height;
};

// All that a picture needs of the scene.
struct Frame {
    std::vector<SeenCloud> clouds;
    // Only those that may show in a pixel.
    std::vector<SeenEllipsoid> ellipsoids;
};

// textures: false leaves them out, for estimates.
Frame frame_of(const Scene& scene, const View& view, bool textures);

// The radiances of white. The share `ambient` of a surface's I is lit by the sky, the rest by the sun; a grey I has
// the same luminance in both. White is as bright as sunlit cloud (a reflectance of 1/2) with the sky's light, where
// automatic exposure expects it.
struct Whites {
    glm::dvec3 sunlit{0}, ambient{0};
};
Whites whites_of(const Scene& scene);

}  // namespace awan::gardner
