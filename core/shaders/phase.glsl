// Phase functions: how much light is scattered from one direction into another. Normalised so that the mean over the
// sphere is 1. Written in what GLSL and C++ with GLM have in common.
//
// to_light: unit, towards the light. ray: unit, from the eye outward. Light that goes straight on has to_light = ray.
// |g| < 1.

// 1 + g^2 - 2 g cos, without cancellation near cos = +-1 at g near +-1. For unit vectors a, b it is
//   (1 - |g|)^2 + |g| |a - b|^2   (g >= 0),    (1 - |g|)^2 + |g| |a + b|^2   (g < 0).
float phase_base(vec3 to_light, vec3 ray, float g) {
    vec3 apart = g >= 0.0f ? to_light - ray : to_light + ray;
    float rest = 1.0f - abs(g);
    return rest * rest + abs(g) * dot(apart, apart);
}

// Henyey & Greenstein 1941: p = (1 - g^2) / (1 + g^2 - 2 g cos)^1.5.
float henyey_greenstein(vec3 to_light, vec3 ray, float g) {
    float base = phase_base(to_light, ray, g);
    return (1.0f - abs(g)) * (1.0f + abs(g)) / (base * sqrt(base));
}

// Cornette & Shanks 1992: p = 3 (1 - g^2) / (2 (2 + g^2)) (1 + cos^2) / (1 + g^2 - 2 g cos)^1.5; at g = 0 Rayleigh's.
// Sunar et al. 2005 (3.14) prints (1 + g^2) for (2 + g^2), which is not normalised.
float cornette_shanks(vec3 to_light, vec3 ray, float g) {
    float cosine = dot(to_light, ray);
    return 1.5f * (1.0f + cosine * cosine) / (2.0f + g * g) * henyey_greenstein(to_light, ray, g);
}

// Droplets, by the fit of core/scene/droplets.h: fit.x and fit.y are g of the narrow and of the wide part, fit.z the
// wide part's alpha, fit.w its share. The wide part is Draine's: Henyey & Greenstein's times
//     (1 + alpha cos^2) / (1 + alpha (1 + 2 g^2) / 3).
float droplets(vec3 to_light, vec3 ray, vec4 fit) {
    float cosine = dot(to_light, ray);
    float wide = (1.0f + fit.z * cosine * cosine) / (1.0f + fit.z * (1.0f + 2.0f * fit.y * fit.y) / 3.0f);
    return (1.0f - fit.w) * henyey_greenstein(to_light, ray, fit.x) +
           fit.w * wide * henyey_greenstein(to_light, ray, fit.y);
}
