// Pass 1, step 2: running sums along the columns, from the light on. Each slab then holds the depth of all slabs up
// to it.
layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer Volume { vec2 volume[]; };

layout(location = 0) uniform ivec3 cells;

void main() {
    int column = int(gl_GlobalInvocationID.x);
    int stride = cells.x * cells.y;
    if (column >= stride) return;
    vec2 sum = vec2(0.0);
    for (int k = 0; k < cells.z; ++k) {
        sum += volume[column + k * stride];
        volume[column + k * stride] = sum;
    }
}
