// Writing a cloud of model "implicit".
#include "core/scene/implicit.h"
#include "server/document/models.h"

namespace awan {
namespace {

const char* name_of(ImplicitPreset preset) {
    constexpr const char* kNames[] = {"cumulus", "cirrus", "stratus", "mackerel", "creature"};
    return kNames[static_cast<std::size_t>(preset)];
}

const char* name_of(ImplicitShape shape) {
    constexpr const char* kNames[] = {"sphere", "ellipsoid", "cylinder", "segment"};
    return kNames[static_cast<std::size_t>(shape)];
}

// Lists of objects; left out when empty.
template <typename T, typename Members>
void objects(ObjectText& text, const char* field, const std::vector<T>& list, Members members) {
    if (list.empty()) return;
    write_list(text, field, list, [&](const T& value, std::string& out) {
        ObjectText object(out);
        members(value, object);
        object.end();
    });
}

void vectors(ObjectText& text, const char* field, const std::vector<glm::dvec3>& list) {
    if (list.empty()) return;
    write_list(text, field, list,
               [](const glm::dvec3& v, std::string& out) { append_json_vector(v, out); });
}

void write_key(const ImplicitKey& key, ObjectText& text) {
    text.number("time", key.time);
    if (key.center) text.vector("center", *key.center);
    if (key.radius) text.number("radius", *key.radius);
    if (key.weight) text.number("weight", *key.weight);
}

void write_primitive(const ImplicitPrimitive& p, ObjectText& text) {
    const ImplicitPrimitive standard;
    if (p.shape != standard.shape) text.text("shape", name_of(p.shape));
    text.vector("center", p.center, standard.center);
    text.number("radius", p.radius, standard.radius);
    text.vector("radii", p.radii, standard.radii);
    text.number("core", p.core, standard.core);
    vectors(text, "points", p.points);
    text.vector("rotate", p.rotate, standard.rotate);
    text.number("weight", p.weight, standard.weight);
    objects(text, "keys", p.keys, write_key);
}

void write_growth(const ImplicitGrowth& g, ObjectText& text) {
    const ImplicitGrowth standard;
    if (g.seeds != standard.seeds) text.integer("seeds", g.seeds);
    if (g.most != standard.most) text.integer("most", g.most);
    text.number("radius", g.radius, standard.radius);
    text.number("shrink", g.shrink, standard.shrink);
    text.number("weight", g.weight, standard.weight);
    text.vector("center", g.center, standard.center);
    text.vector("spread", g.spread, standard.spread);
    text.vector("velocity", g.velocity, standard.velocity);
    text.vector("force", g.force, standard.force);
    text.number("turbulence", g.turbulence, standard.turbulence);
    text.number("drag", g.drag, standard.drag);
    text.number("lifetime", g.lifetime, standard.lifetime);
    text.number("rate", g.rate, standard.rate);
    text.number("duration", g.duration, standard.duration);
}

void write_warps(const ImplicitCloud& cloud, ObjectText& text) {
    const ImplicitCloud standard;
    text.number("warp_from", cloud.warp_from, standard.warp_from);
    text.number("warp_to", cloud.warp_to, standard.warp_to);
    objects(text, "attractors", cloud.attractors, [](const ImplicitAttractor& a, ObjectText& one) {
        one.vector("at", a.at, glm::dvec3(0));
        one.number("strength", a.strength);
        one.number("reach", a.reach);
    });
    objects(text, "vortices", cloud.vortices, [](const ImplicitVortex& v, ObjectText& one) {
        one.vector("at", v.at, glm::dvec3(0));
        one.vector("axis", v.axis, glm::dvec3(0, 1, 0));
        one.number("angle", v.angle);
        one.number("reach", v.reach);
    });
    if (!cloud.flow) return;
    write_object(text, "flow", [&](ObjectText& one) {
        one.vector("min", cloud.flow->min);
        one.vector("max", cloud.flow->max);
        one.vector("size", cloud.flow->size);
        vectors(one, "vectors", cloud.flow->vectors);
    });
}

// An object that says nothing still says that it is there.
void write_growth_of(const ImplicitCloud& cloud, ObjectText& text) {
    if (!cloud.growth) return;
    std::string inner;
    ObjectText object(inner);
    write_growth(*cloud.growth, object);
    object.end();
    text.name("growth") += inner;
}

}  // namespace

void write_implicit(const ImplicitCloud& cloud, ObjectText& text) {
    const ImplicitCloud standard;
    const auto given = [&](const char* field, const std::optional<double>& value) {
        if (value) text.number(field, *value);
    };
    if (cloud.preset != standard.preset) text.text("preset", name_of(cloud.preset));
    if (cloud.primitives && cloud.primitives->empty()) text.name("primitives") += "[]";
    if (cloud.primitives) objects(text, "primitives", *cloud.primitives, write_primitive);
    if (!cloud.smooth_keys) text.text("interpolation", "linear");
    given("base", cloud.base);
    given("amount", cloud.amount);
    given("exponent", cloud.exponent);
    given("blend", cloud.blend);
    given("displacement", cloud.displacement);
    if (cloud.diagonal) text.text("displace", "diagonal");
    given("noise_size", cloud.noise_size);
    if (cloud.octaves) text.integer("octaves", *cloud.octaves);
    given("gain", cloud.gain);
    given("stretch", cloud.stretch);
    if (cloud.jet) text.vector("jet", *cloud.jet);
    given("jet_turbulence", cloud.jet_turbulence);
    write_warps(cloud, text);
    if (cloud.ripple) text.vector("ripple", *cloud.ripple);
    given("ripple_depth", cloud.ripple_depth);
    given("ripple_turbulence", cloud.ripple_turbulence);
    text.number("swirl", cloud.swirl, standard.swirl);
    if (cloud.printed_swirl) text.text("swirl_path", "printed");
    write_growth_of(cloud, text);
    if (cloud.resolution != standard.resolution) text.integer("resolution", cloud.resolution);
    text.number("threshold", cloud.threshold, standard.threshold);
}

}  // namespace awan
