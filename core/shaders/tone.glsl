// The tone curve, the only place where scene radiance becomes a display value. Written in what GLSL and C++ with GLM
// have in common; core/formats/tone.cpp compiles this text.
//
// It is straight up to the knee: what is darker than half of display white keeps its radiance and its hue, so the
// blue of the sky stays as it was asked for and 0.18 stays mid grey. Above the knee comes the curve of Reinhard et
// al. 2002 (4), moved so that it leaves the knee with slope 1 and arrives at 1 exactly at kToneWhite: sunlit cloud
// keeps its shading, and only what is five times as bright as a sunlit white wall is plain white. It is to be applied
// to each channel by itself, which takes the tint out of highlights instead of leaving coloured whites.
//
// kToneKnee is display-linear; below it the curve is the identity.
const float kToneKnee = 0.5f;
// Exposed radiance that becomes display white.
const float kToneWhite = 8.0f;

// Where automatic exposure puts the sunlit side of a thick cloud, before the curve;
// tone_curve(1.6) is 0.85, 237 of 255 in sRGB: white, with room for what is brighter.
const float kMeteredLevel = 1.6f;

// Exposed radiance -> display-linear, 0..1. Rises everywhere up to kToneWhite. Less than 0 gives 0.
float tone_curve(float x) {
    if (x <= kToneKnee) return max(x, 0.0f);
    float t = (min(x, kToneWhite) - kToneKnee) / (1.0f - kToneKnee);
    float t_white = (kToneWhite - kToneKnee) / (1.0f - kToneKnee);
    return kToneKnee + (1.0f - kToneKnee) * t * (1.0f + t / (t_white * t_white)) / (1.0f + t);
}
