// Pass 1, step 3: the light on each particle, as a value at its centre and a gradient.
//
// Six points lie around the centre, at distance r along the scene's axes. The mean of their values is the value; half
// the difference of two opposite ones over r is the gradient along that axis.
layout(local_size_x = 64) in;

struct SamplePoint {
    // The centre's u, v (texels) and depth (slabs), and the distance r of the six points, scene units.
    vec4 place;
};
layout(std430, binding = 0) readonly buffer Points { SamplePoint points[]; };
layout(std430, binding = 1) readonly buffer Volume { vec2 volume[]; };
// Three a particle, one for each component of light_at(): gradient in xyz, value in w.
layout(std430, binding = 2) writeonly buffer Samples { vec4 samples[]; };

layout(location = 0) uniform ivec3 cells;
layout(location = 1) uniform int count;
// What a step of one scene unit along x, y or z is in texels along u, in texels along v, ...
layout(location = 2) uniform vec3 axis_u;
layout(location = 3) uniform vec3 axis_v;
// ... and in slabs.
layout(location = 4) uniform vec3 axis_depth;
layout(location = 5) uniform bool from_sky;
// Of light that is scattered about: the share of an optical depth that turns it, 1 - a g; k, by which it falls off with
// that depth where matter absorbs, sqrt(3 (1 - a) / (1 - a g)); and the share of the sun's that is kept between the
// cloud's sides. The first is negative where scattered light is lost.
layout(location = 6) uniform vec3 about;

vec2 slab_at(ivec2 a, ivec2 b, vec2 f, int slab) {
    int base = slab * cells.x * cells.y;
    vec2 low = mix(volume[base + a.y * cells.x + a.x], volume[base + a.y * cells.x + b.x], f.x);
    vec2 high = mix(volume[base + b.y * cells.x + a.x], volume[base + b.y * cells.x + b.x], f.x);
    return mix(low, high, f.y);
}

// The hyperbolic sine of k x over k, and the cosine, both over e^(k x). k > 0.
vec2 hyperbolic(float x, float k) {
    float e = exp(-2.0 * k * x);
    return vec2((1.0 - e) / (2.0 * k), (1.0 + e) / 2.0);
}

// The fluence, over the open sky's, that half a sky sends into a layer of depth w down to where x of it is left: of
//     F' = -3 H,    H' = -(k^2 / 3) F,    F + 2 H = 4 where it enters,    F = 2 H where it leaves,
// half of F. Without absorption, or where there is too little to absorb in, it is 2 (2 + 3 x) / (4 + 3 w).
float from_half_sky(float x, float w, float k) {
    if (k * w < 0.01) return 2.0 * (2.0 + 3.0 * x) / (4.0 + 3.0 * w);
    vec2 here = hyperbolic(x, k), whole = hyperbolic(w, k);
    return 2.0 * exp(-k * (w - x)) * (2.0 * here.y + 3.0 * here.x) /
           (4.0 * whole.y + (3.0 + 4.0 / 3.0 * k * k) * whole.x);
}

// The fluence in a layer under a beam (light/light.h). What absorption takes is not exact: what a layer without end
// sends back, and the fall of light with depth.
float under_beam(float t, float w, float k) {
    float c = (5.0 - exp(-w)) / (4.0 + 3.0 * w);
    float back = max((1.0 - k * (2.0 / 3.0)) / (1.0 + k * (2.0 / 3.0)), 0.0);
    return back * exp(-k * t) * (5.0 - 2.0 * c - 3.0 * c * t - 2.0 * exp(-t));
}

// From the sun: unscattered light, light that was scattered forward on its way, and light that is scattered about. From
// the sky: light from its upper half, and from its lower half.
vec3 light_at(vec3 p) {
    vec2 q = clamp(p.xy, vec2(0.0), vec2(cells.xy - 1));
    ivec2 a = ivec2(q);
    ivec2 b = min(a + 1, cells.xy - 1);
    vec2 f = q - vec2(a);
    float z = clamp(p.z, 0.0, float(cells.z - 1));
    int k = min(int(z), cells.z - 2);
    vec2 depth = mix(slab_at(a, b, f, k), slab_at(a, b, f, k + 1), z - float(k));
    vec2 whole = max(slab_at(a, b, f, cells.z - 1), depth);
    float t = about.x * depth.x, w = about.x * whole.x;
    if (from_sky) {
        if (about.x < 0.0) return vec3(exp(-vec2(depth.y, whole.y - depth.y)), 0.0);
        return vec3(from_half_sky(w - t, w, about.y), from_half_sky(t, w, about.y), 0.0);
    }
    vec2 through = exp(-depth);
    float scattered = max(through.y - through.x, 0.0);
    float diffuse = about.x < 0.0 ? 0.0 : about.z * max(under_beam(t, w, about.y) - through.y, 0.0);
    return vec3(through.x, scattered, diffuse);
}

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= count) return;
    vec4 point = points[i].place;
    vec3 step_x = point.w * vec3(axis_u.x, axis_v.x, axis_depth.x);
    vec3 step_y = point.w * vec3(axis_u.y, axis_v.y, axis_depth.y);
    vec3 step_z = point.w * vec3(axis_u.z, axis_v.z, axis_depth.z);
    vec3 right = light_at(point.xyz + step_x), left = light_at(point.xyz - step_x);
    vec3 above = light_at(point.xyz + step_y), below = light_at(point.xyz - step_y);
    vec3 front = light_at(point.xyz + step_z), back = light_at(point.xyz - step_z);
    vec3 mean = (right + left + above + below + front + back) / 6.0;
    float scale = point.w > 0.0 ? 0.5 / point.w : 0.0;
    samples[3 * i] = vec4(scale * vec3(right.x - left.x, above.x - below.x, front.x - back.x), mean.x);
    samples[3 * i + 1] = vec4(scale * vec3(right.y - left.y, above.y - below.y, front.y - back.y), mean.y);
    samples[3 * i + 2] = vec4(scale * vec3(right.z - left.z, above.z - below.z, front.z - back.z), mean.z);
}
