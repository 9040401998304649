#include "core/generate/implicit/field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>

#include "core/scene/limits.h"

namespace awan::implicit {
namespace {

using lanes::all;
using lanes::Floats;
using lanes::Vec;

// The warps below take a point p to where the matter was that is seen at p.

// By the table of vectors v, trilinear between its entries: p - v(p).
AWAN_INLINE void warp_by_flow(const PreparedFlow& flow, Vec& p) {
    for (int lane = 0; lane < lanes::kCount; ++lane) {
        const float at[3] = {p.x[lane], p.y[lane], p.z[lane]};
        int low[3], high[3];
        float part[3];
        for (int axis = 0; axis < 3; ++axis) {
            const float most = static_cast<float>(flow.size[axis] - 1);
            const float index = (at[axis] - flow.min[axis]) * flow.steps[axis];
            const float inside = index > 0 ? (index < most ? index : most) : 0.0f;
            low[axis] = static_cast<int>(inside);
            high[axis] = low[axis] + 1 < flow.size[axis] ? low[axis] + 1 : low[axis];
            part[axis] = inside - static_cast<float>(low[axis]);
        }
        glm::vec3 sum(0);
        for (int corner = 0; corner < 8; ++corner) {
            const bool ux = (corner & 1) != 0, uy = (corner & 2) != 0, uz = (corner & 4) != 0;
            const int index =
                ((uz ? high[2] : low[2]) * flow.size[1] + (uy ? high[1] : low[1])) * flow.size[0] +
                (ux ? high[0] : low[0]);
            const float w = (ux ? part[0] : 1 - part[0]) * (uy ? part[1] : 1 - part[1]) *
                            (uz ? part[2] : 1 - part[2]);
            const glm::vec3& v = flow.vectors[static_cast<std::size_t>(index)];
            sum.x += w * v.x, sum.y += w * v.y, sum.z += w * v.z;
        }
        p.x[lane] -= sum.x, p.y[lane] -= sum.y, p.z[lane] -= sum.z;
    }
}

// Along the line from the attractor's place q, by Wyvill's cubic h: p + strength h(|p - q| / reach) (p - q).
AWAN_INLINE void warp_by_attractor(const PreparedAttractor& a, Vec& p) {
    const Floats x = p.x - a.at.x, y = p.y - a.at.y, z = p.z - a.at.z;
    const Floats h = a.strength * wyvill((x * x + y * y + z * z) * (a.inverse * a.inverse));
    p.x += h * x, p.y += h * y, p.z += h * z;
}

// About the vortex' axis k through its place q, by the angle a = -angle h(|p - q| / reach). Rodrigues' rotation of d =
// p - q:
//   q + cos a d + sin a (k x d) + (1 - cos a) (k . d) k.
AWAN_INLINE void warp_by_vortex(const PreparedVortex& v, Vec& p) {
    const Floats x = p.x - v.at.x, y = p.y - v.at.y, z = p.z - v.at.z;
    const Floats turns = -v.turns * wyvill((x * x + y * y + z * z) * (v.inverse * v.inverse));
    const Floats s = lanes::sin_turns(turns), c = lanes::sin_turns(turns + 0.25f);
    const glm::vec3& k = v.axis;
    const Floats along = (k.x * x + k.y * y + k.z * z) * (1.0f - c);
    p.x = v.at.x + (c * x + s * (k.y * z - k.z * y) + along * k.x);
    p.y = v.at.y + (c * y + s * (k.z * x - k.x * z) + along * k.y);
    p.z = v.at.z + (c * z + s * (k.x * y - k.y * x) + along * k.z);
}

// Where in the noise a point lies: stretched along the jet stream, and moved along the noise's path.
AWAN_INLINE Vec in_noise_space(const ImplicitField& f, const Vec& p) {
    const glm::vec3& axis = f.stretch_axis;
    const Floats less = (p.x * axis.x + p.y * axis.y + p.z * axis.z) * f.stretch_less;
    Vec n{(p.x + less * axis.x) * f.noise_scale, (p.y + less * axis.y) * f.noise_scale,
          (p.z + less * axis.z) * f.noise_scale};
    // The path's offset is in the octaves' lattices already; this is the rest of what the path does to the place.
    const Floats peach = noise(f.path_noise, n);
    n.x += peach * f.path_scale.x, n.y += peach * f.path_scale.y, n.z += peach * f.path_scale.z;
    return n;
}

// The point moved by turbulence: all along (1, -1, 1) by t, as Ebert 2002 prints it, or along each axis by a noise of
// its own.
AWAN_INLINE Vec displaced(const ImplicitField& f, const Vec& p, const Vec& n, const Floats& t) {
    const float most = f.displacement;
    if (!(most > 0)) return p;
    if (f.diagonal) {
        const Floats d = most * lanes::min(t, all(1.0f));
        return {p.x + d, p.y - d, p.z + d};
    }
    const Vec b = brownian3(f.moving, n);
    return {p.x + most * lanes::clamp(b.x, -1, 1), p.y + most * lanes::clamp(b.y, -1, 1),
            p.z + most * lanes::clamp(b.z, -1, 1)};
}

// All warps. The jet stream blows what is at the top so far, and what is at the bottom not at all.
AWAN_INLINE void warp(const ImplicitField& f, const Floats& t, Vec& p) {
    const Floats height = lanes::clamp((p.y - f.jet_floor) * f.jet_slope, 0, 1);
    const Floats more = f.jet_turbulence * lanes::min(t, all(1.0f));
    p.x -= height * (f.jet.x + 0.2f * more);
    p.y -= height * (f.jet.y + 0.3f * more);
    p.z -= height * (f.jet.z + 0.25f * more);
    if (f.flow.any) warp_by_flow(f.flow, p);
    for (const PreparedAttractor& a : f.attractors) warp_by_attractor(a, p);
    for (const PreparedVortex& v : f.vortices) warp_by_vortex(v, p);
}

// Where the matter is when nothing is squashed that is seen at p.
AWAN_INLINE Vec unsquashed(const ImplicitField& f, const Vec& p) {
    const glm::mat3 m(f.unsquash);
    const glm::vec3 at(f.squash_at);
    const Floats x = p.x - at.x, y = p.y - at.y, z = p.z - at.z;
    return {at.x + (m[0].x * x + m[1].x * y + m[2].x * z),
            at.y + (m[0].y * x + m[1].y * y + m[2].y * z),
            at.z + (m[0].z * x + m[1].z * y + m[2].z * z)};
}

// Mackerel: 1 - depth (1 - s_x s_y s_z), s = (1 + sin(2 pi x / wavelength + turbulence t)) / 2 along each axis that has
// a wavelength.
AWAN_INLINE Floats ripples(const ImplicitField& f, const Vec& p, const Floats& t) {
    Floats product = all(1.0f);
    const auto along = [&](float inverse, const Floats& x) __attribute__((always_inline)) {
        if (inverse > 0)
            product *= 0.5f + 0.5f * lanes::sin_turns(lanes::clamp(x * inverse + f.ripple_turns * t,
                                                                   -kNoiseReach, kNoiseReach));
    };
    along(f.ripple.x, p.x);
    along(f.ripple.y, p.y);
    along(f.ripple.z, p.z);
    return 1.0f - f.ripple_depth * (1.0f - product);
}

// The density at sixteen points p, in the frame (Ebert 2002, procedure cumulus()): turbulence t moves the point, the
// primitives there give m, and
//   density = (p1 m (p3 + (1 - p3) t) * ripples * base)^p2,    p1 amount, p2 exponent, p3 blend,
// cut at limits::kMaxImplicitDensity.
// Also says m and t.
AWAN_INLINE Floats density(const ImplicitField& f, const std::uint32_t* list, int count,
                           const Vec& seen, Floats& m, Floats& t) {
    const Vec p = f.squashed ? unsquashed(f, seen) : seen;
    const Vec n = in_noise_space(f, p);
    t = turbulence(f.octaves, n);
    const Vec moved = displaced(f, p, n, t);
    Vec at = moved;
    if (f.warped) warp(f, t, at);
    m = macro_density(f.elements.data(), list, count, at);
    Floats x = f.amount * (m * f.blend + (1.0f - f.blend) * t * m);
    if (f.ripple_depth > 0) x *= ripples(f, p, t);
    if (f.has_base) {
        // The base is wavy, by a quarter of what the displacement does there.
        const Floats s =
            lanes::clamp((0.75f * p.y + 0.25f * moved.y - f.base) * f.base_inverse, 0, 1);
        x *= s * s * (3.0f - 2.0f * s);
    }
    if (f.exponent == 0.5f)
        x = lanes::sqrt(x);
    else if (f.exponent != 1)
        x = lanes::power(x, f.exponent);
    return lanes::min(x, all(static_cast<float>(limits::kMaxImplicitDensity)));
}

// What the user's formula makes of the density d.
AWAN_INLINE Floats by_formula(const ImplicitField& f, const Vec& p, const Floats& d,
                              const Floats& m, const Floats& t) {
    FormulaPlaces at;
    const auto put = [](float* to, const Floats& x) __attribute__((always_inline)) {
        std::memcpy(to, &x, sizeof x);
    };
    put(at.x, p.x), put(at.y, p.y), put(at.z, p.z);
    put(at.density, d), put(at.primitives, m), put(at.turbulence, t);
    float out[lanes::kCount];
    run_formula(*f.formula, f.elements.data(), at, out);
    Floats said;
    std::memcpy(&said, out, sizeof said);
    return said;
}

// The densities of `cells` points from `first` on, `step` apart along x; all in the frame.
AWAN_INLINE void run_row_body(const ImplicitField& f, const std::uint32_t* list, int count,
                              const glm::dvec3& first, double step, int cells, float* out) {
    for (int begin = 0; begin < cells; begin += lanes::kCount) {
        Vec p{Floats{}, all(static_cast<float>(first.y)), all(static_cast<float>(first.z))};
        for (int lane = 0; lane < lanes::kCount; ++lane)
            p.x[lane] = static_cast<float>(first.x + step * (begin + lane));
        Floats m, t;
        Floats d = density(f, list, count, p, m, t);
        if (f.formula != nullptr) d = by_formula(f, p, d, m, t);
        for (int lane = 0; lane < std::min(lanes::kCount, cells - begin); ++lane)
            out[begin + lane] = d[lane];
    }
}
AWAN_KERNEL(void, run_row,
            (const ImplicitField& f, const std::uint32_t* list, int count, const glm::dvec3& first,
             double step, int cells, float* out),
            (f, list, count, first, step, cells, out))

}  // namespace

void row_densities(const ImplicitField& field, const std::vector<std::uint32_t>& list,
                   const CellRow& row, float* out) {
    if (list.empty() && field.formula == nullptr) {
        std::fill(out, out + row.count, 0.0f);
        return;
    }
    const Frame& frame = field.frame;
    run_row(field, list.data(), static_cast<int>(list.size()),
            (row.first - frame.middle) / frame.unit, row.step / frame.unit, row.count, out);
}

double density_at(const ImplicitField& field, const glm::dvec3& p) {
    std::vector<std::uint32_t> list(field.elements.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = static_cast<std::uint32_t>(i);
    float density = 0;
    row_densities(field, list, {p, 0, 1}, &density);
    return static_cast<double>(density);
}

}  // namespace awan::implicit
