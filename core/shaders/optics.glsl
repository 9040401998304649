// Optical depth and what follows from it, in float32 without cancellation or overflow. Common subset of GLSL
// and C++ with GLM: the tests compile this text too (core/shaders/glsl_in_cpp.h).

// 1 - exp(-tau), tau >= 0. Relative error < 3e-6 for every tau: below 1/32 by series, since the difference would
// lose all digits (3% at tau = 1e-6).
float one_minus_exp(float tau) {
    return tau < 0.03125f ? tau * (1.0f - tau * (0.5f - tau * (1.0f / 6.0f - tau * (1.0f / 24.0f)))) : 1.0f - exp(-tau);
}
vec4 one_minus_exp(vec4 tau) {
    vec4 series = tau * (1.0f - tau * (0.5f - tau * (1.0f / 6.0f - tau * (1.0f / 24.0f))));
    return mix(1.0f - exp(-tau), series, lessThan(tau, vec4(0.03125f)));
}

// Cumulative normal distribution by Abramowitz & Stegun 7.1.26; absolute error < 1e-7, relative to the smaller tail
// too within 1e-3 for |x| < 4. Same-sign arguments only: no 1 - erf for the far tail.
vec4 normal_cdf(vec4 x) {
    vec4 z = abs(x) * 0.70710678f;
    vec4 t = 1.0f / (1.0f + 0.3275911f * z);
    vec4 tail = 0.5f * exp(-z * z) * t *
                (0.254829592f + t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
    return mix(tail, 1.0f - tail, lessThan(vec4(0.0f), x));
}
