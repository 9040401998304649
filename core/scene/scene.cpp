#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>

#include "core/base/exact_math.h"

namespace awan {
namespace {

// The cubes at the top of a document are those of its only cloud, if it says nothing else.
const std::vector<Cube>* top_cubes(const SceneDraft& scene) {
    if (!scene.top_level_cubes || scene.clouds.size() != 1) return nullptr;
    const Cloud& cloud = scene.clouds[0];
    const bool plain = cloud.model == CloudModel::kCubes && cloud.translate == glm::dvec3(0) &&
                       cloud.scale == 1 && cloud.rotate_y == 0 && cloud.velocity == glm::dvec3(0) &&
                       !cloud.fill && !cloud.density && !cloud.seed && !cloud.texture &&
                       !cloud.billboards;
    return plain ? &cloud.cubes : nullptr;
}

constexpr Field top_cubes_field() {
    Access a;
    a.holds = Holds::kObjects;
    a.optional = true;
    a.get = [](const void* o) -> const void* {
        return top_cubes(*static_cast<const SceneDraft*>(o));
    };
    a.member = a.get;
    a.put = [](void* o) -> void* {
        auto& scene = *static_cast<SceneDraft*>(o);
        scene.top_level_cubes = true;
        scene.clouds.assign(1, Cloud{});
        return &scene.clouds[0].cubes;
    };
    a.size = [](const void* l) { return static_cast<const std::vector<Cube>*>(l)->size(); };
    a.element = [](const void* l, std::size_t i) -> const void* {
        return &(*static_cast<const std::vector<Cube>*>(l))[i];
    };
    a.append = [](void* l) -> void* { return &static_cast<std::vector<Cube>*>(l)->emplace_back(); };
    a.table = &table_of<Cube>;
    return {{.name = "cubes",
             .wanted = "a list of cubes",
             .counts = at_most(limits::kMaxCubes),
             .says = "The cubes of one cloud. Either this or clouds."},
            a};
}

constexpr Field clouds_field() {
    Field made = field<&SceneDraft::clouds>({.name = "clouds",
                                             .wanted = "a list of clouds",
                                             .counts = at_most(limits::kMaxClouds),
                                             .says = "Several clouds. Either this or cubes."});
    made.access.optional = true;
    made.access.get = [](const void* o) -> const void* {
        const auto& scene = *static_cast<const SceneDraft*>(o);
        return top_cubes(scene) ? nullptr : &scene.clouds;
    };
    made.access.put = [](void* o) -> void* {
        auto& scene = *static_cast<SceneDraft*>(o);
        scene.top_level_cubes = false;
        return &scene.clouds;
    };
    return made;
}

constexpr Field kSceneFields[] = {
    // Covers top_level_cubes: how the clouds were written.
    top_cubes_field(),
    clouds_field(),
    field<&SceneDraft::fill>({.name = "fill",
                              .words = kFillWords,
                              .says = "How cubes are filled: uniform (centred, low-discrepancy), "
                                      "gardner (uniform and a phase-shift warp), "
                                      "printed (the equations as they were published), "
                                      "cumulus (domes on a flat base), stratus (a layer with "
                                      "round corners)."}),
    field<&SceneDraft::seed>(
        {.name = "seed",
         .wanted = "an integer from 0 to 18446744073709551615",
         .says = "Same scene and same seed: same particles, on every machine and thread count."}),
    field<&SceneDraft::texture>(
        {.name = "texture",
         .wanted = "the name of a texture",
         .says = "Of all clouds: their particles are billboards, squares that face the eye, "
                 "painted with it: soft, puff, cauliflower, torn, wisp, hard, one that was "
                 "uploaded, or a texture's hash.",
         .otherwise = "none"}),
    field<&SceneDraft::billboards>({.name = "billboards",
                                    .wanted = "an integer >= 0",
                                    .counts = at_most(limits::kMaxParticles),
                                    .says = "Billboards per box: how many each cube with a texture "
                                            "has, in the place of its particles.",
                                    .otherwise = "as many as particles"}),
    field<&SceneDraft::density>(
        {.name = "density",
         .wanted = R"(a number >= 0 (extinction, 1/unit) or "auto")",
         .range = from_to(0, limits::kMaxDensity),
         .absent = "auto",
         .unit = "1/unit",
         .says = "Peak extinction of a particle, 1/unit. \"auto\": cubes and ready "
                 "particles get what makes each cloud an optical depth of "
                 "some 40 through its middle, other models 0.2."}),
    field<&SceneDraft::medium>(
        {.name = "medium", .wanted = "an object", .says = "What the particles do with light."}),
    field<&SceneDraft::sun>({.name = "sun", .wanted = "an object", .says = "The sun."}),
    field<&SceneDraft::sky>(
        {.name = "sky",
         .wanted = R"(an object, "physical" or "none")",
         .says =
             "\"none\": black, and no light from it. \"physical\": {\"model\": \"physical\"}."}),
    field<&SceneDraft::ground>({.name = "ground",
                                .wanted = R"(an object or "none")",
                                .absent = "none",
                                .says =
                                    "A level, matt plane without end, seen from above only, and "
                                    "hills on it."}),
    field<&SceneDraft::haze>({.name = "haze",
                              .wanted = R"(an object or "none")",
                              .absent = "none",
                              .says = "Air that is seen."}),
    field<&SceneDraft::detail>({.name = "detail",
                                .wanted = R"(an object, "auto" or "none")",
                                .absent = "none",
                                .says = "Structure finer than the particles. \"auto\": amount 0.7, "
                                        "size 1.5, where its bumps take 16 pixels or more."}),
    field<&SceneDraft::camera>({.name = "camera",
                                .wanted = R"(an object or "auto")",
                                .says = "\"auto\": the whole cloud, three-quarter view."}),
    field<&SceneDraft::image>({.name = "image", .wanted = "an object", .says = "The picture."}),
    field<&SceneDraft::effects>({.name = "effects",
                                 .wanted = R"(an object or "auto")",
                                 .absent = "auto",
                                 .says = "What is simulated."}),
    field<&SceneDraft::accuracy>(
        {.name = "accuracy",
         .wanted = "an object",
         .says = "How accurate the picture is to be, or how fast; left out: error 0.1."}),
    field<&SceneDraft::look>(
        {.name = "look",
         .words = kLookWords,
         .says = "How the picture is made: by light as it is, or by the rules "
                 "of a published system: ostroushko for "
                 "clouds of model spheres, gardner for model ellipsoids, upchurch for "
                 "model automaton. A look has no rungs and no stated error, and "
                 "goes without accuracy."}),
    field<&SceneDraft::display>(
        {.name = "display",
         .words = kDisplayWords,
         .says =
             "What the picture shows: lit, the clouds by light; or, drawn flat, what they are "
             "made of: cubes, quads (textures on the cubes' faces), billboards, "
             "bounding_boxes, show_texture (each cube's texture by itself), ellipsoids (those of "
             "automata, and their grids' boundaries). Only lit has rungs and an error."}),
    field<&SceneDraft::time>(
        {.name = "time",
         .wanted = "a number (seconds)",
         .range = within(limits::kMaxTime),
         .unit = "seconds",
         .says = "Seconds: when the picture is of, where clouds move or change."}),
    field<&SceneDraft::sequence>(
        {.name = "sequence",
         .wanted = R"(an object or "none")",
         .absent = "none",
         .says = "The times that belong together. An automatic camera then holds the clouds at all "
                 "of them, unless `camera` moves it, and rung, "
                 "effects and detail are settled for all; a render is still of one time, `time`."}),
    outside_document<&SceneDraft::textures>(
        "files beside the document; what is used of them is told apart by its hash"),
    outside_document<&SceneDraft::relief>("follows from `ground`, and is kept to be made once"),
};
static_assert(covers<SceneDraft>(kSceneFields));

constexpr Table kSceneTable{
    .name = "Scene",
    .says =
        "The smallest scene is a layout; everything else has a default. "
        "Right-handed axes, y up; the unit of length is "
        "the scene's own; angles in degrees; colours linear, Rec. 709 "
        "primaries. At most 4194304 particles in all "
        "clouds together. Unknown fields, wrong types, values out of range and "
        "duplicate keys are errors that name "
        "the place.",
    .fields = kSceneFields,
    .standard = standard_of<SceneDraft>};
static_assert(limits::kMaxParticles == 4194304, "the prose above says it");

}  // namespace

template <>
const Table& table_of<SceneDraft>() {
    return kSceneTable;
}

std::optional<Effect> effect_from_name(std::string_view name) {
    for (int i = 0; i < kEffectCount; ++i)
        if (name == effect_name(static_cast<Effect>(i))) return static_cast<Effect>(i);
    return std::nullopt;
}

double clouds_time(const SceneDraft& scene) {
    return scene.sequence && scene.sequence->clouds_stand ? scene.sequence->from : scene.time;
}

std::optional<double> density_of(const SceneDraft& scene, const Cloud& cloud) {
    if (cloud.auto_density) return std::nullopt;
    return cloud.density ? cloud.density : scene.density;
}

Fill fill_of(const SceneDraft& scene, const Cloud& cloud) {
    return cloud.fill.value_or(scene.fill);
}

std::uint64_t seed_of(const SceneDraft& scene, const Cloud& cloud) {
    return cloud.seed.value_or(scene.seed);
}

glm::dvec3 sun_direction(const Sun& sun) {
    if (sun.direction) {
        // By the largest component first: the squares of 1e-200 would vanish.
        const glm::dvec3 d = *sun.direction;
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        return glm::normalize(d / largest);
    }
    // Exact at multiples of 90 degrees: a sun at the zenith or on an axis shines along it.
    const exact::SinCos elevation = exact::sincos_degrees(sun.elevation);
    const exact::SinCos azimuth = exact::sincos_degrees(sun.azimuth);
    // + 0.0: no negative zeros, which print as "-0".
    return glm::dvec3(elevation.cos * azimuth.sin, elevation.sin, elevation.cos * azimuth.cos) +
           0.0;
}

std::uint64_t particle_count(const SceneDraft& scene) {
    // Saturates, so that a sum over a draft nobody has checked cannot wrap to a small number.
    std::uint64_t total = 0;
    const auto add = [&total](std::uint64_t n) {
        total = n > std::numeric_limits<std::uint64_t>::max() - total
                    ? std::numeric_limits<std::uint64_t>::max()
                    : total + n;
    };
    for (const Cloud& cloud : scene.clouds) {
        if (cloud.model == CloudModel::kCubes)
            for (const Cube& cube : cloud.cubes) add(particles_of(scene, cloud, cube));
        else if (cloud.model == CloudModel::kParticles)
            add(cloud.ready.positions.size());
        else
            add(most_particles(cloud));
    }
    return total;
}

}  // namespace awan
