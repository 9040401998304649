// Pass 2: Gaussian particles blended front to back, per pixel (Harris & Lastra 2001):
//   E_k = S_k + T_k E_(k-1),    S = a (1 - e^-tau) p I / 4 pi,    T = e^-tau.
// Print has S = a tau p I / 4 pi (Sunar et al. 2005, below (3.13)), which is not bounded by the light that arrives.
//
// A work group draws a tile of 8 x 16 pixels; a work item draws a column of 16 of them, four by four in vectors. A
// particle's optical depth along a pixel's ray d is exact in perspective,
//   tau exp(-|q x d|^2 / (2 s^2 |d|^2)),    q: from the eye to the centre,
// and in a column |q x d|^2 = C (Y - Y0)^2 + m, without cancellation.
//
// Where the program is compiled with PAINTED, particles may be billboards: squares that face the eye, through the
// particle's centre, and opaque as their texture says, which was made for about their optical depth
// (draw/billboards.h). With TINTED, too, textures have colours, by which the light that a billboard scatters is
// multiplied: "the polygon color is set to the scattering factor and the texture is modulated by this color" (Sunar et
// al. 2005, below (3.15), after Harris).
//
// Where it is compiled with DETAIL, a particle's depth is that of the lumps that its thin matter is gathered into, by
// the rule of generate/detail.h and with the field of the march. What is to be known of the line through a particle is
// looked up once, where it is the densest: at the point of the ray closest to the centre. Many particles overlap, at
// other points each, and together they are as smooth as the line.
//
// The program is compiled twice, since llvmpipe runs both sides of every branch: INTERIOR (effect `interior`) takes
// only the half line before the eye, for all particles, the other the whole line. Light and phase function are
// evaluated where the fragment is: at the point of the ray closest to the particle's centre.
layout(local_size_x = 8) in;

#include "optics.glsl"
#include "phase.glsl"
#include "sky.glsl"

// A particle: five vec4s. In a buffer texture, since llvmpipe fetches a vec4 of it in a tenth of the time that four
// words of a storage buffer take.
struct Splat {
    // Its centre in the eye's frame (right, up, forward), and 1 / (2 s^2). Right and up count from the line through the
    // eye and the window's middle.
    vec4 place;
    // Albedo * colour * the sun's irradiance / 4 pi, and the optical depth through the centre; of a billboard, what its
    // texture's opacity is multiplied by.
    vec4 matter;
    // Sunlight that was not scattered on its way: gradient in the eye's frame, and the value extrapolated to the eye
    // (not the value at the centre).
    vec4 direct;
    // Radiance scattered from all other light, at the centre, and the largest factor that may multiply it.
    vec4 other;
    // The factor on `other`: gradient in the eye's frame, and the value extrapolated to the eye.
    vec4 change;
};
layout(binding = 0) uniform samplerBuffer splats;
#ifdef PAINTED
// A particle: three vec4s. The axes of its texture in the eye's frame, to its right and up, over the square of half the
// square's side; with them the layer, or -1 where it is no billboard, and the mip level. Then the layer of its colours,
// and which share of `other` is the haze's, which they do not tint.
layout(binding = 1) uniform samplerBuffer billboards;
layout(binding = 2) uniform sampler2DArray textures;
#endif
#ifdef DETAIL
// The extinction of all particles together, in units of that below which detail gathers matter; and the field of its
// bumps (generate/detail.h).
layout(binding = 3) uniform sampler3D extinction;
layout(binding = 4) uniform sampler3D bumps;
// From the eye's frame to the coordinates of each.
layout(location = 14) uniform mat4x3 to_extinction;
layout(location = 18) uniform mat4x3 to_bumps;
// Detail's `keep` and softness, and the distance from the eye at which the largest bumps are as wide as pixels are
// apart.
layout(location = 22) uniform vec3 lump;
// sqrt(2 pi) times the extinction below which detail gathers matter, 1/unit.
layout(location = 23) uniform float gathered_below;
// How far a particle looks `extinction` up aside, at most (draw/splat_detail.h).
layout(location = 24) uniform vec3 at_most_aside;
#endif
#ifdef TINTED
layout(binding = 3) uniform sampler2DArray hues;
#endif
layout(std430, binding = 1) readonly buffer TileBegin { uint tile_begin[]; };
layout(std430, binding = 2) readonly buffer TileItems { uint tile_items[]; };
layout(std430, binding = 3) buffer Picture { vec4 picture[]; };

// The tiles of this dispatch: first x, first y, count along x, count along y.
layout(location = 0) uniform ivec4 region;
// Width and height of the window (draw/splats.h), pixels: of the whole picture, or of a part with finer pixels.
layout(location = 1) uniform ivec2 size;
// Half its width and half its height in the image plane at distance 1.
layout(location = 2) uniform vec2 tangent;
// Towards the sun: unit, in the eye's frame.
layout(location = 3) uniform vec3 to_sun;
// The scene's y axis in the eye's frame.
layout(location = 4) uniform vec3 vertical;
// The sky's radiances; black for no sky.
layout(location = 5) uniform vec3 zenith;
layout(location = 6) uniform vec3 horizon;
layout(location = 7) uniform float g;
layout(location = 8) uniform bool is_cornette_shanks;
// Of droplets, as phase.glsl takes it; fit.w is 0 for another phase function.
layout(location = 13) uniform vec4 fit;
// Whether effect view_extinction is on.
layout(location = 9) uniform bool extinguish;
// Whether the sky is drawn behind.
layout(location = 10) uniform bool opaque;
// The first entry of the lists to blend now, how many, and 1 where they are the last.
layout(location = 11) uniform ivec3 run;
// The window's middle in the image plane; 0 for the whole picture. In a fine window far from the picture's middle, the
// small distances between rays and particles are lost in differences of coordinates that count from the picture's
// middle. So they count from the window's; where X and Y below do, they are called local.
layout(location = 12) uniform vec2 middle;

// Below this transmittance the rest of the list is skipped: what is behind adds no more than a thousandth of itself, a
// quarter of an 8-bit step.
const float kOpaque = 1e-3;
#ifdef DETAIL
// As in generate/detail.h.
const float kMostGathered = 1.5;
#endif

// Four pixels of a column. Never in an array, since one that a loop indexes lives in memory on llvmpipe.
struct Pixels {
    // Of the rays d = (X, Y, 1): Y, local and not, 1 / |d|^2, and the phase function.
    vec4 local, Y, per_d2, phase;
    // Transmittance and radiance so far.
    vec4 left, red, green, blue;
};

// What is the same of a particle for a whole column: the terms that do not depend on Y. Its light is linear in the
// scene and almost linear in Y along a column, so it is expanded about the row nearest to the centre.
struct Column {
    float X, local, aside, y0, a, m, along;
    // Two linear functions of Y, x + y Y: direct sunlight, and the factor on the other light.
    vec2 direct, change;
#ifdef DETAIL
    // What aside_of gives for it.
    vec3 looked_aside;
#endif
#ifdef PAINTED
    // The same of what the texture's coordinates are times d q, and of that product.
    vec2 across, up, to_center;
    float layer, level;
#ifdef TINTED
    float hue, veil;
#endif
#endif
};

Splat fetch(int at) {
    return Splat(texelFetch(splats, at), texelFetch(splats, at + 1), texelFetch(splats, at + 2),
                 texelFetch(splats, at + 3), texelFetch(splats, at + 4));
}

// A linear function of the scene (f: gradient, value at the eye) as x + y Y on the rays (X, Y, 1) near Y = y. It is
// evaluated at the point t d of the ray that is closest to the centre; slope is the change of t with Y.
vec2 on_column(vec4 f, float X, float y, float t, float slope) {
    float along = f.x * X + f.z + f.y * y;
    float change = slope * along + t * f.y;
    return vec2(f.w + t * along - change * y, change);
}

// The row nearest to the centre q is Y0 = q.y (q.x X + q.z) / (q.x^2 + q.z^2). From the window's middle it is written
// with q.y less q.z times that middle, by q.z (q.x X + q.z) - q.x^2 - q.z^2 = q.x (q.z X - q.x).
Column on_column(Splat p, float local, float low, float high) {
    Column k;
    vec2 q = p.place.xy + p.place.z * middle;
    float c = q.x * q.x + p.place.z * p.place.z;
    float per_c = 1.0 / max(c, 1e-30);
    float ratio = q.y / max(c, 1e-30);
    k.local = local;
    k.X = middle.x + local;
    k.aside = p.place.z * local - p.place.x;
    k.along = q.x * k.X + p.place.z;
    k.y0 = p.place.y / max(c, 1e-30) * k.along + middle.y * q.x * per_c * k.aside;
    k.a = c * p.place.w;
    k.m = k.aside * k.aside * (1.0 + q.y * ratio) * p.place.w;
    float y = clamp(middle.y + k.y0, low, high);
    float per_d2 = 1.0 / (1.0 + k.X * k.X + y * y);
    float t = (k.along + q.y * y) * per_d2;
    float slope = (q.y - 2.0 * y * t) * per_d2;
#ifdef INTERIOR
    slope = t > 0.0 ? slope : 0.0;
    t = max(t, 0.0);
#endif
    k.direct = on_column(p.direct, k.X, y, t, slope);
    k.change = on_column(p.change, k.X, y, t, slope);
    return k;
}

#ifdef PAINTED
// A ray d meets the square's plane, which is at right angles to q, at t d with t = |q|^2 / (d q), and the axes are at
// right angles to q: t (d axis) is the place on the square.
void paint(int item, Splat p, inout Column k) {
    vec4 across = texelFetch(billboards, item * 3), up = texelFetch(billboards, item * 3 + 1);
    vec2 q = p.place.xy + p.place.z * middle;
    float q2 = dot(q, q) + p.place.z * p.place.z;
    k.across = q2 * vec2(across.x * k.X + across.z, across.y);
    k.up = q2 * vec2(up.x * k.X + up.z, up.y);
    k.to_center = vec2(k.along, q.y);
    k.layer = across.w;
    k.level = up.w;
#ifdef TINTED
    vec4 tint = texelFetch(billboards, item * 3 + 2);
    k.hue = tint.x;
    k.veil = tint.y;
#endif
}

// The first row of a texture is its highest. Beside the square there is none of it, and what would be infinite lies
// there.
vec2 on_texture(Column k, float Y, float ahead) {
    vec2 at = vec2(k.across.x + k.across.y * Y, -(k.up.x + k.up.y * Y)) / max(ahead, 1e-30);
    return clamp(0.5 + 0.5 * at, vec2(-1.0), vec2(2.0));
}

// Behind the eye there is nothing.
float opacity(Column k, float Y) {
    float ahead = k.to_center.x + k.to_center.y * Y;
    vec2 at = on_texture(k, Y, ahead);
    return ahead > 0.0 ? textureLod(textures, vec3(at, k.layer), k.level).x : 0.0;
}
#endif

#ifdef DETAIL
// generate/detail.h: what the depth of matter is multiplied by that has the extinction u, in units of that below which
// it is gathered, where the bumps are n.
vec4 gathered(vec4 u, vec4 n) {
    float soft = lump.y;
    u = max(u, 1e-3);
    vec4 v = 2.0 * u / (1.0 + u);
    vec4 ramp = clamp((n - 1.0 + v * (1.0 + soft)) / soft, 0.0, 1.0);
    vec4 a = 1.0 - v * (1.0 + soft), rest = 1.0 - a;
    vec4 early = rest * rest / (2.0 * soft), late = 1.0 - (a + soft) * (a + soft) / (2.0 * soft);
    vec4 share = mix(late, rest - 0.5 * soft, greaterThanEqual(a, vec4(0.0)));
    share = mix(share, early, greaterThanEqual(a, vec4(1.0 - soft)));
    vec4 gain = ramp * min(1.0 / max(share, 1e-6), kMostGathered / u);
    return mix(gain, vec4(1.0), greaterThanEqual(u, vec4(1.0)));
}

// Where the particle looks `extinction` up, in its coordinates, from where it is: the same for all of it, and evenly
// spread over particles (Roberts 2018, the R3 sequence).
vec3 aside_of(uint item) {
    return (fract(float(item) * vec3(0.8191725, 0.6710436, 0.5497005)) - 0.5) * at_most_aside;
}

// At the points t (X, Y, 1) of four rays. own: the particle's own extinction there.
vec4 detail_at(vec4 t, float X, vec4 Y, vec4 own, vec3 aside) {
    mat4x3 e = to_extinction, b = to_bumps;
    e[3] += aside;
    vec3 e0 = e[0] * X + e[2], b0 = b[0] * X + b[2];
    vec4 n;
    // Its voxels are as wide as particles are: four pixels in a row differ evenly.
    float first = texture(extinction, e[3] + t.x * (e0 + Y.x * e[1])).x;
    float last = texture(extinction, e[3] + t.w * (e0 + Y.w * e[1])).x;
    vec4 u = mix(vec4(first), vec4(last), vec4(0.0, 1.0, 2.0, 3.0) / 3.0);
    n.x = texture(bumps, b[3] + t.x * (b0 + Y.x * b[1])).x;
    n.y = texture(bumps, b[3] + t.y * (b0 + Y.y * b[1])).x;
    n.z = texture(bumps, b[3] + t.z * (b0 + Y.z * b[1])).x;
    n.w = texture(bumps, b[3] + t.w * (b0 + Y.w * b[1])).x;
    n = (255.0 * n + 0.5) / 256.0;
    // Bumps that lie between pixels would be seen as noise: smooth matter takes over.
    vec4 sharp = clamp(lump.z / max(t, 1e-6) - 1.0, 0.0, 1.0);
    return mix(vec4(1.0), lump.x * gathered(max(u, own), n), sharp);
}
#endif

#ifdef TINTED
vec3 hue(Column k, float Y) {
    vec2 at = on_texture(k, Y, k.to_center.x + k.to_center.y * Y);
    return textureLod(hues, vec3(at, k.hue), k.level).rgb;
}

void add_tinted(Splat p, Column k, vec4 direct, vec4 other, inout Pixels px) {
    vec3 a = hue(k, px.Y.x), b = hue(k, px.Y.y), c = hue(k, px.Y.z), d = hue(k, px.Y.w);
    vec4 red = vec4(a.r, b.r, c.r, d.r), green = vec4(a.g, b.g, c.g, d.g), blue = vec4(a.b, b.b, c.b, d.b);
    px.red += other * p.other.x * mix(red, vec4(1.0), k.veil) + direct * p.matter.x * red;
    px.green += other * p.other.y * mix(green, vec4(1.0), k.veil) + direct * p.matter.y * green;
    px.blue += other * p.other.z * mix(blue, vec4(1.0), k.veil) + direct * p.matter.z * blue;
}
#endif

Pixels look(float X, float first_row) {
    Pixels px;
    vec4 row = vec4(first_row) + vec4(0.5, 1.5, 2.5, 3.5);
    px.local = (1.0 - row / float(size.y) * 2.0) * tangent.y;
    px.Y = middle.y + px.local;
    px.per_d2 = 1.0 / (1.0 + X * X + px.Y * px.Y);
    vec4 per_d = sqrt(px.per_d2);
    vec3 a = vec3(X, px.Y.x, 1.0) * per_d.x, b = vec3(X, px.Y.y, 1.0) * per_d.y;
    vec3 c = vec3(X, px.Y.z, 1.0) * per_d.z, d = vec3(X, px.Y.w, 1.0) * per_d.w;
    if (fit.w > 0.0)
        px.phase = vec4(droplets(to_sun, a, fit), droplets(to_sun, b, fit), droplets(to_sun, c, fit),
                        droplets(to_sun, d, fit));
    else
        px.phase = is_cornette_shanks ? vec4(cornette_shanks(to_sun, a, g), cornette_shanks(to_sun, b, g),
                                             cornette_shanks(to_sun, c, g), cornette_shanks(to_sun, d, g))
                                      : vec4(henyey_greenstein(to_sun, a, g), henyey_greenstein(to_sun, b, g),
                                             henyey_greenstein(to_sun, c, g), henyey_greenstein(to_sun, d, g));
    px.left = vec4(1.0);
    px.red = px.green = px.blue = vec4(0.0);
    return px;
}

// Light from all sides falls off along a particle as it does along the line that was laid through it, but never ends.
void blend(Splat p, Column k, inout Pixels px) {
#ifdef INTERIOR
    // How far along its ray each pixel's closest point lies, in units of d.
    vec4 t = (k.along + (p.place.y + p.place.z * middle.y) * px.Y) * px.per_d2;
    vec4 up = p.place.y - p.place.z * px.local;
    vec4 over = p.place.x * px.local - p.place.y * k.local - middle.x * up - middle.y * k.aside;
    vec4 miss = (up * up + k.aside * k.aside + over * over) * p.place.w;
    vec4 tau = p.matter.w * exp(-miss * px.per_d2) *
               normal_cdf(t * inversesqrt(px.per_d2) * sqrt(2.0 * p.place.w));
#else
    vec4 off = px.local - k.y0;
    vec4 tau = p.matter.w * exp(-(k.a * off * off + k.m) * px.per_d2);
#endif
#ifdef DETAIL
#ifndef INTERIOR
    vec4 t = (k.along + (p.place.y + p.place.z * middle.y) * px.Y) * px.per_d2;
#endif
    tau *= detail_at(max(t, 0.0), k.X, px.Y, tau * (sqrt(2.0 * p.place.w) / gathered_below), k.looked_aside);
#endif
    vec4 alpha = one_minus_exp(tau);
#ifdef PAINTED
    if (k.layer >= 0.0)
        alpha = p.matter.w * vec4(opacity(k, px.Y.x), opacity(k, px.Y.y), opacity(k, px.Y.z), opacity(k, px.Y.w));
#endif
    vec4 weight = extinguish ? px.left * alpha : alpha;
    px.left -= px.left * alpha;
    vec4 direct = weight * clamp(k.direct.x + k.direct.y * px.Y, 0.0, 1.0) * px.phase;
    vec4 change = k.change.x + k.change.y * px.Y;
    change = mix(change, 1.0 / (2.0 - min(change, 1.0)), lessThan(change, vec4(1.0)));
    vec4 other = weight * min(change, p.other.w);
#ifdef TINTED
    if (k.layer >= 0.0) {
        add_tinted(p, k, direct, other, px);
        return;
    }
#endif
    px.red += other * p.other.x + direct * p.matter.x;
    px.green += other * p.other.y + direct * p.matter.y;
    px.blue += other * p.other.z + direct * p.matter.z;
}

void put(int at, float X, float Y, float per_d2, float left, vec3 color) {
    // More entries follow: the transmittance is kept in place of the opacity, and nothing is put behind.
    if (run.z == 0) {
        picture[at] = vec4(color, left);
        return;
    }
    float alpha = 1.0 - left;
    if (opaque) {
        float up = (vertical.x * X + vertical.y * Y + vertical.z) * sqrt(per_d2);
        color += left * sky_radiance(up, zenith, horizon);
        alpha = 1.0;
    }
    picture[at] = vec4(color, alpha);
}

void put(int at, int stride, float X, Pixels px) {
    put(at, X, px.Y.x, px.per_d2.x, px.left.x, vec3(px.red.x, px.green.x, px.blue.x));
    put(at + stride, X, px.Y.y, px.per_d2.y, px.left.y, vec3(px.red.y, px.green.y, px.blue.y));
    put(at + 2 * stride, X, px.Y.z, px.per_d2.z, px.left.z, vec3(px.red.z, px.green.z, px.blue.z));
    put(at + 3 * stride, X, px.Y.w, px.per_d2.w, px.left.w, vec3(px.red.w, px.green.w, px.blue.w));
}

void resume(int at, int stride, inout Pixels px) {
    vec4 a = picture[at], b = picture[at + stride], c = picture[at + 2 * stride], d = picture[at + 3 * stride];
    px.red = vec4(a.x, b.x, c.x, d.x);
    px.green = vec4(a.y, b.y, c.y, d.y);
    px.blue = vec4(a.z, b.z, c.z, d.z);
    px.left = vec4(a.w, b.w, c.w, d.w);
}

void main() {
    ivec2 tile = ivec2(gl_WorkGroupID.xy);
    ivec2 pixel = (region.xy + tile) * ivec2(8, 16) + ivec2(int(gl_LocalInvocationID.x), 0);
    float local = ((float(pixel.x) + 0.5) / float(size.x) * 2.0 - 1.0) * tangent.x;
    float X = middle.x + local;
    Pixels p0 = look(X, float(pixel.y)), p1 = look(X, float(pixel.y + 4));
    Pixels p2 = look(X, float(pixel.y + 8)), p3 = look(X, float(pixel.y + 12));

    int stride = region.z * 8;
    int at = tile.y * 16 * stride + tile.x * 8 + int(gl_LocalInvocationID.x);
    if (run.x > 0) {
        resume(at, stride, p0);
        resume(at + 4 * stride, stride, p1);
        resume(at + 8 * stride, stride, p2);
        resume(at + 12 * stride, stride, p3);
    }

    int list = tile.y * region.z + tile.x;
    uint first = tile_begin[list] + uint(run.x);
    uint end = min(tile_begin[list + 1], first + uint(run.y));
    for (uint i = first; i < end; ++i) {
        Splat p = fetch(int(tile_items[i]) * 5);
        Column k = on_column(p, local, p3.Y.w, p0.Y.x);
#ifdef DETAIL
        k.looked_aside = aside_of(tile_items[i]);
#endif
#ifdef PAINTED
        paint(int(tile_items[i]), p, k);
#endif
        blend(p, k, p0);
        blend(p, k, p1);
        blend(p, k, p2);
        blend(p, k, p3);
        if (extinguish && (i & 7u) == 7u) {
            vec4 rest = max(max(p0.left, p1.left), max(p2.left, p3.left));
            if (max(max(rest.x, rest.y), max(rest.z, rest.w)) < kOpaque) break;
        }
    }

    put(at, stride, X, p0);
    put(at + 4 * stride, stride, X, p1);
    put(at + 8 * stride, stride, X, p2);
    put(at + 12 * stride, stride, X, p3);
}
