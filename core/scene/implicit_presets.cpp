// The presets of a cloud of model "implicit", and what an ImplicitCloud comes to with them.
#include <cmath>

#include "core/base/exact_math.h"
#include "core/scene/implicit.h"

namespace awan {
namespace {

// Places and radii below are in tens of metres, and a unit is kTen of them: 3.3 metres. With the default density, .2 a
// unit, a cumulus has then the extinction of a real one, .06 a metre, and is opaque.
constexpr double kTen = 3;

ImplicitPrimitive sphere(glm::dvec3 center, double radius, double weight = 1) {
    ImplicitPrimitive primitive;
    primitive.center = kTen * center;
    primitive.radius = kTen * radius;
    primitive.weight = weight;
    return primitive;
}

ImplicitPrimitive ellipsoid(glm::dvec3 center, double radius, glm::dvec3 radii, double weight = 1) {
    ImplicitPrimitive primitive = sphere(center, radius, weight);
    primitive.shape = ImplicitShape::kEllipsoid;
    primitive.radii = radii;
    return primitive;
}

ImplicitPrimitive segment(glm::dvec3 center, const std::vector<glm::dvec3>& points, double radius,
                          double weight = 1) {
    ImplicitPrimitive primitive = sphere(center, radius, weight);
    primitive.shape = ImplicitShape::kSegment;
    for (const glm::dvec3& p : points) primitive.points.push_back(kTen * p);
    return primitive;
}

// Nine spheres, as many as in the document's figure 9.2.
ImplicitSettings cumulus() {
    ImplicitSettings s;
    s.primitives = {sphere({-72, 0, 2}, 26),        sphere({-38, 6, -10}, 37, 1.1),
                    sphere({-4, 8, 10}, 39, 1.2),   sphere({34, 4, -6}, 37, 1.1),
                    sphere({68, -2, 6}, 26),        sphere({-32, 38, -4}, 31, 1.1),
                    sphere({-26, 66, -6}, 23, 1.1), sphere({20, 34, 0}, 29, 1.1),
                    sphere({30, 54, 4}, 19)};
    s.base = kTen * -8;
    s.amount = 0.4;
    s.exponent = 0.5;
    s.blend = 0.4;
    s.displacement = 0.7;
    s.noise_size = 0.6;
    s.octaves = 6;
    return s;
}

// A few filaments of an envelope each, drawn out along the wind.
ImplicitSettings cirrus() {
    ImplicitSettings s;
    s.primitives = {segment({-20, 0, -60}, {{-170, -6, -10}, {-40, 0, 0}, {90, 5, -14}}, 30, 0.9),
                    segment({20, 4, 0}, {{-190, -4, 14}, {0, 0, 0}, {170, 6, 22}}, 36, 1),
                    segment({-30, -2, 66}, {{-120, -4, 0}, {40, 2, 8}, {160, 8, -6}}, 28, 0.8),
                    ellipsoid({30, 2, 10}, 100, {1.7, 0.14, 0.95}, 0.35)};
    s.amount = 1.2;
    s.exponent = 3;
    s.blend = 0;
    s.displacement = 0.9;
    s.noise_size = 0.4;
    s.octaves = 6;
    s.stretch = 5;
    s.jet = {2.2, 0, 0.5};
    s.jet_turbulence = 1.5;
    return s;
}

ImplicitSettings stratus() {
    ImplicitSettings s;
    s.primitives = {ellipsoid({0, 0, 0}, 150, {1, 0.09, 0.8}, 1),
                    ellipsoid({-90, 2, 40}, 110, {1, 0.12, 0.7}, 0.8),
                    ellipsoid({95, -2, -45}, 120, {1, 0.1, 0.7}, 0.8)};
    s.amount = 0.5;
    s.exponent = 0.7;
    s.blend = 0.25;
    s.displacement = 0.1;
    s.noise_size = 0.45;
    s.octaves = 6;
    return s;
}

ImplicitSettings mackerel() {
    ImplicitSettings s;
    s.primitives = {ellipsoid({0, 0, 0}, 170, {1, 0.045, 0.85}, 1)};
    s.amount = 2;
    s.exponent = 1.6;
    s.blend = 0.3;
    s.displacement = 0.05;
    s.noise_size = 0.35;
    s.octaves = 6;
    s.ripple = {0.2, 0, 0.42};
    s.ripple_depth = 0.95;
    s.ripple_turbulence = 5;
    return s;
}

// Nine spheres as a long-tailed animal: body, neck, head, legs, tail.
ImplicitSettings creature() {
    ImplicitSettings s;
    s.primitives = {sphere({-10, 0, 0}, 40, 1.3),   sphere({26, 4, 0}, 38, 1.3),
                    sphere({56, 26, 0}, 24, 1.2),   sphere({76, 48, 0}, 27, 1.4),
                    sphere({100, 42, 0}, 15, 1.2),  sphere({-34, -34, 8}, 20, 1.2),
                    sphere({36, -34, -8}, 20, 1.2), sphere({-56, 14, 0}, 26, 1.1),
                    sphere({-84, 32, 0}, 18, 1.1)};
    s.amount = 0.4;
    s.exponent = 0.5;
    s.blend = 0.6;
    s.displacement = 0.35;
    s.noise_size = 0.9;
    s.octaves = 6;
    return s;
}

ImplicitSettings of_preset(ImplicitPreset preset) {
    switch (preset) {
        case ImplicitPreset::kCumulus:
            return cumulus();
        case ImplicitPreset::kCirrus:
            return cirrus();
        case ImplicitPreset::kStratus:
            return stratus();
        case ImplicitPreset::kMackerel:
            return mackerel();
        case ImplicitPreset::kCreature:
            return creature();
    }
    return cumulus();
}

// Of what makes primitives of its own, each counted once.
double mean_of_makers(const ImplicitCloud& cloud) {
    double sum = 0, count = 0;
    const auto add = [&](const auto& maker) {
        if (maker) sum += maker->radius, ++count;
    };
    add(cloud.growth), add(cloud.bubbles), add(cloud.billows), add(cloud.cells);
    if (!cloud.particles.empty()) {
        double radii = 0;
        for (const ImplicitParticle& row : cloud.particles) radii += row.radius;
        sum += radii / static_cast<double>(cloud.particles.size()), ++count;
    }
    return count > 0 ? sum / count : 1;
}

double mean_radius(const ImplicitSettings& settings, const ImplicitCloud& cloud) {
    double sum = 0;
    for (const ImplicitPrimitive& primitive : settings.primitives) {
        const glm::dvec3 r = primitive.radii;
        const bool scaled = primitive.shape == ImplicitShape::kEllipsoid;
        sum += primitive.radius * (scaled ? exact::cbrt(r.x * r.y * r.z) : 1.0) + primitive.core;
    }
    if (!settings.primitives.empty()) return sum / static_cast<double>(settings.primitives.size());
    return mean_of_makers(cloud);
}

}  // namespace

ImplicitSettings resolved(const ImplicitCloud& cloud) {
    ImplicitSettings s = of_preset(cloud.preset);
    if (cloud.primitives || makes_primitives(cloud)) {
        s.primitives = cloud.primitives.value_or(std::vector<ImplicitPrimitive>());
        s.base.reset();
    }
    if (cloud.base) s.base = cloud.base;
    s.amount = cloud.amount.value_or(s.amount);
    s.exponent = cloud.exponent.value_or(s.exponent);
    s.blend = cloud.blend.value_or(s.blend);
    s.displacement = cloud.displacement.value_or(s.displacement);
    s.noise_size = cloud.noise_size.value_or(s.noise_size);
    s.octaves = cloud.octaves.value_or(s.octaves);
    s.gain = cloud.gain.value_or(s.gain);
    s.stretch = cloud.stretch.value_or(s.stretch);
    s.jet = cloud.jet.value_or(s.jet);
    s.jet_turbulence = cloud.jet_turbulence.value_or(s.jet_turbulence);
    s.ripple = cloud.ripple.value_or(s.ripple);
    s.ripple_depth = cloud.ripple_depth.value_or(s.ripple_depth);
    s.ripple_turbulence = cloud.ripple_turbulence.value_or(s.ripple_turbulence);
    s.mean_radius = mean_radius(s, cloud);
    return s;
}

}  // namespace awan
