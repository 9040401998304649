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
// Two a particle, one for each component of light_at(): gradient in xyz, value in w.
layout(std430, binding = 2) writeonly buffer Samples { vec4 samples[]; };

layout(location = 0) uniform ivec3 cells;
layout(location = 1) uniform int count;
// What a step of one scene unit along x, y or z is in texels along u, in texels along v, ...
layout(location = 2) uniform vec3 axis_u;
layout(location = 3) uniform vec3 axis_v;
// ... and in slabs.
layout(location = 4) uniform vec3 axis_depth;
layout(location = 5) uniform bool from_sky;

vec2 slab_at(ivec2 a, ivec2 b, vec2 f, int slab) {
    int base = slab * cells.x * cells.y;
    vec2 low = mix(volume[base + a.y * cells.x + a.x], volume[base + a.y * cells.x + b.x], f.x);
    vec2 high = mix(volume[base + b.y * cells.x + a.x], volume[base + b.y * cells.x + b.x], f.x);
    return mix(low, high, f.y);
}

// From the sun: unscattered light, and light that was scattered forward on its way. From the sky: light from its
// upper half, and from its lower half.
vec2 light_at(vec3 p) {
    vec2 q = clamp(p.xy, vec2(0.0), vec2(cells.xy - 1));
    ivec2 a = ivec2(q);
    ivec2 b = min(a + 1, cells.xy - 1);
    vec2 f = q - vec2(a);
    float z = clamp(p.z, 0.0, float(cells.z - 1));
    int k = min(int(z), cells.z - 2);
    vec2 depth = mix(slab_at(a, b, f, k), slab_at(a, b, f, k + 1), z - float(k));
    if (from_sky) {
        float whole = slab_at(a, b, f, cells.z - 1).y;
        return exp(-vec2(depth.y, max(whole - depth.y, 0.0)));
    }
    vec2 through = exp(-depth);
    return vec2(through.x, max(through.y - through.x, 0.0));
}

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= count) return;
    vec4 point = points[i].place;
    vec3 step_x = point.w * vec3(axis_u.x, axis_v.x, axis_depth.x);
    vec3 step_y = point.w * vec3(axis_u.y, axis_v.y, axis_depth.y);
    vec3 step_z = point.w * vec3(axis_u.z, axis_v.z, axis_depth.z);
    vec2 right = light_at(point.xyz + step_x), left = light_at(point.xyz - step_x);
    vec2 above = light_at(point.xyz + step_y), below = light_at(point.xyz - step_y);
    vec2 front = light_at(point.xyz + step_z), back = light_at(point.xyz - step_z);
    vec2 mean = (right + left + above + below + front + back) / 6.0;
    float scale = point.w > 0.0 ? 0.5 / point.w : 0.0;
    samples[2 * i] = vec4(scale * vec3(right.x - left.x, above.x - below.x, front.x - back.x), mean.x);
    samples[2 * i + 1] = vec4(scale * vec3(right.y - left.y, above.y - below.y, front.y - back.y), mean.y);
}
