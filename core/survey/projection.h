// Where a ball appears in a picture.
#pragma once

#include <glm/vec3.hpp>

namespace awan {

struct Interval {
    double low, high;  // low > high: nothing
};

// The values of x / z that the points with z > 0 of a disc take, as seen from the origin. (x, z):
// its centre; radius > 0.
// +-infinity where the disc reaches behind the eye; the whole line when it holds the eye.
// Mara & McGuire 2013, "2D polyhedral bounds of a clipped, perspective-projected 3D sphere".
Interval disc_slopes(double x, double z, double radius);

// The pixels along one side of a picture that see slopes `low` to `high`, in pixels from the middle of the first one
// (within +-1e7), and those of them whose middle does: first > last: none. tangent: of half the side's angle; up:
// rows count downward.
struct PixelSpan {
    double low, high;
    int first, last;
};
PixelSpan pixels_between(Interval slopes, double tangent, int pixels, bool up);

// A right-handed orthonormal pair beside the unit vector `axis`; continuous but at one point.
// Duff et al. 2017, "Building an orthonormal basis, revisited".
struct SideAxes {
    glm::dvec3 u, v;
};
SideAxes side_axes(glm::dvec3 axis);

}  // namespace awan
