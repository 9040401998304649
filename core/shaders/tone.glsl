// The tone curves, the only place where scene radiance becomes a display value. Written in what GLSL and C++ with GLM
// have in common; core/formats/tone.cpp compiles this text.
//
// The scalar curve is straight up to the knee: what is darker than half of display white keeps its radiance and its
// hue, so the blue of the sky stays as it was asked for and 0.18 stays mid grey. Above the knee comes the curve of
// Reinhard et al. 2002 (4), moved so that it leaves the knee with slope 1 and arrives at 1 exactly at kToneWhite:
// sunlit cloud keeps its shading, and only what is eight times as bright as a sunlit cloud is plain white.
//
// kToneKnee is display-linear; below it the curve is the identity.
const float kToneKnee = 0.5f;
// Exposed radiance that becomes display white.
const float kToneWhite = 8.0f;

// Where automatic exposure puts the sunlit side of a thick cloud, before the curve; tone_curve(1.13) is 0.78, 229 of
// 255 in sRGB: white, where the curve is still steep, with two stops above it for brighter lumps and the rim of the
// sun.
const float kMeteredLevel = 1.13f;

// How fast a colour pales as the curve takes light away from it (Khronos 2024, the same figure).
const float kToneDesaturation = 0.15f;

// Exposed radiance -> display-linear, 0..1. Rises everywhere up to kToneWhite. Less than 0 gives 0.
float tone_curve(float x) {
    if (x <= kToneKnee) return max(x, 0.0f);
    float t = (min(x, kToneWhite) - kToneKnee) / (1.0f - kToneKnee);
    float t_white = (kToneWhite - kToneKnee) / (1.0f - kToneKnee);
    return kToneKnee + (1.0f - kToneKnee) * t * (1.0f + t / (t_white * t_white)) / (1.0f + t);
}

// Each channel by itself. Takes the tint out of highlights, but turns their hue on the way: orange becomes lemon.
vec3 tone_reinhard(vec3 color) {
    return vec3(tone_curve(color.r), tone_curve(color.g), tone_curve(color.b));
}

// After the neutral tone mapper of Khronos 2024: the curve is that of the brightest channel, the other two keep their
// proportion to it, and then all are mixed with white by how much the curve took away. So a colour keeps its hue
// however bright it is, and pales on its way to white. That mapper's own curve is another, and it takes .04 off what
// is dark, the reflection of a glossy surface, which no cloud has. Channels: 0 or more, finite.
vec3 tone_neutral(vec3 color) {
    float peak = max(color.r, max(color.g, color.b));
    if (peak <= kToneKnee) return color;
    float level = tone_curve(peak);
    float pale = 1.0f - 1.0f / (1.0f + kToneDesaturation * (peak - level));
    return mix(color * (level / peak), vec3(level), pale);
}
