// Optical depth and what follows from it, in float32 without cancellation or overflow. Written in what GLSL and C++
// with GLM have in common: the tests compile this text too (core/shaders/shared.h).

// 1 - exp(-tau), the share of light that matter of optical depth tau takes; tau >= 0. Relative error < 3e-6 for every
// tau. Below 1/32 by its series, since the difference would lose its digits there (3% at tau = 1e-6).
float one_minus_exp(float tau) {
    return tau < 0.03125f ? tau * (1.0f - tau * (0.5f - tau * (1.0f / 6.0f - tau * (1.0f / 24.0f)))) : 1.0f - exp(-tau);
}
vec4 one_minus_exp(vec4 tau) {
    vec4 series = tau * (1.0f - tau * (0.5f - tau * (1.0f / 6.0f - tau * (1.0f / 24.0f))));
    return mix(1.0f - exp(-tau), series, lessThan(tau, vec4(0.03125f)));
}

// Cumulative normal distribution by formula 7.1.26 of Abramowitz & Stegun 1964. Absolute error < 1e-7; relative to
// the smaller tail within 1e-3 for |x| < 4. The difference of two values is accurate where both arguments have the
// same sign; the far tail is never taken as 1 - erf.
vec4 normal_cdf(vec4 x) {
    vec4 z = abs(x) * 0.70710678f;
    vec4 t = 1.0f / (1.0f + 0.3275911f * z);
    vec4 tail = 0.5f * exp(-z * z) * t *
                (0.254829592f + t * (-0.284496736f + t * (1.421413741f + t * (-1.453152027f + t * 1.061405429f))));
    return mix(tail, 1.0f - tail, lessThan(vec4(0.0f), x));
}
