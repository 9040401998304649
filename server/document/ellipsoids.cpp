// The fields of a cloud of model "ellipsoids".
#include "core/scene/ellipsoids.h"

#include "core/scene/limits.h"
#include "server/document/models.h"

namespace awan {
namespace {

using State = DraftInProgress;

constexpr const char* kPointWanted = "[x, y, z]: three numbers";

// --- rows

constexpr Field kEllipsoidsFields[] = {
    {.name = "texture", .wanted = "an object", .object = ObjectKind::kEllipsoidsTexture},
    {.name = "shading", .wanted = "an object", .object = ObjectKind::kEllipsoidsShading},
    {.name = "threshold",
     .wanted = "a number (of texture, T1)",
     .number = [](State& s, double v) { s.ellipsoids->translucence.threshold = v; }},
    {.name = "threshold_edge",
     .wanted = "a number (of texture, T2)",
     .number = [](State& s, double v) { s.ellipsoids->translucence.threshold_edge = v; }},
    {.name = "range",
     .wanted = "a number > 0 (of texture, D)",
     .number = [](State& s, double v) { s.ellipsoids->translucence.range = v; }},
    {.name = "plane",
     .wanted = R"(an object or "none")",
     .word =
         [](State&, std::string_view v) {
             return v == "none" ? WordOutcome::kTaken : WordOutcome::kUnknown;
         },
     .object = ObjectKind::kSkyPlane},
    {.name = "formations", .wanted = "a list of formations", .list = ListKind::kFormations},
    {.name = "ellipsoids", .wanted = "a list of ellipsoids", .list = ListKind::kEllipsoids},
    {.name = "drift",
     .wanted = "[x, y, z]: three numbers (units a second)",
     .vector = [](State& s) { return &s.ellipsoids->drift; }},
    {.name = "density",
     .wanted = "a number >= 0 (multiplies the cloud's)",
     .number = [](State& s, double v) { s.ellipsoids->density = v; }},
    {.name = "resolution",
     .wanted = "an integer from 8 to 160 (cells along the longest side)",
     .integer = [](State& s, std::uint64_t v) { s.ellipsoids->resolution = v; }},
};

// Of the texture that `Of` finds.
template <SineTexture& (*Of)(State&)>
constexpr Field kTextureFields[] = {
    {.name = "form",
     .wanted = R"("clean" or "printed")",
     .word =
         [](State& s, std::string_view v) {
             const bool printed = v == "printed";
             if (!printed && v != "clean") return WordOutcome::kUnknown;
             Of(s).form = printed ? TextureForm::kPrinted : TextureForm::kClean;
             return WordOutcome::kTaken;
         }},
    {.name = "terms",
     .wanted = "an integer from 1 to 8",
     .integer = [](State& s, std::uint64_t v) { Of(s).terms = v; }},
    {.name = "frequency_x",
     .wanted = "a number > 0 (radians/unit)",
     .number = [](State& s, double v) { Of(s).frequency_x = v; }},
    {.name = "frequency_z",
     .wanted = "a number > 0 (radians/unit)",
     .number = [](State& s, double v) { Of(s).frequency_z = v; }},
    {.name = "offset",
     .wanted = "a number >= 0 (T0)",
     .number = [](State& s, double v) { Of(s).offset = v; }},
};
SineTexture& texture_in_space(State& s) {
    return s.ellipsoids->texture;
}
SineTexture& texture_of_plane(State& s) {
    return s.ellipsoids->plane->texture;
}

constexpr Field kShadingFields[] = {
    {.name = "specular",
     .wanted = "a number from 0 to 1",
     .number = [](State& s, double v) { s.ellipsoids->shading.specular = v; }},
    {.name = "texture",
     .wanted = "a number from 0 to 1",
     .number = [](State& s, double v) { s.ellipsoids->shading.texture = v; }},
    {.name = "ambient",
     .wanted = "a number from 0 to 1",
     .number = [](State& s, double v) { s.ellipsoids->shading.ambient = v; }},
    {.name = "shininess",
     .wanted = "a number >= 1",
     .number = [](State& s, double v) { s.ellipsoids->shading.shininess = v; }},
};

constexpr Field kPlaneFields[] = {
    {.name = "altitude",
     .wanted = "a number",
     .number = [](State& s, double v) { s.ellipsoids->plane->altitude = v; }},
    {.name = "extent",
     .wanted = "a number > 0",
     .number = [](State& s, double v) { s.ellipsoids->plane->extent = v; }},
    {.name = "thickness",
     .wanted = "a number >= 0",
     .number = [](State& s, double v) { s.ellipsoids->plane->thickness = v; }},
    {.name = "threshold",
     .wanted = "a number (of texture, T1)",
     .number = [](State& s, double v) { s.ellipsoids->plane->threshold = v; }},
    {.name = "range",
     .wanted = "a number > 0 (of texture, D)",
     .number = [](State& s, double v) { s.ellipsoids->plane->range = v; }},
    {.name = "density",
     .wanted = "a number >= 0 (multiplies the cloud's)",
     .number = [](State& s, double v) { s.ellipsoids->plane->density = v; }},
    {.name = "resolution",
     .wanted = "an integer from 8 to 1000 (cells along a side)",
     .integer = [](State& s, std::uint64_t v) { s.ellipsoids->plane->resolution = v; }},
    {.name = "texture", .wanted = "an object", .object = ObjectKind::kPlaneTexture},
};

Formation& formation(State& s) {
    return s.ellipsoids->formations.back();
}
constexpr Field kFormationFields[] = {
    {.name = "kind",
     .wanted = R"(one of "horizontal", "vertical", "combined")",
     .word =
         [](State& s, std::string_view v) {
             FormationKind& kind = formation(s).kind;
             if (v == "horizontal") {
                 kind = FormationKind::kHorizontal;
             } else if (v == "vertical") {
                 kind = FormationKind::kVertical;
             } else if (v == "combined") {
                 kind = FormationKind::kCombined;
             } else {
                 return WordOutcome::kUnknown;
             }
             return WordOutcome::kTaken;
         }},
    {.name = "count",
     .wanted = "an integer >= 1",
     .integer = [](State& s, std::uint64_t v) { formation(s).count = v; }},
    {.name = "center",
     .wanted = kPointWanted,
     .vector = [](State& s) { return &formation(s).center; }},
    {.name = "radii",
     .wanted = kPointWanted,
     .vector = [](State& s) { return &formation(s).radii; }},
    {.name = "variation",
     .wanted = "a number from 0 to 0.9",
     .number = [](State& s, double v) { formation(s).variation = v; }},
    {.name = "link",
     .wanted = "a number from 0.05 to 0.95",
     .number = [](State& s, double v) { formation(s).link = v; }},
    {.name = "heading",
     .wanted = "a number (degrees)",
     .number = [](State& s, double v) { formation(s).heading = v; }},
    {.name = "spread",
     .wanted = "a number from 0 to 180 (degrees)",
     .number = [](State& s, double v) { formation(s).spread = v; }},
};

Ellipsoid& ellipsoid(State& s) {
    return s.ellipsoids->ellipsoids.back();
}
constexpr Field kEllipsoidFields[] = {
    {.name = "center",
     .wanted = kPointWanted,
     .required = true,
     .vector = [](State& s) { return &ellipsoid(s).center; }},
    {.name = "radii",
     .wanted = kPointWanted,
     .required = true,
     .vector = [](State& s) { return &ellipsoid(s).radii; }},
    {.name = "rotate_y",
     .wanted = "a number (degrees)",
     .number = [](State& s, double v) { ellipsoid(s).rotate_y = v; }},
    {.name = "threshold",
     .wanted = "a number (of texture, T1)",
     .number = [](State& s, double v) { ellipsoid(s).threshold = v; }},
    {.name = "threshold_edge",
     .wanted = "a number (of texture, T2)",
     .number = [](State& s, double v) { ellipsoid(s).threshold_edge = v; }},
    {.name = "range",
     .wanted = "a number > 0 (of texture, D)",
     .number = [](State& s, double v) { ellipsoid(s).range = v; }},
};

// --- writing

void integer(ObjectText& text, const char* field, std::uint64_t value, std::uint64_t standard) {
    if (value != standard) text.integer(field, value);
}

void write_texture(ObjectText& parent, const SineTexture& texture, const SineTexture& standard) {
    write_object(parent, "texture", [&](ObjectText& text) {
        if (texture.form != standard.form)
            text.text("form", texture.form == TextureForm::kPrinted ? "printed" : "clean");
        integer(text, "terms", texture.terms, standard.terms);
        text.number("frequency_x", texture.frequency_x, standard.frequency_x);
        text.number("frequency_z", texture.frequency_z, standard.frequency_z);
        text.number("offset", texture.offset, standard.offset);
    });
}

// A plane is there also where all of it is the default.
void write_plane(ObjectText& parent, const SkyPlane& plane) {
    const SkyPlane standard;
    std::string inner;
    ObjectText text(inner);
    text.number("altitude", plane.altitude, standard.altitude);
    text.number("extent", plane.extent, standard.extent);
    text.number("thickness", plane.thickness, standard.thickness);
    text.number("threshold", plane.threshold, standard.threshold);
    text.number("range", plane.range, standard.range);
    text.number("density", plane.density, standard.density);
    integer(text, "resolution", plane.resolution, standard.resolution);
    write_texture(text, plane.texture, standard.texture);
    text.end();
    parent.name("plane") += inner;
}

void append_formation(const Formation& one, std::string& out) {
    const Formation standard;
    ObjectText text(out);
    if (one.kind != standard.kind)
        text.text("kind", one.kind == FormationKind::kHorizontal ? "horizontal" : "vertical");
    integer(text, "count", one.count, standard.count);
    text.vector("center", one.center, standard.center);
    text.vector("radii", one.radii, standard.radii);
    text.number("variation", one.variation, standard.variation);
    text.number("link", one.link, standard.link);
    text.number("heading", one.heading, standard.heading);
    text.number("spread", one.spread, standard.spread);
    text.end();
}

void append_ellipsoid(const Ellipsoid& one, std::string& out) {
    ObjectText text(out);
    text.vector("center", one.center);
    text.vector("radii", one.radii);
    text.number("rotate_y", one.rotate_y, 0);
    if (one.threshold) text.number("threshold", *one.threshold);
    if (one.threshold_edge) text.number("threshold_edge", *one.threshold_edge);
    if (one.range) text.number("range", *one.range);
    text.end();
}

}  // namespace

std::span<const Field> ellipsoids_fields() {
    return kEllipsoidsFields;
}

std::span<const Field> ellipsoids_part_fields(ObjectKind kind) {
    switch (kind) {
        case ObjectKind::kEllipsoidsTexture:
            return kTextureFields<texture_in_space>;
        case ObjectKind::kPlaneTexture:
            return kTextureFields<texture_of_plane>;
        case ObjectKind::kEllipsoidsShading:
            return kShadingFields;
        case ObjectKind::kSkyPlane:
            return kPlaneFields;
        case ObjectKind::kFormation:
            return kFormationFields;
        case ObjectKind::kEllipsoid:
            return kEllipsoidFields;
        default:
            return {};
    }
}

const List& ellipsoids_list(ListKind kind) {
    static constexpr List kFormations{
        .wanted = "an object", .most = limits::kMaxEllipsoids, .object = ObjectKind::kFormation};
    static constexpr List kEllipsoids{
        .wanted = "an object", .most = limits::kMaxEllipsoids, .object = ObjectKind::kEllipsoid};
    return kind == ListKind::kFormations ? kFormations : kEllipsoids;
}

void write_ellipsoids(const EllipsoidsCloud& cloud, ObjectText& text) {
    const EllipsoidsCloud standard;
    write_texture(text, cloud.texture, standard.texture);
    write_object(text, "shading", [&](ObjectText& inner) {
        inner.number("specular", cloud.shading.specular, standard.shading.specular);
        inner.number("texture", cloud.shading.texture, standard.shading.texture);
        inner.number("ambient", cloud.shading.ambient, standard.shading.ambient);
        inner.number("shininess", cloud.shading.shininess, standard.shading.shininess);
    });
    const Translucence &own = cloud.translucence, &usual = standard.translucence;
    text.number("threshold", own.threshold, usual.threshold);
    text.number("threshold_edge", own.threshold_edge, usual.threshold_edge);
    text.number("range", own.range, usual.range);
    if (cloud.plane) write_plane(text, *cloud.plane);
    if (!cloud.formations.empty())
        write_list(text, "formations", cloud.formations, append_formation);
    if (!cloud.ellipsoids.empty())
        write_list(text, "ellipsoids", cloud.ellipsoids, append_ellipsoid);
    text.vector("drift", cloud.drift, standard.drift);
    text.number("density", cloud.density, standard.density);
    integer(text, "resolution", cloud.resolution, standard.resolution);
}

}  // namespace awan
