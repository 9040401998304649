// Pass 1, step 1: optical depth from a light to every point of a volume that faces it.
//
// A column of the volume is one line from the light through one texel. Each particle adds its whole optical depth
// (and its gain depth, optics.glsl) on that line, spread along the line as its mass is: the fraction before depth z
// is the normal distribution of (z - centre) / s. So between particles the light obeys the recurrence (3.12)
// exactly, and within one it falls off as its Gaussian does. Columns do not need each other: there is no order to keep.
layout(local_size_x = 8, local_size_y = 8) in;

#include "optics.glsl"

struct LightParticle {
    vec4 place;   // u, v (texels), depth (slabs), 1 / (2 s^2) in texels^-2
    vec4 matter;  // optical depth through the centre, 1 / s in slabs^-1, 4 s in slabs, unused
};
layout(std430, binding = 0) readonly buffer Particles { LightParticle particles[]; };
layout(std430, binding = 1) readonly buffer TileBegin { uint tile_begin[]; };
layout(std430, binding = 2) readonly buffer TileItems { uint tile_items[]; };
layout(std430, binding = 3) writeonly buffer Volume { vec2 volume[]; };  // plain, with gain

layout(location = 0) uniform ivec3 cells;   // texels u, texels v, slabs
layout(location = 1) uniform ivec4 region;  // of tiles: first u, first v, count u, count v
layout(location = 2) uniform float gain;

// Slabs a work item carries in its registers.
const int kSlabs = 8;

void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 texel = (region.xy + tile) * 8 + ivec2(gl_LocalInvocationID.xy);
    int first = int(gl_WorkGroupID.z) * kSlabs;
    vec4 depth_a = vec4(first) + vec4(0.0, 1.0, 2.0, 3.0);
    vec4 depth_b = depth_a + 4.0;
    vec4 plain_a = vec4(0.0), plain_b = vec4(0.0), gained_a = vec4(0.0), gained_b = vec4(0.0);

    int list = tile.y * region.z + tile.x;
    uint end = tile_begin[list + 1];
    for (uint i = tile_begin[list]; i < end; ++i) {
        LightParticle p = particles[tile_items[i]];
        if (p.place.z - p.matter.z > depth_b.w) continue;  // behind all of these slabs
        vec2 apart = vec2(texel) - p.place.xy;
        float tau = p.matter.x * exp(-dot(apart, apart) * p.place.w);
        float gained = gain_depth(tau, gain);
        vec4 share_a = vec4(1.0), share_b = vec4(1.0);
        if (p.place.z + p.matter.z > depth_a.x) {
            share_a = normal_cdf((depth_a - p.place.z) * p.matter.y);
            share_b = normal_cdf((depth_b - p.place.z) * p.matter.y);
        }
        plain_a += tau * share_a;
        plain_b += tau * share_b;
        gained_a += gained * share_a;
        gained_b += gained * share_b;
    }

    if (texel.x >= cells.x || texel.y >= cells.y) return;
    int stride = cells.x * cells.y;
    int at = first * stride + texel.y * cells.x + texel.x;
    for (int k = 0; k < 4; ++k) {
        volume[at + k * stride] = vec2(plain_a[k], gained_a[k]);
        volume[at + (k + 4) * stride] = vec2(plain_b[k], gained_b[k]);
    }
}
