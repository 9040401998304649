#include "core/scene/cloud.h"

#include "core/scene/automaton.h"
#include "core/scene/ellipsoids.h"
#include "core/scene/implicit.h"
#include "core/scene/spheres.h"

namespace awan {
namespace {

constexpr int of(CloudModel model) {
    return static_cast<int>(model);
}

constexpr Field kCloudFields[] = {
    field<&Cloud::model>(
        {.name = "model", .words = kCloudModelWords, .says = "What it is made of."}),
    field<&Cloud::cubes>({.name = "cubes",
                          .wanted = "a list of cubes",
                          .counts = at_most(limits::kMaxCubes),
                          .required = true,
                          .says = "Boxes of particles.",
                          .of_model = of(CloudModel::kCubes)}),
    field_within<&Cloud::ready, &ReadyParticles::positions>(
        {.name = "positions",
         .wanted = "a list of [x, y, z]",
         .range = within(limits::kMaxCoordinate),
         .counts = at_most(limits::kMaxParticles),
         .required = true,
         .unit = "units",
         .says = "[x, y, z], scene units.",
         .of_model = of(CloudModel::kParticles),
         .part_of = "ready"}),
    field_within<&Cloud::ready, &ReadyParticles::radii>(
        {.name = "radii",
         .wanted = "a list of numbers > 0",
         .range = from_to(limits::kMinRadius, limits::kMaxRadius),
         .counts = at_most(limits::kMaxParticles),
         .required = true,
         .unit = "units",
         .says = "As many as positions.",
         .of_model = of(CloudModel::kParticles),
         .part_of = "ready"}),
    field_within<&Cloud::ready, &ReadyParticles::densities>(
        {.name = "densities",
         .wanted = "a list of numbers >= 0",
         .range = from_to(0, limits::kMaxDensity),
         .counts = at_most(limits::kMaxParticles),
         .says = "Each multiplies the cloud's density; as many as positions, or left out: all 1.",
         .of_model = of(CloudModel::kParticles),
         .part_of = "ready"}),
    field_within<&Cloud::ready, &ReadyParticles::colors>(
        {.name = "colors",
         .wanted = "a list of [r, g, b]",
         .range = from_to(0, 1),
         .counts = at_most(limits::kMaxParticles),
         .says = "[r, g, b]; multiplies the albedo; as many as positions, or left out: all white.",
         .of_model = of(CloudModel::kParticles),
         .part_of = "ready"}),
    field<&Cloud::automaton>({.name = "automaton",
                              .wanted = "an object",
                              .required = true,
                              .says = "Of a cellular automaton.",
                              .of_model = of(CloudModel::kAutomaton)}),
    field<&Cloud::spheres>({.name = "spheres",
                            .wanted = "an object",
                            .required = true,
                            .says = "Spheres within spheres.",
                            .of_model = of(CloudModel::kSpheres)}),
    field<&Cloud::implicit>({.name = "implicit",
                             .wanted = "an object",
                             .required = true,
                             .says = "Implicit functions.",
                             .of_model = of(CloudModel::kImplicit)}),
    field<&Cloud::ellipsoids>({.name = "ellipsoids",
                               .wanted = "an object",
                               .required = true,
                               .says = "Textured ellipsoids and a sky plane.",
                               .of_model = of(CloudModel::kEllipsoids)}),
    field<&Cloud::translate>({.name = "translate",
                              .wanted = "[x, y, z]: three numbers",
                              .range = within(limits::kMaxCoordinate),
                              .unit = "units",
                              .says = "Where the model's origin stands, scene units."}),
    field<&Cloud::velocity>(
        {.name = "velocity",
         .wanted = "[x, y, z]: three numbers (units a second)",
         .range = within(limits::kMaxVelocity),
         .unit = "units a second",
         .says = "Scene units a second: at the scene's time it stands so much farther."}),
    field<&Cloud::scale>({.name = "scale",
                          .wanted = "a number > 0",
                          .range = from_to(limits::kMinScale, limits::kMaxScale),
                          .says = "Multiplies positions and radii; extinction (1/unit) stays."}),
    field<&Cloud::rotate_y>({.name = "rotate_y",
                             .wanted = "a number (degrees)",
                             .range = within(limits::kMaxAngle),
                             .unit = "degrees",
                             .says = "Degrees, from +z towards +x."}),
    field<&Cloud::fill>({.name = "fill",
                         .words = kFillWords,
                         .says = "Instead of the scene's, for this cloud.",
                         .otherwise = "the scene's"}),
    field_unless<&Cloud::density, &Cloud::auto_density>(
        {.name = "density",
         .wanted = R"(a number >= 0 (extinction, 1/unit) or "auto")",
         .range = from_to(0, limits::kMaxDensity),
         .absent = "auto",
         .unit = "1/unit",
         .says = "Peak extinction of a particle, or what the model's own density multiplies, "
                 "1/unit; instead of the scene's, for this cloud. \"auto\": what makes it, of any "
                 "model, an optical depth of some 24 in the mean along its thinnest axis (model "
                 "spheres has its own by meteorological_range).",
         .otherwise = "the scene's"}),
    field<&Cloud::seed>({.name = "seed",
                         .wanted = "an integer from 0 to 18446744073709551615",
                         .says = "Instead of the scene's, for this cloud.",
                         .otherwise = "the scene's"}),
    field<&Cloud::texture>({.name = "texture",
                            .wanted = "the name of a texture",
                            .says = "Of all its cubes, or of all its particles; instead of the "
                                    "scene's, for this cloud.",
                            .otherwise = "the scene's"}),
    field<&Cloud::billboards>({.name = "billboards",
                               .wanted = "an integer >= 0",
                               .counts = at_most(limits::kMaxParticles),
                               .says = "Billboards per box, of its cubes that have a texture; "
                                       "instead of the scene's, for this cloud.",
                               .otherwise = "the scene's",
                               .of_model = of(CloudModel::kCubes)}),
};
static_assert(covers<Cloud>(kCloudFields));
static_assert(covers_part<ReadyParticles>(kCloudFields, "ready"));

constexpr Table kCloudTable{
    .name = "Cloud",
    .says = "One cloud. A point p of the model stands at translate + rotate_y(scale * p).",
    .fields = kCloudFields,
    .standard = standard_of<Cloud>};

}  // namespace

template <>
const Table& table_of<Cloud>() {
    return kCloudTable;
}

bool is_procedural(const Cloud& cloud) {
    return cloud.model != CloudModel::kCubes && cloud.model != CloudModel::kParticles;
}

std::uint64_t most_particles(const Cloud& cloud) {
    if (cloud.automaton) return most_particles(*cloud.automaton);
    if (cloud.spheres) return most_particles(*cloud.spheres);
    if (cloud.implicit) return most_particles(*cloud.implicit);
    if (cloud.ellipsoids) return most_particles(*cloud.ellipsoids);
    return 0;
}

}  // namespace awan
