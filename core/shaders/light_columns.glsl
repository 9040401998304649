// Pass 1, step 1: how much optical depth each slab of each column of a volume holds; the columns run from a light away.
//
// A column is one line from the light through one texel. Each particle adds its whole optical depth on that line (and its
// gain depth, optics.glsl), spread over the slabs as its mass is. Summed up along the column (light_sums.glsl), that is the
// recurrence (3.12) exactly between particles, and within one the light falls off as its Gaussian does. Columns do
// not need each other and sums have no order to keep.
layout(local_size_x = 8, local_size_y = 8) in;

#include "optics.glsl"

// Two texels a particle: u, v (texels), depth (slabs), 1 / (2 s^2) in texels^-2;
// optical depth through the centre, 1 / (2 kSpread s) in slabs^-1. A buffer texture, since llvmpipe fetches a vec4 of it
// in a tenth of the time that four words of a storage buffer take.
layout(binding = 0) uniform samplerBuffer particles;
layout(std430, binding = 1) readonly buffer TileBegin { uint tile_begin[]; };
layout(std430, binding = 2) readonly buffer TileItems { uint tile_items[]; };
layout(std430, binding = 3) writeonly buffer Volume { vec2 volume[]; };  // plain, with gain

layout(location = 0) uniform ivec3 cells;   // texels u, texels v, slabs
layout(location = 1) uniform ivec4 region;  // of tiles: first u, first v, count u, count v
layout(location = 2) uniform float gain;

// Part of a Gaussian's mass before depth z, x = (z - centre) / (2 kSpread s): a smooth step in place of the error
// function, within .02 of it.
vec4 share_before(vec4 x) {
    vec4 t = clamp(x + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

void main() {
    ivec3 tile = ivec3(gl_WorkGroupID);
    ivec2 texel = (region.xy + tile.xy) * 8 + ivec2(gl_LocalInvocationID.xy);
    float first = float(tile.z * 8);
    vec4 depth_a = vec4(first) + vec4(-1.0, 0.0, 1.0, 2.0);  // of the slabs' near sides
    vec4 depth_b = depth_a + 4.0;
    vec4 plain_a = vec4(0.0), plain_b = vec4(0.0), gained_a = vec4(0.0), gained_b = vec4(0.0);

    int list = (tile.z * region.w + tile.y) * region.z + tile.x;
    uint end = tile_begin[list + 1];
    for (uint i = tile_begin[list]; i < end; ++i) {
        int at = int(tile_items[i]) * 2;
        vec4 place = texelFetch(particles, at);
        vec4 matter = texelFetch(particles, at + 1);
        vec2 apart = vec2(texel) - place.xy;
        float tau = matter.x * exp(-dot(apart, apart) * place.w);
        float gained = gain_depth(tau, gain);
        vec4 before_a = share_before((depth_a - place.z) * matter.y);
        vec4 before_b = share_before((depth_b - place.z) * matter.y);
        float before_end = share_before(vec4((first + 7.0 - place.z) * matter.y)).x;
        vec4 share_a = vec4(before_a.yzw, before_b.x) - before_a;
        vec4 share_b = vec4(before_b.yzw, before_end) - before_b;
        plain_a += tau * share_a;
        plain_b += tau * share_b;
        gained_a += gained * share_a;
        gained_b += gained * share_b;
    }

    if (texel.x >= cells.x || texel.y >= cells.y) return;
    int stride = cells.x * cells.y;
    int to = tile.z * 8 * stride + texel.y * cells.x + texel.x;
    volume[to] = vec2(plain_a.x, gained_a.x);
    volume[to + stride] = vec2(plain_a.y, gained_a.y);
    volume[to + 2 * stride] = vec2(plain_a.z, gained_a.z);
    volume[to + 3 * stride] = vec2(plain_a.w, gained_a.w);
    volume[to + 4 * stride] = vec2(plain_b.x, gained_b.x);
    volume[to + 5 * stride] = vec2(plain_b.y, gained_b.y);
    volume[to + 6 * stride] = vec2(plain_b.z, gained_b.z);
    volume[to + 7 * stride] = vec2(plain_b.w, gained_b.w);
}
