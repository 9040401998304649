// Pass 2: Gaussian particles blended front to back, per pixel (document 000, eq. 3.13 with S = a (1 - e^-tau) p I / 4 pi).
//
// A work group draws a tile of 16 x 16 pixels, a work item a column of 16 of them, four by four in vectors. A particle's
// optical depth along a pixel's ray d is exact in perspective: tau exp(-|q x d|^2 / (2 s^2 |d|^2)), and in a column
// |q x d|^2 = C (Y - Y0)^2 + m with no cancellation. Where the eye is close, only the half line before it counts.
// Light and phase function are evaluated where the fragment is: at the ray's closest point to the centre.
layout(local_size_x = 16) in;

#include "optics.glsl"
#include "phase.glsl"
#include "sky.glsl"

struct Splat {
    vec4 place;   // centre in the eye's frame (right, up, forward), 1 / (2 s^2)
    vec4 matter;  // tau through the centre, 1 / s when the eye is close else 0, C = x^2 + z^2, y / C
    vec4 direct;  // sun light that was not scattered: gradient (eye's frame), value at the eye (!)
    vec4 red, green, blue;  // radiance scattered from all other light, likewise
    vec4 tint;    // albedo * colour * sun irradiance / 4 pi; upper bound of red, green, blue
};
layout(std430, binding = 0) readonly buffer Splats { Splat splats[]; };
layout(std430, binding = 1) readonly buffer TileBegin { uint tile_begin[]; };
layout(std430, binding = 2) readonly buffer TileItems { uint tile_items[]; };
layout(std430, binding = 3) writeonly buffer Picture { vec4 picture[]; };

layout(location = 0) uniform ivec4 region;    // of tiles: first x, first y, count x, count y
layout(location = 1) uniform ivec2 size;      // of the whole picture, pixels
layout(location = 2) uniform vec2 tangent;    // half width and half height of the image plane at distance 1
layout(location = 3) uniform vec3 to_sun;     // unit, eye's frame
layout(location = 4) uniform vec3 vertical;   // scene's y axis in the eye's frame
layout(location = 5) uniform vec3 zenith;     // sky radiance; black for none
layout(location = 6) uniform vec3 horizon;
layout(location = 7) uniform float g;
layout(location = 8) uniform bool is_cornette_shanks;
layout(location = 9) uniform bool extinguish;  // effect view_extinction
layout(location = 10) uniform bool opaque;     // the sky behind

// Below this transmittance nothing behind can change an 8-bit or half-float pixel; the rest of the list is skipped.
const float kOpaque = 1e-6;

void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 pixel = (region.xy + tile) * 16 + ivec2(int(gl_LocalInvocationID.x), 0);
    float X = ((float(pixel.x) + 0.5) / float(size.x) * 2.0 - 1.0) * tangent.x;

    vec4 Y[4], per_d2[4], phase[4], left[4], red[4], green[4], blue[4];
    for (int r = 0; r < 4; ++r) {
        vec4 row = vec4(float(pixel.y + 4 * r)) + vec4(0.5, 1.5, 2.5, 3.5);
        Y[r] = (1.0 - row / float(size.y) * 2.0) * tangent.y;
        per_d2[r] = 1.0 / (1.0 + X * X + Y[r] * Y[r]);
        for (int c = 0; c < 4; ++c) {
            vec3 ray = vec3(X, Y[r][c], 1.0) * sqrt(per_d2[r][c]);
            phase[r][c] = is_cornette_shanks ? cornette_shanks(to_sun, ray, g) : henyey_greenstein(to_sun, ray, g);
        }
        left[r] = vec4(1.0);
        red[r] = green[r] = blue[r] = vec4(0.0);
    }

    int list = tile.y * region.z + tile.x;
    uint end = tile_begin[list + 1];
    for (uint i = tile_begin[list]; i < end; ++i) {
        Splat p = splats[tile_items[i]];
        bool close = p.matter.y > 0.0;
        float aside = p.place.z * X - p.place.x;
        float y0 = p.matter.w * (p.place.z + p.place.x * X);
        float a = p.matter.z * p.place.w;
        float m = aside * aside * (1.0 + p.place.y * p.matter.w) * p.place.w;
        float along = p.place.x * X + p.place.z;
        float direct_x = p.direct.x * X + p.direct.z;
        float red_x = p.red.x * X + p.red.z;
        float green_x = p.green.x * X + p.green.z;
        float blue_x = p.blue.x * X + p.blue.z;

        for (int r = 0; r < 4; ++r) {
            vec4 t = (along + p.place.y * Y[r]) * per_d2[r];  // of the closest point, in units of d
            vec4 off = Y[r] - y0;
            vec4 miss = a * off * off + m;
            vec4 tau;
            if (close) {
                vec4 up = p.place.y - p.place.z * Y[r], over = p.place.x * Y[r] - p.place.y * X;
                miss = (up * up + aside * aside + over * over) * p.place.w;
                tau = p.matter.x * exp(-miss * per_d2[r]) * normal_cdf(t * inversesqrt(per_d2[r]) * p.matter.y);
                t = max(t, 0.0);
            } else {
                tau = p.matter.x * exp(-miss * per_d2[r]);
            }
            vec4 alpha = one_minus_exp(tau);
            vec4 weight = extinguish ? left[r] * alpha : alpha;
            left[r] -= left[r] * alpha;
            vec4 direct = clamp(p.direct.w + t * (direct_x + p.direct.y * Y[r]), 0.0, 1.0) * phase[r];
            red[r] += weight * (clamp(p.red.w + t * (red_x + p.red.y * Y[r]), 0.0, p.tint.w) + direct * p.tint.x);
            green[r] += weight * (clamp(p.green.w + t * (green_x + p.green.y * Y[r]), 0.0, p.tint.w) + direct * p.tint.y);
            blue[r] += weight * (clamp(p.blue.w + t * (blue_x + p.blue.y * Y[r]), 0.0, p.tint.w) + direct * p.tint.z);
        }
        if (extinguish && (i & 7u) == 7u) {
            vec4 most = max(max(left[0], left[1]), max(left[2], left[3]));
            if (max(max(most.x, most.y), max(most.z, most.w)) < kOpaque) break;
        }
    }

    if (pixel.x >= size.x) return;
    int stride = region.z * 16;
    int at = tile.y * 16 * stride + tile.x * 16 + int(gl_LocalInvocationID.x);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) {
            vec3 color = vec3(red[r][c], green[r][c], blue[r][c]);
            float alpha = 1.0 - left[r][c];
            if (opaque) {
                float up = (vertical.x * X + vertical.y * Y[r][c] + vertical.z) * sqrt(per_d2[r][c]);
                color += left[r][c] * sky_radiance(up, zenith, horizon);
                alpha = 1.0;
            }
            picture[at + (4 * r + c) * stride] = vec4(color, alpha);
        }
}
