// The fields of a cloud of model "implicit".
#include "core/scene/implicit.h"
#include "core/scene/limits.h"
#include "server/document/models.h"

namespace awan {
namespace {

using State = DraftInProgress;

ImplicitPrimitive& primitive(State& s) {
    return s.implicit->primitives->back();
}

// Names of an enumeration's values, in their order.
constexpr std::string_view kPresets[] = {"cumulus", "cirrus", "stratus", "mackerel", "creature"};
constexpr std::string_view kShapes[] = {"sphere", "ellipsoid", "cylinder", "segment"};

template <typename E, std::size_t N>
WordOutcome choose(std::string_view name, const std::string_view (&names)[N], E& value) {
    for (std::size_t i = 0; i < N; ++i)
        if (names[i] == name) {
            value = static_cast<E>(i);
            return WordOutcome::kTaken;
        }
    return WordOutcome::kUnknown;
}

// One of two words.
WordOutcome either(std::string_view name, std::string_view no, std::string_view yes, bool& value) {
    value = name == yes;
    return value || name == no ? WordOutcome::kTaken : WordOutcome::kUnknown;
}

constexpr const char* kVector = "[x, y, z]: three numbers";

constexpr Field kImplicitFields[] = {
    {.name = "preset",
     .wanted = R"(one of "cumulus", "cirrus", "stratus", "mackerel", "creature")",
     .word = [](State& s, std::string_view v) { return choose(v, kPresets, s.implicit->preset); }},
    {.name = "primitives", .wanted = "a list of primitives", .list = ListKind::kImplicitPrimitives},
    {.name = "interpolation",
     .wanted = R"("smooth" or "linear")",
     .word =
         [](State& s, std::string_view v) {
             return either(v, "linear", "smooth", s.implicit->smooth_keys);
         }},
    {.name = "base",
     .wanted = "a number (height of a flat base)",
     .number = [](State& s, double v) { s.implicit->base = v; }},
    {.name = "amount",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.implicit->amount = v; }},
    {.name = "exponent",
     .wanted = "a number > 0",
     .number = [](State& s, double v) { s.implicit->exponent = v; }},
    {.name = "blend",
     .wanted = "a number from 0 (turbulence) to 1 (primitives alone)",
     .number = [](State& s, double v) { s.implicit->blend = v; }},
    {.name = "displacement",
     .wanted = "a number >= 0 (mean radii)",
     .number = [](State& s, double v) { s.implicit->displacement = v; }},
    {.name = "displace",
     .wanted = R"("every_way" or "diagonal")",
     .word =
         [](State& s, std::string_view v) {
             return either(v, "every_way", "diagonal", s.implicit->diagonal);
         }},
    {.name = "noise_size",
     .wanted = "a number > 0 (of the largest bumps, mean radii)",
     .number = [](State& s, double v) { s.implicit->noise_size = v; }},
    {.name = "octaves",
     .wanted = "an integer from 1 to 10",
     .integer = [](State& s, std::uint64_t v) { s.implicit->octaves = v; }},
    {.name = "gain",
     .wanted = "a number from 0 to 1 (strength of an octave over that of the one before)",
     .number = [](State& s, double v) { s.implicit->gain = v; }},
    {.name = "stretch",
     .wanted = "a number >= 1 (of the noise along the jet stream)",
     .number = [](State& s, double v) { s.implicit->stretch = v; }},
    {.name = "jet",
     .wanted = "[x, y, z]: three numbers (mean radii)",
     .vector = [](State& s) { return &s.implicit->jet.emplace(); }},
    {.name = "jet_turbulence",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.implicit->jet_turbulence = v; }},
    {.name = "warp_from",
     .wanted = "a number (seconds)",
     .number = [](State& s, double v) { s.implicit->warp_from = v; }},
    {.name = "warp_to",
     .wanted = "a number (seconds)",
     .number = [](State& s, double v) { s.implicit->warp_to = v; }},
    {.name = "attractors", .wanted = "a list of attractors", .list = ListKind::kImplicitAttractors},
    {.name = "vortices", .wanted = "a list of vortices", .list = ListKind::kImplicitVortices},
    {.name = "flow", .wanted = "an object", .object = ObjectKind::kImplicitFlow},
    {.name = "ripple",
     .wanted = "[x, y, z]: three wavelengths (mean radii; 0: none)",
     .vector = [](State& s) { return &s.implicit->ripple.emplace(); }},
    {.name = "ripple_depth",
     .wanted = "a number from 0 to 1",
     .number = [](State& s, double v) { s.implicit->ripple_depth = v; }},
    {.name = "ripple_turbulence",
     .wanted = "a number >= 0 (radians)",
     .number = [](State& s, double v) { s.implicit->ripple_turbulence = v; }},
    {.name = "swirl",
     .wanted = "a number (frames a second)",
     .number = [](State& s, double v) { s.implicit->swirl = v; }},
    {.name = "swirl_path",
     .wanted = R"("steady" or "printed")",
     .word =
         [](State& s, std::string_view v) {
             return either(v, "steady", "printed", s.implicit->printed_swirl);
         }},
    {.name = "growth", .wanted = "an object", .object = ObjectKind::kImplicitGrowth},
    {.name = "resolution",
     .wanted = "an integer from 16 to 160 (cells along the longest side)",
     .integer = [](State& s, std::uint64_t v) { s.implicit->resolution = v; }},
    {.name = "threshold",
     .wanted = "a number from 0 to 0.5 (of the largest density)",
     .number = [](State& s, double v) { s.implicit->threshold = v; }},
};

constexpr Field kPrimitiveFields[] = {
    {.name = "shape",
     .wanted = R"(one of "sphere", "ellipsoid", "cylinder", "segment")",
     .word = [](State& s, std::string_view v) { return choose(v, kShapes, primitive(s).shape); }},
    {.name = "center", .wanted = kVector, .vector = [](State& s) { return &primitive(s).center; }},
    {.name = "radius",
     .wanted = "a number > 0",
     .number = [](State& s, double v) { primitive(s).radius = v; }},
    {.name = "radii",
     .wanted = "[x, y, z]: three numbers > 0 (times the radius)",
     .vector = [](State& s) { return &primitive(s).radii; }},
    {.name = "core",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { primitive(s).core = v; }},
    {.name = "points", .wanted = "a list of [x, y, z]", .list = ListKind::kImplicitPoints},
    {.name = "rotate",
     .wanted = "[x, y, z]: three numbers (degrees)",
     .vector = [](State& s) { return &primitive(s).rotate; }},
    {.name = "weight",
     .wanted = "a number",
     .number = [](State& s, double v) { primitive(s).weight = v; }},
    {.name = "keys", .wanted = "a list of keys", .list = ListKind::kImplicitKeys},
};

constexpr Field kKeyFields[] = {
    {.name = "time",
     .wanted = "a number (seconds)",
     .required = true,
     .number = [](State& s, double v) { primitive(s).keys.back().time = v; }},
    {.name = "center",
     .wanted = kVector,
     .vector = [](State& s) { return &primitive(s).keys.back().center.emplace(); }},
    {.name = "radius",
     .wanted = "a number > 0",
     .number = [](State& s, double v) { primitive(s).keys.back().radius = v; }},
    {.name = "weight",
     .wanted = "a number",
     .number = [](State& s, double v) { primitive(s).keys.back().weight = v; }},
};

constexpr const char* kCount = "an integer from 1 to 500";

constexpr Field kGrowthFields[] = {
    {.name = "seeds",
     .wanted = kCount,
     .integer = [](State& s, std::uint64_t v) { s.implicit->growth->seeds = v; }},
    {.name = "most",
     .wanted = kCount,
     .integer = [](State& s, std::uint64_t v) { s.implicit->growth->most = v; }},
    {.name = "radius",
     .wanted = "a number > 0",
     .number = [](State& s, double v) { s.implicit->growth->radius = v; }},
    {.name = "shrink",
     .wanted = "a number from 0.1 to 1",
     .number = [](State& s, double v) { s.implicit->growth->shrink = v; }},
    {.name = "weight",
     .wanted = "a number",
     .number = [](State& s, double v) { s.implicit->growth->weight = v; }},
    {.name = "center",
     .wanted = kVector,
     .vector = [](State& s) { return &s.implicit->growth->center; }},
    {.name = "spread",
     .wanted = "[x, y, z]: three numbers >= 0 (radii)",
     .vector = [](State& s) { return &s.implicit->growth->spread; }},
    {.name = "velocity",
     .wanted = "[x, y, z]: three numbers (radii a second)",
     .vector = [](State& s) { return &s.implicit->growth->velocity; }},
    {.name = "force",
     .wanted = "[x, y, z]: three numbers (radii a second, each second)",
     .vector = [](State& s) { return &s.implicit->growth->force; }},
    {.name = "turbulence",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.implicit->growth->turbulence = v; }},
    {.name = "drag",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.implicit->growth->drag = v; }},
    {.name = "lifetime",
     .wanted = "a number > 0 (seconds)",
     .number = [](State& s, double v) { s.implicit->growth->lifetime = v; }},
    {.name = "rate",
     .wanted = "a number >= 0 (children a second)",
     .number = [](State& s, double v) { s.implicit->growth->rate = v; }},
    {.name = "duration",
     .wanted = "a number > 0 (seconds)",
     .number = [](State& s, double v) { s.implicit->growth->duration = v; }},
};

constexpr Field kAttractorFields[] = {
    {.name = "at",
     .wanted = kVector,
     .vector = [](State& s) { return &s.implicit->attractors.back().at; }},
    {.name = "strength",
     .wanted = "a number",
     .required = true,
     .number = [](State& s, double v) { s.implicit->attractors.back().strength = v; }},
    {.name = "reach",
     .wanted = "a number > 0",
     .required = true,
     .number = [](State& s, double v) { s.implicit->attractors.back().reach = v; }},
};

constexpr Field kVortexFields[] = {
    {.name = "at",
     .wanted = kVector,
     .vector = [](State& s) { return &s.implicit->vortices.back().at; }},
    {.name = "axis",
     .wanted = kVector,
     .vector = [](State& s) { return &s.implicit->vortices.back().axis; }},
    {.name = "angle",
     .wanted = "a number (degrees)",
     .required = true,
     .number = [](State& s, double v) { s.implicit->vortices.back().angle = v; }},
    {.name = "reach",
     .wanted = "a number > 0",
     .required = true,
     .number = [](State& s, double v) { s.implicit->vortices.back().reach = v; }},
};

constexpr Field kFlowFields[] = {
    {.name = "min",
     .wanted = kVector,
     .required = true,
     .vector = [](State& s) { return &s.implicit->flow->min; }},
    {.name = "max",
     .wanted = kVector,
     .required = true,
     .vector = [](State& s) { return &s.implicit->flow->max; }},
    {.name = "size",
     .wanted = "[x, y, z]: three whole numbers, how many vectors along each axis",
     .required = true,
     .vector = [](State& s) { return &s.implicit->flow->size; }},
    {.name = "vectors",
     .wanted = "a list of [x, y, z]",
     .required = true,
     .list = ListKind::kImplicitVectors},
};

}  // namespace

std::span<const Field> implicit_fields(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::kImplicitPrimitive:
            return kPrimitiveFields;
        case ObjectKind::kImplicitKey:
            return kKeyFields;
        case ObjectKind::kImplicitGrowth:
            return kGrowthFields;
        case ObjectKind::kImplicitAttractor:
            return kAttractorFields;
        case ObjectKind::kImplicitVortex:
            return kVortexFields;
        case ObjectKind::kImplicitFlow:
            return kFlowFields;
        default:
            return kImplicitFields;
    }
}

const List& implicit_list(ListKind kind) {
    static constexpr List kPrimitives{.wanted = "an object",
                                      .most = limits::kMaxImplicitElements,
                                      .object = ObjectKind::kImplicitPrimitive};
    // A skeleton of n pieces has n + 1 points.
    static constexpr List kPoints{
        .wanted = kVector,
        .most = limits::kMaxImplicitElements + 1,
        .row = [](State& s, const glm::dvec3& v) { primitive(s).points.push_back(v); }};
    static constexpr List kKeys{.wanted = "an object",
                                .most = limits::kMaxImplicitKeys,
                                .object = ObjectKind::kImplicitKey};
    static constexpr List kAttractors{.wanted = "an object",
                                      .most = limits::kMaxImplicitWarps,
                                      .object = ObjectKind::kImplicitAttractor};
    static constexpr List kVortices{.wanted = "an object",
                                    .most = limits::kMaxImplicitWarps,
                                    .object = ObjectKind::kImplicitVortex};
    static constexpr List kVectors{
        .wanted = kVector,
        .most = limits::kMaxFlowVectors,
        .row = [](State& s, const glm::dvec3& v) { s.implicit->flow->vectors.push_back(v); }};
    switch (kind) {
        case ListKind::kImplicitPoints:
            return kPoints;
        case ListKind::kImplicitKeys:
            return kKeys;
        case ListKind::kImplicitAttractors:
            return kAttractors;
        case ListKind::kImplicitVortices:
            return kVortices;
        case ListKind::kImplicitVectors:
            return kVectors;
        default:
            return kPrimitives;
    }
}

void begin_implicit(ObjectKind kind, ImplicitCloud& cloud) {
    switch (kind) {
        case ObjectKind::kImplicitPrimitive:
            if (!cloud.primitives) cloud.primitives.emplace();
            cloud.primitives->emplace_back();
            break;
        case ObjectKind::kImplicitKey:
            cloud.primitives->back().keys.emplace_back();
            break;
        case ObjectKind::kImplicitGrowth:
            cloud.growth.emplace();
            break;
        case ObjectKind::kImplicitAttractor:
            cloud.attractors.emplace_back();
            break;
        case ObjectKind::kImplicitVortex:
            cloud.vortices.emplace_back();
            break;
        case ObjectKind::kImplicitFlow:
            cloud.flow.emplace();
            break;
        default:
            break;
    }
}

}  // namespace awan
