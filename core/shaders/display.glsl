// Triangles for what is displayed instead of lit (draw/display.h). A vertex is three vec4s of a buffer texture: its
// place in clip coordinates, its colour (premultiplied), and of a texture the place and the layer, or -1 for none.

// A band of the picture: what y of the whole is multiplied by, and what is added to it.
layout(location = 0) uniform vec2 band;
layout(binding = 0) uniform samplerBuffer vertices;
layout(binding = 1) uniform sampler2DArray textures;
layout(binding = 2) uniform sampler2DArray hues;

#ifdef VERTEX
out vec4 color;
out vec3 place;

void main() {
    int at = gl_VertexID * 3;
    gl_Position = texelFetch(vertices, at);
    gl_Position.y = gl_Position.y * band.x + gl_Position.w * band.y;
    color = texelFetch(vertices, at + 1);
    place = texelFetch(vertices, at + 2).xyz;
}
#endif

#ifdef FRAGMENT
in vec4 color;
in vec3 place;
out vec4 shown;

void main() {
    float share = texture(textures, vec3(place.xy, max(place.z, 0.0))).x;
    vec4 hue = vec4(texture(hues, vec3(place.xy, max(place.z, 0.0))).rgb, 1.0);
    shown = color * (place.z < 0.0 ? vec4(1.0) : share * hue);
}
#endif
