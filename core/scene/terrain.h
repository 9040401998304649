// Hills on the ground: a height map over a square of it, of a picture that came beside the document or by seed
// (core/generate/relief.h). Beyond the square the ground is level, and towards its sides the hills run out into that.
// Like the ground it is seen from above only.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/scene/limits.h"
#include "core/scene/table.h"
#include "core/scene/texture.h"

namespace awan {

struct Terrain {
    // The name or the hash of a picture; none: hills of Awan's own.
    std::optional<std::string> map;
    double height = 1;
    double extent = 100;
    // Its y does not count.
    glm::dvec3 center{0};
    double size = 20;
    double roughness = 0.5;
    double level = 0;
    std::uint64_t seed = 1;
    // None: the ground's albedo, and no snow.
    std::optional<glm::dvec3> rock;
    std::optional<double> snow;
};

inline bool terrain_has_map(const void* terrain) {
    return static_cast<const Terrain*>(terrain)->map.has_value();
}

inline constexpr Field kTerrainFields[] = {
    field<&Terrain::map>({.name = "map",
                          .wanted = "the name or the hash of a picture",
                          .says =
                              "A picture as height map, black the lowest, by its luminance: one "
                              "that was uploaded (PUT /v1/textures/{name}) or comes in the "
                              "form, by name or hash. Its upper edge lies towards -z.",
                          .otherwise = "hills by seed"}),
    field<&Terrain::height>(
        {.name = "height",
         .wanted = "a number >= 0",
         .range = from_to(0, limits::kMaxLength),
         .required = true,
         .unit = "units",
         .says = "Of the highest place above the ground's own height; 0: none."}),
    field<&Terrain::extent>({.name = "extent",
                             .wanted = "a number > 0",
                             .range = from_to(limits::kMinLength, limits::kMaxLength),
                             .unit = "units",
                             .says = "Side of the square that it covers, of a picture the longer "
                                     "side. Over the outermost eighth it falls to the level "
                                     "ground beyond."}),
    field<&Terrain::center>({.name = "center",
                             .wanted = "an array of 3 numbers",
                             .range = within(limits::kMaxCoordinate),
                             .unit = "units",
                             .says = "Of the square; y does not count."}),
    field<&Terrain::size>({.name = "size",
                           .wanted = "a number > 0",
                           .range = from_to(limits::kMinLength, limits::kMaxLength),
                           .unit = "units",
                           .says = "From one large hill to the next, of hills by seed.",
                           .idle = terrain_has_map}),
    field<&Terrain::roughness>({.name = "roughness",
                                .wanted = "a number from 0 to 1",
                                .range = from_to(0, 1),
                                .says = "Of hills by seed: 0 smooth, 1 jagged.",
                                .idle = terrain_has_map}),
    field<&Terrain::level>({.name = "level",
                            .wanted = "a number from 0 to 0.95",
                            .range = from_to(0, limits::kMaxTerrainLevel),
                            .says =
                                "Share of the heights that lies below the level ground: valleys "
                                "that deep are flat, as if filled."}),
    field<&Terrain::seed>({.name = "seed",
                           .wanted = "an integer from 0 to 18446744073709551615",
                           .says = "Of hills by seed.",
                           .idle = terrain_has_map}),
    field<&Terrain::rock>({.name = "rock",
                           .wanted = "a number or [r, g, b], from 0 to 1",
                           .range = from_to(0, 1),
                           .one_for_all = true,
                           .says = "Albedo of its steep places, from 25 to 40 degrees on.",
                           .otherwise = "the ground's"}),
    field<&Terrain::snow>({.name = "snow",
                           .wanted = "a number",
                           .range = within(limits::kMaxLength),
                           .unit = "units",
                           .says = "From so high above the ground's own height on, places that are "
                                   "not steep are white.",
                           .otherwise = "nowhere"}),
};
static_assert(covers<Terrain>(kTerrainFields));

inline constexpr Table kTerrainTable{
    .name = "Terrain",
    .says =
        "Hills on the ground, over a square of it. They hide what is behind, take the clouds' "
        "shadows and their own, and are seen from above only.",
    .fields = kTerrainFields,
    .standard = standard_of<Terrain>};
template <>
inline const Table& table_of<Terrain>() {
    return kTerrainTable;
}

struct Relief;  // core/generate/relief.h

// Where a scene's relief is kept once somebody has asked for it; shared by all scenes that differ in other things only.
struct ReliefSlot {
    // What it is made from, as text; another key is another relief.
    std::string key;
    std::once_flag made;
    std::shared_ptr<const Relief> relief;
};

// The picture that came beside the document and that a terrain is made from; null: another, or none.
std::shared_ptr<const Texture> map_of(const SceneDraft& scene);

// What tells the terrain's picture from others: the hash of its heights, or that of one of Awan's own textures, whose
// depths are heights, too. "": there is none of that name, or it has none.
std::string_view map_hash(const SceneDraft& scene);

// Whether hills are to be drawn: the scene's ground has some, above 0, its light is followed (Look::kPhysical), and
// effect `terrain` is not switched off.
bool has_terrain(const SceneDraft& scene);

}  // namespace awan
