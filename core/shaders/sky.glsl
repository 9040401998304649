// The sky behind the clouds. Common subset of GLSL and C++ with GLM.

// Radiance from a direction whose sine of elevation is `up`: from the horizon's colour to the zenith's with the square
// root of the sine, so that most of the change is near the horizon. Below the horizon: the horizon's colour.
vec3 sky_radiance(float up, vec3 zenith, vec3 horizon) { return mix(horizon, zenith, sqrt(max(up, 0.0f))); }

// Mean of sky_radiance over the upper hemisphere: the mean of sqrt(up) for up uniform in 0..1 is 2/3.
vec3 sky_mean_above(vec3 zenith, vec3 horizon) { return mix(horizon, zenith, 2.0f / 3.0f); }
