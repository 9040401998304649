// Pass 1, step 1: how much optical depth each slab of each column of a volume holds. The columns run from the light
// away.
//
// A column is one line from the light through one texel. Each particle adds its whole optical depth on that line (and
// its gain depth, see light/light.cpp), spread over the slabs as its mass is. Summed up along the column
// (light_sums.glsl), that is exactly the recurrence of Harris & Lastra 2001,
//   I_k = g_(k-1) + T_(k-1) I_(k-1),    T = exp(-tau),
// between particles, and within one the light falls off as its Gaussian does. Columns do not need each other, and the
// sums have no order to keep.
//
// A work group makes a brick of 8 x 8 texels and 8 slabs; a work item makes a row of 8 texels along v with all slabs.
// What is the same for a whole particle is then worked out once for 64 cells.
layout(local_size_x = 8) in;

// Two vec4s a particle. First: u, v of the centre (texels), its depth (slabs), 1 / (2 s^2) (texels^-2). Second: the
// optical depth through the centre, 1 / (2 kSpread s) (slabs^-1), and the two coefficients of gained() below. A
// buffer texture, since llvmpipe fetches a vec4 of it in a tenth of the time that four words of a storage buffer
// take.
layout(binding = 0) uniform samplerBuffer particles;
layout(std430, binding = 1) readonly buffer TileBegin { uint tile_begin[]; };
layout(std430, binding = 2) readonly buffer TileItems { uint tile_items[]; };
layout(std430, binding = 4) readonly buffer FilledTiles { uint filled_tiles[]; };
// Of each cell: its optical depth, and its gain depth.
layout(std430, binding = 3) buffer Volume { vec2 volume[]; };

// Cells of the volume: texels along u, texels along v, slabs.
layout(location = 0) uniform ivec3 cells;
// The tiles of this dispatch: first u, first v, count along u, count along v.
layout(location = 1) uniform ivec4 region;
// The first entry of the tiles' lists to add now, and how many.
layout(location = 2) uniform ivec2 run;

// The share of a Gaussian's mass that lies before depth z, where x = (z - centre) / (2 kSpread s). A smooth step
// takes the place of the error function; it stays within .02 of it.
vec4 share_before(vec4 x) {
    vec4 t = clamp(x + 0.5, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// The gain depth (gain_curve in light/light.cpp) of a line through a particle whose optical depth on that line is
// tau:
//   start tau / (1 + bend tau).
// It is exact for thin lines and for the line through the centre, and bounded as the exact one is. Between these it
// is within 2% for particles up to optical depth 1, and within 25% for any.
vec4 gained(vec4 tau, float start, float bend) { return start * tau / (1.0 + bend * tau); }

// What one slab of a row of 8 texels holds, as 4 + 4 texels along v: optical depth and gain depth.
struct Cells {
    vec4 plain_a, plain_b, gained_a, gained_b;
};

void add(inout Cells c, float share, vec4 plain_a, vec4 plain_b, vec4 gained_a, vec4 gained_b) {
    c.plain_a += share * plain_a;
    c.plain_b += share * plain_b;
    c.gained_a += share * gained_a;
    c.gained_b += share * gained_b;
}

void put(int at, vec2 depth) { volume[at] = run.x > 0 ? volume[at] + depth : depth; }

void put(int u, int v, int slab, vec4 plain, vec4 gain) {
    int at = (slab * cells.y + v) * cells.x + u;
    if (v < cells.y) put(at, vec2(plain.x, gain.x));
    if (v + 1 < cells.y) put(at + cells.x, vec2(plain.y, gain.y));
    if (v + 2 < cells.y) put(at + 2 * cells.x, vec2(plain.z, gain.z));
    if (v + 3 < cells.y) put(at + 3 * cells.x, vec2(plain.w, gain.w));
}

void put(int u, int v, int slab, Cells c) {
    put(u, v, slab, c.plain_a, c.gained_a);
    put(u, v + 4, slab, c.plain_b, c.gained_b);
}

void main() {
    int list = int(filled_tiles[gl_WorkGroupID.x]);
    ivec3 tile = ivec3(list % region.z, list / region.z % region.w, list / (region.z * region.w));
    int u = (region.x + tile.x) * 8 + int(gl_LocalInvocationID.x);
    int v = (region.y + tile.y) * 8;
    int slab = tile.z * 8;
    float texel_u = float(u);
    vec4 row_a = vec4(float(v)) + vec4(0.0, 1.0, 2.0, 3.0), row_b = row_a + 4.0;
    // Depths of the near sides of this slab, the one before and the six after it.
    vec4 side_a = vec4(float(slab)) + vec4(-1.0, 0.0, 1.0, 2.0), side_b = side_a + 4.0;
    Cells none = Cells(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    Cells c0 = none, c1 = none, c2 = none, c3 = none, c4 = none, c5 = none, c6 = none, c7 = none;

    uint first = tile_begin[list] + uint(run.x);
    uint end = min(tile_begin[list + 1], first + uint(run.y));
    for (uint i = first; i < end; ++i) {
        int at = int(tile_items[i]) * 2;
        vec4 place = texelFetch(particles, at);
        vec4 matter = texelFetch(particles, at + 1);
        float over = texel_u - place.x;
        vec4 up_a = row_a - place.y, up_b = row_b - place.y;
        vec4 plain_a = matter.x * exp(-(over * over + up_a * up_a) * place.w);
        vec4 plain_b = matter.x * exp(-(over * over + up_b * up_b) * place.w);
        vec4 gained_a = gained(plain_a, matter.z, matter.w), gained_b = gained(plain_b, matter.z, matter.w);
        vec4 before_a = share_before((side_a - place.z) * matter.y);
        vec4 before_b = share_before((side_b - place.z) * matter.y);
        float before_end = share_before(vec4((side_b.w + 1.0 - place.z) * matter.y)).x;
        add(c0, before_a.y - before_a.x, plain_a, plain_b, gained_a, gained_b);
        add(c1, before_a.z - before_a.y, plain_a, plain_b, gained_a, gained_b);
        add(c2, before_a.w - before_a.z, plain_a, plain_b, gained_a, gained_b);
        add(c3, before_b.x - before_a.w, plain_a, plain_b, gained_a, gained_b);
        add(c4, before_b.y - before_b.x, plain_a, plain_b, gained_a, gained_b);
        add(c5, before_b.z - before_b.y, plain_a, plain_b, gained_a, gained_b);
        add(c6, before_b.w - before_b.z, plain_a, plain_b, gained_a, gained_b);
        add(c7, before_end - before_b.w, plain_a, plain_b, gained_a, gained_b);
    }

    if (u >= cells.x) return;
    put(u, v, slab, c0);
    put(u, v, slab + 1, c1);
    put(u, v, slab + 2, c2);
    put(u, v, slab + 3, c3);
    put(u, v, slab + 4, c4);
    put(u, v, slab + 5, c5);
    put(u, v, slab + 6, c6);
    put(u, v, slab + 7, c7);
}
