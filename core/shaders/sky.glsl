// The sky behind the clouds. Written in what GLSL and C++ with GLM have in common.

// Radiance from a direction whose sine of elevation is `up`: a blend from the horizon's colour to the zenith's, half
// way at about 17 degrees. It is level at the horizon, so that there is no edge, and keeps the horizon's colour
// below.
vec3 sky_radiance(float up, vec3 zenith, vec3 horizon) {
    float high = max(up, 0.0f) * max(up, 0.0f);
    return mix(horizon, zenith, 1.09f * high / (high + 0.09f));
}

// The mean of sky_radiance over the upper hemisphere. The blend is 1.09 u^2 / (u^2 + .3^2), u uniform in 0..1; its
// mean is 1.09 (1 - .3 atan(1 / .3)).
vec3 sky_mean_above(vec3 zenith, vec3 horizon) { return mix(horizon, zenith, 0.6716560f); }
